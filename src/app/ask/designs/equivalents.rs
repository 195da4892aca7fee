//! The octahedral platform behind a design, and its equivalents as designs with names.

use std::sync::OnceLock;

use crate::{Design, Error};
use files::design::{DesignModel, InvalidShare, Origin, Share};
use platform::manipulator::{Body, LegIndex, Manipulator, NotOctahedral, Octahedral};
use synthesis::singularity::GriffisDuffy;
use synthesis::{
    AffineLegMap, Derivation, Family, HexagonPoint, InstantiateError, JointLabel, LegEnd, LegMapOutcome,
    LegMapTolerances, NearestOctahedral, NearestOptions, Offset, Pattern, Relation, corner, edge, leg_map,
    nearest_octahedral, sliding_body,
};

/// An octahedral platform with the names of its corners and of the joints on its edges.
#[derive(Debug, Clone)]
pub struct Original {
    /// Its triangles.
    pub octahedral: Octahedral,
    /// The octahedral platform as a design.
    pub design: Design,
    /// The beginning of the names of the equivalents.
    name: String,
    /// The names of `P1` .. `P6` in the design.
    corners: [String; 6],
    /// `Q1`, `Q1b` .. `Q6`, `Q6b`: the joints on the sides of the hexagon.
    on_edges: [[String; 2]; 6],
    /// The design as an equivalent of the octahedral platform; `None` if it is octahedral itself.
    pub seen: Option<(Pattern, Vec<f64>)>,
    /// The leg map from the octahedral platform to the design, if they differ; decided on the exact joints.
    pub map: Option<LegMapOutcome>,
}

/// The relation of a design to an octahedral platform.
#[derive(Debug, Clone)]
pub enum Origins {
    /// The design is octahedral, or made from an octahedral one by offsets along the sides of its triangles. The map
    /// tells whether within rounding or singular.
    Of(Box<Original>),
    /// The design looks like such a platform, and is proved not to be equivalent to it.
    Refuted(Box<LegMapOutcome>),
    /// There is no relation.
    None,
}

impl Original {
    /// The octahedral platform of a design. It is the design itself, or for separate joints the platform from which
    /// offsets along the sides of two triangles make the design. `None` for other designs.
    pub fn of(design: &Design) -> Option<Self> {
        match Self::behind(design) {
            Origins::Of(original) => Some(*original),
            Origins::Refuted(_) | Origins::None => None,
        }
    }

    /// As [`of`](Self::of), with the reason if there is none.
    pub fn behind(design: &Design) -> Origins {
        if let Ok(octahedral) = Octahedral::recognise(design.manipulator()) {
            return Origins::Of(Box::new(Self::octahedral(design, octahedral)));
        }
        let found = Self::griffis_duffy(design).map(|original| {
            let (from, to) = (original.design.manipulator(), design.manipulator());
            (leg_map(from, to, LegMapTolerances::default()).ok(), original)
        });
        match found {
            None => Origins::None,
            Some((Some(map), _)) if map.relation == Relation::Unrelated => Origins::Refuted(Box::new(map)),
            Some((map, original)) => Origins::Of(Box::new(Self { map, ..original })),
        }
    }

    /// An octahedral design; new joints on its edges get names different from its own.
    pub fn octahedral(design: &Design, octahedral: Octahedral) -> Self {
        let (base, platform) = (octahedral.base_indices(), octahedral.platform_indices());
        let corners = std::array::from_fn(|i| match i {
            0..3 => design.base_names()[base[i]].clone(),
            _ => design.platform_names()[platform[i - 3]].clone(),
        });
        let on_edges =
            std::array::from_fn(|side| [false, true].map(|second| free_name(design, side, second)));
        Self {
            octahedral,
            design: design.clone(),
            name: design.name.clone(),
            corners,
            on_edges,
            seen: None,
            map: None,
        }
    }

