//! `[holes]` and `[plates]`.

use serde::Serialize;

use machine::requirements::{Grid, HolePattern, PlateDesign, Plates};
use platform::manipulator::Body;

/// A grid of `[holes]`.
#[derive(Serialize)]
pub(super) struct GridTable {
    pattern: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pitch: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    first_radius: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    radii: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    count: Option<CountFile>,
    origin: [f64; 2],
    angle_deg: f64,
}

/// Numbers of holes.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum CountFile {
    Ring(u32),
    Circles(Vec<u32>),
}

impl From<&Grid> for GridTable {
    fn from(g: &Grid) -> Self {
        let circles = g.circles.as_slice();
        let first = circles.first().filter(|_| g.pattern == HolePattern::Polar);
        let bolts = g.pattern == HolePattern::BoltCircle;
        let counts = || CountFile::Circles(circles.iter().map(|c| c.holes).collect());
        Self {
            pattern: g.pattern.name(),
            pitch: (!bolts).then_some(g.pitch),
            first_radius: first.map(|c| c.radius),
            radii: bolts.then(|| circles.iter().map(|c| c.radius).collect()),
            count: first.map(|c| CountFile::Ring(c.holes)).or_else(|| bolts.then(counts)),
            origin: g.origin,
            angle_deg: g.angle_deg,
        }
    }
}

/// `[holes]`.
#[derive(Serialize)]
pub(super) struct HolesTable {
    #[serde(skip_serializing_if = "Option::is_none")]
    base: Option<GridTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform: Option<GridTable>,
}

impl From<&[Option<Grid>; 2]> for HolesTable {
    fn from([base, platform]: &[Option<Grid>; 2]) -> Self {
        Self { base: base.as_ref().map(GridTable::from), platform: platform.as_ref().map(GridTable::from) }
    }
}

/// `[plates]`.
#[derive(Serialize)]
pub(super) struct PlatesTable<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    base: Option<PlateTable<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform: Option<PlateTable<'a>>,
}

/// `[plates.base]` and `[plates.platform]`.
#[derive(Serialize)]
pub(super) struct PlateTable<'a> {
    thickness: f64,
    margin: f64,
    hole: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    height: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    material: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    density: Option<f64>,
    edge_distance: f64,
    hole_distance: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    foot: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bolts: Option<BoltsTable>,
}

/// `bolts` of a plate.
#[derive(Serialize)]
pub(super) struct BoltsTable {
    count: u32,
    circle: f64,
    hole: f64,
    first_deg: f64,
    from: &'static str,
}

impl<'a> PlatesTable<'a> {
    pub(super) fn of(plates: &'a Plates) -> Option<Self> {
        let [base, platform] = Body::BOTH.map(|body| plates.of(body).map(PlateTable::from));
        (base.is_some() || platform.is_some()).then_some(Self { base, platform })
    }
}

impl<'a> From<&'a PlateDesign> for PlateTable<'a> {
    fn from(p: &'a PlateDesign) -> Self {
        Self {
            thickness: p.thickness,
            margin: p.margin,
            hole: p.hole,
            height: p.height,
            material: p.material.as_deref(),
            density: p.density,
            edge_distance: p.edge_distance,
            hole_distance: p.hole_distance,
            foot: p.foot,
            bolts: p.bolts.map(|b| BoltsTable {
                count: b.count,
                circle: b.circle,
                hole: b.hole,
                first_deg: b.first_deg,
                from: b.from.name(),
            }),
        }
    }
}
