//! Equivalent platforms with legs at requested places.

use nalgebra::Point3;

use crate::{AssessReport, Design};
use files::design::{DesignModel, Origin, Share};
use num::linalg::LinalgError;
use platform::manipulator::{Body, LegIndex, inverse_condition, jacobian};
use synthesis::LegMapOutcome;
use synthesis::components::Components;
use synthesis::relocate::search::{
    Candidate, Hole, Impossibility, LegSource, MoveSearchOptions, Placement, SearchError, SearchOutcome,
    SearchVerdict, Targets, search,
};
use synthesis::relocate::{Assembled, JointOrigin, spanning_joints};
use verify::decide_map;

/// Default least distance of two joints, as a share of the size.
const SPACING_SHARE: f64 = 0.01;
/// Default least inverse condition number, as a share of the design's own.
const CONDITIONING_SHARE: f64 = 0.1;
/// Default greatest distance of a joint from the centre of its body, in sizes of the design.
const REACH: f64 = 1.5;
/// A joint within this share of the size is on a line of others.
const ON_LINE: f64 = 1e-12;

/// Requested properties of an equivalent platform; missing ones follow from the design.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct MoveTargets {
    /// Whether every joint shall hold one leg.
    pub no_shared_joints: bool,
    /// Whether no two legs, as straight segments, may meet.
    pub no_crossing: bool,
    /// Least clearance of two legs; default: the leg diameter of the design, or 0.
    pub clearance: Option<f64>,
    /// Holes for joints.
    pub holes: Vec<Hole>,
    /// Least distance of two joints of one body; default: the least distance in the design, or a hundredth of its size.
    pub spacing: Option<f64>,
    /// Least inverse condition number of the Jacobian; default: a tenth of the design's own.
    pub conditioning: Option<f64>,
    /// Greatest distance of a joint from the centre of its body, in sizes of the design; default: 1.5.
    pub reach: Option<f64>,
    /// Whether all poses of the workspace are checked, rather than home alone.
    pub workspace: bool,
}

impl MoveTargets {
    num::setters! {
        /// Whether every joint shall hold one leg.
        fn no_shared_joints(no_shared_joints: bool) = no_shared_joints;
        /// Whether no two legs, as straight segments, may meet.
        fn no_crossing(no_crossing: bool) = no_crossing;
        /// Least clearance of two legs.
        fn clearance(clearance: Option<f64>) = clearance;
        /// Holes for joints.
        fn holes(holes: Vec<Hole>) = holes;
        /// Least distance of two joints of one body.
        fn spacing(spacing: Option<f64>) = spacing;
        /// Least inverse condition number of the Jacobian.
        fn conditioning(conditioning: Option<f64>) = conditioning;
        /// Greatest distance of a joint from the centre of its body, in sizes of the design.
        fn reach(reach: Option<f64>) = reach;
        /// Whether all poses of the workspace are checked, rather than home alone.
        fn workspace(workspace: bool) = workspace;
    }
}

/// The outcome of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SearchWord {
    /// A platform has every requested property and meets the requirements of the design.
    Found,
    /// Platforms with every requested property were found, but each of them violates requirements of the design.
    Violated,
    /// There is no such platform.
    Impossible,
    /// No such platform was found, which proves nothing.
    Undecided,
}

/// An equivalent platform of a search.
#[derive(Debug, Clone)]
pub struct MovedPlatform {
    /// Its legs, with the margins of the requested properties.
    pub candidate: Candidate,
    /// The legs, families and holes from which its legs come, in the order of the placements.
    pub sources: Vec<String>,
    /// The platform as a design; `None` if the legs make no platform.
    pub design: Option<Design>,
    /// The relation to the design, decided on the joints of both.
    pub map: LegMapOutcome,
    /// The margins of the design's requirements; `None` without requirements.
    pub assessed: Option<AssessReport>,
}

impl MovedPlatform {
    /// Whether the requirements of the design are met; `Some(true)` without requirements.
    #[must_use]
    pub fn met(&self) -> Option<bool> {
        self.assessed.as_ref().map_or(Some(true), AssessReport::met_at_assessed_poses)
    }

    /// Whether every property is fulfilled and every requirement proved.
    #[must_use]
    pub fn is_fulfilled(&self) -> bool {
        self.candidate.fulfilled && self.met() == Some(true)
    }

    /// The legs that differ from the legs of the design.
    #[must_use]
    pub fn new_legs(&self) -> Vec<LegIndex> {
        let new = |p: &&Placement| !matches!(p.source, LegSource::Kept(_));
        self.candidate.placements.iter().filter(new).map(|p| p.leg).collect()
    }

