//! A small reader of Rust sources: enough to list the paths a file names, with comments and strings gone.

/// What a file names.
#[derive(Debug, Default)]
pub(crate) struct Scan {
    /// Paths with their groups written out and `self`, `super` resolved: `crate::geom::Pose`, `std::fs`.
    pub(crate) paths: Vec<String>,
    /// Names followed by `!`.
    pub(crate) macros: Vec<String>,
    /// Modules declared in the file, which hide external crates of the same name.
    pub(crate) declared: Vec<String>,
    /// Whether `static mut` occurs.
    pub(crate) static_mut: bool,
}

impl Scan {
    /// Reads `source`, a file whose module path is `module` (`["solve", "certify"]`).
    pub(crate) fn of(source: &str, module: &[&str], with_tests: bool) -> Self {
        let mut words = words(&blank(source));
        if !with_tests {
            drop_tests(&mut words);
        }
        let mut scan = Self::default();
        let mut inside: Vec<String> = module.iter().map(ToString::to_string).collect();
        let (mut depth, mut opened) = (0, Vec::new());
        let mut i = 0;
        while i < words.len() {
            let next = |k: usize| words.get(i + k).map_or("", String::as_str);
            match words[i].as_str() {
                "#" if next(1) == "[" && next(2) == "cfg_attr" => {
                    i = attribute_end(&words, i + 1);
                    continue;
                }
                "mod" if is_name(next(1)) => {
                    scan.declared.push(next(1).to_string());
                    if next(2) == "{" {
                        inside.push(next(1).to_string());
                        opened.push(depth);
                    }
                    i += 2;
                    continue;
                }
                "static" if next(1) == "mut" => scan.static_mut = true,
                "{" => depth += 1,
                "}" => {
                    depth -= 1;
                    if opened.last() == Some(&depth) {
                        opened.pop();
                        inside.pop();
                    }
                }
                name if is_name(name) && next(1) == "!" && next(2) != "=" => {
                    scan.macros.push(name.to_string());
                }
                name if is_name(name) => {
                    let mut found = Vec::new();
                    let single = i > 0 && words[i - 1] == "use";
                    i = tree(&words, i, "", &mut found);
                    found.retain(|p| single || p.contains("::"));
                    scan.paths.extend(found.iter().map(|p| resolved(p, &inside)));
                    continue;
                }
                _ => {}
            }
            i += 1;
        }
        scan
    }
}

/// Behind the attribute whose bracket is at `open`: derives behind a feature (`serde`, `schemars`) are no edges of the module.
fn attribute_end(words: &[String], open: usize) -> usize {
    let mut depth = 0;
    for (i, word) in words.iter().enumerate().skip(open) {
        match word.as_str() {
            "[" => depth += 1,
            "]" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return i + 1;
        }
    }
    words.len()
}

fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// The paths of the use tree that begins at word `i`; the index after it.
fn tree(words: &[String], mut i: usize, prefix: &str, out: &mut Vec<String>) -> usize {
    let mut path = prefix.to_string();
    loop {
        match words.get(i).map(String::as_str) {
            Some("{") => {
                i += 1;
                while words.get(i).is_some_and(|w| w != "}") {
                    i = if words[i] == "," { i + 1 } else { tree(words, i, &path, out) };
                }
                return i + 1;
            }
            Some(word) if is_name(word) || word == "*" => {
                let joint = if path.is_empty() { "" } else { "::" };
                path = format!("{path}{joint}{word}");
                i += 1;
            }
            _ => break,
        }
        let more = |w: &String| is_name(w) || w == "{" || w == "*";
        if words.get(i).is_some_and(|w| w == "::") && words.get(i + 1).is_some_and(more) {
            i += 1;
        } else {
            break;
        }
    }
    out.push(path);
    if prefix.is_empty() {
        return i;
    }
    // inside a group: pass over `as name` and whatever else stands before the comma
    i + words[i..].iter().take_while(|w| *w != "," && *w != "}").count()
}

/// `self` and `super` at the beginning of a path replaced by `crate::...`.
fn resolved(path: &str, inside: &[String]) -> String {
    let mut at = inside.len();
    let mut rest: Vec<&str> = path.split("::").collect();
    if !matches!(rest[0], "self" | "super") {
        return path.to_string();
    }
    while matches!(rest.first(), Some(&("self" | "super"))) {
        at -= usize::from(rest.remove(0) == "super").min(at);
    }
    let mut out = vec!["crate"];
    out.extend(inside[..at].iter().map(String::as_str));
    out.extend(rest);
    out.join("::")
}

/// Removes every item under `#[cfg(test)]`.
fn drop_tests(words: &mut Vec<String>) {
    const MARK: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    while let Some(start) = words.windows(7).position(|w| w == MARK) {
        let (mut end, mut depth) = (start + 7, 0);
        while let Some(word) = words.get(end) {
            end += 1;
            match word.as_str() {
                "{" => depth += 1,
                "}" if depth == 1 => break,
                "}" => depth -= 1,
                ";" if depth == 0 => break,
                _ => {}
            }
        }
        words.drain(start..end);
    }
}

/// Names, `::` and single other characters.
fn words(text: &str) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let name = |c: char| c.is_alphanumeric() || c == '_';
        let length = match first {
            _ if name(first) => rest.find(|c| !name(c)).unwrap_or(rest.len()),
            ':' if rest.starts_with("::") => 2,
            _ => first.len_utf8(),
        };
        out.push(rest[..length].to_string());
        rest = rest[length..].trim_start();
    }
    out
}

/// The text with comments, strings and characters replaced by blanks.
pub(crate) fn blank(source: &str) -> String {
    let mut out = String::with_capacity(source.len());
    let mut rest = source;
    while let Some(first) = rest.chars().next() {
        let named = out.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block_comment(rest)
        } else if let Some(length) = (!named).then(|| raw_string(rest)).flatten() {
            length
        } else if first == '"' {
            1 + closing(&rest[1..], '"')
        } else if first == '\'' && !is_lifetime(rest) {
            1 + closing(&rest[1..], '\'')
        } else {
            0
        };
        if skipped == 0 {
            out.push(first);
            rest = &rest[first.len_utf8()..];
        } else {
            out.push(' ');
            rest = &rest[skipped..];
        }
    }
    out
}

fn block_comment(text: &str) -> usize {
    let mut depth = 0;
    for (i, _) in text.char_indices() {
        let at = &text[i..];
        if at.starts_with("/*") {
            depth += 1;
        } else if at.starts_with("*/") {
            depth -= 1;
            if depth == 0 {
                return i + 2;
            }
        }
    }
    text.len()
}

/// Length of the raw string `r#"..."#` (or `br`) that begins here.
fn raw_string(text: &str) -> Option<usize> {
    let body = text.strip_prefix("br").or_else(|| text.strip_prefix('r'))?;
    let hashes = body.len() - body.trim_start_matches('#').len();
    let content = body[hashes..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    let length = content.find(&end).map_or(content.len(), |k| k + end.len());
    Some(text.len() - content.len() + length)
}

/// Length up to and with the closing quote, escapes passed over.
fn closing(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (i, c) in text.char_indices() {
        if c == quote && !escaped {
            return i + c.len_utf8();
        }
        escaped = c == '\\' && !escaped;
    }
    text.len()
}

/// `'a` in `&'a str`: a name not followed by a quote.
fn is_lifetime(text: &str) -> bool {
    let mut after = text[1..].chars();
    let first = after.next();
    first.is_some_and(|c| c.is_alphabetic() || c == '_') && after.next() != Some('\'')
}
