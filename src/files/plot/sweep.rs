//! Pictures of tables of many designs: fields over two columns, distributions, clouds with their fronts, parallel axes.

#![allow(clippy::cast_sign_loss, reason = "only shares of counts are cast")]

use super::contour::ValueGrid;
use super::style::{PixelAxis, Svg, escape, frame, px};

/// A column of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct SweptColumn {
    /// Its name, with the unit.
    pub label: String,
    /// One value per row; NaN if missing.
    pub values: Vec<f64>,
}

/// The contents of a picture of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct SweptFigure {
    /// The title above.
    pub title: String,
    /// A line of text below.
    pub note: String,
    /// The number of the candidate of each row.
    pub candidates: Vec<i64>,
    /// The plotted columns.
    pub columns: Vec<SweptColumn>,
}

// the layout in pixels: sizes, and positions from the left and the top
const LEFT: f64 = 92.0;
const TOP: f64 = 62.0;
const WIDE: f64 = 520.0;
const HIGH: f64 = 420.0;
const BELOW: f64 = 92.0;
const SCALE: f64 = 120.0;
/// Number of columns and rows of a field over values without a grid.
const BINS: usize = 48;
/// Greatest number of different values in a column of a grid.
const GRID: usize = 200;
/// Greatest number of points and lines in a picture: more would be unreadable and too much for viewers.
const MOST_POINTS: usize = 20_000;
const MOST_LINES: usize = 600;
/// Number of lines of equal value.
const LEVELS: usize = 9;

/// Colours of a scale from low to high: viridis (van der Walt, Smith 2015), even in lightness and safe for colour-blind
/// readers.
const COLOURS: [[f64; 3]; 6] = [
    [68.0, 1.0, 84.0],
    [65.0, 68.0, 135.0],
    [42.0, 120.0, 142.0],
    [34.0, 168.0, 132.0],
    [122.0, 209.0, 81.0],
    [253.0, 231.0, 37.0],
];

/// The colour of a share from 0 to 1.
fn colour(share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
    let k = (at as usize).min(COLOURS.len() - 2);
    let mix = |c: usize| COLOURS[k][c] + (COLOURS[k + 1][c] - COLOURS[k][c]) * (at - k as f64);
    format!("#{:02x}{:02x}{:02x}", mix(0).round() as u8, mix(1).round() as u8, mix(2).round() as u8)
}

/// At most `most` of `n` items, one from each of equal parts. The position in the part varies, since every second point
/// of a space-filling sequence fills only half of the cube.
fn thinned(n: usize, most: usize) -> Vec<usize> {
    if n <= most {
        return (0..n).collect();
    }
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    let at = |i: usize| ((i as f64 + (i as f64 * golden).fract()) / most as f64 * n as f64) as usize;
    (0..most).map(|i| at(i).min(n - 1)).collect()
}

/// Least and greatest finite value, with a range also around a single value.
fn range(values: &[f64]) -> (f64, f64) {
    let finite = values.iter().copied().filter(|x| x.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |r, x| (r.0.min(x), r.1.max(x)));
    if !low.is_finite() {
        return (0.0, 1.0);
    }
    if high - low > 1e-12 * high.abs() {
        (low, high)
    } else {
        (low - 0.1 * low.abs().max(1e-9), high + 0.1 * high.abs().max(1e-9))
    }
}

/// The range with a margin.
fn padded(values: &[f64]) -> (f64, f64) {
    let (low, high) = range(values);
    let padding = 0.04 * (high - low);
    (low - padding, high + padding)
}

/// The title of a point or a line: the candidate of the row, and its values to five digits.
fn behind(figure: &SweptFigure, k: usize) -> String {
    let value = |c: &SweptColumn| {
        let rounded = format!("{:.4e}", c.values[k]).parse().ok().filter(|x: &f64| x.is_finite());
        format!("{} = {}", c.label, rounded.map_or_else(|| "none".into(), |x| x.to_string()))
    };
    let values: Vec<String> = figure.columns.iter().map(value).collect();
    escape(&format!("candidate {}: {}", figure.candidates[k], values.join(", ")))
}