    /// A design of Griffis-Duffy type. Its joints at the corners are those of the original, and the leg on side `k`
    /// becomes leg `k` of the cycle.
    fn griffis_duffy(design: &Design) -> Option<Self> {
        let m = design.manipulator();
        let found = GriffisDuffy::recognise(m)?;
        let ends = found.order.map(|leg| m.pairs()[leg]);
        let (base, platform) = ([5, 1, 3].map(|k| ends[k].0), [0, 2, 4].map(|k| ends[k].1));
        let mut pairs = [(0, 0); 6];
        for (k, leg) in found.order.into_iter().enumerate() {
            pairs[leg] = (corner(Body::Base, k), corner(Body::Platform, k) - 3);
        }
        let points = |all: &[nalgebra::Point3<f64>], used: [usize; 3]| used.map(|i| all[i]).to_vec();
        let original =
            Manipulator::try_new(points(m.base_joints(), base), points(m.platform_joints(), platform), pairs)
                .ok()?;
        let octahedral = Octahedral::recognise_from(&original, LegIndex::new(found.order[0])?).ok()?;
        let (of_base, of_platform) = (design.base_names(), design.platform_names());
        let names = [base.map(|i| of_base[i].clone()), platform.map(|i| of_platform[i].clone())];
        let on_edges = std::array::from_fn(|k| {
            let (a, b) = ends[k];
            let own = if k % 2 == 0 { &of_base[a] } else { &of_platform[b] };
            [own.clone(), free_name(design, k, true)]
        });
        let [first, second] = names.clone().map(Vec::from);
        let named =
            DesignModel::new(format!("{}, octahedral original", design.name), &design.units, original);
        let corners = [base, platform].map(|list| list.map(Origin::Kept));
        let mut named = named
            .with_joint_names(first, second)
            .ok()?
            .with_tables_of(design)
            .constructed_from(design, [&corners[0], &corners[1]]);
        let [[p1, p2, p3], [p4, p5, p6]] = names;
        let pattern = Pattern::new([false; 6], [1; 6])?;
        let back = pattern.leg_map(&octahedral, &found.t).ok()?.invert().ok();
        let squares = design.lengths.zip(back).and_then(|(l, back)| back.apply(&l.squared()).ok());
        named.lengths = squares.map(|s| s.lengths());
        Some(Self {
            octahedral,
            design: named.into(),
            name: design.name.clone(),
            corners: [p1, p2, p3, p4, p5, p6],
            on_edges,
            seen: Some((pattern, found.t.to_vec())),
            map: None,
        })
    }

    /// The name of a joint, taken from the design if it has one.
    pub fn joint_name(&self, joint: JointLabel) -> String {
        match joint {
            JointLabel::Corner(i) => self.corners[i].clone(),
            JointLabel::OnEdge(o) => self.on_edges[o.side][usize::from(o.second)].clone(),
        }
    }

    /// Names of the two joints of a leg, base first.
    pub fn leg_names(&self, point: HexagonPoint) -> [String; 2] {
        point.joints().map(|j| self.joint_name(j))
    }

    /// The equivalent platform of a pattern as a design, with the tables of the original, and its leg map.
    ///
    /// It maps leg lengths of the original to those of the equivalent at the same pose.
    ///
    /// # Errors
    /// A wrong number of offsets, offsets that are not finite, or that make no platform.
    pub fn equivalent(
        &self,
        pattern: &Pattern,
        offsets: &[f64],
    ) -> Result<(Design, AffineLegMap), InstantiateError> {
        let shares: Vec<Share> = offsets.iter().copied().filter_map(Share::shortest).collect();
        self.built(pattern, offsets, &shares)
    }

    /// The same with offsets as written, which the joints of the design keep exactly.
    ///
    /// # Errors
    /// A wrong number of offsets, or offsets that make no platform.
    pub fn equivalent_at(
        &self,
        pattern: &Pattern,
        shares: &[Share],
    ) -> Result<(Design, AffineLegMap), InstantiateError> {
        let offsets: Vec<f64> = shares.iter().map(Share::nearest).collect();
        self.built(pattern, &offsets, shares)
    }

    fn built(
        &self,
        pattern: &Pattern,
        offsets: &[f64],
        shares: &[Share],
    ) -> Result<(Design, AffineLegMap), InstantiateError> {
        let m = pattern.instantiate(&self.octahedral, offsets)?;
        let map = pattern.leg_map(&self.octahedral, offsets)?;
        let [base, platform] = pattern.joints().map(|l| l.iter().map(|j| self.joint_name(*j)).collect());
        let own = &self.design;
        let plain = DesignModel::new(format!("{} {pattern}", self.name), &own.units, m);
        // a pattern has a name for each of its joints
        let built = plain.clone().with_joint_names(base, platform).unwrap_or(plain).with_tables_of(own);
        let [on_base, on_platform] = self.origins(pattern, shares);
        let mut built = built.constructed_from(own, [&on_base, &on_platform]);
        let listed = shares.iter().map(Share::to_string).collect::<Vec<_>>().join(", ");
        built.description = Some(format!("{pattern} of {}, offsets [{}]", own.name, listed));
        built.lengths = own.lengths.and_then(|l| map.apply(&l.squared()).ok()).map(|s| s.lengths());
        Ok((built.into(), map))
    }

