//! The places of the coefficients: the structure of the template, independent of the numbers of a problem.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use thiserror::Error;

/// Exponents of `(u, v, w, x, y, z)`.
type Monomial = [u8; 6];

/// Template data that do not describe a template.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// A section is missing or has another number of monomials than announced.
    #[error("section {section} of the template data is missing or incomplete")]
    Section {
        /// Name of the section.
        section: &'static str,
    },
    /// The column sets overlap, or a basic monomial over `w` is neither basic nor reducible.
    #[error("the monomial sets of the template data do not fit together")]
    Inconsistent,
}

/// One contribution `factor * coefficient` to an entry of the matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fill {
    pub(super) row: u16,
    pub(super) column: u16,
    /// Index of the equation, of five.
    pub(super) equation: u8,
    /// Index of its coefficient, of 40.
    pub(super) term: u8,
    /// Sign, and whether `L_1` is a factor.
    pub(super) sign: f64,
    pub(super) times_first: bool,
}

/// A basic monomial divided by `w`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum DividedMonomial {
    /// Basic monomial of this index.
    Basic(usize),
    /// Reducible monomial of this index.
    Reducible(usize),
}

/// The elimination template: matrix entries and the pencil made from the eliminated matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct TemplateLayout {
    pub(super) rows: usize,
    pub(super) excessive: usize,
    pub(super) reducible: usize,
    pub(super) basic: usize,
    pub(super) fills: Vec<Fill>,
    pub(super) quotients: Vec<DividedMonomial>,
    /// Places of `w, uw, vw, w^2, xw, yw, zw` among the basic monomials.
    pub(super) coordinates: [usize; 7],
}

/// The 40 monomials of an equation: `{1, u, v, w}^2` (ten) times `{1, x, y, z}`, the latter fastest.
fn support() -> impl Iterator<Item = Monomial> {
    crate::solve::generic_frame::PRODUCTS.into_iter().flat_map(|(i, j)| {
        (0..4).map(move |k| {
            let mut m = [0; 6];
            for index in [i, j].into_iter().filter(|&index| index > 0) {
                m[index - 1] += 1;
            }
            if k > 0 {
                m[2 + k] += 1;
            }
            m
        })
    })
}

fn section(text: &str, name: &'static str) -> Result<Vec<Monomial>, LayoutError> {
    let missing = LayoutError::Section { section: name };
    let start = text.split('@').find_map(|part| part.strip_prefix(name)?.strip_prefix(' '));
    let mut words = start.ok_or(missing.clone())?.split_whitespace();
    let count: usize = words.next().and_then(|w| w.parse().ok()).ok_or(missing.clone())?;
    let monomial = |word: &str| {
        let digits: Option<Vec<u8>> = word.chars().map(|c| c.to_digit(10).map(|d| d as u8)).collect();
        digits.and_then(|d| Monomial::try_from(d).ok())
    };
    let found: Option<Vec<Monomial>> = words.map(monomial).collect();
    found.filter(|f| f.len() == count).ok_or(missing)
}

/// The normal form of a monomial modulo the shifts of `f_1 = x^2 + y^2 + z^2 - L_1` by `shifts`, pivot `x^2`:
/// terms `(monomial, sign, power of L_1)`.
fn reduce(m: Monomial, shifts: &BTreeSet<Monomial>) -> Vec<(Monomial, f64, u8)> {
    let mut lower = m;
    if m[3] >= 2 {
        lower[3] -= 2;
    }
    if m[3] < 2 || !shifts.contains(&lower) {
        return vec![(m, 1.0, 0)];
    }
    let (mut with_y, mut with_z) = (lower, lower);
    with_y[4] += 2;
    with_z[5] += 2;
    let part = |m, sign: f64, power: u8| {
        reduce(m, shifts).into_iter().map(move |(m, s, p)| (m, sign * s, power + p))
    };
    part(lower, 1.0, 1).chain(part(with_y, -1.0, 0)).chain(part(with_z, -1.0, 0)).collect()
}

