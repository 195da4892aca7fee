//! A slice of the workspace, coloured by the limits around it.

use super::contour::ValueGrid;
use super::slice::SliceAxis;
use super::style::{LIMIT_FILLS, PixelAxis, Svg};

/// A limit of the workspace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WorkspaceLimit {
    /// Its code, which determines its colour ([`LIMIT_FILLS`]).
    pub code: &'static str,
    /// Its name in the legend.
    pub name: String,
}

/// The part of a required workspace in the slice.
#[derive(Debug, Clone, PartialEq)]
pub struct RequiredSection {
    /// The section of its region; absent without a region, or if the region misses the slice.
    pub outline: Option<SectionOutline>,
    /// Single poses that lie in the slice.
    pub poses: Vec<(f64, f64)>,
}

/// The boundary of a section.
#[derive(Debug, Clone, PartialEq)]
pub enum SectionOutline {
    /// A closed line through these points, which may be a segment or one point.
    Through(Vec<(f64, f64)>),
    /// The zero set of a function with these values at the grid points.
    Zero(Vec<f64>),
}

/// The contents of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct WorkspaceFigure {
    /// Title.
    pub title: String,
    /// Lines of text below the plot.
    pub notes: Vec<String>,
    /// The axis to the right.
    pub across: SliceAxis,
    /// The axis upwards.
    pub up: SliceAxis,
    /// Points of the grid per side, two or more.
    pub side: usize,
    /// Margins at the grid points, row by row from the lowest: positive inside the workspace.
    pub margins: Vec<f64>,
    /// The limit with the least margin at each grid point.
    pub worst: Vec<Option<usize>>,
    /// The limits with the least margin somewhere.
    pub limits: Vec<WorkspaceLimit>,
    /// The required workspace, if there is one.
    pub required: Option<RequiredSection>,
    /// The pose in the middle of the workspace and its label.
    pub home: ((f64, f64), String),
}

// the layout in pixels: sizes, and positions from the left and the top
const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 690.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 604.0;
const TOP: f64 = 56.0;
const BOTTOM: f64 = 576.0;

/// The workspace is white with a heavy boundary line; regions beyond it have the colour of the limit with the greatest
/// violation. Regions inside all limits that are not connected with home in the slice are dotted. A dashed line shows
/// the required workspace.
#[must_use]
pub fn workspace_slice(figure: &WorkspaceFigure) -> String {
    let x = PixelAxis { low: figure.across.low, high: figure.across.high, from: LEFT, to: RIGHT };
    let y = PixelAxis { low: figure.up.low, high: figure.up.high, from: BOTTOM, to: TOP };
    let inside = figure.margins.iter().filter(|m| **m > 0.0).count();
    let share = 100.0 * inside as f64 / figure.margins.len().max(1) as f64;
    let description = format!(
        "Reachable poses over {} and {}: {share:.0} % of the slice. Colours outside, by the limit with the largest violation: {}.",
        figure.across.label,
        figure.up.label,
        figure.limits.iter().map(|l| l.name.as_str()).collect::<Vec<_>>().join(", ")
    );
    let mut svg = Svg::new(WIDTH, HEIGHT, &figure.title, &description);
    svg.style(&css());
    svg.text("title", (LEFT, 32.0), &figure.title);
    let last = figure.side.saturating_sub(1).max(1) as f64;
    let place = |axis: &PixelAxis, k: f64| axis.at(axis.low + k / last * (axis.high - axis.low));
    let joined = joined(figure);
    cells(&mut svg, figure, &joined, &|k| place(&x, k), &|k| place(&y, k));
    let margins = figure.margins.iter().map(|m| m.clamp(-1e300, 1e300)).collect();
    let grid = ValueGrid { columns: figure.side, rows: figure.side, values: margins };
    for line in grid.contour(0.0) {
        let points: Vec<(f64, f64)> = line.into_iter().map(|(i, j)| (place(&x, i), place(&y, j))).collect();
        svg.polyline("boundary", &points);
    }
    required(&mut svg, figure, &grid, (&x, &y), &|i, j| (place(&x, i), place(&y, j)));
    let (at, label) = &figure.home;
    let at = (x.at(at.0), y.at(at.1));
    svg.circle("mark", at, 5.0);
    svg.text("halo", (at.0 + 9.0, at.1 + 4.0), label);
    frame(&mut svg, &x, &y, figure);
    legend(&mut svg, figure, &joined);
    svg.finish()
}

fn css() -> String {
    let fills = LIMIT_FILLS
        .iter()
        .map(|(code, fill)| format!(".{code}{{fill:{fill};fill-opacity:.62;shape-rendering:crispEdges}}"));
    fills.collect::<String>()
        + ".under{fill:none;stroke:#fff;stroke-width:5;stroke-linejoin:round}.required{fill:none;stroke:#00429d;stroke-width:2.4;stroke-dasharray:8 4;stroke-linejoin:round}.asked{fill:#fff;stroke:#00429d;stroke-width:2}.boundary{fill:none;stroke:#1a1a1a;stroke-width:2.2;stroke-linejoin:round}.apart{fill:#8a8a8a}.sample{stroke:#555;stroke-width:.6}"
}

