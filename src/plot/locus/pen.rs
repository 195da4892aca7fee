//! Pieces of curves joined to strokes, so that the document is no longer than it must be.

use super::super::style::Svg;

/// A stroke of one class.
struct Stroke {
    class: usize,
    heavy: bool,
    points: Vec<(f64, f64)>,
}

/// Strokes in the order of their beginnings.
#[derive(Default)]
pub(super) struct Pen {
    strokes: Vec<Stroke>,
    /// Strokes that ended at the last step and may go on, and those of this step.
    open: [Vec<usize>; 2],
}

impl Pen {
    /// The pieces that follow belong to the next step.
    pub(super) fn next_step(&mut self) {
        self.open[0] = std::mem::take(&mut self.open[1]);
    }

    /// Adds a piece: to the stroke that ends where it begins, else as a new one.
    pub(super) fn piece(&mut self, class: usize, heavy: bool, points: &[(f64, f64)]) {
        let [first, _, ..] = points else { return };
        let same = |p: (f64, f64), q: (f64, f64)| (p.0 - q.0).abs() + (p.1 - q.1).abs() < 1e-9;
        let goes_on = |k: &usize| {
            let s = &self.strokes[*k];
            s.class == class && s.heavy == heavy && s.points.last().is_some_and(|e| same(*e, *first))
        };
        let k = if let Some(k) = self.open[0].iter().copied().find(goes_on) {
            let stroke = &mut self.strokes[k].points;
            // what is not seen is not drawn, but the end stays where it is
            if let [.., p, q] = stroke[..]
                && (p.0 - q.0).hypot(p.1 - q.1) < 0.7
            {
                stroke.pop();
            }
            stroke.extend(&points[1..]);
            k
        } else {
            self.strokes.push(Stroke { class, heavy, points: points.to_vec() });
            self.strokes.len() - 1
        };
        self.open[1].push(k);
    }

    pub(super) fn draw(self, svg: &mut Svg) {
        for s in self.strokes {
            svg.polyline(&format!("along c{}{}", s.class, if s.heavy { " on" } else { "" }), &s.points);
        }
    }
}
