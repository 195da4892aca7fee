//! `cargo bench --package equipod-benches --bench pose_counts -- SEED`: how many finite poses, real and complex,
//! platforms of special families have for generic leg lengths.
//!
//! Each family is drawn with exact joints, counted modulo two random primes (`docs/theory/pose-count.md`), and held
//! against the bound that is proved for all lengths. The seed draws the joints; without a number it is 1.

use std::error::Error;
use std::fmt::Write;

use equipod::methods::design::{Format, parse};
use equipod::methods::solve::pose_count::PoseSet;

#[allow(clippy::print_stdout, reason = "a table is printed")]
fn main() -> Result<(), Box<dyn Error>> {
    // cargo adds an option of its own
    let seed = std::env::args().skip(1).find_map(|text| text.parse().ok()).unwrap_or(1);
    print!("{}", table(seed)?);
    Ok(())
}

fn table(seed: u64) -> Result<String, Box<dyn Error>> {
    let mut out = String::new();
    writeln!(
        out,
        "| family | finite poses | by degree | e.e = 0 | at infinity | proved bound |\n|---|--:|---|--:|--:|--:|"
    )?;
    for (name, family) in FAMILIES {
        let (base, platform) = family(&mut Draw(seed));
        let text = text(name, &base, &platform);
        let (design, _) = parse(&text, Format::Toml).map_err(|violations| format!("{violations:?}"))?;
        let checked = design.check()?;
        let bound = checked.pose_bound.bound();
        match &checked.pose_count.set {
            PoseSet::Finite { count, by_degree } => {
                let degrees: Vec<String> = by_degree.iter().map(ToString::to_string).collect();
                let number = |n: Option<usize>| n.map_or("-".into(), |n| n.to_string());
                let (isotropic, far) =
                    checked.common_points.map_or((None, None), |p| (p.isotropic, p.at_infinity));
                let (degrees, isotropic, far) = (degrees.join(", "), number(isotropic), number(far));
                writeln!(out, "| {name} | {count} | {degrees} | {isotropic} | {far} | {bound} |")?;
            }
            PoseSet::PositiveDimensional { dimension, degree } => {
                writeln!(out, "| {name} | dimension {dimension}, degree {degree} | | | | {bound} |")?;
            }
            PoseSet::Undecided { .. } => writeln!(out, "| {name} | undecided | | | | {bound} |")?,
        }
    }
    Ok(out)
}

/// Coordinates as the expressions of design files.
type Joint = [String; 3];
type Hexagon = Vec<Joint>;
type Family = fn(&mut Draw) -> (Hexagon, Hexagon);

const FAMILIES: [(&str, Family); 21] = [
    ("nothing special", |d| (d.spatial(6), d.spatial(6))),
    ("both bodies planar", |d| (d.planar(6), d.planar(6))),
    ("projective image of a planar hexagon", |d| {
        let base = d.planar(6);
        let m = d.numbers(8);
        (base.clone(), base.iter().map(|p| quotient(&m, p, false)).collect())
    }),
    ("affine image of a planar hexagon", |d| {
        let base = d.planar(6);
        let m = d.numbers(4);
        let image = |p: &Joint| [sum(&m[0..2], &p[..2]), sum(&m[2..4], &p[..2]), "0".into()];
        (base.clone(), base.iter().map(image).collect())
    }),
    ("similar planar hexagons", |d| {
        let (base, k) = (d.planar(6), d.number());
        (base.clone(), scaled(&base, &k))
    }),
    ("congruent planar hexagons", |d| {
        let base = d.planar(6);
        (base.clone(), base)
    }),
    ("projective image of a spatial hexagon", |d| {
        let base = d.spatial(6);
        let m = d.numbers(15);
        (base.clone(), base.iter().map(|p| quotient(&m, p, true)).collect())
    }),
    ("affine image of a spatial hexagon", |d| {
        let base = d.spatial(6);
        let m = d.numbers(9);
        (base.clone(), base.iter().map(|p| [sum(&m[0..3], p), sum(&m[3..6], p), sum(&m[6..9], p)]).collect())
    }),
    ("similar spatial hexagons", |d| {
        let (base, k) = (d.spatial(6), d.number());
        (base.clone(), scaled(&base, &k))
    }),
    ("congruent spatial hexagons", |d| {
        let base = d.spatial(6);
        (base.clone(), base)
    }),
    ("mirror images of each other", |d| {
        let base = d.spatial(6);
        (base.clone(), scaled(&base, "-1"))
    }),
    ("three base joints on a line", |d| (d.with_line(3), d.spatial(6))),
    ("four base joints on a line", |d| (d.with_line(4), d.spatial(6))),
    ("five base joints on a line", |d| (d.with_line(5), d.spatial(6))),
    ("three joints of each body on a line, same legs", |d| (d.with_line(3), d.with_line(3))),
    ("three joints of each body on a line, other legs", |d| {
        let (base, mut platform) = (d.with_line(3), d.with_line(3));
        platform.reverse();
        (base, platform)
    }),
    ("four joints of each body on a line, same legs", |d| (d.with_line(4), d.with_line(4))),
    ("four base joints on a line, affine image in the platform", |d| {
        let (base, mut platform) = (d.with_line(4), d.spatial(6));
        let (k, c) = (d.number(), d.number());
        for (end, own) in platform.iter_mut().zip(&base).take(4) {
            *end = [
                format!("({k})*({}) + {c}", own[0]),
                format!("({k})*({})", own[1]),
                format!("({k})*({})", own[2]),
            ];
        }
        (base, platform)
    }),
    ("octahedral", |d| {
        let (b, p) = (d.spatial(3), d.spatial(3));
        (zigzag(&b, [0, 1, 1, 2, 2, 0]), zigzag(&p, [0, 0, 1, 1, 2, 2]))
    }),
    ("two semi-regular hexagons", |d| (d.semi_regular(true), d.semi_regular(true))),
    ("threefold symmetry of both bodies without mirror planes", |d| {
        (d.semi_regular(false), d.semi_regular(false))
    }),
];

