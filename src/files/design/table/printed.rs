//! Matrices that MATLAB and Octave print in groups of columns.

/// The numbers of the heads `Columns 1 through 4`, `Columns 5 and 6:` and `Column 6`.
fn columns(line: &str) -> Option<(usize, usize)> {
    let words: Vec<&str> = line.split_whitespace().map(|word| word.trim_end_matches(':')).collect();
    match words[..] {
        ["Columns", first, "through" | "and" | "to", last] => Some((first.parse().ok()?, last.parse().ok()?)),
        ["Column", only] => only.parse().ok().map(|only| (only, only)),
        _ => None,
    }
}

fn is_numbers(line: &str) -> bool {
    line.split_whitespace().all(|cell| cell.parse::<f64>().is_ok())
}

/// The text with groups of columns side by side; `None` without such groups.
pub(super) fn joined(text: &str) -> Option<String> {
    if !text.lines().any(|line| columns(line).is_some_and(|(first, _)| first > 1)) {
        return None;
    }
    let mut out: Vec<String> = Vec::new();
    // the place of the first line of the matrix, and of the next one that goes on
    let (mut begin, mut at) = (0, None);
    for line in text.lines() {
        match (columns(line), at) {
            (Some((1, _)), _) => {
                (begin, at) = (out.len(), None);
            }
            (Some(_), _) => at = Some(begin),
            (None, _) if line.trim().is_empty() => {}
            (None, Some(row)) if row < out.len() && is_numbers(line) => {
                out[row] = format!("{} {}", out[row], line.trim());
                at = Some(row + 1);
            }
            (None, _) => {
                at = None;
                out.push(line.to_owned());
            }
        }
    }
    Some(out.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_of_columns_stand_side_by_side_again() {
        let matlab = "B =\n\n  Columns 1 through 2\n\n   1  2\n   4  5\n\n  Column 3\n\n   3\n   6\n\nP =\n\n  Columns 1 through 2\n\n  7 8\n\n  Column 3\n\n  9\n";
        let octave = matlab.replace("through 2", "and 2:").replace("Column 3", "Column 3:");
        for text in [matlab, &octave] {
            let lines: Vec<String> =
                joined(text).unwrap().lines().map(|line| line.trim().to_owned()).collect();
            assert_eq!(lines, ["B =", "1  2 3", "4  5 6", "P =", "7 8 9"]);
        }
        assert_eq!(joined("Columns 1 through 4\n1 2 3 4\n"), None);
    }
}