fn opened(figure: &SweptFigure, what: &str, width: f64) -> Svg {
    let names: Vec<&str> = figure.columns.iter().map(|c| c.label.as_str()).collect();
    let description =
        format!("{what} of {} rows: {}. {}", figure.candidates.len(), names.join(", "), figure.note);
    let mut svg = Svg::new(width, TOP + HIGH + BELOW, &figure.title, &description);
    svg.style(".dot{fill-opacity:.75;stroke:none}.strand{fill:none;stroke-width:1;stroke-opacity:.45}.staircase{fill:none;stroke:#b00020;stroke-width:1.6}.best{fill:#b00020;stroke:#fff;stroke-width:1}.bar{fill:#2b5c94}.isoline{fill:none;stroke:#fff;stroke-width:1.3}");
    svg.text("title", (LEFT, 32.0), &figure.title);
    svg.text("note", (LEFT, TOP + HIGH + BELOW - 16.0), &figure.note);
    svg
}

fn labels(svg: &mut Svg, across: &str, up: &str) {
    svg.text("mid", (LEFT + WIDE / 2.0, TOP + HIGH + 42.0), across);
    svg.turned_text("mid", (LEFT - 66.0, TOP + HIGH / 2.0), -90.0, up);
}

/// The scale of colours beside a plot.
fn scale(svg: &mut Svg, (low, high): (f64, f64), label: &str) {
    let left = LEFT + WIDE + 26.0;
    let axis = PixelAxis { low, high, from: TOP + HIGH, to: TOP };
    let steps = 64;
    for k in 0..steps {
        let top = TOP + HIGH * (1.0 - f64::from(k + 1) / f64::from(steps));
        filled(
            svg,
            &colour((f64::from(k) + 0.5) / f64::from(steps)),
            (left, top),
            (16.0, HIGH / f64::from(steps) + 0.5),
            "",
        );
    }
    for (value, text) in axis.ticks(6) {
        svg.line("tick", (left + 16.0, axis.at(value)), (left + 21.0, axis.at(value)));
        svg.text("start", (left + 25.0, axis.at(value) + 4.0), &text);
    }
    svg.turned_text("mid", (left + 82.0, TOP + HIGH / 2.0), -90.0, label);
}

fn filled(svg: &mut Svg, fill: &str, (x, y): (f64, f64), (w, h): (f64, f64), title: &str) {
    let title = if title.is_empty() { String::new() } else { format!("<title>{}</title>", escape(title)) };
    svg.raw(&format!(
        "<rect fill=\"{fill}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">{title}</rect>",
        px(x),
        px(y),
        px(w),
        px(h)
    ));
}

/// The places of one axis of a field: middles and width of its cells.
struct Cells {
    low: f64,
    width: f64,
    count: usize,
}

impl Cells {
    /// The cells of the grid if the values have one, otherwise equal ones over their range.
    fn of(values: &[f64]) -> Self {
        let mut different: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
        different.sort_by(f64::total_cmp);
        different.dedup();
        let (low, high) = range(values);
        let count = different.len();
        let step = (high - low) / (count.max(2) - 1) as f64;
        let even = different.iter().enumerate().all(|(k, x)| (x - low - step * k as f64).abs() < 1e-6 * step);
        if (2..=GRID).contains(&count) && even {
            return Self { low: low - step / 2.0, width: step, count };
        }
        Self { low, width: (high - low) / BINS as f64, count: BINS }
    }

    fn at(&self, x: f64) -> Option<usize> {
        let k = ((x - self.low) / self.width).floor();
        (x.is_finite() && k >= 0.0).then(|| (k as usize).min(self.count - 1))
    }

    fn end(&self) -> f64 {
        self.low + self.width * self.count as f64
    }
}

