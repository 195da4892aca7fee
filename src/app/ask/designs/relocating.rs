//! Which equivalent platforms have their legs where they are wanted?

use nalgebra::Point3;

use crate::{AssessReport, Design};
use files::design::{DesignModel, Origin, Share};
use num::linalg::LinalgError;
use platform::manipulator::{Body, LegIndex, inverse_condition, jacobian};
use synthesis::LegMapOutcome;
use synthesis::components::Components;
use synthesis::relocate::search::{
    Candidate, Hole, Impossibility, LegSource, MoveSearchOptions, Placement, SearchError, SearchOutcome,
    SearchVerdict, Wishes, search,
};
use synthesis::relocate::{Assembled, JointOrigin, spanning_joints};
use verify::judge;

/// Share of the size that two joints keep apart when nothing else is said.
const SPACING_SHARE: f64 = 0.01;
/// Share of the design's own inverse condition number that is asked for.
const CONDITIONING_SHARE: f64 = 0.1;
/// The greatest distance of a joint from the centre of its body, sizes of the design, when nothing else is said.
const REACH: f64 = 1.5;
/// A joint is on a line of others within this share of the size.
const ON_LINE: f64 = 1e-12;

/// Wishes for an equivalent platform; those that are absent follow from the design.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MoveWishes {
    /// Every joint holds one leg.
    pub no_shared_joints: bool,
    /// No two legs meet, taken as straight segments.
    pub no_crossing: bool,
    /// Least distance of two legs; the leg diameter of the design when absent, else 0.
    pub clearance: Option<f64>,
    /// Places for joints.
    pub holes: Vec<Hole>,
    /// Least distance of two joints of one body; that of the design when absent, else a hundredth of its size.
    pub spacing: Option<f64>,
    /// Least inverse condition number of the Jacobian; a tenth of the design's when absent.
    pub conditioning: Option<f64>,
    /// Greatest distance of a joint from the centre of its body, sizes of the design; 1.5 when absent.
    pub reach: Option<f64>,
    /// All poses of the workspace are looked at, and not only home.
    pub workspace: bool,
}

/// What came of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SearchWord {
    /// A platform that fulfils every wish and meets the requirements of the design.
    Found,
    /// Platforms that fulfil every wish were found, and each of them violates requirements of the design.
    Violated,
    /// There is none.
    Impossible,
    /// None was found, which proves nothing.
    Undecided,
}

/// An equivalent platform of a search.
#[derive(Debug, Clone)]
pub struct MovedPlatform {
    /// Its legs, with its margins over the wishes.
    pub candidate: Candidate,
    /// The names of the legs, families and holes from which its legs are, in the order of the placements.
    pub sources: Vec<String>,
    /// `None` where the legs make no platform.
    pub design: Option<Design>,
    /// The relation to the design, decided on the joints of both.
    pub map: LegMapOutcome,
    /// By how much it meets the requirements of the design; `None` where nothing is required.
    pub assessed: Option<AssessReport>,
}

impl MovedPlatform {
    /// Whether the requirements of the design are met; `Some(true)` where there are none.
    #[must_use]
    pub fn met(&self) -> Option<bool> {
        self.assessed.as_ref().map_or(Some(true), AssessReport::met)
    }

    /// Every wish, and every requirement proved.
    #[must_use]
    pub fn is_fulfilled(&self) -> bool {
        self.candidate.fulfilled && self.met() == Some(true)
    }

    /// The legs that are not legs of the design.
    #[must_use]
    pub fn new_legs(&self) -> Vec<LegIndex> {
        let new = |p: &&Placement| !matches!(p.source, LegSource::Kept(_));
        self.candidate.placements.iter().filter(new).map(|p| p.leg).collect()
    }

