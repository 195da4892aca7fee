//! Following values from step to step: what belongs together, and where values meet on the real axis.

/// The values at one length.
#[derive(Debug, Clone, PartialEq)]
pub struct LocusStep {
    /// The length that is varied, design units.
    pub length: f64,
    /// Squared virtual lengths, one a pose; those not finite are passed over.
    pub values: Vec<LocusValue>,
}

/// One squared virtual length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocusValue {
    /// Real part, design units squared.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// The pose is real.
    pub real: bool,
}

/// Two values meet on the real axis and leave it, or the other way round: a double root in between.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocusMeeting {
    /// Index of the step before.
    pub after: usize,
    /// About this length.
    pub length: f64,
    /// About this value.
    pub value: f64,
}

/// Values this close, relative to the largest of the step, are one for the picture (poses that are mirror images).
const SAME: f64 = 1e-9;
/// The nearest value is the next one on the curve when every other is this much farther.
const CLEAR: f64 = 1.5;

/// One step with values told apart by the side of the real axis.
pub(super) struct Sides {
    pub(super) length: f64,
    /// On the real axis, ascending, with whether a pose is real.
    pub(super) axis: Vec<(f64, bool)>,
    /// Above it; the conjugates below are left out.
    pub(super) above: Vec<(f64, f64)>,
}

pub(super) fn sides(step: &LocusStep) -> Sides {
    let finite = step.values.iter().filter(|v| v.re.is_finite() && v.im.is_finite());
    let values: Vec<&LocusValue> = finite.collect();
    let scale = values.iter().map(|v| v.re.hypot(v.im)).fold(0.0, f64::max);
    let near = |d: f64| d <= SAME * scale;
    let mut out = Sides { length: step.length, axis: Vec::new(), above: Vec::new() };
    for v in values {
        if v.real || near(v.im.abs()) {
            match out.axis.iter_mut().find(|a| near((a.0 - v.re).abs())) {
                Some(known) => known.1 |= v.real,
                None => out.axis.push((v.re, v.real)),
            }
        } else if v.im > 0.0 && !out.above.iter().any(|a| near((a.0 - v.re).hypot(a.1 - v.im))) {
            out.above.push((v.re, v.im));
        }
    }
    out.axis.sort_by(|a, b| a.0.total_cmp(&b.0));
    out
}

/// What becomes of the values between two steps.
pub(super) struct Links {
    /// Indices on the axis, before and after.
    pub(super) axis: Vec<(usize, usize)>,
    /// Indices above the axis.
    pub(super) above: Vec<(usize, usize)>,
    /// Two on the axis, one above; `before` tells on which side of the meeting the two are.
    pub(super) meetings: Vec<Met>,
}

/// A meeting with the indices of its values.
pub(super) struct Met {
    pub(super) pair: [usize; 2],
    pub(super) above: usize,
    pub(super) axis_before: bool,
    pub(super) length: f64,
    pub(super) value: f64,
}

pub(super) fn links(before: &Sides, after: &Sides) -> Links {
    let real = |s: &Sides| s.axis.iter().map(|a| (a.0, 0.0)).collect::<Vec<_>>();
    let (b, a) = (real(before), real(after));
    let axis = mutual(&b, &a);
    let above = mutual(&before.above, &after.above);
    let meetings = if before.axis.len() > after.axis.len() {
        meet(before, after, &axis, &above, true)
    } else {
        meet(after, before, &turned(&axis), &turned(&above), false)
    };
    Links { axis, above, meetings }
}

fn turned(pairs: &[(usize, usize)]) -> Vec<(usize, usize)> {
    pairs.iter().map(|p| (p.1, p.0)).collect()
}

/// Pairs each of which is the other's nearest by far.
fn mutual(before: &[(f64, f64)], after: &[(f64, f64)]) -> Vec<(usize, usize)> {
    let to: Vec<Option<usize>> = before.iter().map(|p| nearest(p, after)).collect();
    let back: Vec<Option<usize>> = after.iter().map(|p| nearest(p, before)).collect();
    let pair = |(i, j): (usize, &Option<usize>)| j.filter(|j| back[*j] == Some(i)).map(|j| (i, j));
    to.iter().enumerate().filter_map(pair).collect()
}

fn nearest(p: &(f64, f64), others: &[(f64, f64)]) -> Option<usize> {
    let distance = |q: &(f64, f64)| (p.0 - q.0).hypot(p.1 - q.1);
    let best = (0..others.len()).min_by(|i, j| distance(&others[*i]).total_cmp(&distance(&others[*j])))?;
    let limit = CLEAR * distance(&others[best]);
    let clear = others.iter().enumerate().all(|(k, q)| k == best || distance(q) >= limit);
    clear.then_some(best)
}