    /// Offsets of a pattern as they are written: shares of the sides, or lengths with a unit from their first joints.
    ///
    /// # Errors
    /// A text that is neither; a unit where the design has none.
    pub fn shares(&self, pattern: &Pattern, texts: &[String]) -> Result<Vec<Share>, InvalidShare> {
        let order = pattern.offsets();
        let share = |(k, text): (usize, &String)| match order.get(k) {
            Some(offset) => {
                let ends = edge(offset.side).map(|i| self.corner_joint(i));
                self.design.share_of(sliding_body(offset.side), ends, text)
            }
            None => text.parse(),
        };
        texts.iter().enumerate().map(share).collect()
    }

    /// The joint of the design at a corner of the triangles.
    fn corner_joint(&self, i: usize) -> usize {
        let o = &self.octahedral;
        if i < 3 { o.base_indices()[i] } else { o.platform_indices()[i - 3] }
    }

    /// The derivation of the leg map to an equivalent platform of this pattern from coplanar joints. `None` for an edge
    /// of length zero, which no octahedral platform has.
    #[must_use]
    pub fn derivation(&self, pattern: &Pattern, built: &Design) -> Option<Derivation> {
        Derivation::of(&self.octahedral, self.design.manipulator(), pattern, built.manipulator())
    }

    /// The origins of the joints of a pattern: corners, and points between two corners.
    fn origins(&self, pattern: &Pattern, offsets: &[Share]) -> [Vec<Origin>; 2] {
        let corner = |i: usize| self.corner_joint(i);
        let order = pattern.offsets();
        pattern.joints().map(|list| {
            let origin = |joint: &JointLabel| match *joint {
                JointLabel::Corner(i) => Origin::Kept(corner(i)),
                JointLabel::OnEdge(offset) => {
                    let value = order.iter().position(|x| *x == offset).and_then(|k| offsets.get(k));
                    value.map_or(Origin::New, |t| {
                        Origin::Between(edge(offset.side).map(corner), Box::new(t.clone()))
                    })
                }
            };
            list.iter().map(origin).collect()
        })
    }
}

/// The name of a joint on an edge, with one `N` before it for each time the design has the name already.
fn free_name(design: &Design, side: usize, second: bool) -> String {
    let mut name = JointLabel::OnEdge(Offset { side, second }).to_string();
    while design.base_names().contains(&name) || design.platform_names().contains(&name) {
        name.insert(0, 'N');
    }
    name
}

/// All platforms equivalent to an octahedral one: patterns of joints on the sides of its triangles, and their designs.
#[derive(Debug, Clone)]
pub struct Equivalents {
    original: Original,
    /// Enumerated at the first use.
    family: OnceLock<Family>,
}

impl Equivalents {
    /// The class of the octahedral platform that the design is, or is made from.
    ///
    /// # Errors
    /// The reason why the design is neither octahedral nor made from an octahedral one.
    pub fn of(design: &Design) -> Result<Self, NotOctahedral> {
        match Original::of(design) {
            Some(original) => Ok(Self { original, family: OnceLock::new() }),
            None => Err(Octahedral::recognise(design.manipulator())
                .err()
                .unwrap_or_else(|| unreachable!("an octahedral design is its own original"))),
        }
    }

    /// The octahedral platform; the design itself if it is octahedral.
    #[must_use]
    pub fn original(&self) -> &Design {
        &self.original.design
    }

    /// All patterns with their topologies and counts.
    #[must_use]
    pub fn family(&self) -> &Family {
        self.family.get_or_init(Family::octahedral)
    }

    /// The platform of a pattern as a design, and the leg map from the octahedral platform to it. There is one offset
    /// for each inner point, as a fraction of its side.
    ///
    /// # Errors
    /// A wrong number of offsets, offsets that are not finite, or that make no platform.
    pub fn build(
        &self,
        pattern: &Pattern,
        offsets: &[f64],
    ) -> Result<(Design, AffineLegMap), InstantiateError> {
        self.original.equivalent(pattern, offsets)
    }

    /// The same at offsets as they are written: shares, or lengths along the sides with a unit.
    ///
    /// # Errors
    /// Texts that are no offsets; offsets that are too few or too many, or make no platform.
    pub fn build_at(&self, pattern: &Pattern, offsets: &[String]) -> Result<(Design, AffineLegMap), Error> {
        Ok(self.original.equivalent_at(pattern, &self.original.shares(pattern, offsets)?)?)
    }

