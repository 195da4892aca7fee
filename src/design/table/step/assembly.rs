//! Where the parts of an assembly are.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use nalgebra::Point3;

use super::part21::{ExchangeFile, StepRecord};
use super::shape::{Cylinder, PartShape, placement};
use crate::design::table::placed::{identity, inverse, within};
use crate::geom::Pose;

/// Assemblies in assemblies.
const MAX_DEPTH: usize = 50;
/// Parts that are placed. An assembly of assemblies of equal parts grows fast.
const MAX_PARTS: usize = 200_000;

/// A part or a surface of it in the frame of the whole, millimetres.
#[derive(Debug, Clone)]
pub(super) struct Named<T> {
    pub(super) shape: T,
    /// Of the part, of its occurrence, of the assembly it is in and so on; not that of the whole.
    pub(super) names: Vec<String>,
}

/// All spheres and cylinders.
#[derive(Debug, Default)]
pub(super) struct PartAssembly {
    pub(super) spheres: Vec<Named<Point3<f64>>>,
    pub(super) cylinders: Vec<Named<Cylinder>>,
    /// Millimetres of the unit of the first representation that has one.
    pub(super) unit: Option<f64>,
}

/// A representation of shapes.
struct Representation {
    items: Vec<u64>,
    /// Millimetres of its unit.
    unit: Option<f64>,
}

/// A group of representations in the frame of another.
struct Occurrence {
    child: u64,
    at: Pose,
    name: String,
}

/// The parts of a file by the number of their representation.
struct Parts<'a> {
    file: &'a ExchangeFile,
    representations: BTreeMap<u64, Representation>,
    /// The group of each representation, those in the same frame: the least number.
    group: HashMap<u64, u64>,
    occurrences: BTreeMap<u64, Vec<Occurrence>>,
    names: HashMap<u64, String>,
}

/// Millimetres of a unit of length.
fn millimetres(file: &ExchangeFile, id: u64, depth: usize) -> Option<f64> {
    if let Some(si) = file.record(id, "SI_UNIT") {
        let [.., prefix, name] = &si.values[..] else { return None };
        let power = match prefix.word() {
            None => 0,
            Some("MICRO") => -6,
            Some("MILLI") => -3,
            Some("CENTI") => -2,
            Some("DECI") => -1,
            Some("KILO") => 3,
            Some(_) => return None,
        };
        return (name.word() == Some("METRE")).then(|| 10.0_f64.powi(power + 3));
    }
    let measure = file.record(id, "CONVERSION_BASED_UNIT")?.values.last()?.reference()?;
    let record = ["LENGTH_MEASURE_WITH_UNIT", "MEASURE_WITH_UNIT"]
        .into_iter()
        .filter_map(|name| file.record(measure, name))
        .find(|r| r.values.len() == 2)?;
    let inner = if depth > 4 { None } else { millimetres(file, record.reference(1)?, depth + 1) };
    Some(record.values[0].number()? * inner?).filter(|x| x.is_finite() && *x > 0.0)
}

/// The unit of length of a context.
fn unit(file: &ExchangeFile, context: u64) -> Option<f64> {
    let units = file.record(context, "GLOBAL_UNIT_ASSIGNED_CONTEXT")?.values.first()?.list();
    let length = units.iter().filter_map(super::part21::StepValue::reference).find(|id| {
        file.record(*id, "LENGTH_UNIT").is_some()
            || file
                .record(*id, "SI_UNIT")
                .is_some_and(|r| r.values.last().and_then(super::part21::StepValue::word) == Some("METRE"))
    })?;
    millimetres(file, length, 0)
}

impl<'a> Parts<'a> {
    fn of(file: &'a ExchangeFile) -> Result<Self, String> {
        let mut parts = Self {
            file,
            representations: BTreeMap::new(),
            group: HashMap::new(),
            occurrences: BTreeMap::new(),
            names: HashMap::new(),
        };
        for id in &file.order {
            let records = file.entities.get(id).map_or(&[][..], Vec::as_slice);
            let found = records.iter().find_map(|r| {
                let known = r.name.ends_with("SHAPE_REPRESENTATION") || r.name == "REPRESENTATION";
                let [_, items, context] = &r.values[..] else { return None };
                let mut list = Vec::new();
                items.references(&mut list);
                (known && !items.list().is_empty())
                    .then_some(Representation { items: list, unit: unit(file, context.reference()?) })
            });
            if let Some(found) = found {
                parts.representations.insert(*id, found);
                parts.group.insert(*id, *id);
            }
        }
        parts.join_frames();
        parts.product_names();
        parts.place()?;
        parts.map()?;
        Ok(parts)
    }

    fn group_of(&self, mut id: u64) -> Option<u64> {
        loop {
            let next = *self.group.get(&id)?;
            if next == id {
                return Some(id);
            }
            id = next;
        }
    }

