//! The two examples of Porta and Thomas by their exact closure polynomials, against the certified poses.

use super::cli_frame::{document, equipod};
use equipod::methods::design::{Design, Format, parse};
use equipod::methods::distance::{closure_degrees, closure_polynomial, plans};
use equipod::methods::fk::{
    Closure, Completeness, FkOptions, FkSolutions, ForwardKinematics, Homotopy, closure,
};
use equipod::methods::manipulator::{Leg, Manipulator, SquaredLegLengths};
use equipod::methods::poly::{RealRoot, complex_roots};

fn design(name: &str) -> Design {
    let path = format!("{}/designs/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    parse(&std::fs::read_to_string(path).unwrap(), Format::Toml).unwrap().0
}

fn solve(m: &Manipulator, s: &SquaredLegLengths) -> (FkSolutions, Closure) {
    let found = Homotopy.solve(m, s, &FkOptions::default()).unwrap();
    assert!(
        matches!(found.completeness, Completeness::Proved { .. })
            && found.roots.iter().all(equipod::methods::fk::FkRoot::certified)
    );
    let closure = closure(m, s, &found).unwrap();
    (found, closure)
}

/// Finite and real poses of both, and the real poses proved by the polynomial.
fn counts(m: &Manipulator, s: &SquaredLegLengths) -> (usize, usize, Option<usize>) {
    let (found, closure) = solve(m, s);
    assert_eq!(closure.degrees.after, found.roots.len());
    (found.roots.len(), found.assembly_modes().count(), closure.real_count())
}

#[test]
fn the_decoupled_example_has_ten_real_poses_of_sixteen() {
    let d = design("porta-thomas-1");
    let (m, s) = (d.manipulator(), d.lengths.unwrap().squared());
    assert_eq!(counts(m, &s), (16, 10, Some(10)));
    // the polynomial in s_bg of the paper, from degree 40
    let (b, g) = (joint(d.base_names(), "b"), joint(d.platform_names(), "g"));
    let plan = plans(m, 1).unwrap().into_iter().find(|p| p.virtual_legs == [(b, g)]).unwrap();
    let c = closure_polynomial(m, &s, &plan).unwrap();
    let degrees = closure_degrees(m, &s, &plan).unwrap();
    assert_eq!((degrees.before, degrees.after, c.real_roots.len()), (40, 16, 10));
    let sum: f64 = complex_roots(&c.polynomial, 60).unwrap().iter().map(|z| z.to_complex64().re).sum();
    assert!((sum - 1827.466).abs() < 5e-4, "{sum}");
}

#[test]
fn the_coupled_example_has_ten_real_poses_as_printed_and_eight_with_exact_squares() {
    let d = design("innocenti-6-4");
    let m = d.manipulator();
    assert_eq!(counts(m, &d.lengths.unwrap().squared()), (32, 10, Some(10)));
    let exact = SquaredLegLengths::try_new([33.0, 11.0, 21.0, 29.0, 22.0, 21.0]).unwrap();
    assert_eq!(counts(m, &exact), (32, 8, Some(8)));
    // two of the eight are nearly one, in s_be
    let (b, e) = (joint(d.base_names(), "b"), joint(d.platform_names(), "e"));
    let plan = plans(m, 1).unwrap().into_iter().find(|p| p.virtual_legs == [(b, e)]).unwrap();
    let degrees = closure_degrees(m, &exact, &plan).unwrap();
    assert_eq!((degrees.before, degrees.after), (200, 32));
    let roots: Vec<f64> =
        closure_polynomial(m, &exact, &plan).unwrap().real_roots.iter().map(RealRoot::to_f64).collect();
    assert_eq!(roots[2].to_bits(), 18f64.to_bits(), "the home pose");
    assert!((roots[6] - 24.267_296).abs() < 1e-6 && (roots[7] - 24.290_641).abs() < 1e-6, "{roots:?}");
    // every real pose is over its own root
    let leg = Leg { base: m.base_joints()[b], platform: m.platform_joints()[e] };
    let (found, _) = solve(m, &exact);
    let mut values: Vec<f64> =
        found.assembly_modes().map(|r| r.pose.real_part().squared_length(&leg)).collect();
    values.sort_by(f64::total_cmp);
    assert!(values.iter().zip(&roots).all(|(v, r)| (v - r).abs() < 1e-9));
}

#[test]
fn nothing_is_claimed_without_the_number_of_all_poses() {
    let d = design("innocenti-6-4");
    let (m, s) = (d.manipulator(), d.lengths.unwrap().squared());
    let mut found = Homotopy.solve(m, &s, &FkOptions::default()).unwrap();
    found.completeness = Completeness::unproved([]);
    assert_eq!(closure(m, &s, &found).unwrap().real_count(), None);
    // nor with a wrong number
    let mut found = Homotopy.solve(m, &s, &FkOptions::default()).unwrap();
    found.roots.pop();
    assert_eq!(closure(m, &s, &found).unwrap().real_count(), None);
}

#[test]
fn the_command_shows_the_closure_polynomial() {
    let doc =
        document(&equipod(&["fk", "designs/innocenti-6-4.toml", "--method", "trilateration", "--json"]));
    let c = &doc["closure"];
    assert_eq!((doc["method"].as_str(), doc["real_count"].as_u64()), (Some("trilateration"), Some(10)));
    let numbers =
        ["degree_before", "degree", "distinct_roots", "poses_real_proved"].map(|k| c[k].as_u64().unwrap());
    assert_eq!(numbers, [200, 32, 32, 10]);
    assert_eq!(c["coefficients"].as_array().unwrap().len(), 33);
    assert_eq!((c["virtual_leg"].as_array().unwrap().len(), c["sequence"].as_array().unwrap().len()), (2, 7));
    let roots = c["real_roots"].as_array().unwrap();
    assert_eq!(roots.len(), 10);
    for r in roots {
        let (low, high) = (r[0].as_f64().unwrap(), r[1].as_f64().unwrap());
        assert!(low < high && high - low < 1e-13 * high);
    }
    // both bodies planar: mirror pairs, told apart by the height
    let out = equipod(&["fk", "tests/fixtures/planar-doubles.toml", "--method", "trilateration", "--json"]);
    let doc = document(&out);
    assert_eq!(
        (doc["finite_count"].as_u64(), doc["closure"]["poses_real_proved"].as_u64()),
        (Some(16), Some(12))
    );
    let text = equipod(&["fk", "designs/porta-thomas-1.toml", "--method", "trilateration"]);
    assert!(String::from_utf8_lossy(&text.stdout).contains("real poses: 10, proved by its real roots"));
    // other methods say nothing of it
    let doc = document(&equipod(&["fk", "designs/innocenti-6-4.toml", "--json"]));
    assert!(doc.get("closure").is_none());
}

/// The octic of the octahedral platform in each of its three distances, that of the paper with its printed roots
/// (Rojas, Borras, Thomas, eq. 10).
#[test]
fn the_unknown_of_the_closure_polynomial_can_be_chosen() {
    let between = |design: &str, pair: &str| document(&equipod(&["fk", design, "--between", pair, "--json"]));
    let octahedral = "designs/rbt-octahedral.toml";
    let printed = [269.2450856, 328.7364309, 359.5275017, 463.5657697, 497.902151, 513.0332445];
    let c = &between(octahedral, "P1,P5")["closure"];
    assert_eq!((&c["unknown"], &c["degree"]), (&serde_json::json!(["P1", "P5"]), &8.into()));
    for (root, printed) in c["real_roots"].as_array().unwrap().iter().zip(printed) {
        assert!((root[0].as_f64().unwrap() - printed).abs() < 1e-6, "{root} {printed}");
    }
    for pair in ["P4,P3", "P2,P6"] {
        let c = &between(octahedral, pair)["closure"];
        assert_eq!((&c["degree"], c["real_roots"].as_array().map(Vec::len)), (&8.into(), Some(6)), "{pair}");
    }
    // the unknown of the paper's first example; its printed polynomial has another sum of roots
    let c = &between("designs/porta-thomas-1.toml", "b,g")["closure"];
    let parts = |k: usize| {
        let digits = c["coefficients"][k].as_str().unwrap();
        let (sign, digits) = digits.strip_prefix('-').map_or((1.0, digits), |rest| (-1.0, rest));
        (sign * format!("0.{digits}").parse::<f64>().unwrap(), i32::try_from(digits.len()).unwrap())
    };
    let ((x, of_x), (y, of_y)) = (parts(15), parts(16));
    let sum = -x / y * 10f64.powi(of_x - of_y);
    assert!(c["degree"] == 16 && (sum - 1827.466).abs() < 1e-3, "{sum}");
    // distances that place no joint have a polynomial from all poses; given ones have none
    let c = &between("designs/innocenti-6-4.toml", "k,d")["closure"];
    assert!(c["no_sequence"].as_str().unwrap().contains("cannot be placed one by one"), "{c}");
    assert_eq!((&c["degree"], &c["coefficients_known"]), (&32.into(), &"enclosed".into()));
    let why = |design, pair| between(design, pair)["closure"]["error"].as_str().unwrap().to_owned();
    assert!(why(octahedral, "P1,P4").contains("a leg joins these joints"));
    assert_eq!(between(octahedral, "P1,P2")["error"]["code"], "fk::unknown_joint");
}

fn joint(names: &[String], name: &str) -> usize {
    names.iter().position(|n| n == name).unwrap()
}
