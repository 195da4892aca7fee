//! `[frames]`: the machine's own convention for poses.

use serde_json::{Value as Json, json};

use super::kind::{KeyKind, own, unit, vector, word};
use super::stored::{StoredValue, Word};
use super::{Code, FoundKey, KeyTable, key};
use crate::design::tree::Node;
use crate::design::violation::Findings;
use platform::geom::{AngleUnit, ListedFrom, PoseConvention, QuaternionOrder, RotationOrder, UpAxis};

const ORDER: KeyKind = own(
    r#"{"type": "string", "pattern": "^((fixed|moving)-(x[yz]|y[xz]|z[xy])[xyz]|rpy|pi|rubin|vector)$"}"#,
    unit::NONE,
);

pub(super) static FRAMES: KeyTable<PoseConvention> = KeyTable {
    keys: &[
        key!("rotation_order" { default = r#""fixed-xyz""# }: ORDER, rotation_order;
            "order of the three rotations: `fixed-xyz` (`R = Rz Ry Rx`), `moving-xyz` (`R = Rx Ry Rz`) or any other axes; `rpy`, `pi` and `rubin` by name; `vector`: a rotation vector"),
        key!("angles" { default = r#""deg""# }: word(AngleUnit::words), angles; "unit of angles"),
        key!("quaternion" { default = r#""wxyz""# }: word(QuaternionOrder::words), quaternion;
            "order of quaternions, scalar first or last"),
        key!("pivot" { default = "[0, 0, 0]" }: vector(unit::LENGTH), pivot;
            "the point of the platform whose position a pose gives, platform frame, such as the tool"),
        key!("relative_to" { default = r#""base""# }: word(ListedFrom::words), relative_to;
            "`home`: poses are displacements from home along the axes of the base; `base`: poses are in the base frame"),
        key!("up" { default = r#""z""# }: word(UpAxis::words), up;
            "the axis that points up: `y` means that (x, y, z) of poses and pivot are (x, -z, y) of the joints"),
    ],
    ..KeyTable::EMPTY
};

/// The convention that the keys of `[frames]` state, without the name of the table above them.
pub(crate) fn frames(root: &Node, report: &mut Findings<'_>) -> PoseConvention {
    let mut convention = PoseConvention::default();
    FRAMES.read(report, root, "[frames]", &mut convention);
    convention
}

impl StoredValue for RotationOrder {
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
        let read = found.text()?.parse::<Self>();
        if let Err(why) = &read {
            let help =
                "write \"fixed-xyz\", \"moving-xyz\", other axes, \"rpy\", \"pi\", \"rubin\" or \"vector\"";
            found.refuse(Code::WrongType, why.to_string(), help);
        }
        read.ok()
    }

    fn json(&self) -> Json {
        json!(self.to_string())
    }
}
