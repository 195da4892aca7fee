//! Sizes of samples: `EVIDENCE=full cargo test` takes the large ones.

/// The size of a sample: the first, or with `EVIDENCE=full` the second.
pub(crate) fn size<T>(quick: T, full: T) -> T {
    if std::env::var_os("EVIDENCE").is_some_and(|value| value == "full") { full } else { quick }
}
