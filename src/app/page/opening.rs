//! The contents of a page about a design.

use serde::Serialize;

use super::request::Chosen;
use super::session::{Equivalent, Session};
use ask::Design;
use ask::equivalents::Original;
use machine::requirements::Hardware;
use platform::geom::{PoseConvention, UpAxis};
use platform::manipulator::Body;
use records::PoseRecord;
use synthesis::singularity::SingularityVerdict;
use synthesis::{Factor, Family, HexagonPoint, JointLabel, Pattern, corner, edge_lengths, sliding_body};

/// A design with the questions that its page can ask.
#[derive(Debug, Serialize)]
pub(super) struct OpeningRecord<'a> {
    name: &'a str,
    units: &'a str,
    source: Option<&'a str>,
    description: Option<&'a str>,
    /// The kind: `"octahedral"`, `"equivalent"`, `"general"`, or `"cranks"` for rods on cranks.
    kind: &'static str,
    size: f64,
    /// Whether the platform shown first is architecturally singular: the octahedral original, or else the design.
    /// `null`: undecided, or cranks.
    singular: Option<bool>,
    /// The reason why it is singular, or why it is undecided.
    reason: Option<String>,
    /// Whether the design as an equivalent, with the starting offsets of the page, is singular. `null`: undecided, or
    /// the page starts with another platform.
    start_singular: Option<bool>,
    home: PoseRecord,
    centre: [f64; 3],
    radius: f64,
    trajectory: bool,
    workspace: bool,
    lengths: Option<[f64; 6]>,
    /// Least and greatest angle of each crank, degrees, `null` without limits; absent without cranks.
    angles_deg: Option<Vec<Option<[f64; 2]>>>,
    limits: LimitsRecord,
    hardware: HardwareRecord,
    slides: SlidesRecord,
    frames: FramesRecord,
    /// Sentences about the symmetry that the joints have up to rounding; `null`: none was found.
    symmetry: Option<Vec<String>>,
    /// The hexagon of the octahedral original.
    hexagon: Option<HexagonRecord>,
    /// The equivalents to choose from.
    patterns: Option<Vec<StartPattern>>,
    /// The equivalent shown at the beginning.
    start: Option<Chosen>,
}

/// The limits for an equivalent.
#[derive(Debug, Serialize)]
struct LimitsRecord {
    /// Least distance of joint centres, design units.
    spacing: f64,
    /// Least `|det A|`.
    det: f64,
}

/// Dimensions of the parts, design units; `null`: not stated by the design.
#[derive(Debug, Serialize)]
struct HardwareRecord {
    /// Widths of the joints of base and platform, design units.
    joints: [Option<f64>; 2],
    /// Diameter of the leg, or of its cylinder, design units.
    leg: Option<f64>,
    /// Length of the cylinder and diameter of the rod, design units.
    rod: Option<[f64; 2]>,
    /// Least and greatest leg length, design units.
    lengths: Option<[f64; 2]>,
}

impl HardwareRecord {
    fn of(hardware: &Hardware) -> Self {
        let width = |body| {
            let all = (0..6).filter_map(|leg| hardware.housing(body, leg));
            all.map(|h| h.greatest_width()).reduce(f64::max)
        };
        Self {
            joints: Body::BOTH.map(width),
            leg: hardware.leg_body.map(|l| l.diameter),
            rod: hardware.leg_body.and_then(|l| l.rod).map(|(length, diameter)| [length, diameter]),
            lengths: hardware.leg_length.map(|l| l.range().into()),
        }
    }
}

/// The ranges of the pose sliders, to either side of home.
#[derive(Debug, Serialize)]
struct SlidesRecord {
    /// Range of the position, design units.
    position: [f64; 3],
    /// Range of the three angles, in their unit.
    angles: [f64; 3],
}

