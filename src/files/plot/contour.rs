//! Contour lines by marching squares.
//!
//! The line `f = level` crosses each cell of a grid in no, one or two segments. Crossings are interpolated linearly on
//! the grid edges. Their edges chain them into polylines, so nothing depends on comparing coordinates. In a saddle cell
//! the mean of the corners decides which corners are joined.
//!
//! Source: W. Lorensen, H. Cline, Marching cubes (1987), in two dimensions.

use std::collections::BTreeMap;

/// A grid edge: column, row, and `true` for the edge to the next column.
type Edge = (usize, usize, bool);

/// Values on a grid of `columns` x `rows` points, row by row.
#[derive(Debug, Clone)]
pub struct ValueGrid {
    /// Points in a row.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// The values, row by row.
    pub values: Vec<f64>,
}

impl ValueGrid {
    fn value(&self, i: usize, j: usize) -> f64 {
        self.values[j * self.columns + i]
    }

    /// The crossing on an edge in grid coordinates.
    fn crossing(&self, (i, j, along): Edge, level: f64) -> (f64, f64) {
        let (a, b) = (self.value(i, j), if along { self.value(i + 1, j) } else { self.value(i, j + 1) });
        let t = (level - a) / (b - a);
        if along { (i as f64 + t, j as f64) } else { (i as f64, j as f64 + t) }
    }

    fn segments(&self, level: f64) -> Vec<[Edge; 2]> {
        let mut out = Vec::new();
        for j in 0..self.rows.saturating_sub(1) {
            for i in 0..self.columns.saturating_sub(1) {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                let above = corners.map(|(i, j)| self.value(i, j) >= level);
                let edges: [Edge; 4] = [(i, j, true), (i + 1, j, false), (i, j + 1, true), (i, j, false)];
                let cut: Vec<usize> = (0..4).filter(|&k| above[k] != above[(k + 1) % 4]).collect();
                match *cut.as_slice() {
                    [p, q] => out.push([edges[p], edges[q]]),
                    [..] if cut.len() == 4 => {
                        let mean = corners.iter().map(|c| self.value(c.0, c.1)).sum::<f64>() / 4.0;
                        // the corners on the side of the mean are connected, the other two are cut off
                        let first_cut_off = (mean >= level) != above[0];
                        let pairs = if first_cut_off { [[3, 0], [1, 2]] } else { [[0, 1], [2, 3]] };
                        out.extend(pairs.map(|[p, q]| [edges[p], edges[q]]));
                    }
                    _ => {}
                }
            }
        }
        out
    }

    /// The lines `f = level` in grid coordinates; a closed line ends where it starts.
    pub fn contour(&self, level: f64) -> Vec<Vec<(f64, f64)>> {
        let segments = self.segments(level);
        let mut ends: BTreeMap<Edge, Vec<usize>> = BTreeMap::new();
        for (k, s) in segments.iter().enumerate() {
            for end in s {
                ends.entry(*end).or_default().push(k);
            }
        }
        let mut used = vec![false; segments.len()];
        let mut lines = Vec::new();
        // open lines first, from their ends; the remaining lines are closed
        let open: Vec<Edge> = ends.iter().filter(|(_, s)| s.len() == 1).map(|(e, _)| *e).collect();
        let closed: Vec<Edge> = segments.iter().map(|s| s[0]).collect();
        for start in open.into_iter().chain(closed) {
            let mut line = vec![start];
            let mut here = start;
            while let Some(k) = ends[&here].iter().copied().find(|&k| !used[k]) {
                used[k] = true;
                here = if segments[k][0] == here { segments[k][1] } else { segments[k][0] };
                line.push(here);
            }
            if line.len() > 1 {
                lines.push(line.into_iter().map(|e| self.crossing(e, level)).collect());
            }
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(f: impl Fn(f64, f64) -> f64) -> ValueGrid {
        let n = 41;
        let at = |k: usize| k as f64 / 20.0 - 1.0;
        ValueGrid { columns: n, rows: n, values: (0..n * n).map(|k| f(at(k % n), at(k / n))).collect() }
    }

    #[test]
    fn a_circle_is_one_closed_line_on_the_circle() {
        let lines = grid(|x, y| x * x + y * y).contour(0.5);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        for (i, j) in &lines[0] {
            let (x, y) = (i / 20.0 - 1.0, j / 20.0 - 1.0);
            assert!((x.hypot(y) - 0.5f64.sqrt()).abs() < 2e-3);
        }
    }

    #[test]
    fn a_straight_line_is_exact_and_a_missing_level_empty() {
        let lines = grid(|x, y| x + 2.0 * y).contour(0.3);
        assert_eq!(lines.len(), 1);
        for (i, j) in &lines[0] {
            assert!(((i / 20.0 - 1.0) + 2.0 * (j / 20.0 - 1.0) - 0.3).abs() < 1e-12);
        }
        assert!(grid(|x, y| x + y).contour(9.0).is_empty());
    }

    #[test]
    fn a_saddle_gives_two_lines() {
        assert_eq!(grid(|x, y| x * y).contour(0.013).len(), 2);
        assert_eq!(grid(|x, y| x * y).contour(-0.013).len(), 2);
    }
}