    /// Gives the platform a name and a description, and the leg lengths at the pose of the given design.
    fn finish(&mut self, given: &Design, number: usize) {
        let (c, assessed) = (&self.candidate, self.assessed.as_ref());
        let words = targets_in_words(
            c.fulfilled,
            assessed.map(|a| {
                let met = a.met_at_assessed_poses();
                (met, a.names(met))
            }),
        );
        let Some(out) = &mut self.design else { return };
        out.name = format!("{}, rearranged {number}", given.name);
        out.description = Some(format!(
            "Equivalent to \"{}\" by equipod {}: det A = {}, {words}",
            given.name,
            env!("CARGO_PKG_VERSION"),
            c.map.determinant
        ));
        let lengths = given.lengths.and_then(|l| c.map.closest.apply(&l.squared()).ok());
        out.lengths = lengths.map(|s| s.lengths());
    }
}

/// The requested properties and requirements that a platform has and misses. The argument `assessed` says whether all
/// requirements are met, with the names of the requirements of this verdict.
#[must_use]
pub fn targets_in_words(targets: bool, assessed: Option<(Option<bool>, String)>) -> String {
    let targets = if targets { "every target met" } else { "not every target met" };
    match assessed {
        None => targets.to_owned(),
        Some((Some(true), _)) => format!("{targets}, all requirements met"),
        Some((Some(false), names)) => format!("{targets}, requirements violated: {names}"),
        Some((None, names)) => format!("{targets}, requirements not proved: {names}"),
    }
}

/// The equivalent platforms that a search has found.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct MoveSearchReport {
    /// The search; its candidates are in `platforms`.
    pub outcome: SearchOutcome,
    /// The platforms in the order of the search, with those that fulfil everything first.
    pub platforms: Vec<MovedPlatform>,
}

impl MoveSearchReport {
    /// The outcome, including the requirements of the design.
    #[must_use]
    pub fn word(&self) -> SearchWord {
        let on_target = || self.platforms.iter().filter(|f| f.candidate.fulfilled);
        match self.outcome.verdict {
            SearchVerdict::Impossible(_) => SearchWord::Impossible,
            SearchVerdict::Found if on_target().any(MovedPlatform::is_fulfilled) => SearchWord::Found,
            SearchVerdict::Found if on_target().all(|f| f.met() == Some(false)) => SearchWord::Violated,
            SearchVerdict::Found | SearchVerdict::Undecided => SearchWord::Undecided,
        }
    }

    /// The first platform that fulfils everything, makes a design, and has a leg that the given design lacks.
    #[must_use]
    pub fn first_other(&self) -> Option<&MovedPlatform> {
        self.platforms.iter().find(|f| f.is_fulfilled() && !f.new_legs().is_empty() && f.design.is_some())
    }
}

/// The subject and verb of a sentence about this number of platforms.
fn platforms_meet(count: usize) -> String {
    if count == 1 {
        "1 equivalent platform meets".to_owned()
    } else {
        format!("{count} equivalent platforms meet")
    }
}

/// The outcome in a sentence.
impl std::fmt::Display for MoveSearchReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let o = &self.outcome;
        match o.verdict {
            SearchVerdict::Found => {
                let on_target = self.platforms.iter().filter(|f| f.candidate.fulfilled).count();
                let count = self.platforms.iter().filter(|f| f.is_fulfilled()).count();
                let assessed = self.platforms.iter().any(|f| f.assessed.is_some());
                match self.word() {
                    SearchWord::Found if assessed => {
                        write!(f, "{} every target and the requirements of the design", platforms_meet(count))
                    }
                    SearchWord::Found => write!(f, "{} every target", platforms_meet(count)),
                    SearchWord::Violated => write!(
                        f,
                        "{} every target, but each violates requirements of the design",
                        platforms_meet(on_target)
                    ),
                    _ => write!(
                        f,
                        "{} every target, but none is proved to meet the requirements of the design",
                        platforms_meet(on_target)
                    ),
                }
            }
            SearchVerdict::Impossible(Impossibility::NoLegAtHole(h)) => write!(
                f,
                "impossible, proved: no leg of any equivalent platform ends at hole {} (exact rank; smallest singular value {:.2e})",
                h + 1,
                o.holes[h].singular_value
            ),
            SearchVerdict::Impossible(Impossibility::PartnersAtInfinity(h)) => {
                write!(f, "impossible: the other end of every leg at hole {} is at infinity", h + 1)
            }
            SearchVerdict::Impossible(Impossibility::NotByThoseLegs(h)) => {
                write!(
                    f,
                    "impossible: no leg of the joint at hole {} can be replaced by a leg that ends there",
                    h + 1
                )
            }
            SearchVerdict::Impossible(Impossibility::SharedJoints(least)) => write!(
                f,
                "impossible: every equivalent platform has at least {least} shared {}. All replaceable legs are known, and six independent \
                 legs always share that many",
                if least == 1 { "joint" } else { "joints" }
            ),
            SearchVerdict::Impossible(Impossibility::HolesTogether) => f.write_str(
                "impossible: all replaceable legs are known, and no six independent legs reach all the holes",
            ),
            SearchVerdict::Undecided => write!(
                f,
                "undecided: no platform that meets every target was found in {} of {} pattern(s) of legs, which proves nothing",
                o.searched, o.patterns
            ),
        }
    }
}