/// The mean of the third column over the cells of the first two, as colours, and on request with lines of equal value.
/// Without a third column it is the number of rows.
pub fn swept_field(figure: &SweptFigure, lines: bool) -> String {
    let (x, y) = (&figure.columns[0], &figure.columns[1]);
    let (across, up) = (Cells::of(&x.values), Cells::of(&y.values));
    let mut cells = vec![(0.0, 0usize, i64::MAX); across.count * up.count];
    for (k, candidate) in figure.candidates.iter().enumerate() {
        let z = figure.columns.get(2).map_or(1.0, |c| c.values[k]);
        let (Some(i), Some(j)) = (across.at(x.values[k]), up.at(y.values[k])) else { continue };
        if z.is_finite() {
            let cell = &mut cells[j * across.count + i];
            *cell = (cell.0 + z, cell.1 + 1, cell.2.min(*candidate));
        }
    }
    let counting = figure.columns.len() < 3;
    let value = |c: &(f64, usize, i64)| match c.1 {
        0 => f64::NAN,
        _ if counting => c.0,
        n => c.0 / n as f64,
    };
    let values: Vec<f64> = cells.iter().map(value).collect();
    let (low, high) = range(&values);
    let label = figure.columns.get(2).map_or("rows", |c| c.label.as_str());
    let mut svg =
        opened(figure, if lines { "Lines of equal value" } else { "Field" }, LEFT + WIDE + SCALE + 20.0);
    let ax = PixelAxis { low: across.low, high: across.end(), from: LEFT, to: LEFT + WIDE };
    let ay = PixelAxis { low: up.low, high: up.end(), from: TOP + HIGH, to: TOP };
    let (w, h) = (WIDE / across.count as f64, HIGH / up.count as f64);
    for (k, value) in values.iter().enumerate().filter(|(_, v)| v.is_finite()) {
        let (i, j) = (k % across.count, k / across.count);
        let at = (LEFT + w * i as f64, TOP + HIGH - h * (j + 1) as f64);
        let one = cells[k].1 == 1;
        let title = if one {
            format!("candidate {}: {value}", cells[k].2)
        } else {
            format!("{value}, {} rows", cells[k].1)
        };
        filled(&mut svg, &colour((value - low) / (high - low)), at, (w + 0.3, h + 0.3), &title);
    }
    if lines && values.iter().all(|v| v.is_finite()) {
        let grid = ValueGrid { columns: across.count, rows: up.count, values };
        let place = |(i, j): (f64, f64)| (LEFT + w * (i + 0.5), TOP + HIGH - h * (j + 0.5));
        for (level, text) in (PixelAxis { low, high, from: 0.0, to: 1.0 }).ticks(LEVELS) {
            for line in grid.contour(level) {
                let points: Vec<(f64, f64)> = line.iter().map(|p| place(*p)).collect();
                svg.polyline("isoline", &points);
                svg.text("small halo", points[points.len() / 2], &text);
            }
        }
    }
    frame(&mut svg, &ax, &ay, (6, 7));
    labels(&mut svg, &x.label, &y.label);
    scale(&mut svg, (low, high), label);
    svg.finish()
}

