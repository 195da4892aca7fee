//! The known word nearest to a misspelt one.

/// Jaro-Winkler similarity, 1 for equal words, case-sensitive. Words too long for a typing error get 0, since the
/// comparison is quadratic.
pub fn likeness(given: &str, known: &str) -> f64 {
    if given.len() > 100 {
        return 0.0;
    }
    strsim::jaro_winkler(&given.to_lowercase(), &known.to_lowercase())
}

/// The known word most similar to the given one, if the similarity is at least `least`.
pub fn nearest_word<'a>(given: &str, known: &[&'a str], least: f64) -> Option<&'a str> {
    let best = known.iter().max_by(|a, b| likeness(given, a).total_cmp(&likeness(given, b)));
    best.copied().filter(|word| likeness(given, word) >= least)
}
