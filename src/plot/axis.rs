//! Axes with round numbers.

use super::style::Svg;

/// A linear axis: values `low..high` on pixels `from..to`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axis {
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Axis {
    /// Where `value` is on the page.
    pub(super) fn at(&self, value: f64) -> f64 {
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Distance of ticks: 1, 2 or 5 times a power of ten, at most `count` of them.
    pub(super) fn step(&self, count: usize) -> f64 {
        let rough = (self.high - self.low) / count.max(1) as f64;
        let power = 10f64.powf(rough.log10().floor());
        [1.0, 2.0, 5.0].into_iter().map(|m| m * power).find(|s| *s >= rough).unwrap_or(10.0 * power)
    }

    /// Tick values and labels, about `count` of them.
    pub(super) fn ticks(&self, count: usize) -> Vec<(f64, String)> {
        let step = self.step(count);
        let decimals = (0..12usize).find(|k| step * 10f64.powf(*k as f64) > 0.999).unwrap_or(12);
        // a hair beyond the ends, so that rounding loses no tick at an end
        let (first, last) =
            ((self.low / step - 1e-9).ceil() as i64, (self.high / step + 1e-9).floor() as i64);
        (first..=last)
            .map(|k| {
                let value = k as f64 * step;
                (value, format!("{value:.decimals$}").replace('-', "\u{2212}"))
            })
            .collect()
    }

    /// Ticks of an axis of common logarithms: powers of ten, at most about `count` of them.
    pub(super) fn decades(&self, count: i64) -> Vec<(f64, String)> {
        let (first, last) = (self.low.ceil() as i64, self.high.floor() as i64);
        let stride = (last - first).max(0) / count.max(1) + 1;
        // multiples of the stride, so that the exponents are the same on neighbouring pictures
        let on_grid = (first..=last).filter(|k| k.rem_euclid(stride) == 0);
        on_grid.map(|k| (k as f64, format!("10{}", superscript(k)))).collect()
    }
}

/// The frame of a plot with about so many ticks on either axis; `x` runs to the right, `y` upwards.
pub(super) fn frame(svg: &mut Svg, x: &Axis, y: &Axis, (across, up): (usize, usize)) {
    svg.rect("frame", (x.from, y.to), (x.to - x.from, y.from - y.to));
    for (value, label) in x.ticks(across) {
        svg.line("tick", (x.at(value), y.from), (x.at(value), y.from + 5.0));
        svg.text("mid", (x.at(value), y.from + 19.0), &label);
    }
    for (value, label) in y.ticks(up) {
        svg.line("tick", (x.from - 5.0, y.at(value)), (x.from, y.at(value)));
        svg.text("end", (x.from - 9.0, y.at(value) + 4.0), &label);
    }
}

fn superscript(k: i64) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize]);
    k.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_are_powers_of_ten() {
        let axis = Axis { low: -12.5, high: 0.5, from: 0.0, to: 1.0 };
        let labels: Vec<String> = axis.decades(7).into_iter().map(|t| t.1).collect();
        assert_eq!(labels, ["10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"]);
        assert_eq!(Axis { low: 0.2, high: 0.4, ..axis }.decades(7), []);
    }

    #[test]
    fn ticks_are_round_and_reach_the_ends() {
        let axis = Axis { low: -0.3, high: 1.2, from: 0.0, to: 150.0 };
        let labels: Vec<String> = axis.ticks(8).into_iter().map(|t| t.1).collect();
        assert_eq!(labels, ["\u{2212}0.2", "0.0", "0.2", "0.4", "0.6", "0.8", "1.0", "1.2"]);
        assert!((axis.at(0.0) - 30.0).abs() < 1e-12);
        let axis = Axis { low: 0.0, high: 12.0, from: 0.0, to: 1.0 };
        assert_eq!(axis.ticks(6).last().map(|t| t.1.clone()), Some("12".into()));
    }
}