    /// The two representations of a relationship and what moves one to the other.
    fn related(records: &[StepRecord]) -> Option<(u64, u64, Option<u64>)> {
        let with = records.iter().find(|r| r.name == "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION");
        let pair =
            records.iter().find(|r| r.name.contains("REPRESENTATION_RELATIONSHIP") && r.values.len() >= 4)?;
        let moved = with.and_then(|r| r.values.last()?.reference());
        if with.is_some() && moved.is_none() {
            return None;
        }
        Some((pair.reference(2)?, pair.reference(3)?, moved))
    }

    /// Representations that are related without a transformation have the same frame.
    fn join_frames(&mut self) {
        for id in &self.file.order {
            let records = self.file.entities.get(id).map_or(&[][..], Vec::as_slice);
            let Some((first, second, None)) = Self::related(records) else { continue };
            if let (Some(a), Some(b)) = (self.group_of(first), self.group_of(second)) {
                self.group.insert(a.max(b), a.min(b));
            }
        }
    }

    fn product_name(&self, definition: u64) -> Option<String> {
        let formation = self.file.record(definition, "PRODUCT_DEFINITION")?.reference(2)?;
        let records = self.file.entities.get(&formation)?;
        let product =
            records.iter().find(|r| r.name.starts_with("PRODUCT_DEFINITION_FORMATION"))?.reference(2)?;
        let product = self.file.record(product, "PRODUCT")?;
        let texts = [product.values.get(1)?.text()?, product.values.first()?.text()?];
        texts.into_iter().find(|t| !t.trim().is_empty()).map(ToString::to_string)
    }

    fn product_names(&mut self) {
        for (_, record) in self.file.all("SHAPE_DEFINITION_REPRESENTATION") {
            let named = || {
                let property = self.file.record(record.reference(0)?, "PRODUCT_DEFINITION_SHAPE")?;
                Some((self.group_of(record.reference(1)?)?, self.product_name(property.reference(2)?)?))
            };
            if let Some((group, name)) = named() {
                self.names.entry(group).or_insert(name);
            }
        }
    }

    /// Whether `item` stands among the items of a representation.
    fn has(&self, representation: u64, item: u64) -> bool {
        self.representations.get(&representation).is_some_and(|r| r.items.contains(&item))
    }

    fn scale(&self, representation: u64) -> f64 {
        self.representations.get(&representation).and_then(|r| r.unit).unwrap_or(1.0)
    }

    /// Placements by relationship: the frame in the child goes to the frame in the parent.
    fn place(&mut self) -> Result<(), String> {
        // relationship: the occurrence that uses it
        let mut used: HashMap<u64, &StepRecord> = HashMap::new();
        for (_, record) in self.file.all("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION") {
            let occurrence = || {
                let property = self.file.record(record.reference(1)?, "PRODUCT_DEFINITION_SHAPE")?;
                let records = self.file.entities.get(&property.reference(2)?)?;
                let usage = records.iter().find(|r| r.name == "NEXT_ASSEMBLY_USAGE_OCCURRENCE")?;
                Some((record.reference(0)?, usage))
            };
            used.extend(occurrence());
        }
        let definition_of = self.definitions();
        for id in &self.file.order {
            let records = self.file.entities.get(id).map_or(&[][..], Vec::as_slice);
            let Some((first, second, Some(moved))) = Self::related(records) else { continue };
            let Some(transformation) = self.file.record(moved, "ITEM_DEFINED_TRANSFORMATION") else {
                return Err(format!(
                    "entity #{moved}, which places a part, is no ITEM_DEFINED_TRANSFORMATION; no other is read"
                ));
            };
            let (Some(a), Some(b)) = (transformation.reference(2), transformation.reference(3)) else {
                return Err(format!("entity #{moved} does not name two placements"));
            };
            let usage = used.get(id);
            // the first is the child, but for files that have it the other way round
            let child_of_usage =
                usage.and_then(|u| u.reference(4)).and_then(|d| definition_of.get(&d).copied());
            let turned = child_of_usage.is_some()
                && child_of_usage == self.group_of(second)
                && child_of_usage != self.group_of(first);
            let (child, parent) = if turned { (second, first) } else { (first, second) };
            // the items go with the representations, but for files that have these the other way round
            let straight = if turned { (b, a) } else { (a, b) };
            let swapped = self.has(parent, straight.0) && self.has(child, straight.1);
            let (of_child, of_parent) = if swapped { (straight.1, straight.0) } else { straight };
            let (Some(child_group), Some(parent_group)) = (self.group_of(child), self.group_of(parent))
            else {
                continue;
            };
            let inner = placement(self.file, of_child, self.scale(child))?;
            let outer = placement(self.file, of_parent, self.scale(parent))?;
            let text = |k: usize| usage.and_then(|u| u.values.get(k)?.text()).unwrap_or_default();
            let name = if text(1).trim().is_empty() { text(0) } else { text(1) };
            let at = within(&outer, &inverse(&inner));
            let occurrence = Occurrence { child: child_group, at, name: name.to_string() };
            self.occurrences.entry(parent_group).or_default().push(occurrence);
        }
        Ok(())
    }