/// Values without a partner: two neighbours on the axis of one step and one above in the other. The square of half their difference is
/// smooth through the meeting and changes sign there, so that it is found by interpolation.
fn meet(
    two: &Sides,
    one: &Sides,
    axis: &[(usize, usize)],
    above: &[(usize, usize)],
    axis_before: bool,
) -> Vec<Met> {
    let mut free: Vec<usize> = (0..two.axis.len()).filter(|i| axis.iter().all(|p| p.0 != *i)).collect();
    let mut out = Vec::new();
    for k in (0..one.above.len()).filter(|k| above.iter().all(|p| p.1 != *k)) {
        let (re, im) = one.above[k];
        let middle = |i: usize| f64::midpoint(two.axis[free[i]].0, two.axis[free[i + 1]].0);
        let off = |i: &usize| (middle(*i) - re).abs();
        let Some(i) = (0..free.len().saturating_sub(1)).min_by(|i, j| off(i).total_cmp(&off(j))) else {
            break;
        };
        let half = 0.5 * (two.axis[free[i + 1]].0 - two.axis[free[i]].0);
        // farther apart than they can have come in one step: they belong to something else
        if off(&i) > 2.0 * (half + im) {
            continue;
        }
        let t = half * half / (half * half + im * im);
        out.push(Met {
            pair: [free[i], free[i + 1]],
            above: k,
            axis_before,
            length: two.length + t * (one.length - two.length),
            value: middle(i) + t * (re - middle(i)),
        });
        free.drain(i..i + 2);
    }
    out
}

/// Where values meet on the real axis, by interpolation between steps; meetings that are not clear are not reported.
#[must_use]
pub fn locus_meetings(steps: &[LocusStep]) -> Vec<LocusMeeting> {
    let sides: Vec<Sides> = steps.iter().map(sides).collect();
    let mut out = Vec::new();
    for (after, pair) in sides.windows(2).enumerate() {
        let found = links(&pair[0], &pair[1]).meetings;
        out.extend(found.iter().map(|m| LocusMeeting { after, length: m.length, value: m.value }));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Roots of `x^2 = t` beside one that stays.
    fn step(t: f64) -> LocusStep {
        let root = t.abs().sqrt();
        let value = |re: f64, im: f64| LocusValue { re, im, real: im.to_bits() << 1 == 0 };
        let pair = if t > 0.0 {
            [value(-root, 0.0), value(root, 0.0)]
        } else {
            [value(0.0, -root), value(0.0, root)]
        };
        LocusStep { length: t, values: vec![pair[0], value(9.0, 0.0), pair[1]] }
    }

    #[test]
    fn a_double_root_is_found_between_the_steps_in_both_directions() {
        let steps: Vec<LocusStep> = (0..10).map(|k| step(f64::from(k) - 4.3)).collect();
        let back: Vec<LocusStep> = steps.iter().rev().cloned().collect();
        for (list, after) in [(steps, 4), (back, 4)] {
            let found = locus_meetings(&list);
            assert_eq!(found.len(), 1, "{found:?}");
            assert_eq!(found[0].after, after);
            assert!(found[0].length.abs() < 1e-12 && found[0].value.abs() < 1e-12);
        }
    }

    #[test]
    fn values_that_stay_on_their_side_do_not_meet() {
        let steps: Vec<LocusStep> = (1..10).map(|k| step(f64::from(k))).collect();
        assert_eq!(locus_meetings(&steps), []);
        let none = LocusStep { length: 0.0, values: Vec::new() };
        assert_eq!(locus_meetings(&[step(1.0), none, step(-1.0)]), []);
    }

    #[test]
    fn equal_values_are_one_and_unclear_ones_are_not_linked() {
        let value = |re: f64, im: f64| LocusValue { re, im, real: false };
        let twice = sides(&LocusStep {
            length: 1.0,
            values: vec![value(2.0, 1.0), value(2.0, 1.0), value(3.0, 1e-12), value(f64::NAN, 0.0)],
        });
        assert_eq!((twice.above.len(), twice.axis.as_slice()), (1, [(3.0, false)].as_slice()));
        assert_eq!(mutual(&[(0.0, 1.0)], &[(0.1, 1.0), (-0.11, 1.0)]), []);
        assert_eq!(mutual(&[(0.0, 1.0)], &[(0.1, 1.0), (-0.9, 1.0)]), [(0, 0)]);
    }
}
