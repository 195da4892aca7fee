//! Both platforms at a pose: places, lengths, margins, and the relation of the lengths.

use nalgebra::{Matrix6, Point3};
use serde::Serialize;

use super::request::Refusal;
use super::session::{Equivalent, Session};
use ask::Design;
use machine::requirements::{LeastMargins, Terms};
use machine::rotary::RotaryPlatform;
use platform::geom::{Pose, PoseConvention};
use platform::manipulator::{Body, Manipulator, SquaredLegLengths, inverse_condition, jacobian};
use records::{AssessAnswer, CrankRecord, MarginRecord, OutOfReachRecord, PoseRecord, RotaryIkRecord};
use sheet::Sheet;
use sheet::answers::{MarginsAtPose, requirements_table};
use synthesis::AffineLegMap;

/// Singular values below this count as zero.
const ROUNDING: f64 = 1e-13;

/// Both platforms at a pose.
#[derive(Debug, Serialize)]
pub(super) struct SceneRecord {
    pose: PoseRecord,
    /// Position and angles of the pose in the convention of the design.
    written: [f64; 6],
    platforms: Vec<PlatformRecord>,
    /// The leg map from the lengths of the first platform to those of the second.
    map: Option<RelationRecord>,
    /// The table of requirements as markup, in which every text is escaped.
    requirements: String,
}

/// A platform at a pose.
#[derive(Debug, Serialize)]
struct PlatformRecord {
    name: String,
    base: Vec<PlaceRecord>,
    platform: Vec<PlaceRecord>,
    /// Indices of the joints of each leg.
    legs: [[usize; 2]; 6],
    lengths: [f64; 6],
    squares: [f64; 6],
    inverse_condition: f64,
    sign: i8,
    spacing: BodySpacings,
    /// The cranks, for rods on cranks; the lengths are then rod lengths.
    cranks: Option<CranksRecord>,
}

/// The cranks at a pose; their centres are the base joints.
#[derive(Debug, Serialize)]
struct CranksRecord {
    /// The vectors from each centre to the tip at angle 0 and at a quarter turn.
    arms: [[[f64; 3]; 2]; 6],
    out_of_reach: Option<OutOfReachRecord>,
    /// The cranks in leg order; empty if a rod does not reach.
    list: Vec<CrankPlace>,
}

/// A crank with both places of its tip.
#[derive(Debug, Serialize)]
struct CrankPlace {
    #[serde(flatten)]
    crank: CrankRecord,
    /// The tip on the other side.
    other_tip: [f64; 3],
}

/// A joint with its position, base frame.
#[derive(Debug, Serialize)]
struct PlaceRecord {
    name: String,
    at: [f64; 3],
}

/// The closest joints of each body.
#[derive(Debug, Serialize)]
struct BodySpacings {
    base: Option<SpacingRecord>,
    platform: Option<SpacingRecord>,
}

/// The two joint centres in use that are closest to each other.
#[derive(Debug, Serialize)]
struct SpacingRecord {
    distance: f64,
    joints: [String; 2],
}

/// The map `s' = A s + c`, with its error at the pose.
#[derive(Debug, Serialize)]
struct RelationRecord {
    #[serde(rename = "A")]
    matrix: [[f64; 6]; 6],
    #[serde(rename = "c")]
    constants: [f64; 6],
    det: f64,
    inverse_condition: f64,
    /// The image `A s + c`, design units squared.
    image: [f64; 6],
    /// The largest relative difference of the image from `s'`.
    error: f64,
    /// For each offset, the value for which `det A` vanishes; `null`: there is none.
    zeros: Vec<Option<f64>>,
}

/// All data that a page shows at a pose; `limits` is the answer about the whole workspace.
pub(super) fn record(
    session: &Session,
    at: &Pose,
    e: Option<&Equivalent>,
    limits: Option<&AssessAnswer>,
) -> Result<SceneRecord, Refusal> {
    let first = session.first();
    let s = match &session.cranks {
        Some(platform) => platform.rods().squared(),
        None => squares(first, at)?,
    };
    let mut platforms = vec![platform(session, first, at, &s)];
    let mut here = Vec::new();
    let mut column = |title, design, shown: &PlatformRecord| {
        let margins = margins(session, design, at);
        here.push(MarginsAtPose { title, margins, inverse_condition: shown.inverse_condition });
    };
    if session.first_is_given() {
        column(if e.is_some() { "here, original" } else { "here" }, first, &platforms[0]);
    }
    let mut map = None;
    if let Some(e) = e {
        let (second, a) = session.second(e)?;
        let own = squares(&second, at)?;
        let shown = platform(session, &second, at, &own);
        column("here, equivalent", &second, &shown);
        platforms.push(shown);
        map = Some(relation(e, &a, &s, &own)?);
    }
    let requirements = Sheet::from(requirements_table(limits, &here)).html();
    Ok(SceneRecord {
        pose: at.into(),
        written: session.frames().write(at).numbers(),
        platforms,
        map,
        requirements: sheet::shown(&requirements),
    })
}

