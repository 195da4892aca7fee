//! Models of links with joints between them: URDF and SDF.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Point3, Unit, Vector3};

use super::graph::{JointKind, Mechanism, ModelJoint, WORLD};
use platform::geom::Pose;

/// The kind of a joint in the file.
#[derive(Debug)]
pub(super) enum LinkJointKind {
    Fixed,
    Slide,
    Ball,
    /// The axes of one hinge, or of the two of a universal joint, model frame.
    Hinges(Vec<Unit<Vector3<f64>>>),
}

/// A joint between two links, by their numbers; `None` is the world.
#[derive(Debug)]
pub(super) struct LinkJoint {
    pub(super) kind: LinkJointKind,
    pub(super) name: String,
    pub(super) links: [Option<usize>; 2],
    /// Its centre, model frame.
    pub(super) at: Point3<f64>,
}

/// A link.
#[derive(Debug)]
pub(super) struct ModelLink {
    pub(super) name: String,
    /// Its frame, model frame.
    pub(super) at: Pose,
}

/// Links and joints at the reference configuration.
#[derive(Debug, Default)]
pub(super) struct LinkedModel {
    pub(super) links: Vec<ModelLink>,
    pub(super) joints: Vec<LinkJoint>,
    pub(super) guesses: Vec<String>,
}

impl LinkedModel {
    /// Links joined to these by fixed joints.
    fn fixed_to(&self, first: BTreeSet<Option<usize>>) -> BTreeSet<Option<usize>> {
        let mut all = first;
        loop {
            let before = all.len();
            for joint in self.joints.iter().filter(|j| matches!(j.kind, LinkJointKind::Fixed)) {
                if joint.links.iter().any(|link| all.contains(link)) {
                    all.extend(joint.links);
                }
            }
            if all.len() == before {
                return all;
            }
        }
    }

    /// The base link: the one fixed to the world, otherwise the one named base.
    fn base(&self) -> Result<usize, String> {
        let called_base = |link: usize| self.links[link].name.to_lowercase().contains("base");
        let grounded: Vec<usize> = self.fixed_to(BTreeSet::from([None])).into_iter().flatten().collect();
        let named: Vec<usize> = (0..self.links.len()).filter(|link| called_base(*link)).collect();
        match (grounded.iter().find(|link| called_base(**link)).or(grounded.first()), &named[..]) {
            (Some(link), _) => Ok(*link),
            (None, [link, others @ ..]) => {
                let one = self.fixed_to(BTreeSet::from([Some(*link)]));
                if others.iter().all(|other| one.contains(&Some(*other))) {
                    Ok(*link)
                } else {
                    Err("several links are called base: join the base to the world by a fixed joint".into())
                }
            }
            (None, []) => Err(
                "no link is fixed to the world and none is called base, so that the base is not said: name it `base`"
                    .into(),
            ),
        }
    }

    /// Groups and joints in the frame of the base.
    pub(super) fn mechanism(mut self) -> Result<Mechanism, String> {
        let base = self.base()?;
        self.guesses.push(format!("The base is the link `{}`.", self.links[base].name));
        let back = self.links[base].at.inverse();
        let mut mechanism = Mechanism::new();
        let groups: Vec<usize> = self.links.iter().map(|_| mechanism.new_group()).collect();
        for (link, group) in self.links.iter().zip(&groups) {
            mechanism.first.insert(*group, (link.name.clone(), back.compose(&link.at)));
        }
        mechanism.join(groups[base], WORLD);
        for LinkJoint { kind, name, links, at } in self.joints {
            let of = |link: Option<usize>| link.map_or(WORLD, |link| groups[link]);
            let groups = links.map(of);
            let points = [back.transform(&at); 2];
            let mut add = |kind, groups, axis| {
                mechanism.joints.push(ModelJoint { kind, name: name.clone(), groups, points, axis });
            };
            match kind {
                LinkJointKind::Fixed => mechanism.join(groups[0], groups[1]),
                LinkJointKind::Slide => add(JointKind::Slide, groups, None),
                LinkJointKind::Ball => add(JointKind::Ball, groups, None),
                LinkJointKind::Hinges(axes) => {
                    let mut from = groups[0];
                    let count = axes.len();
                    for (k, axis) in axes.into_iter().enumerate() {
                        let to = if k + 1 == count { groups[1] } else { mechanism.new_group() };
                        mechanism.joints.push(ModelJoint {
                            kind: JointKind::Hinge,
                            name: name.clone(),
                            groups: [from, to],
                            points,
                            axis: Some(back.rotation * axis),
                        });
                        from = to;
                    }
                }
            }
        }
        mechanism.guesses = self.guesses;
        Ok(mechanism)
    }
}

/// The groups of a piece of the mechanism after the slides are removed.
type Piece = BTreeSet<usize>;

