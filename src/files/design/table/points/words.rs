//! Words for the bodies, the axes and the legs in names of columns and of lists.

use crate::design::likeness::nearest_word;
use crate::design::table::header::plain;
use platform::manipulator::Body;

/// Names of a column with leg numbers.
pub(super) const LEG_WORDS: [&str; 11] = [
    "leg",
    "legnumber",
    "legno",
    "strut",
    "actuator",
    "limb",
    "cylinder",
    "bein",
    "zylinder",
    "jambe",
    "pierna",
];

/// Names of a column that counts rows.
pub(super) const ROW_WORDS: [&str; 8] = ["", "no", "nr", "n", "id", "index", "number", "joint"];

/// Words beside an axis that tell nothing about the body.
const POINT_WORDS: [&str; 10] =
    ["coordinate", "coord", "position", "pos", "point", "joint", "pin", "centre", "center", "anchor"];

/// The coordinate, 0 to 2, at the start or end of a plain name, and the rest of the name.
pub(super) fn axis_of(name: &str) -> Option<(usize, &str)> {
    let axis = |c: char| "xyz".find(c);
    let last = name.chars().last().and_then(axis).map(|k| (k, &name[..name.len() - 1]));
    let first = name.chars().next().and_then(axis).map(|k| (k, &name[1..]));
    // `index`, `matrix`: a word that contains an x is no coordinate
    let known = |(_, rest): &(usize, &str)| {
        rest.chars().count() <= 2 || body_of_word(rest).is_some() || POINT_WORDS.contains(rest)
    };
    last.filter(known).or(first.filter(known))
}

/// Words for a height, which is the coordinate z of a table without z.
const HEIGHT_WORDS: [&str; 5] = ["height", "hoehe", "h\u{f6}he", "hauteur", "elevation"];

/// Words for the bodies that are found again when they are misspelt.
const BODIES: [&str; 9] =
    ["base", "bottom", "lower", "platform", "plattform", "plateforme", "plataforma", "piattaforma", "upper"];
/// Least similarity of a misspelt word.
const NEAR: f64 = 0.85;

/// The coordinate at the end of a name, behind a separator and a misspelt word for a body, and the word that is meant.
pub(super) fn misspelt_axis(name: &str) -> Option<(usize, &'static str)> {
    let name = name.split(['[', '(']).next()?.trim().to_lowercase();
    let axis = "xyz".find(name.chars().last()?)?;
    let head = &name[..name.len() - 1];
    let word = head.trim_end_matches(|c: char| "_ .-".contains(c));
    Some((axis, nearest_word(word, &BODIES, NEAR).filter(|_| word.len() < head.len())?))
}

/// The word beside a height: `base` for `base pin height`.
pub(super) fn height_of(name: &str) -> Option<&str> {
    let rest = HEIGHT_WORDS.iter().find_map(|word| name.strip_suffix(word))?;
    (rest.is_empty() || body_of_word(rest).is_some() || POINT_WORDS.contains(&rest)).then_some(rest)
}

/// A word beside an axis without the words for points.
pub(super) fn stem(word: &str) -> &str {
    let mut word = word;
    while let Some(shorter) =
        POINT_WORDS.iter().find_map(|noise| word.strip_prefix(noise).or(word.strip_suffix(noise)))
    {
        word = shorter;
    }
    word
}

/// Whether two words beside axes name one body.
pub(super) fn same_body(a: &str, b: &str) -> bool {
    a == b || body_of_word(a).is_some_and(|body| body_of_word(b) == Some(body))
}

/// The body that a plain word names unambiguously.
pub(in crate::design::table) fn body_of_word(word: &str) -> Option<Body> {
    const BASE: [&str; 12] = [
        "base",
        "fixed",
        "lower",
        "bottom",
        "ground",
        "fest",
        "unten",
        "basis",
        "gestell",
        "inferior",
        "socle",
        "fondation",
    ];
    const PLATFORM: [&str; 14] = [
        "plat",
        "piatta",
        "moving",
        "mobile",
        "upper",
        "top",
        "effector",
        "oben",
        "deck",
        "beweg",
        "superior",
        "movil",
        "m\u{f3}vil",
        "nacelle",
    ];
    let has = |list: &[&str]| list.iter().any(|w| word.contains(w));
    match (has(&BASE), has(&PLATFORM)) {
        (true, false) => Some(Body::Base),
        (false, true) => Some(Body::Platform),
        _ => None,
    }
}

/// Pairs of letters, the base first: common one-letter names of the bodies.
const LETTERS: [(&str, &str); 9] = [
    ("a", "b"),
    ("b", "p"),
    ("b", "t"),
    ("b", "m"),
    ("l", "u"),
    ("f", "m"),
    ("1", "2"),
    ("0", "1"),
    ("g", "p"),
];

/// The first letter of a word.
fn initial(word: &str) -> &str {
    word.char_indices().nth(1).map_or(word, |(end, _)| &word[..end])
}

/// Whether two words are common names of the two bodies.
pub(super) fn name_both_bodies(first: &str, second: &str) -> bool {
    match [first, second].map(body_of_word) {
        [Some(one), Some(other)] => one != other,
        [None, None] => LETTERS.contains(&(first, second)) || LETTERS.contains(&(second, first)),
        _ => false,
    }
}

/// The plain words of two names, without the structure that both are fields of: `machine.a` and `machine.b`.
pub(super) fn own_words(names: [&str; 2]) -> [String; 2] {
    let fields = names.map(|name| plain(name.rsplit('.').next().unwrap_or(name)));
    if fields[0] == fields[1] { names.map(plain) } else { fields }
}

/// The bodies of two different words: by their meaning, or by their order of appearance.
pub(super) fn bodies_of_words(first: &str, second: &str, guesses: &mut Vec<String>) -> [Body; 2] {
    let said = [first, second].map(body_of_word);
    let is_pair = |(a, b): (&str, &str)| LETTERS.contains(&(a, b));
    let order = match said {
        [Some(body), other] if other != Some(body) => [body, body.other()],
        [None, Some(body)] => [body.other(), body],
        _ if is_pair((first, second)) => Body::BOTH,
        _ if is_pair((second, first)) => [Body::Platform, Body::Base],
        _ if is_pair((initial(first), initial(second))) => Body::BOTH,
        _ if is_pair((initial(second), initial(first))) => [Body::Platform, Body::Base],
        _ => Body::BOTH,
    };
    guesses.push(told_apart([first, second], order));
    order
}

pub(super) fn told_apart([first, second]: [&str; 2], order: [Body; 2]) -> String {
    format!("`{first}` is the {} and `{second}` the {}.", order[0], order[1])
}

/// The guess about legs of joints without numbers.
pub(super) const FIRST_WITH_FIRST: &str =
    "Leg 1 joins the first joint of the base and the first of the platform, and so on.";

/// The only number in a word, such as 3 in `base_3`; `None` for several numbers.
pub(super) fn only_number(word: &str) -> Option<u64> {
    let mut groups = word.split(|c: char| !c.is_ascii_digit()).filter(|group| !group.is_empty());
    let number = groups.next()?.parse().ok()?;
    if groups.next().is_none() { Some(number) } else { None }
}