impl Design {
    /// Searches for equivalent platforms with requested properties, and assesses each by the requirements of the
    /// design; `families` are its [replaceable legs](Self::replaceable_legs).
    ///
    /// # Errors
    /// [`SearchError`].
    pub fn search_moves(
        &self,
        families: &Components,
        targets: &MoveTargets,
        options: &MoveSearchOptions,
    ) -> Result<MoveSearchReport, SearchError> {
        let mut outcome = search(self.manipulator(), families, &self.targets(targets), options)?;
        let candidates = std::mem::take(&mut outcome.candidates).into_iter();
        let platforms = candidates.map(|c| self.assessed_move(families, c, options.seed));
        let mut platforms = platforms.collect::<Result<Vec<_>, _>>()?;
        platforms.sort_by_key(|f| !f.is_fulfilled());
        for (k, platform) in platforms.iter_mut().enumerate() {
            platform.finish(self, k + 1);
        }
        Ok(MoveSearchReport { outcome, platforms })
    }

    fn assessed_move(
        &self,
        families: &Components,
        candidate: Candidate,
        seed: u64,
    ) -> Result<MovedPlatform, LinalgError> {
        let parameters = candidate.placements.iter().flat_map(|p| p.parameters.iter().copied());
        let shares: Vec<Share> = parameters.filter_map(Share::shortest).collect();
        let design = self.with_legs_of(&candidate.assembled, &shares);
        let on_joints = design.as_ref().and_then(|d| decide_map(self.manipulator(), d.manipulator()).ok());
        let sources = candidate.placements.iter().map(|p| self.source_name(families, p.source));
        Ok(MovedPlatform {
            sources: sources.collect::<Result<_, _>>()?,
            map: on_joints.unwrap_or_else(|| candidate.map.clone()),
            assessed: design.as_ref().and_then(|d| d.assessed(seed)),
            design,
            candidate,
        })
    }

    fn source_name(&self, families: &Components, source: LegSource) -> Result<String, LinalgError> {
        Ok(match source {
            LegSource::Kept(leg) => leg.to_string(),
            LegSource::Family(k) => {
                let name = self.family_name(families, k)?;
                name.map_or(format!("family {}", k + 1), |n| format!("family {} {n}", k + 1))
            }
            LegSource::Hole(h) => format!("hole {}", h + 1),
            LegSource::Holes(h, l) => format!("holes {} and {}", h + 1, l + 1),
        })
    }

    /// The requested properties, with limits that follow from the design.
    fn targets(&self, asked: &MoveTargets) -> Targets {
        let m = self.manipulator();
        let (size, hardware) = (m.size(), self.hardware);
        let home = self.home_or_default();
        let poses = if asked.workspace { self.workspace.sample(&home) } else { vec![home] };
        let length = self.characteristic_length();
        let own = poses.iter().map(|p| inverse_condition(&jacobian(m, p, length))).fold(f64::MAX, f64::min);
        let housings = Body::BOTH.into_iter().flat_map(|body| (0..6).map(move |leg| (body, leg)));
        let widths =
            housings.filter_map(|(body, leg)| hardware.housing(body, leg)).map(|h| h.greatest_width());
        let spacing = asked.spacing.or(widths.reduce(f64::max)).or(self.optimize.min_joint_distance);
        let diameter = || hardware.leg_body.map_or(0.0, |b| b.diameter);
        Targets {
            no_shared_joints: asked.no_shared_joints,
            spacing: spacing.unwrap_or(SPACING_SHARE * size),
            clearance: asked.no_crossing.then(|| asked.clearance.unwrap_or_else(diameter)),
            holes: asked.holes.clone(),
            conditioning: asked.conditioning.unwrap_or(CONDITIONING_SHARE * own),
            reach: asked.reach.unwrap_or(REACH) * size,
            poses,
            characteristic_length: length,
        }
    }

    /// The name of a family, `P1:P4-P5`, if joints of the platform span it.
    ///
    /// # Errors
    /// A decomposition that does not converge.
    pub fn family_name(&self, found: &Components, family: usize) -> Result<Option<String>, LinalgError> {
        let join = |list: &[usize], names: &[String]| {
            list.iter().map(|k| names[*k].as_str()).collect::<Vec<_>>().join("-")
        };
        let joints = spanning_joints(self.manipulator(), found, family)?;
        Ok(joints
            .map(|[a, b]| format!("{}:{}", join(&a, self.base_names()), join(&b, self.platform_names()))))
    }

