//! Coordinates from constructions, evaluated in the order of their dependencies.

use std::ops::Range;

use nalgebra::{Point3, Rotation3, Vector3};
use thiserror::Error;

use super::expression::{Expression, Unsolved};
use super::{
    Construction, Constructions, CoordinatePlane, LinePlace, MirrorPlane, RealPoint, WrittenCranks,
    WrittenHome, WrittenNumber, exact_double,
};
use crate::design::Code;
use crate::design::keys::nearest_help;
use num::real::{NoReal, RealNumber};
use platform::manipulator::Body;

/// Most operations of all constructions of a design, square roots counted as twenty.
const MAX_WORK: usize = 12_000;

/// The owner of a fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::design) enum Owner {
    Parameter(usize),
    Joint(Body, usize),
    Home,
    /// All cranks, or the one at a base joint.
    Crank(Option<usize>),
}

/// The reason why a construction gives no point.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{message}; {help}")]
pub(crate) struct Fault {
    pub(in crate::design) owner: Owner,
    /// The part at fault: a coordinate, a key.
    pub(in crate::design) part: Option<usize>,
    /// The place in the expression.
    pub(in crate::design) within: Option<Range<usize>>,
    pub(in crate::design) code: Code,
    pub(in crate::design) message: String,
    pub(in crate::design) help: String,
}