/// The convention of the six numbers of a pose.
#[derive(Debug, Serialize)]
struct FramesRecord {
    /// Names of the numbers.
    names: [&'static str; 6],
    /// The unit of angles.
    angle_unit: &'static str,
    /// The convention in sentences.
    sentence: String,
}

impl FramesRecord {
    fn of(convention: &PoseConvention) -> Self {
        let [a, b, c] = convention.angle_words();
        Self {
            names: ["x", "y", "z", a, b, c],
            angle_unit: convention.angle_unit().name(),
            sentence: convention.sentences(),
        }
    }
}

/// The factor by which sliders exceed the workspace, so that poses beyond it can be seen.
const BEYOND: f64 = 1.5;
/// Least range of a slider: as a share of the size of the design, and in degrees.
const LEAST_SLIDE: (f64, f64) = (0.25, 30.0);

/// The range shown by the page to either side of home: positions in design units, and angles in degrees.
pub(super) fn reach(design: &Design) -> ([f64; 3], [f64; 3]) {
    let (translation, rotation_deg) = design.workspace_or_default().space(&design.home_or_default()).reach();
    let least = LEAST_SLIDE.0 * design.manipulator().size();
    let position = translation.map(|x| (BEYOND * x).max(least));
    (position.into(), rotation_deg.map(|x| (BEYOND * x).max(LEAST_SLIDE.1)).into())
}

impl SlidesRecord {
    fn of(design: &Design, convention: &PoseConvention) -> Self {
        let (position, degrees) = reach(design);
        let [x, y, z] = position;
        let position = if convention.up_axis() == UpAxis::Y { [x, z, y] } else { position };
        let angles = degrees.map(|range| convention.angle_unit().of_radians(range.to_radians()));
        Self { position, angles }
    }
}

/// The hexagon: its legs as vertices, and the joints that slide on its sides.
#[derive(Debug, Serialize)]
struct HexagonRecord {
    vertices: Vec<VertexRecord>,
    sides: Vec<SideRecord>,
}

/// A leg of the original.
#[derive(Debug, Serialize)]
struct VertexRecord {
    leg: usize,
    joints: [String; 2],
}

/// An edge of a body on which a joint can slide.
#[derive(Debug, Serialize)]
struct SideRecord {
    body: String,
    /// The joint of the other body, which stays fixed.
    fixed: String,
    length: f64,
    from: String,
    to: String,
}

/// One of the equivalents.
#[derive(Debug, Serialize)]
struct StartPattern {
    id: String,
    base_joints: usize,
    platform_joints: usize,
    shared_joints: usize,
    offsets: Vec<OffsetRecord>,
    legs: Vec<EquivalentLeg>,
    /// The formula of `det A`.
    det: String,
    /// The equations of the zeros of its factors.
    zero: Vec<String>,
}

/// An offset of an equivalent.
#[derive(Debug, Serialize)]
struct OffsetRecord {
    name: String,
    side: usize,
    joint: String,
}

/// A leg of an equivalent.
#[derive(Debug, Serialize)]
struct EquivalentLeg {
    leg: usize,
    joints: [String; 2],
    side: Option<usize>,
    /// Index into the offsets; absent for a fixed leg.
    offset: Option<usize>,
    vertex: Option<usize>,
}

/// Whether a design is architecturally singular, as in `equipod check`, and the reason, also for an undecided case.
fn regularity(design: &Design) -> (Option<bool>, Option<String>) {
    match SingularityVerdict::of(design.manipulator()) {
        Err(e) => (None, Some(format!("not decided: {e}"))),
        Ok(found) => {
            let why = || found.architecture.findings.first().map(|f| f.case.sentence());
            (found.is_singular(), found.undecided_in_words(&design.units).or_else(why))
        }
    }
}

/// The design, the original's hexagon, and the patterns to choose from.
pub(super) fn record(session: &Session) -> OpeningRecord<'_> {
    let design = &session.design;
    // results on the joints apply only to legs of variable length, so not to cranks
    let (singular, reason) = match session.cranks {
        None => regularity(session.first()),
        Some(_) => (None, None),
    };
    let starts_with_it = session.original.as_ref().and_then(|o| o.seen.as_ref()).zip(session.start.as_ref());
    let starts_with_it =
        starts_with_it.is_some_and(|(seen, start)| (&start.pattern, &start.offsets) == (&seen.0, &seen.1));
    let (centre, radius) = session.reach();
    let kind = match &session.original {
        Some(o) if o.seen.is_none() => "octahedral",
        Some(_) => "equivalent",
        None if session.cranks.is_some() => "cranks",
        None => "general",
    };
    let original = session.original.as_ref();
    let frames = session.frames();
    OpeningRecord {
        name: &design.name,
        units: &design.units,
        source: design.source.as_deref(),
        description: design.description.as_deref(),
        kind,
        size: design.manipulator().size(),
        singular,
        reason,
        start_singular: if starts_with_it { regularity(design).0 } else { None },
        home: (&session.home).into(),
        centre: centre.coords.into(),
        radius,
        trajectory: design.workspace.trajectory.is_some(),
        workspace: !design.workspace.is_empty(),
        lengths: session.first().lengths.map(|l| l.get()),
        angles_deg: session.cranks.as_ref().map(|platform| {
            let degrees = |(a, b): (f64, f64)| [a.to_degrees(), b.to_degrees()];
            platform.legs().iter().map(|leg| leg.limits.map(degrees)).collect()
        }),
        limits: LimitsRecord { spacing: session.limits.0, det: session.limits.1 },
        hardware: HardwareRecord::of(&design.hardware),
        slides: SlidesRecord::of(design, &frames.convention),
        frames: FramesRecord::of(&frames.convention),
        symmetry: design.snapped().map(|snapped| snapped.sentences(&design.units)),
        hexagon: original.map(hexagon),
        patterns: session.start.as_ref().zip(original).map(|(s, o)| patterns(s, o)),
        start: session.start.as_ref().map(Chosen::from),
    }
}