    /// The design with the joints of the new platform. A joint that all legs left keeps its name at the place of its
    /// first leg. The ends of other moved legs get the name with a letter. `None` if the legs make no platform.
    ///
    /// A new joint at one of the `shares` of the way between two fixed joints is constructed there, and so is exact.
    #[must_use]
    pub fn with_legs_of(&self, new: &Assembled, shares: &[Share]) -> Option<Self> {
        let platform = new.platform.clone().ok()?;
        let points = [platform.base_joints().to_vec(), platform.platform_joints().to_vec()];
        let mut taken: Vec<String> = self.base_names().iter().chain(self.platform_names()).cloned().collect();
        let mut names = |origins: &[JointOrigin], old: &[String]| -> Vec<String> {
            origins
                .iter()
                .map(|o| match o {
                    JointOrigin::Kept(k) | JointOrigin::Displaced(k) => old[*k].clone(),
                    JointOrigin::Split(k) => fresh(&old[*k], &mut taken),
                })
                .collect()
        };
        let base = names(&new.base, self.base_names());
        let on_platform = names(&new.platform_joints, self.platform_names());
        let built = DesignModel::new(self.name.clone(), self.units.clone(), platform)
            .with_joint_names(base, on_platform);
        let limit = ON_LINE * self.manipulator().size();
        let origins = |body: Body, of: &[JointOrigin]| -> Vec<Origin> {
            let old = self.manipulator().joints(body);
            let kept: Vec<usize> = of.iter().filter_map(JointOrigin::kept).collect();
            // on a line of joints that are still present, else of former joints
            let all: Vec<usize> = (0..old.len()).collect();
            let within = |list: &[usize]| -> Vec<[usize; 2]> {
                list.iter()
                    .flat_map(|i| list.iter().filter(move |j| *j != i).map(move |j| [*i, *j]))
                    .collect()
            };
            let lines = [within(&kept), within(&all)].concat();
            let between = |x: &Point3<f64>| {
                let at = |[i, j]: [usize; 2], t: f64| old[i] + (old[j] - old[i]) * t;
                let places = lines.iter().flat_map(|ends| shares.iter().map(move |t| (*ends, t)));
                places.into_iter().find(|(ends, t)| (at(*ends, t.nearest()) - x).norm() <= limit)
            };
            // the two parameters of a leg in a plane stand beside one another
            let in_plane = |x: &Point3<f64>| {
                let ways = |[i, j, k]: [usize; 3]| (old[i], old[j] - old[i], old[k] - old[i]);
                let triples = all.iter().flat_map(|i| within(&all).into_iter().map(move |[j, k]| [*i, j, k]));
                let triples = triples.filter(|[i, j, k]| i != j && i != k);
                let spanning = triples.filter(|t| {
                    let (_, a, b) = ways(*t);
                    a.cross(&b).norm() > ON_LINE * a.norm() * b.norm()
                });
                let places = spanning.flat_map(|t| shares.windows(2).map(move |pair| (t, pair)));
                places.into_iter().find(|(t, pair)| {
                    let (from, a, b) = ways(*t);
                    (from + a * pair[0].nearest() + b * pair[1].nearest() - x).norm() <= limit
                })
            };
            let origin = |(k, o): (usize, &JointOrigin)| {
                let place = &points[body.index()][k];
                match o {
                    JointOrigin::Kept(k) => Origin::Kept(*k),
                    JointOrigin::Displaced(_) | JointOrigin::Split(_) => {
                        let on_line =
                            || between(place).map(|(ends, t)| Origin::Between(ends, Box::new(t.clone())));
                        let on_plane = || {
                            let (corners, pair) = in_plane(place)?;
                            Some(Origin::InPlane(corners, Box::new([pair[0].clone(), pair[1].clone()])))
                        };
                        on_line().or_else(on_plane).unwrap_or(Origin::New)
                    }
                }
            };
            of.iter().enumerate().map(origin).collect()
        };
        let kept = [origins(Body::Base, &new.base), origins(Body::Platform, &new.platform_joints)];
        built.ok().map(|d| d.with_tables_of(self).constructed_from(self, [&kept[0], &kept[1]]).into())
    }
}

/// The name with the first letter or number that makes it unique.
fn fresh(name: &str, taken: &mut Vec<String>) -> String {
    let letters = ('a'..='z').map(|c| format!("{name}{c}"));
    let numbers = (1..).map(|k| format!("{name}_{k}"));
    let new = letters.chain(numbers).find(|n| !taken.contains(n)).unwrap_or_default();
    taken.push(new.clone());
    new
}