/// Names of the joints, and their coordinates where they are three numbers: not finite where they could not be read.
#[derive(Debug, Clone, Copy)]
pub(in crate::design) struct Joints<'a> {
    pub(in crate::design) names: [&'a [String]; 2],
    pub(in crate::design) points: [&'a [Point3<f64>]; 2],
    /// Parameters whose values could not be read.
    pub(in crate::design) unread: &'a [String],
}

impl Constructions {
    /// The exact coordinates of all joints, which are kept, and the nearest doubles; also the home pose, which is kept.
    ///
    /// Every fault is reported once; values that depend on a faulty one stay silent.
    pub(in crate::design) fn resolve(
        &mut self,
        given: Joints<'_>,
    ) -> Result<[Vec<Point3<f64>>; 2], Vec<Fault>> {
        let mut faults = Vec::new();
        self.limit_work(&mut faults);
        if !faults.is_empty() {
            return Err(faults);
        }
        let parameters = self.parameters(given.unread, &mut faults);
        let mut complete = true;
        let mut points = [Vec::new(), Vec::new()];
        for body in Body::BOTH {
            let k = body.index();
            if self.joints[k].is_empty() {
                points[k] = given.points[k].to_vec();
                self.exact[k] = Vec::new();
                continue;
            }
            let found = self.body(body, given, &parameters, &mut faults);
            points[k] =
                found.iter().flatten().map(|p| p.each_ref().map(RealNumber::nearest).into()).collect();
            for (j, p) in given.points[k].iter().enumerate() {
                // joints of three doubles keep their bits, including the sign of zero
                if let (None, Some(own)) = (&self.joints[k][j], points[k].get_mut(j)) {
                    *own = *p;
                }
            }
            complete &= found.iter().all(Option::is_some);
            self.exact[k] = found.into_iter().flatten().collect();
        }
        if let Some(mut home) = self.home.take() {
            complete &= self.resolve_home(&mut home, (&parameters, given.unread), &mut faults).is_some();
            self.home = Some(home);
        }
        if let Some(mut cranks) = self.cranks.take() {
            let values = (parameters.as_slice(), given.unread);
            complete &= self.resolve_cranks(&mut cranks, given.names[0], values, &mut faults).is_some();
            self.cranks = Some(cranks);
        }
        if faults.is_empty() && complete { Ok(points) } else { Err(faults) }
    }

    fn limit_work(&self, faults: &mut Vec<Fault>) {
        let parameters = self.parameters.iter().enumerate();
        let parameters = parameters.map(|(i, (_, q))| (Owner::Parameter(i), q.expression().work()));
        let joints = Body::BOTH.into_iter().flat_map(|body| {
            self.joints[body.index()].iter().enumerate().filter_map(move |(j, c)| {
                let own = c.as_ref()?.quantities().iter().map(|(_, q)| q.expression().work()).sum::<usize>();
                Some((Owner::Joint(body, j), own + 20))
            })
        });
        let home = self.home.iter().flat_map(WrittenHome::quantities);
        let home = home.map(|(_, q)| (Owner::Home, q.expression().work()));
        let cranks = self.cranks.iter().flat_map(WrittenCranks::all);
        let cranks = cranks.flat_map(|(joint, crank)| {
            let work = crank.quantities().into_iter().map(|(_, q)| q.expression().work());
            work.map(move |work| (Owner::Crank(joint), work)).collect::<Vec<_>>()
        });
        let mut sum = 0;
        for (owner, work) in parameters.chain(joints).chain(home).chain(cranks) {
            sum += work;
            if sum > MAX_WORK {
                faults.push(Fault {
                    owner,
                    part: None,
                    within: None,
                    code: Code::TooComplex,
                    message: format!("up to here the constructions take more than {MAX_WORK} operations"),
                    help: "write the coordinates of joints that no leg uses as numbers, or leave them out"
                        .into(),
                });
                return;
            }
        }
    }

    fn parameters(&self, unread: &[String], faults: &mut Vec<Fault>) -> Vec<Option<RealNumber>> {
        let place = |name: &str| self.parameters.iter().position(|(n, _)| n == name);
        let needs: Vec<Vec<usize>> = self
            .parameters
            .iter()
            .map(|(_, q)| q.expression().names().into_iter().filter_map(place).collect())
            .collect();
        let mut values = vec![None; self.parameters.len()];
        let (order, cycles) = ordered(&needs);
        for i in order {
            let owner = (Owner::Parameter(i), None);
            values[i] = self.quantity(owner, &self.parameters[i].1, (&values, unread), faults);
        }
        for cycle in cycles {
            let name = |i: &usize| self.parameters[*i].0.as_str();
            faults.push(circle(Owner::Parameter(cycle[0]), "parameters", cycle.iter().map(name)));
        }
        values
    }

    /// The pose of home from its numbers.
    fn resolve_home(
        &self,
        home: &mut WrittenHome,
        parameters: (&[Option<RealNumber>], &[String]),
        faults: &mut Vec<Fault>,
    ) -> Option<()> {
        // evaluate all of them, so that each fault is reported
        let of = |(part, q)| self.quantity((Owner::Home, Some(part)), q, parameters, faults);
        let values: Vec<Option<RealNumber>> = home.quantities().map(of).collect();
        home.values = values.into_iter().collect::<Option<_>>()?;
        let values: Vec<f64> = home.values.iter().map(RealNumber::nearest).collect();
        home.pose.position = Vector3::new(values[0], values[1], values[2]);
        if let [roll, pitch, yaw] = values[3..] {
            let [roll, pitch, yaw] = [roll, pitch, yaw].map(f64::to_radians);
            home.pose.rotation = Rotation3::from_euler_angles(roll, pitch, yaw);
        }
        Some(())
    }

    pub(super) fn quantity(
        &self,
        (owner, part): (Owner, Option<usize>),
        quantity: &WrittenNumber,
        (values, unread): (&[Option<RealNumber>], &[String]),
        faults: &mut Vec<Fault>,
    ) -> Option<RealNumber> {
        let named = |name: &str| {
            let i = self.parameters.iter().position(|(n, _)| n == name);
            match i {
                Some(i) => values[i].clone().ok_or(Unsolved::Poisoned),
                None if unread.iter().any(|n| n == name) => Err(Unsolved::Poisoned),
                None => Err(Unsolved::Name(name.to_string())),
            }
        };
        let expression: &Expression = quantity.expression();
        let stuck = match expression.value(&named) {
            Ok(value) => return Some(value),
            Err(stuck) => stuck,
        };
        let (code, message, help) = match stuck.why {
            Unsolved::Poisoned => return None,
            Unsolved::Name(name) => {
                let known: Vec<&str> = self.parameters.iter().map(|(n, _)| n.as_str()).collect();
                let message = format!("`{name}` is not one of [parameters]");
                (Code::UnknownName, message, known_names(&name, &known))
            }
            Unsolved::NoReal(why) => no_real(why),
        };
        faults.push(Fault { owner, part, within: Some(stuck.place), code, message, help });
        None
    }

    fn body(
        &self,
        body: Body,
        given: Joints<'_>,
        parameters: &[Option<RealNumber>],
        faults: &mut Vec<Fault>,
    ) -> Vec<Option<RealPoint>> {
        let (list, names) = (&self.joints[body.index()], given.names[body.index()]);
        let needs: Vec<Vec<usize>> =
            list.iter().map(|c| c.as_ref().map_or_else(Vec::new, |c| c.joints().to_vec())).collect();
        let mut found: Vec<Option<RealPoint>> = vec![None; list.len()];
        let (order, cycles) = ordered(&needs);
        for i in order {
            found[i] = match &list[i] {
                None => {
                    let p = &given.points[body.index()][i];
                    p.iter().all(|x| x.is_finite()).then(|| exact_double(p))
                }
                Some(c) => {
                    let values = (parameters, given.unread);
                    self.point((body, i), c, names, &found, values, faults)
                }
            };
        }
        for cycle in cycles {
            let name = |i: &usize| names[*i].as_str();
            faults.push(circle(
                Owner::Joint(body, cycle[0]),
                &format!("{body} joints"),
                cycle.iter().map(name),
            ));
        }
        found
    }

    fn point(
        &self,
        (body, joint): (Body, usize),
        construction: &Construction,
        names: &[String],
        found: &[Option<RealPoint>],
        parameters: (&[Option<RealNumber>], &[String]),
        faults: &mut Vec<Fault>,
    ) -> Option<RealPoint> {
        let owner = Owner::Joint(body, joint);
        let quantities = construction.quantities();
        // evaluate all of them, so that each fault is reported
        let values: Vec<Option<RealNumber>> = quantities
            .iter()
            .map(|(part, q)| self.quantity((owner, Some(*part)), q, parameters, faults))
            .collect();
        let values: Vec<RealNumber> = values.into_iter().collect::<Option<_>>()?;
        let points: Vec<&RealPoint> =
            construction.joints().iter().map(|j| found[*j].as_ref()).collect::<Option<_>>()?;
        let made = match construction {
            Construction::Coordinates(_) => return <[RealNumber; 3]>::try_from(values).ok(),
            Construction::OnLine { at, through } => {
                let (a, b) = (points[0], points[1]);
                on_line(a, b, at, &values[0]).unwrap_or_else(|| {
                    let [a, b] = through.map(|j| &names[j]);
                    faults.push(Fault {
                        owner,
                        part: Some(0),
                        within: None,
                        code: Code::NoLine,
                        message: format!(
                            "{a} and {b} are the same point, through which there is no one line"
                        ),
                        help: "name two joints that are apart".into(),
                    });
                    Ok(None)
                })
            }
            Construction::Polar { .. } => {
                let z = values.get(2).cloned().unwrap_or_else(|| RealNumber::integer(0));
                values[1].turn().and_then(|(c, s)| Ok(Some([values[0].times(&c)?, values[0].times(&s)?, z])))
            }
            Construction::Turned { about, .. } => {
                let [deg, through @ ..] = values.as_slice() else { return None };
                deg.turn()
                    .and_then(|cos_sin| around(points[0], through, |p| turned(p, about.index(), &cos_sin)))
            }
            Construction::Mirrored { plane: MirrorPlane::Coordinate(plane), .. } => {
                around(points[0], &values, |p| Ok(mirrored(p, *plane)))
            }
            Construction::Mirrored { .. } => {
                let (normal, through) = values.split_at(3);
                around(points[0], through, |p| reflected(p, normal))
            }
        };
        made.unwrap_or_else(|why| {
            let (code, message, help) = no_real(why);
            faults.push(Fault { owner, part: None, within: None, code, message, help });
            None
        })
    }
}

/// `None` if the points are equal or indistinguishable.
pub(super) fn on_line(
    a: &RealPoint,
    b: &RealPoint,
    at: &LinePlace,
    value: &RealNumber,
) -> Option<Result<Option<RealPoint>, NoReal>> {
    let share = || -> Result<Option<RealPoint>, NoReal> {
        let way = [0, 1, 2].map(|i| b[i].minus(&a[i]));
        let [x, y, z] = way;
        let way = [x?, y?, z?];
        let [x, y, z] = way.each_ref().map(|x| x.times(x));
        let square = x?.plus(&y?)?.plus(&z?)?;
        let share = match at {
            LinePlace::Share(_) => {
                if square.may_be_zero() {
                    return Err(NoReal::DivisionByZero);
                }
                value.clone()
            }
            LinePlace::Offset(_) => value.over(&square.sqrt()?)?,
        };
        let [x, y, z] = [0, 1, 2].map(|i| a[i].plus(&way[i].times(&share)?));
        Ok(Some([x?, y?, z?]))
    };
    match share() {
        Err(NoReal::DivisionByZero | NoReal::DivisorNearZero | NoReal::RootNearZero) => None,
        other => Some(other),
    }
}

/// The image of a point under a map that fixes another point: the origin if there is none.
fn around(
    p: &RealPoint,
    through: &[RealNumber],
    map: impl Fn(&RealPoint) -> Result<RealPoint, NoReal>,
) -> Result<Option<RealPoint>, NoReal> {
    let [x, y, z] = through else { return map(p).map(Some) };
    let [a, b, c] = p;
    let [a, b, c] = map(&[a.minus(x)?, b.minus(y)?, c.minus(z)?])?;
    Ok(Some([a.plus(x)?, b.plus(y)?, c.plus(z)?]))
}

/// Turned about an axis of the frame.
fn turned(p: &RealPoint, axis: usize, (c, s): &(RealNumber, RealNumber)) -> Result<RealPoint, NoReal> {
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut image = p.clone();
    image[i] = p[i].times(c)?.minus(&p[j].times(s)?)?;
    image[j] = p[i].times(s)?.plus(&p[j].times(c)?)?;
    Ok(image)
}

/// `p - 2 n (n p) / (n n)`.
fn reflected(p: &RealPoint, normal: &[RealNumber]) -> Result<RealPoint, NoReal> {
    let product = |a: &[RealNumber], b: &[RealNumber]| {
        a.iter().zip(b).try_fold(RealNumber::integer(0), |sum, (x, y)| sum.plus(&x.times(y)?))
    };
    let share = product(normal, p)?.over(&product(normal, normal)?)?.times(&RealNumber::integer(2))?;
    let one = |i: usize| p[i].minus(&share.times(&normal[i])?);
    Ok([one(0)?, one(1)?, one(2)?])
}

fn mirrored(p: &RealPoint, plane: CoordinatePlane) -> RealPoint {
    let mut image = p.clone();
    image[plane.normal()] = image[plane.normal()].negated();
    image
}

fn no_real(why: NoReal) -> (Code, String, String) {
    let (code, help) = match why {
        NoReal::DivisionByZero => (Code::DivisionByZero, "the divisor is exactly zero"),
        NoReal::DivisorNearZero => (
            Code::DivisionByZero,
            "write the divisor so that it is a number of a field, without nested roots",
        ),
        NoReal::NegativeRoot => (Code::NegativeRoot, "coordinates are real numbers"),
        NoReal::RootNearZero => {
            (Code::NegativeRoot, "write what is under the root so that it is a number of a field")
        }
        NoReal::TooLong => (Code::OutOfRange, "coordinates stay below 1e60"),
    };
    (code, why.to_string(), help.to_string())
}

/// "did you mean", or all names.
pub(in crate::design) fn known_names(given: &str, known: &[&str]) -> String {
    if known.is_empty() {
        return format!("add [parameters] with `{given} = ...`");
    }
    nearest_help("known names", given, &known[..known.len().min(200)])
}

fn circle<'a>(owner: Owner, what: &str, names: impl Iterator<Item = &'a str>) -> Fault {
    let mut names: Vec<&str> = names.take(20).collect();
    names.extend(names.first().copied());
    Fault {
        owner,
        part: None,
        within: None,
        code: Code::Cycle,
        message: format!("{what} follow from one another in a circle: {}", names.join(" -> ")),
        help: "give one of them by numbers".into(),
    }
}

