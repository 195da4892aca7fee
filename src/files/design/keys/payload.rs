//! `[payload]`: the load that the platform carries.

use nalgebra::{Matrix3, Point3, Vector3};

use super::found::numbers;
use super::kind::{KeyKind, own, positive, table, unit, vector, word};
use super::shapes::{BOX, SPHERE, shape, written};
use super::stored::{StoredValue, Word, rows};
use super::{Code, FoundKey, KeyTable, key};
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use machine::requirements::{GRAVITY, Payload, PlateMass};

/// Principal moments, or rows.
const MOMENTS: KeyKind =
    own(r##"{"oneOf": [{"$ref": "#/$defs/vector"}, {"$ref": "#/$defs/rows"}]}"##, unit::INERTIA);

pub(super) static PAYLOAD: KeyTable<Payload> = KeyTable {
    keys: &[
        key!("mass" { required = "add mass = 100.0" }: positive(unit::MASS), mass;
            "mass of payload and platform, mass units (default kilograms); `plate` tells whether it includes the plate"),
        key!("center" { default = "[0, 0, 0]" }: vector(unit::LENGTH), center;
            "centre of mass, platform frame"),
        key!("inertia": MOMENTS,
            |found, to| to.inertia = inertia(found), |of| of.inertia.as_ref().map(rows);
            "inertia about the centre of mass, axes of the platform frame, mass units times length units squared: principal moments, or rows of the matrix"),
        key!("gravity" { default = "[0, 0, -9.80665]" }: vector(unit::NONE), gravity; "acceleration of gravity, base frame, m/s^2"),
        key!("plate" { default = r#""included""# }: word(PlateMass::words).placed(),
            |found, to| found.fill(&mut to.plate),
            |of| Some(of.plate.json()).filter(|_| of.plate != PlateMass::Included);
            "whether `mass`, `center` and `inertia` include the plate of `[plates.platform]`, or the program adds it"),
        key!("box": table(&BOX),
            |found, to| to.shape = shape(found), |of| written(of.shape.as_ref(), "box");
            "space of the payload, which legs keep clear of: a box along the axes of the platform frame"),
        key!("sphere": table(&SPHERE),
            |found, to| if to.shape.is_none() {
                to.shape = shape(found);
            },
            |of| written(of.shape.as_ref(), "sphere");
            "space of the payload, which legs keep clear of: a ball"),
    ],
    rules: r#"{"not": {"required": ["box", "sphere"]}}"#,
    ..KeyTable::EMPTY
};

/// `[payload]`.
pub(super) fn payload(report: &mut Findings<'_>, top: &[Entry]) -> Option<Payload> {
    let (entry, place) = (find(top, "payload")?, "[payload]");
    let mut payload = Payload {
        mass: f64::NAN,
        center: Point3::origin(),
        inertia: None,
        gravity: Vector3::new(0.0, 0.0, -GRAVITY),
        plate: PlateMass::default(),
        shape: None,
    };
    let entries = PAYLOAD.read(report, &entry.node, place, &mut payload)?;
    PAYLOAD.require(report, entries, (&entry.key_span, place), |_| true);
    if let [Some(_), Some(second)] = ["box", "sphere"].map(|key| find(entries, key)) {
        let message = "[payload] has two shapes";
        report.refuse(Code::ConflictingKeys, &second.key_span, message, "keep `box` or `sphere`");
    }
    Some(payload).filter(|payload| !payload.mass.is_nan())
}

/// Three principal moments along the axes, or three rows.
fn inertia(found: &mut FoundKey<'_, '_>) -> Option<Matrix3<f64>> {
    let (report, node) = (&mut *found.report, &found.entry.node);
    let what = "`inertia` of [payload]";
    let m = match &node.value {
        Value::Array(rows) if matches!(rows.first(), Some(Node { value: Value::Array(_), .. })) => {
            let read = |row: &Node| {
                numbers::<3>(report, row, "a row of `inertia`", Code::CoordinateCount, "moments")
            };
            let rows: Vec<Option<[f64; 3]>> = rows.iter().map(read).collect();
            let rows: Vec<[f64; 3]> = rows.into_iter().collect::<Option<_>>()?;
            if rows.len() != 3 {
                let message = format!("{what} has {} rows", rows.len());
                return found.refused(Code::CoordinateCount, message, "give three rows of three moments");
            }
            Matrix3::from_fn(|i, j| rows[i][j])
        }
        _ => {
            let moments = numbers::<3>(report, node, what, Code::CoordinateCount, "principal moments")?;
            Matrix3::from_diagonal(&Vector3::from(moments))
        }
    };
    let size = m.amax();
    let symmetric = (m - m.transpose()).amax() <= 1e-9 * size;
    // physical inertia: positive, and no principal moment greater than the sum of the others
    let spread = Matrix3::identity() * (0.5 * m.trace()) - m;
    let possible =
        m.symmetric_eigenvalues().min() > 0.0 && spread.symmetric_eigenvalues().min() >= -1e-9 * size;
    if !(symmetric && possible) {
        let help = "give a symmetric matrix with positive principal moments, none greater than the sum of the other two";
        return found.refused(Code::OutOfRange, format!("{what} is that of no body"), help);
    }
    Some(m)
}