/// Histogram of the first column: the number of rows for each value.
pub fn swept_histogram(figure: &SweptFigure) -> String {
    let column = &figure.columns[0];
    let (low, high) = range(&column.values);
    let finite = column.values.iter().filter(|x| x.is_finite());
    let whole = finite.clone().all(|x| x.fract() == 0.0) && high - low <= 60.0;
    // each whole number has a bar
    let (low, high, bars) = if whole {
        (low.floor() - 0.5, high.ceil() + 0.5, (high.ceil() - low.floor()) as usize + 1)
    } else {
        (low, high, 40)
    };
    let mut counts = vec![0usize; bars];
    for x in finite {
        counts[(((x - low) / (high - low) * bars as f64) as usize).min(bars - 1)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    let ax = PixelAxis { low, high, from: LEFT, to: LEFT + WIDE };
    let ay = PixelAxis { low: 0.0, high: 1.05 * most as f64, from: TOP + HIGH, to: TOP };
    let mut svg = opened(figure, "Distribution", LEFT + WIDE + 40.0);
    let w = WIDE / bars as f64;
    for (k, n) in counts.iter().enumerate().filter(|(_, n)| **n > 0) {
        let top = ay.at(*n as f64);
        svg.rect("bar", (LEFT + w * k as f64 + 0.5, top), ((w - 1.0).max(0.5), TOP + HIGH - top));
    }
    frame(&mut svg, &ax, &ay, (8, 6));
    labels(&mut svg, &column.label, "rows");
    svg.finish()
}

/// Rows of which none is better in both of the first two columns; `gain`: whether large values are better. They are in
/// the order of the first column.
pub(crate) fn best_rows(figure: &SweptFigure, gain: [bool; 2]) -> Vec<usize> {
    let worth =
        |k: usize, c: usize| if gain[c] { figure.columns[c].values[k] } else { -figure.columns[c].values[k] };
    let mut rows: Vec<usize> = (0..figure.candidates.len())
        .filter(|k| worth(*k, 0).is_finite() && worth(*k, 1).is_finite())
        .collect();
    rows.sort_by(|a, b| {
        worth(*b, 0).total_cmp(&worth(*a, 0)).then(worth(*b, 1).total_cmp(&worth(*a, 1))).then(a.cmp(b))
    });
    let mut best = f64::NEG_INFINITY;
    rows.retain(|k| {
        let better = worth(*k, 1) > best;
        best = best.max(worth(*k, 1));
        better
    });
    rows
}

/// Points over the first two columns, coloured by the third. With `gain` it adds the front of rows of which none is
/// better in both. The title of each point has its candidate and values.
pub fn swept_cloud(figure: &SweptFigure, gain: Option<[bool; 2]>) -> String {
    let (x, y) = (&figure.columns[0], &figure.columns[1]);
    let (rx, ry) = (padded(&x.values), padded(&y.values));
    let ax = PixelAxis { low: rx.0, high: rx.1, from: LEFT, to: LEFT + WIDE };
    let ay = PixelAxis { low: ry.0, high: ry.1, from: TOP + HIGH, to: TOP };
    let coloured = figure.columns.get(2).map(|c| (range(&c.values), c));
    let mut svg = opened(
        figure,
        if gain.is_some() { "Front" } else { "Points" },
        LEFT + WIDE + if coloured.is_some() { SCALE + 20.0 } else { 40.0 },
    );
    let dot = |svg: &mut Svg, k: usize, class: &str, r: f64, fill: Option<String>| {
        let (px_, py_) = (ax.at(x.values[k]), ay.at(y.values[k]));
        let fill = fill.map_or(String::new(), |f| format!(" fill=\"{f}\""));
        svg.raw(&format!(
            "<circle class=\"{class}\"{fill} cx=\"{}\" cy=\"{}\" r=\"{}\"><title>{}</title></circle>",
            px(px_),
            px(py_),
            px(r),
            behind(figure, k)
        ));
    };
    let both = |k: &usize| x.values[*k].is_finite() && y.values[*k].is_finite();
    for k in thinned(figure.candidates.len(), MOST_POINTS).into_iter().filter(both) {
        let fill = match &coloured {
            Some(((low, high), c)) if c.values[k].is_finite() => colour((c.values[k] - low) / (high - low)),
            Some(_) => "#bbbbbb".into(),
            None => "#2b5c94".into(),
        };
        dot(&mut svg, k, "dot", 2.4, Some(fill));
    }
    if let Some(gain) = gain {
        let best = best_rows(figure, gain);
        let mut line: Vec<(f64, f64)> = Vec::new();
        for k in &best {
            let at = (ax.at(x.values[*k]), ay.at(y.values[*k]));
            // along the axes, over the corner that both dominate
            if let Some(before) = line.last().copied() {
                line.push((at.0, before.1));
            }
            line.push(at);
        }
        svg.polyline("staircase", &line);
        for k in best {
            dot(&mut svg, k, "best", 4.0, None);
        }
    }
    frame(&mut svg, &ax, &ay, (6, 7));
    labels(&mut svg, &x.label, &y.label);
    if let Some((range, c)) = coloured {
        scale(&mut svg, range, &c.label);
    }
    svg.finish()
}

/// One line per row over parallel axes, one axis for each column, coloured by the last one.
pub fn swept_parallel(figure: &SweptFigure) -> String {
    let n = figure.columns.len();
    let gap = (WIDE / (n - 1) as f64).max(110.0);
    let width = LEFT + gap * (n - 1) as f64 + 100.0;
    let mut svg = opened(figure, "Parallel axes", width);
    let ranges: Vec<(f64, f64)> = figure.columns.iter().map(|c| range(&c.values)).collect();
    let axis = |c: usize| PixelAxis { low: ranges[c].0, high: ranges[c].1, from: TOP + HIGH, to: TOP + 14.0 };
    let place = |c: usize, x: f64| (LEFT + gap * c as f64, axis(c).at(x));
    let whole = |k: &usize| figure.columns.iter().all(|c| c.values[*k].is_finite());
    let rows: Vec<usize> = (0..figure.candidates.len()).filter(whole).collect();
    for k in thinned(rows.len(), MOST_LINES).into_iter().map(|i| &rows[i]) {
        let points: Vec<String> = (0..n)
            .map(|c| place(c, figure.columns[c].values[*k]))
            .map(|p| format!("{},{}", px(p.0), px(p.1)))
            .collect();
        let (low, high) = ranges[n - 1];
        let share = (figure.columns[n - 1].values[*k] - low) / (high - low);
        svg.raw(&format!(
            "<polyline class=\"strand\" stroke=\"{}\" points=\"{}\"><title>{}</title></polyline>",
            colour(share),
            points.join(" "),
            behind(figure, *k)
        ));
    }
    for (c, column) in figure.columns.iter().enumerate() {
        let (x, axis) = (LEFT + gap * c as f64, axis(c));
        svg.line("tick", (x, TOP + 14.0), (x, TOP + HIGH));
        for (value, text) in axis.ticks(6) {
            svg.line("tick", (x - 4.0, axis.at(value)), (x, axis.at(value)));
            svg.text("end halo", (x - 7.0, axis.at(value) + 4.0), &text);
        }
        let below = TOP + HIGH + if c % 2 == 0 { 22.0 } else { 40.0 };
        svg.text("mid", (x, below), &column.label);
    }
    svg.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(columns: usize) -> SweptFigure {
        let values = |c: usize| {
            (0..36).map(|k| [f64::from(k % 6), f64::from(k / 6), f64::from(k * k), 1.5][c]).collect()
        };
        SweptFigure {
            title: "t <1>".into(),
            note: "n".into(),
            candidates: (0..36).collect(),
            columns: (0..columns)
                .map(|c| SweptColumn { label: format!("c{c}"), values: values(c) })
                .collect(),
        }
    }

    #[test]
    fn a_field_over_a_grid_has_a_cell_for_each_row() {
        let drawn = swept_field(&figure(3), false);
        assert_eq!(drawn.matches("<title>candidate ").count(), 36);
        assert!(drawn.contains("t &lt;1&gt;") && drawn.contains("candidate 35: 1225"));
        let lines = swept_field(&figure(3), true);
        assert!(lines.matches("class=\"isoline\"").count() > 3);
        // without a third column rows are counted, and cells without a grid hold several
        let mut loose = figure(2);
        loose.columns[0].values[3] += 0.2;
        assert!(swept_field(&loose, false).contains("candidate"));
    }

    #[test]
    fn whole_numbers_have_a_bar_each() {
        assert_eq!(swept_histogram(&figure(1)).matches("class=\"bar\"").count(), 6);
        let mut one = figure(1);
        one.columns[0].values = vec![f64::NAN; 36];
        assert_eq!(swept_histogram(&one).matches("class=\"bar\"").count(), 0);
    }

    #[test]
    fn the_front_holds_the_rows_that_none_is_better_than() {
        let figure = figure(2);
        assert_eq!(best_rows(&figure, [true, true]), [35]);
        assert_eq!(best_rows(&figure, [true, false]), [5]);
        let mut curve = figure.clone();
        curve.columns[1].values = curve.columns[0].values.iter().map(|x| 5.0 - x).collect();
        assert_eq!(best_rows(&curve, [true, true]), [5, 4, 3, 2, 1, 0]);
        let drawn = swept_cloud(&curve, Some([true, true]));
        assert_eq!(drawn.matches("class=\"best\"").count(), 6);
        let mut points = figure.clone();
        assert_eq!(swept_cloud(&points, None).matches("class=\"dot\"").count(), 36);
        // the title of a point has its data
        points.columns[0] = SweptColumn { label: "r<s> [mm]".into(), values: vec![1.0 / 3.0; 36] };
        points.columns.push(SweptColumn { label: "c".into(), values: vec![f64::NAN; 36] });
        let drawn = swept_cloud(&points, None);
        assert!(drawn.contains("<title>candidate 35: r&lt;s&gt; [mm] = 0.33333, c1 = 5, c = none</title>"));
    }

    #[test]
    fn parallel_axes_have_a_line_for_each_whole_row() {
        let mut figure = figure(4);
        figure.columns[2].values[7] = f64::NAN;
        let drawn = swept_parallel(&figure);
        assert_eq!(drawn.matches("class=\"strand\"").count(), 35);
        assert!(drawn.contains("<title>candidate 8: c0 = 2, c1 = 1, c2 = 64, c3 = 1.5</title>"));
    }

    #[test]
    fn what_is_left_out_is_spread_evenly() {
        assert_eq!(thinned(5, 10), [0, 1, 2, 3, 4]);
        let some = thinned(1200, 600);
        assert!(some.windows(2).all(|w| w[0] < w[1]) && some.len() == 600);
        let even = some.iter().filter(|k| *k % 2 == 0).count();
        assert!((200..400).contains(&even), "{even}");
    }

    #[test]
    fn colours_run_from_dark_to_light() {
        assert_eq!([colour(-1.0), colour(1.0), colour(2.0)], ["#440154", "#fde725", "#fde725"]);
    }
}