impl TemplateLayout {
    /// Builds the layout from the monomial sets in `text`.
    ///
    /// # Errors
    /// [`LayoutError`] when the sets are incomplete or do not fit together.
    pub fn parse(text: &str) -> Result<Self, LayoutError> {
        let body: String = text.lines().filter(|l| !l.starts_with('#')).flat_map(|l| [l, "\n"]).collect();
        let first: BTreeSet<Monomial> = section(&body, "shifts1")?.into_iter().collect();
        let shifts = ["shifts2", "shifts3", "shifts4", "shifts5", "shifts6"];
        let [basic, reducible, excessive] =
            ["basic", "reducible", "excessive"].map(|name| section(&body, name));
        let (basic, reducible, excessive) = (basic?, reducible?, excessive?);
        let columns: BTreeMap<Monomial, usize> =
            excessive.iter().chain(&reducible).chain(&basic).enumerate().map(|(k, m)| (*m, k)).collect();
        if columns.len() != excessive.len() + reducible.len() + basic.len() {
            return Err(LayoutError::Inconsistent);
        }
        let mut fills = Vec::new();
        let mut row = 0;
        for (equation, name) in shifts.into_iter().enumerate() {
            for shift in section(&body, name)? {
                for (term, m) in support().enumerate() {
                    let product: Monomial = std::array::from_fn(|k| m[k] + shift[k]);
                    for (m, sign, power) in reduce(product, &first) {
                        let Some(&column) = columns.get(&m) else { continue };
                        // the positions occur to the third power at most, so one reduction is enough
                        if power > 1 {
                            return Err(LayoutError::Inconsistent);
                        }
                        fills.push(Fill {
                            row,
                            column: column as u16,
                            equation: equation as u8,
                            term: term as u8,
                            sign,
                            times_first: power == 1,
                        });
                    }
                }
                row += 1;
            }
        }
        let place = |m: &Monomial| basic.iter().position(|b| b == m);
        let quotient = |b: &Monomial| {
            let mut q = *b;
            q[2] = q[2].checked_sub(1)?;
            let reducible = || reducible.iter().position(|r| *r == q).map(DividedMonomial::Reducible);
            place(&q).map(DividedMonomial::Basic).or_else(reducible)
        };
        let quotients: Option<Vec<DividedMonomial>> = basic.iter().map(quotient).collect();
        let named = [0, 1, 2, 3, 4, 5, 6].map(|k| {
            let mut m: Monomial = [0, 0, 1, 0, 0, 0];
            if k > 0 {
                m[k - 1] += 1;
            }
            place(&m)
        });
        let coordinates = named.into_iter().collect::<Option<Vec<usize>>>().and_then(|v| v.try_into().ok());
        let layout = Self {
            rows: usize::from(row),
            excessive: excessive.len(),
            reducible: reducible.len(),
            basic: basic.len(),
            fills,
            quotients: quotients.ok_or(LayoutError::Inconsistent)?,
            coordinates: coordinates.ok_or(LayoutError::Inconsistent)?,
        };
        let determined = layout.rows == layout.excessive + layout.reducible;
        if determined { Ok(layout) } else { Err(LayoutError::Inconsistent) }
    }

    /// Rows and columns of the matrix.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.rows, self.excessive + self.reducible + self.basic]
    }

    /// Basic monomials: the size of the pencil, and the number of candidates.
    #[must_use]
    pub fn candidates(&self) -> usize {
        self.basic
    }

    /// The same with one entry of the matrix wrong: the sign of contribution `index` turned.
    #[cfg(test)]
    pub(crate) fn corrupted(&self, index: usize) -> Self {
        let mut out = self.clone();
        out.fills[index].sign = -out.fills[index].sign;
        out
    }

    /// Number of contributions to entries of the matrix.
    #[cfg(test)]
    pub(crate) fn contributions(&self) -> usize {
        self.fills.len()
    }

    /// The shipped template, 293 x 362.
    ///
    /// # Errors
    /// [`LayoutError`], if the shipped data were damaged.
    pub fn shipped() -> Result<&'static Self, LayoutError> {
        static LAYOUT: OnceLock<Result<TemplateLayout, LayoutError>> = OnceLock::new();
        LAYOUT.get_or_init(|| Self::parse(include_str!("template66.txt"))).as_ref().map_err(Clone::clone)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_template_has_the_published_sizes() {
        let l = TemplateLayout::shipped().unwrap();
        assert_eq!((l.rows, l.excessive, l.reducible, l.basic), (293, 255, 38, 69));
        let reducible = l.quotients.iter().filter(|q| matches!(q, DividedMonomial::Reducible(_))).count();
        assert_eq!(reducible, 38);
        assert_eq!(l.coordinates, [68, 62, 63, 64, 65, 66, 67], "the last seven, in the published order");
    }

    #[test]
    fn damaged_data_are_refused() {
        let text = include_str!("template66.txt");
        assert_eq!(
            TemplateLayout::parse(&text.replace("@basic 69", "@basic 70")),
            Err(LayoutError::Section { section: "basic" })
        );
        assert_eq!(
            TemplateLayout::parse(&text.replace("001001 001000", "001001 000100")),
            Err(LayoutError::Inconsistent)
        );
        assert_eq!(TemplateLayout::parse("").unwrap_err(), LayoutError::Section { section: "shifts1" });
    }
}
