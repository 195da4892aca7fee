//! Designs of five legs: their keys and their reader.

use super::constructions::{self, BODY, BesideJoints, PARAMETERS};
use super::cranks::CrankPlaces;
use super::document::{legs_entry, numbers_of_legs, required};
use super::found::check_keys;
use super::joints::{self, NamedJoints};
use super::kind::{list_of, not_negative, table, unit};
use super::{KeyTable, TEXT, key};
use crate::design::FiveLegs;
use crate::design::construction::RealPoint;
use crate::design::scale::micrometres;
use crate::design::tree::{Node, Value, find};
use crate::design::violation::Findings;
use num::exact::{Rational, rational};
use num::real::RealNumber;
use platform::manipulator::Body;
use platform::pentapod::{Pentapod, RationalPoint};

/// The keys of a design of five legs.
static TOP: KeyTable<FiveLegs> = KeyTable {
    keys: &[
        key!("name": TEXT, name; "name of the design, not blank"),
        key!("units": TEXT, units; "label of the length unit"),
        key!("source": TEXT, source; "where the numbers come from"),
        key!("description": TEXT, description; "free text"),
        key!("lengths": list_of(5, &not_negative(unit::LENGTH)),
            |found, to| to.lengths = numbers_of_legs(found), |_| None; "leg lengths in leg order"),
        key!("legs": list_of(5, &list_of(2, &TEXT)); "`[base joint, platform joint]` in leg order"),
        key!("parameters": table(&PARAMETERS); "numbers and expressions"),
        key!("base": table(&BODY); "joints in the base frame"),
        key!("platform": table(&BODY); "joints in the platform frame"),
    ],
    ..KeyTable::EMPTY
};

/// Whether the design lists five legs.
pub(crate) fn has_five_legs(root: &Node) -> bool {
    let Value::Table(entries) = &root.value else { return false };
    find(entries, "legs").and_then(joints::number_of_legs) == Some(5)
}

/// The design, or `None` with the reasons in the report.
pub(crate) fn five_legs(root: &Node, report: &mut Findings<'_>) -> Option<FiveLegs> {
    let Value::Table(entries) = &root.value else { return None };
    check_keys(report, entries, &TOP.names(), "a design of five legs");
    let mut design = FiveLegs::default();
    TOP.fill(report, entries, "a design of five legs", &mut design, |_| true);
    for key in ["name", "units"] {
        required(report, root, entries, key);
    }
    report.length_unit = micrometres(&design.units);
    let legs = legs_entry(report, root, entries);
    let parameters = constructions::parameters(report, entries);
    let mut body = |body: Body, key: &str| {
        required(report, root, entries, key).and_then(|entry| joints::body(report, body, entry))
    };
    let (mut base, mut platform) = (body(Body::Base, "base")?, body(Body::Platform, "platform")?);
    let beside = BesideJoints { home: None, cranks: (None, &CrankPlaces::default()) };
    let constructions = constructions::resolve(report, parameters, (&mut base, &mut platform), beside);
    let pairs = joints::pairs::<5>(report, legs?, &base, &platform);
    if !report.is_clean() {
        return None;
    }
    let (constructions, pairs) = (constructions?, pairs?);
    let exact = |body: &NamedJoints, which: Body| constructions.exact(which, &body.points());
    let (on_base, on_platform) = (exact(&base, Body::Base), exact(&platform, Body::Platform));
    let mut rounded = false;
    let mut point = |exact: &RealPoint, double: [f64; 3]| -> Option<RationalPoint> {
        let fraction = |x: &RealNumber| if let RealNumber::Exact(x) = x { x.as_rational() } else { None };
        let fractions: Option<Vec<Rational>> = exact.iter().map(fraction).collect();
        rounded |= fractions.is_none();
        let doubles = || double.iter().map(|x| rational(*x)).collect();
        fractions.or_else(doubles)?.try_into().ok()
    };
    let mut ends = |body: &NamedJoints, exact: &[RealPoint], of: fn(&(usize, usize)) -> usize| {
        let list: Option<Vec<_>> =
            pairs.iter().map(of).map(|joint| point(&exact[joint], body.joints[joint].point)).collect();
        list?.try_into().ok()
    };
    design.pentapod = Pentapod {
        base: ends(&base, &on_base, |pair| pair.0)?,
        platform: ends(&platform, &on_platform, |pair| pair.1)?,
    };
    design.rounded = rounded;
    let (base, platform) = (base.names(), platform.names());
    design.leg_names = pairs.map(|(a, b)| [base[a].clone(), platform[b].clone()]);
    Some(design)
}
