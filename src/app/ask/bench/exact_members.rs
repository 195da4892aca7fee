//! Members of classes whose joints satisfy relations; they are drawn as exact numbers, so that the relations hold
//! exactly.
//!
//! Drawn numbers are multiples of `2^-12`, which keeps derived numbers short. All are doubles, except for the rotations
//! by 120 degrees of hexapods.

use num::Rng;
use num::surd::Surd;
use platform::manipulator::ExactEnds;

type Coordinates = [Surd; 3];

/// Drawn numbers are multiples of `2^-12`.
const GRID: f64 = 4096.0;

/// The legs of a member; `None` when a number became too long.
pub(super) type ExactMember = Option<[ExactEnds; 6]>;

/// A multiple of the grid in an interval.
fn number(rng: &mut Rng, low: f64, high: f64) -> Surd {
    let steps = Surd::integer((rng.uniform(low, high) * GRID).round() as i64);
    let grid = Surd::integer(GRID as i64).inverse();
    grid.and_then(|g| steps.times(&g)).unwrap_or_else(Surd::zero)
}

/// A point of `[-2, 2]^3`, or of the same square in `z = 0`.
fn point(rng: &mut Rng, planar: bool) -> Coordinates {
    let (x, y) = (number(rng, -2.0, 2.0), number(rng, -2.0, 2.0));
    [x, y, if planar { Surd::zero() } else { number(rng, -2.0, 2.0) }]
}

/// `p + t (q - p)`.
fn between(p: &Coordinates, q: &Coordinates, t: &Surd) -> Option<Coordinates> {
    let one = |k: usize| p[k].plus(&q[k].minus(&p[k])?.times(t)?);
    Some([one(0)?, one(1)?, one(2)?])
}

fn zip(base: &[Coordinates; 6], platform: &[Coordinates; 6]) -> [ExactEnds; 6] {
    std::array::from_fn(|i| [base[i].clone(), platform[i].clone()])
}

/// Octahedral legs `P1P4, P2P4, P2P5, P3P5, P3P6, P1P6`. Legs `i` and `i + 1` differ in one end; this end of leg `i`
/// moves towards the other by 0.1 to 0.45 of the edge.
pub(super) fn griffis_duffy(rng: &mut Rng) -> ExactMember {
    let mut triangle = || [(); 3].map(|()| point(rng, false));
    let (b, p) = (triangle(), triangle());
    let pairs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let mut legs = Vec::with_capacity(6);
    for i in 0..6 {
        let ((a, c), (a2, c2)) = (pairs[i], pairs[(i + 1) % 6]);
        let t = number(rng, 0.1, 0.45);
        legs.push([between(&b[a], &b[a2], &t)?, between(&p[c], &p[c2], &t)?]);
    }
    legs.try_into().ok()
}

/// A linear map of the plane, by rows.
pub(super) type PlaneMap = [Surd; 4];

/// Maps to similar, congruent and affine images.
pub(super) fn scaling(rng: &mut Rng) -> PlaneMap {
    let factor = number(rng, 0.4, 0.8);
    [factor.clone(), Surd::zero(), Surd::zero(), factor]
}

/// The identity.
pub(super) fn identity() -> PlaneMap {
    [Surd::integer(1), Surd::zero(), Surd::zero(), Surd::integer(1)]
}

/// Any linear map.
pub(super) fn linear(rng: &mut Rng) -> PlaneMap {
    std::array::from_fn(|_| number(rng, -1.0, 1.0))
}

/// A planar hexagon as base and its image under a linear map of the plane as platform. Rotating the platform's frame
/// would change coordinates only.
pub(super) fn images(rng: &mut Rng, map: impl FnOnce(&mut Rng) -> PlaneMap) -> ExactMember {
    let base = [(); 6].map(|()| point(rng, true));
    let map = map(rng);
    let row = |x: &Surd, y: &Surd, p: &Coordinates| x.times(&p[0])?.plus(&y.times(&p[1])?);
    let image = |p: &Coordinates| -> Option<Coordinates> {
        Some([row(&map[0], &map[1], p)?, row(&map[2], &map[3], p)?, Surd::zero()])
    };
    let platform: Vec<Coordinates> = base.iter().map(image).collect::<Option<_>>()?;
    Some(zip(&base, &platform.try_into().ok()?))
}

/// Cosine and sine of twice the angle with tangent `q`: `((1 - q^2) / (1 + q^2), 2 q / (1 + q^2))`.
fn turn(q: &Surd) -> Option<(Surd, Surd)> {
    let (one, square) = (Surd::integer(1), q.times(q)?);
    let inverse = one.plus(&square)?.inverse()?;
    Some((one.minus(&square)?.times(&inverse)?, q.plus(q)?.times(&inverse)?))
}

/// Base joints of legs 1-3 on a line, and platform joints of legs 4-6 on a line. The first joint of each body is at the
/// origin.
pub(super) fn collinear(rng: &mut Rng) -> ExactMember {
    let mut body = || -> [Coordinates; 6] {
        std::array::from_fn(|i| {
            if i == 0 { [Surd::zero(), Surd::zero(), Surd::zero()] } else { point(rng, false) }
        })
    };
    let (mut base, mut platform) = (body(), body());
    base[2] = between(&base[0], &base[1], &number(rng, -1.0, 2.0))?;
    platform[5] = between(&platform[3], &platform[4], &number(rng, -1.0, 2.0))?;
    Some(zip(&base, &platform))
}

/// Pairs of joints on circles of radius 1 and `radius`, threefold symmetric, with base pairs between platform pairs.
/// Half the angle of a pair is 5 to 25 degrees.
pub(super) fn hexapod(rng: &mut Rng) -> ExactMember {
    let radius = number(rng, 0.4, 0.9);
    let half = |rng: &mut Rng| {
        let tangents = [5.0_f64, 25.0].map(|degrees| (degrees / 2.0).to_radians().tan());
        turn(&number(rng, tangents[0], tangents[1]))
    };
    let (base, platform) = (half(rng)?, half(rng)?);
    let cosine = Surd::integer(2).inverse()?;
    let sine = Surd::integer(3).sqrt()?.times(&cosine)?;
    let turned = |(c, s): &(Surd, Surd), (d, e): &(Surd, Surd)| -> Option<(Surd, Surd)> {
        Some((c.times(d)?.minus(&s.times(e)?)?, s.times(d)?.plus(&c.times(e)?)?))
    };
    let third = (cosine.negated(), sine.clone());
    let mut thirds = vec![(Surd::integer(1), Surd::zero())];
    for k in 0..2 {
        thirds.push(turned(&thirds[k], &third)?);
    }
    let sixth = (cosine, sine);
    let mut legs: Vec<ExactEnds> = Vec::with_capacity(6);
    for direction in &thirds {
        for side in [-1, 1] {
            let mirrored =
                |(c, s): &(Surd, Surd)| (c.clone(), if side < 0 { s.negated() } else { s.clone() });
            // a platform pair sits between two base pairs, each joint at 60 degrees minus its half angle
            let inner = turned(&sixth, &(platform.0.clone(), platform.1.negated()))?;
            let (a, b) = (turned(&mirrored(&base), direction)?, turned(&mirrored(&inner), direction)?);
            let scaled = [b.0.times(&radius)?, b.1.times(&radius)?];
            let [x, y] = scaled;
            legs.push([[a.0, a.1, Surd::zero()], [x, y, Surd::zero()]]);
        }
    }
    legs.try_into().ok()
}