fn squares(design: &Design, at: &Pose) -> Result<SquaredLegLengths, Refusal> {
    let s = at.squared_lengths(design.manipulator());
    s.ok_or_else(|| Refusal::new("pose", "a leg length at this pose is not a finite positive number"))
}

fn platform(session: &Session, design: &Design, at: &Pose, s: &SquaredLegLengths) -> PlatformRecord {
    let m = design.manipulator();
    let place = |(name, p): (&String, Point3<f64>)| PlaceRecord { name: name.clone(), at: p.coords.into() };
    let base = design.base_names().iter().zip(m.base_joints().iter().copied());
    let moved = design.platform_names().iter().zip(m.platform_joints().iter().map(|p| at.transform(p)));
    let pairs = m.pairs();
    PlatformRecord {
        name: design.name.clone(),
        base: base.map(place).collect(),
        platform: moved.map(place).collect(),
        legs: pairs.map(|(a, b)| [a, b]),
        lengths: s.lengths().get(),
        squares: s.get(),
        inverse_condition: session.inverse_condition(design, at),
        sign: session
            .pushing(design, at)
            .map_or(0, |pushing| sign(&jacobian(&pushing, at, design.characteristic_length()))),
        spacing: BodySpacings {
            base: spacing(m, Body::Base, design.base_names()),
            platform: spacing(m, Body::Platform, design.platform_names()),
        },
        cranks: session.cranks.as_ref().map(|platform| cranks(design, platform, at)),
    }
}

fn cranks(design: &Design, platform: &RotaryPlatform, at: &Pose) -> CranksRecord {
    let found = RotaryIkRecord::new(design, platform, at, &design.pose_frames(PoseConvention::default()));
    let place = |(i, crank): (usize, CrankRecord)| CrankPlace {
        other_tip: platform.tip(i, crank.other_angle_deg.to_radians()).coords.into(),
        crank,
    };
    CranksRecord {
        arms: std::array::from_fn(|i| {
            platform.directions()[i].map(|e| (e * platform.legs()[i].crank.length).into())
        }),
        out_of_reach: found.out_of_reach,
        list: found.cranks.into_iter().enumerate().map(place).collect(),
    }
}

/// The sign of `det J`; 0 where `sigma_min / sigma_max` is below rounding.
pub(super) fn sign(j: &Matrix6<f64>) -> i8 {
    match j.determinant() {
        _ if inverse_condition(j) < ROUNDING => 0,
        d if d > 0.0 => 1,
        _ => -1,
    }
}

fn spacing(m: &Manipulator, body: Body, names: &[String]) -> Option<SpacingRecord> {
    let (distance, nearest) = m.nearest_joints(body)?;
    Some(SpacingRecord { distance, joints: nearest.map(|i| names[i].clone()) })
}

/// The least margin of every kind of requirement at the pose.
fn margins(session: &Session, design: &Design, at: &Pose) -> Vec<MarginRecord> {
    let required = design.requirements();
    let terms = Terms::new(design.manipulator(), &required, &session.home);
    let mut least = LeastMargins::default();
    least.see(terms.fixed(), None);
    least.see(terms.at(at), Some(*at));
    let row = |(term, value, pose)| MarginRecord::found(design, &terms.margin((term, value), pose));
    least.each().map(row).collect()
}

fn relation(
    e: &Equivalent,
    map: &AffineLegMap,
    s: &SquaredLegLengths,
    own: &SquaredLegLengths,
) -> Result<RelationRecord, Refusal> {
    let image = map.a * nalgebra::Vector6::from(s.get()) + map.c;
    let most = own.get().into_iter().fold(0.0, f64::max);
    let error = image.iter().zip(own.get()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / most;
    let det = e.pattern.determinant(&e.offsets).map_err(|e| Refusal::new("offsets", e))?;
    Ok(RelationRecord {
        matrix: [0, 1, 2, 3, 4, 5].map(|i| [0, 1, 2, 3, 4, 5].map(|j| map.a[(i, j)])),
        constants: map.c.into(),
        det,
        inverse_condition: map.inverse_condition(),
        image: image.into(),
        error,
        zeros: e.zeros()?,
    })
}