fn zigzag(corners: &[Joint], order: [usize; 6]) -> Hexagon {
    order.iter().map(|k| corners[*k].clone()).collect()
}

fn sum(weights: &[String], values: &[String]) -> String {
    let terms: Vec<String> = weights.iter().zip(values).map(|(w, x)| format!("({w})*({x})")).collect();
    terms.join(" + ")
}

fn scaled(joints: &[Joint], factor: &str) -> Hexagon {
    joints.iter().map(|p| p.each_ref().map(|x| format!("({factor})*({x})"))).collect()
}

/// The image of a point under a projective map, rows `m` of the numerators and of the denominator, whose last entry
/// is 1.
fn quotient(m: &[String], p: &Joint, spatial: bool) -> Joint {
    let n = if spatial { 3 } else { 2 };
    let row = |k: usize| {
        let tail = if k == n { "1" } else { m[(n + 1) * k + n].as_str() };
        format!("{} + {tail}", sum(&m[(n + 1) * k..(n + 1) * k + n], &p[..n]))
    };
    let over = |k: usize| format!("({})/({})", row(k), row(n));
    [over(0), over(1), if spatial { over(2) } else { "0".into() }]
}

fn text(name: &str, base: &[Joint], platform: &[Joint]) -> String {
    // equal joints are one joint, and two legs never join the same two
    let place = |list: &[Joint], k: usize| list.iter().position(|p| *p == list[k]).unwrap_or(k);
    let legs: Vec<String> =
        (0..base.len()).map(|k| format!("[\"B{}\", \"P{}\"]", place(base, k), place(platform, k))).collect();
    let joints = |letter: char, list: &[Joint]| {
        let own = (0..list.len()).filter(|k| place(list, *k) == *k);
        let line = |k: usize| {
            let [x, y, z] = &list[k];
            format!("{letter}{k} = [\"{x}\", \"{y}\", \"{z}\"]")
        };
        own.map(line).collect::<Vec<_>>().join("\n")
    };
    format!(
        "name = \"{name}\"\nunits = \"m\"\nlegs = [{}]\n[base]\n{}\n[platform]\n{}\n",
        legs.join(", "),
        joints('B', base),
        joints('P', platform)
    )
}

/// A linear congruential generator (Knuth's MMIX constants).
struct Draw(u64);

impl Draw {
    fn next(&mut self, below: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % below
    }

    /// A fraction with denominator 7.
    fn number(&mut self) -> String {
        let n = self.next(40) + 1;
        let sign = if self.next(2) == 0 { "" } else { "-" };
        format!("{sign}{n}/7")
    }

    fn numbers(&mut self, count: usize) -> Vec<String> {
        (0..count).map(|_| self.number()).collect()
    }

    fn spatial(&mut self, count: usize) -> Hexagon {
        (0..count).map(|_| [self.number(), self.number(), self.number()]).collect()
    }

    fn planar(&mut self, count: usize) -> Hexagon {
        (0..count).map(|_| [self.number(), self.number(), "0".into()]).collect()
    }

    /// Six points, the first ones on a line.
    fn with_line(&mut self, on_it: usize) -> Hexagon {
        let mut joints = self.spatial(6);
        let direction = self.numbers(3);
        for k in 1..on_it {
            let t = format!("{}/5", 3 * k + usize::from(k == 2));
            joints[k] = [0, 1, 2].map(|i| format!("{} + ({t})*({})", joints[0][i], direction[i]));
        }
        joints
    }

    /// Points on circles about the origin, turned by thirds; mirror images of each other or any two.
    fn semi_regular(&mut self, mirrored: bool) -> Hexagon {
        let (x, y) = (self.number(), self.number());
        let other = if mirrored { [x.clone(), format!("-({y})")] } else { [self.number(), self.number()] };
        let turned = |[x, y]: &[String; 2], s: &str| {
            [format!("-({x})/2 - ({s})*({y})"), format!("({s})*({x}) - ({y})/2")]
        };
        let mut joints = Hexagon::new();
        for s in ["", "sqrt(3)/2", "-sqrt(3)/2"] {
            for p in [[x.clone(), y.clone()], other.clone()] {
                let [x, y] = if s.is_empty() { p } else { turned(&p, s) };
                joints.push([x, y, "0".into()]);
            }
        }
        joints
    }
}