    /// The group of the shape of each product definition.
    fn definitions(&self) -> HashMap<u64, u64> {
        let pair = |record: &StepRecord| {
            let property = self.file.record(record.reference(0)?, "PRODUCT_DEFINITION_SHAPE")?;
            Some((property.reference(2)?, self.group_of(record.reference(1)?)?))
        };
        self.file.all("SHAPE_DEFINITION_REPRESENTATION").filter_map(|(_, r)| pair(r)).collect()
    }

    /// Placements by `MAPPED_ITEM`.
    fn map(&mut self) -> Result<(), String> {
        let mut found = Vec::new();
        for (parent, representation) in &self.representations {
            for item in &representation.items {
                let Some(mapped) = self.file.record(*item, "MAPPED_ITEM") else { continue };
                let source = mapped.reference(1).and_then(|id| self.file.record(id, "REPRESENTATION_MAP"));
                let places =
                    source.and_then(|s| Some((s.reference(0)?, s.reference(1)?, mapped.reference(2)?)));
                let Some((origin, child, target)) = places else {
                    return Err(format!("entity #{item} does not say what it places where"));
                };
                let (Some(child_group), Some(parent_group)) = (self.group_of(child), self.group_of(*parent))
                else {
                    continue;
                };
                let inner = placement(self.file, origin, self.scale(child))?;
                let outer = placement(self.file, target, self.scale(*parent))?;
                let name = mapped.values.first().and_then(super::part21::StepValue::text).unwrap_or_default();
                let at = within(&outer, &inverse(&inner));
                found.push((parent_group, Occurrence { child: child_group, at, name: name.to_string() }));
            }
        }
        for (parent, occurrence) in found {
            self.occurrences.entry(parent).or_default().push(occurrence);
        }
        Ok(())
    }

    /// What each group has itself.
    fn shapes(&self) -> Result<BTreeMap<u64, PartShape>, String> {
        let mut shapes: BTreeMap<u64, PartShape> = BTreeMap::new();
        for (id, representation) in &self.representations {
            let group = self.group_of(*id).unwrap_or(*id);
            let found = PartShape::of(self.file, &representation.items, representation.unit.unwrap_or(1.0))?;
            let shape = shapes.entry(group).or_default();
            shape.spheres.extend(found.spheres);
            shape.cylinders.extend(found.cylinders);
        }
        Ok(shapes)
    }
}

impl PartAssembly {
    /// Places all parts.
    ///
    /// # Errors
    /// Placements that are not read; assemblies that contain themselves.
    pub(super) fn of(file: &ExchangeFile) -> Result<Self, String> {
        let parts = Parts::of(file)?;
        let shapes = parts.shapes()?;
        let children: BTreeSet<u64> = parts.occurrences.values().flatten().map(|o| o.child).collect();
        let mut assembly = Self::default();
        // the unit of the whole, where parts have others
        let roots: Vec<u64> = shapes.keys().copied().filter(|g| !children.contains(g)).collect();
        let of_root = |(id, r): (&u64, &Representation)| {
            roots.contains(&parts.group_of(*id)?).then_some(r.unit).flatten()
        };
        assembly.unit = parts.representations.iter().find_map(of_root);
        let mut open: Vec<(u64, Pose, Vec<String>, usize)> =
            roots.iter().rev().map(|g| (*g, identity(), Vec::new(), 0)).collect();
        let mut count = 0;
        while let Some((group, at, names, depth)) = open.pop() {
            count += 1;
            if depth > MAX_DEPTH || count > MAX_PARTS {
                return Err(format!(
                    "the assembly has more than {MAX_DEPTH} levels or {MAX_PARTS} parts, or contains itself"
                ));
            }
            if let Some(shape) = shapes.get(&group) {
                for p in &shape.spheres {
                    assembly.spheres.push(Named { shape: at.transform(p), names: names.clone() });
                }
                for c in &shape.cylinders {
                    let moved = Cylinder {
                        on_axis: at.transform(&c.on_axis),
                        axis: at.rotation * c.axis,
                        middle: c.middle.map(|p| at.transform(&p)),
                    };
                    assembly.cylinders.push(Named { shape: moved, names: names.clone() });
                }
            }
            for occurrence in parts.occurrences.get(&group).map_or(&[][..], Vec::as_slice).iter().rev() {
                let own = parts.names.get(&occurrence.child).cloned().unwrap_or_default();
                let mut inner = vec![own, occurrence.name.clone()];
                inner.extend(names.iter().cloned());
                open.push((occurrence.child, within(&at, &occurrence.at), inner, depth + 1));
            }
        }
        Ok(assembly)
    }
}