/// An order in which everything comes after its dependencies. Also the circular dependencies that prevent one for the
/// rest, each from its first member on.
pub(super) fn ordered(needs: &[Vec<usize>]) -> (Vec<usize>, Vec<Vec<usize>>) {
    #[derive(Clone, Copy, PartialEq)]
    enum ResolvingState {
        New,
        Open,
        Done,
    }
    let mut state = vec![ResolvingState::New; needs.len()];
    let (mut order, mut cycles) = (Vec::new(), Vec::new());
    // members of circles and their dependents have no place in the order
    let mut lost = vec![false; needs.len()];
    for start in 0..needs.len() {
        if state[start] != ResolvingState::New {
            continue;
        }
        let mut path = vec![(start, 0)];
        state[start] = ResolvingState::Open;
        while let Some((i, next)) = path.last_mut() {
            let i = *i;
            let Some(&need) = needs[i].get(*next) else {
                state[i] = ResolvingState::Done;
                path.pop();
                lost[i] |= needs[i].iter().any(|n| lost[*n]);
                if !lost[i] {
                    order.push(i);
                }
                continue;
            };
            *next += 1;
            match state[need] {
                ResolvingState::Done => {}
                ResolvingState::New => {
                    state[need] = ResolvingState::Open;
                    path.push((need, 0));
                }
                ResolvingState::Open => {
                    let from = path.iter().position(|(j, _)| *j == need).unwrap_or(0);
                    let mut members: Vec<usize> = path[from..].iter().map(|(j, _)| *j).collect();
                    for j in &members {
                        lost[*j] = true;
                    }
                    let first = members.iter().enumerate().min_by_key(|(_, j)| **j).map_or(0, |(k, _)| k);
                    members.rotate_left(first);
                    cycles.push(members);
                }
            }
        }
    }
    (order, cycles)
}