/// The section of the required workspace, with a white line below it so that it is visible on every colour.
fn required(
    svg: &mut Svg,
    figure: &WorkspaceFigure,
    grid: &ValueGrid,
    (x, y): (&PixelAxis, &PixelAxis),
    place: &impl Fn(f64, f64) -> (f64, f64),
) {
    let Some(required) = &figure.required else { return };
    let within = |p: &(f64, f64)| {
        let inside = |axis: &SliceAxis, v: f64| v.clamp(axis.low, axis.high);
        (x.at(inside(&figure.across, p.0)), y.at(inside(&figure.up, p.1)))
    };
    let lines: Vec<Vec<(f64, f64)>> = match &required.outline {
        None => Vec::new(),
        Some(SectionOutline::Through(points)) => {
            vec![points.iter().chain(points.first()).map(within).collect()]
        }
        Some(SectionOutline::Zero(values)) => {
            let grid = ValueGrid { values: values.clone(), ..grid.clone() };
            grid.contour(0.0).into_iter().map(|l| l.into_iter().map(|(i, j)| place(i, j)).collect()).collect()
        }
    };
    for class in ["under", "required"] {
        for line in &lines {
            svg.polyline(class, line);
        }
    }
    for pose in &required.poses {
        svg.circle("asked", (x.at(pose.0), y.at(pose.1)), 4.0);
    }
}

/// Strips of grid points with the same limit, half a cell to either side.
fn cells(
    svg: &mut Svg,
    figure: &WorkspaceFigure,
    joined: &[bool],
    x: &impl Fn(f64) -> f64,
    y: &impl Fn(f64) -> f64,
) {
    let n = figure.side;
    let within = |k: f64| k.clamp(0.0, n.saturating_sub(1) as f64);
    let missed = |k: usize| figure.worst[k].filter(|_| !(figure.margins[k] > 0.0));
    for j in 0..n {
        let (low, high) = (y(within(j as f64 - 0.5)), y(within(j as f64 + 0.5)));
        let mut i = 0;
        while i < n {
            let own = missed(j * n + i);
            let run = (i..n).take_while(|i| missed(j * n + i) == own).count();
            if let Some(limit) = own {
                let (from, to) = (x(within(i as f64 - 0.5)), x(within((i + run) as f64 - 0.5)));
                svg.rect(figure.limits[limit].code, (from, high), (to - from, low - high));
            }
            i += run;
        }
    }
    for j in (0..n).step_by(3) {
        for i in (0..n).step_by(3).filter(|i| figure.margins[j * n + i] > 0.0 && !joined[j * n + i]) {
            svg.circle("apart", (x(i as f64), y(j as f64)), 0.9);
        }
    }
}

/// The grid points inside all limits that are connected with the one nearest to home.
fn joined(figure: &WorkspaceFigure) -> Vec<bool> {
    let n = figure.side;
    let nearest = |axis: &SliceAxis, value: f64| {
        let place = (value - axis.low) / (axis.high - axis.low) * n.saturating_sub(1) as f64;
        (0..n).min_by(|a, b| (*a as f64 - place).abs().total_cmp(&(*b as f64 - place).abs())).unwrap_or(0)
    };
    let mut reached = vec![false; n * n];
    let mut open = vec![(nearest(&figure.across, figure.home.0.0), nearest(&figure.up, figure.home.0.1))];
    while let Some((i, j)) = open.pop() {
        let k = j * n + i;
        if reached.get(k).is_none_or(|seen| *seen) || !(figure.margins[k] > 0.0) {
            continue;
        }
        reached[k] = true;
        let neighbours = [(i.wrapping_sub(1), j), (i + 1, j), (i, j.wrapping_sub(1)), (i, j + 1)];
        open.extend(neighbours.into_iter().filter(|(i, j)| *i < n && *j < n));
    }
    reached
}

fn frame(svg: &mut Svg, x: &PixelAxis, y: &PixelAxis, figure: &WorkspaceFigure) {
    super::style::frame(svg, x, y, (8, 8));
    svg.text("mid", (f64::midpoint(LEFT, RIGHT), BOTTOM + 44.0), &figure.across.label);
    svg.turned_text("mid", (24.0, f64::midpoint(TOP, BOTTOM)), -90.0, &figure.up.label);
    for (k, note) in figure.notes.iter().enumerate() {
        svg.text("note", (LEFT, BOTTOM + 68.0 + 16.0 * k as f64), note);
    }
}

