//! `cargo bench --package equipod-benches --features divan --bench closure`: exact closure polynomials of random
//! members of the topologies that have one.

use divan::Bencher;
use equipod::methods::bench::{Class, LengthsFrom, Planar, Problem, problem};
use equipod::methods::distance::{ClosurePolynomial, closure_polynomial, generic_degrees, plans};
use equipod::methods::poly::{complex_roots, real_roots};
use equipod::methods::topology::{NamedTopology, Sequence, catalogue};

fn main() {
    divan::main();
}

/// The topologies that need at most one virtual leg.
fn names() -> Vec<String> {
    let solvable = catalogue().into_iter().filter(|n| n.topology().trilateration().virtual_legs.len() < 2);
    solvable.map(NamedTopology::id).collect()
}

fn named(id: &str) -> Option<NamedTopology> {
    catalogue().into_iter().find(|n| n.id() == id)
}

fn member(id: &str) -> Option<(Problem, Sequence)> {
    let class = Class::Topology { topology: named(id)?, planar: Planar::Neither };
    let p = problem(class, LengthsFrom::Pose, 1, 0).ok()?;
    let plan = plans(&p.manipulator, 1).ok()?.into_iter().next()?;
    Some((p, plan))
}

fn polynomial((p, plan): &(Problem, Sequence)) -> Option<ClosurePolynomial> {
    closure_polynomial(&p.manipulator, &p.squares, plan).ok()
}

/// With its real roots, isolated.
#[divan::bench(args = names(), sample_count = 10)]
fn exact(bencher: Bencher, id: &str) {
    let member = member(id);
    bencher.bench_local(|| member.as_ref().map(polynomial));
}

#[divan::bench(args = ["T04", "T22", "T03", "T14"], sample_count = 10)]
fn real_roots_alone(bencher: Bencher, id: &str) {
    let found = member(id).as_ref().and_then(polynomial);
    bencher.bench_local(|| found.as_ref().map(|c| real_roots(&c.polynomial)));
}

#[divan::bench(args = ["T04", "T22", "T03", "T14"], sample_count = 10)]
fn complex_roots_to_60_bits(bencher: Bencher, id: &str) {
    let found = member(id).as_ref().and_then(polynomial);
    bencher.bench_local(|| found.as_ref().map(|c| complex_roots(&c.polynomial, 60)));
}

#[divan::bench(args = ["T04", "T22", "T03", "T14"], sample_count = 10)]
fn degrees(bencher: Bencher, id: &str) {
    let topology = named(id).map(NamedTopology::topology);
    bencher.bench_local(|| topology.map(|t| generic_degrees(&t.legs(), &t.trilateration(), 1)));
}