    /// The platform without shared joints at these offsets, one for each side of the hexagon of legs, and the leg map
    /// to it.
    ///
    /// # Errors
    /// Offsets that are not finite or make no platform.
    pub fn joint_free(&self, offsets: [f64; 6]) -> Result<(Design, AffineLegMap), InstantiateError> {
        let pattern = Pattern::new([false; 6], [1; 6])
            .unwrap_or_else(|| unreachable!("one inner point on each side is a pattern"));
        self.build(&pattern, &offsets)
    }
}

/// The octahedral platform nearest to a design, as designs.
#[derive(Debug, Clone)]
pub struct NearestDesigns {
    /// Its distance from the design, and the map between the two.
    pub found: NearestOctahedral,
    /// The octahedral platform; its corners have the names of the joints that moved there.
    pub octahedral: Design,
    /// The platform equivalent to it with every leg near a leg of the design; its joints on sides are constructed from
    /// the corners.
    pub beside: Design,
}

impl NearestDesigns {
    /// The nearest octahedral platform of a design; `None` if no order of its legs around a hexagon gives a regular
    /// platform.
    pub fn of(design: &Design, options: &NearestOptions) -> Option<Self> {
        let found = nearest_octahedral(design.manipulator(), options)?;
        let ends = found.ends();
        let names = [Body::Base, Body::Platform].map(|body| joint_names(design, &ends, body));
        let corner_names = |body: Body| -> Vec<String> {
            let first = 3 * body.index();
            let name = |c: usize| names[body.index()].iter().find(|(end, _)| *end == LegEnd::Corner(c));
            // a corner without a leg keeps its own name
            (first..first + 3)
                .map(|c| name(c).map_or_else(|| format!("P{}", c + 1), |n| n.1.clone()))
                .collect()
        };
        let note = |what: &str| {
            Some(format!(
                "{what} \"{}\" by equipod {}: leg ends moved by at most {} {}",
                design.name,
                env!("CARGO_PKG_VERSION"),
                found.largest_displacement(),
                design.units
            ))
        };
        let plain = Design::new(
            format!("{}, nearest octahedral platform", design.name),
            &design.units,
            found.octahedral().ok()?,
        );
        let mut octahedral = plain
            .with_joint_names(corner_names(Body::Base), corner_names(Body::Platform))
            .ok()?
            .with_tables_of(design);
        octahedral.description = note("The octahedral platform nearest to");

        let listed =
            |body: Body| -> Vec<LegEnd> { names[body.index()].iter().map(|(end, _)| *end).collect() };
        let (base, platform) = (listed(Body::Base), listed(Body::Platform));
        let index = |list: &[LegEnd], end: LegEnd| list.iter().position(|e| *e == end);
        let mut pairs = [(0, 0); 6];
        for (pair, [a, b]) in pairs.iter_mut().zip(ends) {
            *pair = (index(&base, a)?, index(&platform, b)?);
        }
        let points = |list: &[LegEnd]| list.iter().map(|end| found.point(*end)).collect();
        let origins = |list: &[LegEnd]| -> Vec<Origin> {
            let origin = |end: &LegEnd| match *end {
                LegEnd::Corner(c) => Origin::Kept(c % 3),
                LegEnd::OnSide(k) => Origin::between(edge(k).map(|c| c % 3), found.offsets[k]),
            };
            list.iter().map(origin).collect()
        };
        let m = Manipulator::try_new(points(&base), points(&platform), pairs).ok()?;
        let [first, second] = names.map(|list| list.into_iter().map(|(_, name)| name).collect());
        let mut beside =
            DesignModel::new(format!("{}, moved onto an octahedral platform", design.name), &design.units, m)
                .with_joint_names(first, second)
                .ok()?
                .with_tables_of(design)
                .constructed_from(&octahedral, [&origins(&base), &origins(&platform)]);
        beside.description = note("Equivalent to an octahedral platform and nearest to");
        Some(Self { found, octahedral, beside: beside.into() })
    }
}

/// The joints of one body in the order of the legs, each once, with the name of the nearest joint of the design.
fn joint_names(design: &Design, ends: &[[LegEnd; 2]; 6], body: Body) -> Vec<(LegEnd, String)> {
    let mut out: Vec<(LegEnd, String)> = Vec::new();
    for (pair, own) in ends.iter().zip(design.leg_names()) {
        let end = pair[body.index()];
        if out.iter().any(|(known, _)| *known == end) {
            continue;
        }
        // legs that shared a joint may now have one each
        let mut name = body.of(own).to_owned();
        while out.iter().any(|(_, known)| *known == name) {
            name.push_str("_2");
        }
        out.push((end, name));
    }
    out
}