    /// Gives the design its name, its description and the leg lengths of the pose of the given design.
    fn finish(&mut self, given: &Design, number: usize) {
        let (c, judged) = (&self.candidate, self.assessed.as_ref());
        let words = wishes_in_words(c.fulfilled, judged.map(|a| (a.met(), a.names(a.met()))));
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

/// The wishes and the requirements that a platform fulfils and misses. `judged`: whether all requirements are met, and
/// the names of those of which the same is known.
#[must_use]
pub fn wishes_in_words(wishes: bool, judged: Option<(Option<bool>, String)>) -> String {
    let wishes = if wishes { "every wish fulfilled" } else { "not every wish fulfilled" };
    match judged {
        None => wishes.to_owned(),
        Some((Some(true), _)) => format!("{wishes}, all requirements met"),
        Some((Some(false), names)) => format!("{wishes}, requirements violated: {names}"),
        Some((None, names)) => format!("{wishes}, requirements not proved: {names}"),
    }
}

/// The equivalent platforms that a search has found.
#[derive(Debug, Clone)]
pub struct MoveSearchReport {
    /// The search; its candidates are in `platforms`.
    pub outcome: SearchOutcome,
    /// Those that fulfil everything come first, in the order of the search.
    pub platforms: Vec<MovedPlatform>,
}

impl MoveSearchReport {
    /// The verdict, the requirements of the design included.
    #[must_use]
    pub fn word(&self) -> SearchWord {
        let wished = || self.platforms.iter().filter(|f| f.candidate.fulfilled);
        match self.outcome.verdict {
            SearchVerdict::Impossible(_) => SearchWord::Impossible,
            SearchVerdict::Found if wished().any(MovedPlatform::is_fulfilled) => SearchWord::Found,
            SearchVerdict::Found if wished().all(|f| f.met() == Some(false)) => SearchWord::Violated,
            SearchVerdict::Found | SearchVerdict::Undecided => SearchWord::Undecided,
        }
    }

    /// The first platform that fulfils everything, makes a design, and has a leg that the given design has not.
    #[must_use]
    pub fn first_other(&self) -> Option<&MovedPlatform> {
        self.platforms.iter().find(|f| f.is_fulfilled() && !f.new_legs().is_empty() && f.design.is_some())
    }
}

/// The verdict in a sentence.
impl std::fmt::Display for MoveSearchReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let o = &self.outcome;
        match o.verdict {
            SearchVerdict::Found => {
                let wished = self.platforms.iter().filter(|f| f.candidate.fulfilled).count();
                let count = self.platforms.iter().filter(|f| f.is_fulfilled()).count();
                let judged = self.platforms.iter().any(|f| f.assessed.is_some());
                match self.word() {
                    SearchWord::Found if judged => {
                        write!(f, "{count} equivalent platform(s) fulfil every wish and meet the requirements of the design")
                    }
                    SearchWord::Found => write!(f, "{count} equivalent platform(s) fulfil every wish"),
                    SearchWord::Violated => write!(
                        f,
                        "{wished} equivalent platform(s) fulfil every wish, and each of them violates requirements of the design"
                    ),
                    _ => write!(
                        f,
                        "{wished} equivalent platform(s) fulfil every wish, and none of them is proved to meet the requirements of the design"
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
                write!(f, "impossible: a leg at hole {} can replace none of the legs of that joint", h + 1)
            }
            SearchVerdict::Impossible(Impossibility::SharedJoints(least)) => write!(
                f,
                "impossible: every equivalent platform has at least {least} shared joint(s): all replaceable legs are known, and six independent \
                 ones always share that many"
            ),
            SearchVerdict::Impossible(Impossibility::HolesTogether) => f.write_str(
                "impossible: all replaceable legs are known, and no six independent ones have ends at all the holes",
            ),
            SearchVerdict::Undecided => write!(
                f,
                "undecided: no platform with every wish was found in {} of {} pattern(s) of legs, which proves nothing",
                o.searched, o.patterns
            ),
        }
    }
}

impl Design {
    /// The equivalent platforms that fulfil wishes, each judged by the requirements of the design; `families` are its
    /// [replaceable legs](Self::replaceable_legs).
    ///
    /// # Errors
    /// [`SearchError`].
    pub fn search_moves(
        &self,
        families: &Components,
        wishes: &MoveWishes,
        options: &MoveSearchOptions,
    ) -> Result<MoveSearchReport, SearchError> {
        let mut outcome = search(self.manipulator(), families, &self.wishes(wishes), options)?;
        let candidates = std::mem::take(&mut outcome.candidates).into_iter();
        let platforms = candidates.map(|c| self.judged_move(families, c, options.seed));
        let mut platforms = platforms.collect::<Result<Vec<_>, _>>()?;
        platforms.sort_by_key(|f| !f.is_fulfilled());
        for (k, platform) in platforms.iter_mut().enumerate() {
            platform.finish(self, k + 1);
        }
        Ok(MoveSearchReport { outcome, platforms })
    }

    fn judged_move(
        &self,
        families: &Components,
        candidate: Candidate,
        seed: u64,
    ) -> Result<MovedPlatform, LinalgError> {
        let parameters = candidate.placements.iter().flat_map(|p| p.parameters.iter().copied());
        let shares: Vec<Share> = parameters.filter_map(Share::shortest).collect();
        let design = self.with_legs_of(&candidate.assembled, &shares);
        let on_joints = design.as_ref().and_then(|d| judge(self.manipulator(), d.manipulator()).ok());
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

    /// The wishes with the limits that follow from the design.
    fn wishes(&self, asked: &MoveWishes) -> Wishes {
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
        Wishes {
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

    /// `P1:P4-P5`, when joints of the platform span the family.
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

    /// The design with the joints of the new platform: one that all legs left keeps its name where the first of them
    /// goes, the ends of others that left get the name with a letter. `None` when the legs make no platform.
    ///
    /// A new joint that is at one of the `shares` of the way between two joints that stay is constructed there, and one
    /// at two of them in the plane of three joints gets exact coordinates: then it is exact.
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
            // on a line of joints that are still there, else of joints that were
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

/// The name with the first letter or number that makes it a new one.
fn fresh(name: &str, taken: &mut Vec<String>) -> String {
    let letters = ('a'..='z').map(|c| format!("{name}{c}"));
    let numbers = (1..).map(|k| format!("{name}_{k}"));
    let new = letters.chain(numbers).find(|n| !taken.contains(n)).unwrap_or_default();
    taken.push(new.clone());
    new
}
