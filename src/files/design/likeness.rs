//! Which known word a person meant.

/// Similarity of Jaro and Winkler, 1 for equal words, upper and lower case apart; 0 for a word too long for a slip of
/// the pen, since the comparison is quadratic.
pub fn likeness(given: &str, known: &str) -> f64 {
    if given.len() > 100 {
        return 0.0;
    }
    strsim::jaro_winkler(&given.to_lowercase(), &known.to_lowercase())
}

/// The known word most like the given one, when the similarity is `least` or more.
pub fn nearest_word<'a>(given: &str, known: &[&'a str], least: f64) -> Option<&'a str> {
    let best = known.iter().max_by(|a, b| likeness(given, a).total_cmp(&likeness(given, b)));
    best.copied().filter(|word| likeness(given, word) >= least)
}