impl Mechanism {
    fn is_slide(joint: &ModelJoint) -> bool {
        joint.kind == JointKind::Slide
    }

    /// The groups that a group reaches without a slide.
    fn piece_of(&self, group: usize) -> Piece {
        let mut piece = Piece::from([self.group(group)]);
        loop {
            let before = piece.len();
            for joint in self.joints.iter().filter(|j| !Self::is_slide(j)) {
                let groups = joint.groups.map(|g| self.group(g));
                if groups.iter().any(|g| piece.contains(g)) {
                    piece.extend(groups);
                }
            }
            if piece.len() == before {
                return piece;
            }
        }
    }

    /// The group at the far end of a piece that hangs on slides: the one named platform, otherwise its only end.
    fn far_end(&self, piece: &Piece, slide: &ModelJoint) -> Result<usize, String> {
        if let Some(platform) = piece.iter().find(|g| self.is_called_platform(**g)) {
            return Ok(*platform);
        }
        let mut degrees: BTreeMap<usize, usize> = BTreeMap::new();
        for joint in self.joints.iter().filter(|j| !Self::is_slide(j)) {
            for group in joint.groups.map(|g| self.group(g)) {
                *degrees.entry(group).or_default() += 1;
            }
        }
        let on_slide = slide.groups.map(|g| self.group(g));
        let ends: Vec<usize> =
            piece.iter().copied().filter(|g| !on_slide.contains(g) && degrees.get(g) == Some(&1)).collect();
        match ends[..] {
            [end] => Ok(end),
            [] => Err(format!(
                "nothing follows the slide `{}`: give its other end a ball joint, or a joint of type floating, to a link there",
                slide.name
            )),
            _ => Err(format!(
                "the part beyond the slide `{}` has several ends, and none of them is called platform",
                slide.name
            )),
        }
    }

    fn is_called_platform(&self, group: usize) -> bool {
        self.names_of(group).any(|name| name.to_lowercase().contains("platform"))
    }

    /// Names of all links of a group.
    fn names_of(&self, group: usize) -> impl Iterator<Item = &str> {
        self.first.iter().filter(move |(g, _)| self.group(**g) == group).map(|(_, (name, _))| name.as_str())
    }

    /// Closes the loops of a tree: loose leg ends are joined to the platform, or to the base if the legs hang on the
    /// platform.
    pub(super) fn close_loops(&mut self, format: &str) -> Result<(), String> {
        let slides: Vec<ModelJoint> = self.joints.iter().filter(|j| Self::is_slide(j)).cloned().collect();
        let base = self.piece_of(WORLD);
        let mut ends: BTreeSet<usize> = BTreeSet::new();
        let mut hanging = Vec::new();
        for slide in &slides {
            let groups = slide.groups.map(|g| self.group(g));
            let Some(moved) = groups.into_iter().find(|g| !base.contains(g)) else { continue };
            if groups.iter().any(|g| base.contains(g)) {
                ends.insert(self.far_end(&self.piece_of(moved), slide)?);
            } else {
                hanging.push(slide);
            }
        }
        let Some(platform) = ends.iter().find(|g| self.is_called_platform(**g)).or(ends.first()).copied()
        else {
            return Ok(());
        };
        let platform_piece = self.piece_of(platform);
        let mut feet = Vec::new();
        for slide in hanging {
            let groups = slide.groups.map(|g| self.group(g));
            if let Some(loose) = groups.into_iter().find(|g| !platform_piece.contains(g)) {
                feet.push(self.far_end(&self.piece_of(loose), slide)?);
            }
        }
        let named = |model: &Self, groups: &[usize]| {
            groups
                .iter()
                .flat_map(|g| model.names_of(*g))
                .map(|n| format!("`{n}`"))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let tips: Vec<usize> = ends.into_iter().filter(|end| *end != platform).collect();
        if !tips.is_empty() {
            self.guesses.push(format!(
                "{format} has no closed loops: {} are taken as one with the platform, {}.",
                named(self, &tips),
                named(self, &[platform])
            ));
        }
        if !feet.is_empty() {
            self.guesses.push(format!(
                "{format} has no closed loops: {} are taken as one with the base.",
                named(self, &feet)
            ));
        }
        for tip in tips {
            self.join(tip, platform);
        }
        for foot in feet {
            self.join(foot, WORLD);
        }
        Ok(())
    }

    /// The frame of the platform from the file: that of the link named platform, otherwise of its only link.
    pub(super) fn platform_frame(&self, platform: usize) -> Option<&(String, Pose)> {
        let mut links =
            self.first.iter().filter(|(g, _)| self.group(**g) == platform).map(|(_, first)| first);
        let called = links.clone().find(|(name, _)| name.to_lowercase().contains("platform"));
        called.or_else(|| links.next().filter(|_| links.next().is_none()))
    }
}