/// Right of the plot: the limits of the workspace in it.
fn legend(svg: &mut Svg, figure: &WorkspaceFigure, joined: &[bool]) {
    let left = RIGHT + 22.0;
    let mut line = TOP + 12.0;
    let mut entry = |svg: &mut Svg, class: &str, text: &str| {
        svg.rect(class, (left, line - 11.0), (18.0, 13.0));
        svg.rect("frame sample", (left, line - 11.0), (18.0, 13.0));
        svg.text("", (left + 26.0, line), text);
        line += 22.0;
    };
    entry(svg, "plate", "reachable");
    for limit in &figure.limits {
        entry(svg, limit.code, &limit.name);
    }
    if let Some(required) = &figure.required {
        if required.outline.is_some() {
            svg.line("required", (left, line - 5.0), (left + 18.0, line - 5.0));
            svg.text("", (left + 26.0, line), "required workspace");
            line += 22.0;
        }
        if !required.poses.is_empty() {
            svg.circle("asked", (left + 9.0, line - 5.0), 4.0);
            svg.text("", (left + 26.0, line), "required pose");
            line += 22.0;
        }
    }
    if figure.margins.iter().zip(joined).any(|(m, joined)| *m > 0.0 && !joined) {
        svg.circle("apart", (left + 5.0, line - 5.0), 0.9);
        svg.circle("apart", (left + 9.0, line - 5.0), 0.9);
        svg.circle("apart", (left + 13.0, line - 5.0), 0.9);
        svg.text("", (left + 26.0, line), "inside all limits, not");
        svg.text("", (left + 26.0, line + 15.0), "joined to home in this slice");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limit(code: &'static str, name: &str) -> WorkspaceLimit {
        WorkspaceLimit { code, name: name.into() }
    }

    /// A strip around home and a second one apart from it; limit 1 to the left, limit 0 elsewhere.
    fn figure() -> WorkspaceFigure {
        let side = 31;
        let column = |k: usize| k % side;
        let inside = |i: usize| (10..=18).contains(&i) || i > 26;
        let axis = |label: &str| SliceAxis { label: label.into(), low: -1.0, high: 1.0 };
        WorkspaceFigure {
            title: "t".into(),
            notes: vec!["n".into()],
            across: axis("x [mm]"),
            up: axis("y [mm]"),
            side,
            margins: (0..side * side).map(|k| if inside(column(k)) { 0.1 } else { -0.1 }).collect(),
            worst: (0..side * side).map(|k| Some(usize::from(column(k) < 10))).collect(),
            limits: vec![
                limit("max_leg_length", "leg too long"),
                limit("min_leg_length", "leg <2> too short"),
            ],
            required: None,
            home: ((0.0, 0.0), "home".into()),
        }
    }

    #[test]
    fn every_limit_has_its_region_and_its_line_in_the_legend() {
        let text = workspace_slice(&figure());
        // a strip a row for each, and one in the legend
        assert_eq!(text.matches("class=\"max_leg_length\"").count(), 32);
        assert_eq!(text.matches("class=\"min_leg_length\"").count(), 32);
        assert_eq!(text.matches("class=\"boundary\"").count(), 3);
        assert!(text.contains(">leg &lt;2&gt; too short</text>"));
    }

    #[test]
    fn the_required_workspace_is_drawn_over_the_reachable_one() {
        let mut f = figure();
        assert!(!workspace_slice(&f).contains("required workspace"));
        let square = vec![(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
        f.required = Some(RequiredSection {
            outline: Some(SectionOutline::Through(square)),
            poses: vec![(0.25, 0.0)],
        });
        let text = workspace_slice(&f);
        // a quarter of the plot from either end, closed
        let line = "points=\"214.00,446.00 474.00,446.00 474.00,186.00 214.00,186.00 214.00,446.00\"";
        assert!(text.contains(&format!("class=\"required\" {line}")), "{text}");
        assert!(text.find("class=\"boundary\"") < text.find("class=\"required\" points"));
        assert!(text.contains(">required workspace</text>") && text.contains(">required pose</text>"));
        let column = |k: usize| (k % 31) as f64;
        f.required = Some(RequiredSection {
            outline: Some(SectionOutline::Zero(
                (0..31 * 31).map(|k| 5.0 - (column(k) - 15.0).abs()).collect(),
            )),
            poses: Vec::new(),
        });
        assert_eq!(workspace_slice(&f).matches("class=\"required\" points").count(), 2, "two vertical lines");
    }

    #[test]
    fn what_does_not_hang_together_with_home_is_dotted() {
        let mut f = figure();
        assert_eq!(joined(&f).iter().filter(|x| **x).count(), 9 * 31);
        assert!(workspace_slice(&f).contains("joined to home in this slice"));
        f.margins.iter_mut().enumerate().for_each(|(k, m)| *m = if k % 31 > 26 { -0.1 } else { *m });
        assert!(!workspace_slice(&f).contains("joined to home"));
    }
}