fn hexagon(o: &Original) -> HexagonRecord {
    let lengths = edge_lengths(&o.octahedral);
    let vertices = (0..6).map(|k| VertexRecord {
        leg: o.octahedral.order()[k].get() + 1,
        joints: o.leg_names(HexagonPoint::Vertex(k)),
    });
    let sides = (0..6).map(|k| {
        let body = sliding_body(k);
        let fixed = body.other();
        let name = |i: usize| o.joint_name(JointLabel::Corner(i));
        SideRecord {
            body: body.to_string(),
            fixed: name(corner(fixed, k)),
            length: lengths[k],
            from: name(corner(body, k)),
            to: name(corner(body, (k + 1) % 6)),
        }
    });
    HexagonRecord { vertices: vertices.collect(), sides: sides.collect() }
}

/// One pattern of every topology, the platform without shared joints first, and the starting pattern of the page.
fn patterns(start: &Equivalent, o: &Original) -> Vec<StartPattern> {
    let mut list: Vec<Pattern> = vec![start.pattern.clone()];
    list.extend(Pattern::new([false; 6], [1; 6]));
    let mut others: Vec<Pattern> =
        Family::octahedral().topologies().iter().map(|t| t.example.clone()).collect();
    others.sort_by(|a, b| b.cmp(a));
    list.extend(others);
    let mut seen = Vec::new();
    list.retain(|p| {
        let new = !seen.contains(p) && !p.offsets().is_empty();
        seen.push(p.clone());
        new
    });
    list.iter().map(|p| pattern(p, o)).collect()
}

fn pattern(p: &Pattern, o: &Original) -> StartPattern {
    let [base, platform] = p.joints();
    let legs = p.legs().into_iter().enumerate().map(|(k, point)| {
        let (side, offset) = match point {
            HexagonPoint::Vertex(_) => (None, None),
            HexagonPoint::Inner(t) => (Some(t.side), p.offsets().iter().position(|x| *x == t)),
        };
        EquivalentLeg {
            leg: o.octahedral.order()[k].get() + 1,
            joints: o.leg_names(point),
            side,
            offset,
            vertex: if let HexagonPoint::Vertex(v) = point { Some(v) } else { None },
        }
    });
    let offsets = p.offsets().into_iter().map(|t| OffsetRecord {
        name: t.to_string(),
        side: t.side,
        joint: o.joint_name(JointLabel::OnEdge(t)),
    });
    StartPattern {
        id: p.to_string(),
        base_joints: base.len(),
        platform_joints: platform.len(),
        shared_joints: p.shared_joints().len(),
        offsets: offsets.collect(),
        legs: legs.collect(),
        det: p.determinant_formula(),
        zero: p.factors().iter().map(|f| Factor::zero(*f)).collect(),
    }
}
