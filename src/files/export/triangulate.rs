//! Triangles of a polygon with holes, for meshes.

use nalgebra::Point2;

fn cross(a: &Point2<f64>, b: &Point2<f64>, c: &Point2<f64>) -> f64 {
    (b - a).perp(&(c - a))
}

/// Whether two segments have a point in common.
fn meet(a: &Point2<f64>, b: &Point2<f64>, c: &Point2<f64>, d: &Point2<f64>) -> bool {
    let apart = |p: &Point2<f64>, q: &Point2<f64>, r: &Point2<f64>, s: &Point2<f64>| {
        let (x, y) = (cross(p, q, r), cross(p, q, s));
        (x > 0.0 && y > 0.0) || (x < 0.0 && y < 0.0)
    };
    !apart(a, b, c, d) && !apart(c, d, a, b)
}

/// Joins the holes to the outer polygon by pairs of opposite edges; returns one closed walk over the indices of
/// `points`.
fn bridged(points: &[Point2<f64>], loops: &[Vec<usize>]) -> Vec<usize> {
    let mut walk = loops.first().cloned().unwrap_or_default();
    let rightmost = |l: &Vec<usize>| -> usize {
        (0..l.len()).max_by(|i, j| points[l[*i]].x.total_cmp(&points[l[*j]].x)).unwrap_or(0)
    };
    let mut holes: Vec<&Vec<usize>> = loops.iter().skip(1).collect();
    holes.sort_by(|a, b| points[b[rightmost(b)]].x.total_cmp(&points[a[rightmost(a)]].x));
    for (k, hole) in holes.iter().enumerate() {
        let start = rightmost(hole);
        let from = hole[start];
        // a point where bridges end already has two sides, so it takes no further bridge
        let mut ends: Vec<usize> =
            (0..walk.len()).filter(|i| walk.iter().filter(|w| **w == walk[*i]).count() == 1).collect();
        let distance = |i: usize| (points[walk[i]] - points[from]).norm();
        ends.sort_by(|i, j| distance(*i).total_cmp(&distance(*j)));
        let free = |end: usize| {
            let rings = holes[k..].iter().map(|h| h.as_slice()).chain([walk.as_slice()]);
            rings.flat_map(|ring| (0..ring.len()).map(move |i| (ring[i], ring[(i + 1) % ring.len()]))).all(
                |(c, d)| {
                    [c, d].iter().any(|x| *x == from || *x == end)
                        || !meet(&points[from], &points[end], &points[c], &points[d])
                },
            )
        };
        let at = ends.iter().copied().find(|i| free(walk[*i])).unwrap_or(0);
        let detour = (0..=hole.len()).map(|i| hole[(start + i) % hole.len()]).chain([walk[at]]);
        let detour: Vec<usize> = detour.collect();
        let rest = walk.split_off(at + 1);
        walk.extend(detour);
        walk.extend(rest);
    }
    walk
}

/// Triangles that fill `outer` (counter-clockwise) without `holes` (clockwise), counter-clockwise, by ear clipping.
/// Indices count the points of `outer`, then those of the holes.
pub(super) fn triangulate(outer: &[Point2<f64>], holes: &[Vec<Point2<f64>>]) -> Vec<[usize; 3]> {
    let mut points = outer.to_vec();
    let mut loops = vec![(0..outer.len()).collect::<Vec<_>>()];
    for hole in holes {
        loops.push((points.len()..points.len() + hole.len()).collect());
        points.extend_from_slice(hole);
    }
    let mut walk = bridged(&points, &loops);
    let mut out = Vec::new();
    while walk.len() > 3 {
        let n = walk.len();
        let corner = |i: usize| [walk[(i + n - 1) % n], walk[i], walk[(i + 1) % n]];
        let is_ear = |i: &usize| {
            let [a, b, c] = corner(*i).map(|k| points[k]);
            let inside = |p: &Point2<f64>| {
                cross(&a, &b, p) >= 0.0 && cross(&b, &c, p) >= 0.0 && cross(&c, &a, p) >= 0.0
            };
            let foreign = |k: &&usize| !corner(*i).contains(*k);
            cross(&a, &b, &c) > 0.0 && !walk.iter().filter(foreign).any(|k| inside(&points[*k]))
        };
        // if rounding leaves no ear, cut the flattest corner, so that the mesh stays closed
        let flatness = |i: usize| {
            let [a, b, c] = corner(i).map(|k| points[k]);
            cross(&a, &b, &c).abs()
        };
        let ear = (0..n).find(is_ear);
        let ear = ear.or_else(|| (0..n).min_by(|i, j| flatness(*i).total_cmp(&flatness(*j)))).unwrap_or(0);
        out.push(corner(ear));
        walk.remove(ear);
    }
    if let [a, b, c] = walk[..] {
        out.push([a, b, c]);
    }
    out
}
