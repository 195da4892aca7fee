//! Every command that answers a question gives the answer of the others. Designs of all kinds are drawn, and each is
//! put to all of them.

use std::fmt::Write as _;

use equipod::methods::bench::{Class, LengthsFrom, problem};
use equipod::methods::num::Rng;
use equipod::prelude::*;
use serde_json::Value;

use super::cli_frame::asked;
use super::evidence::size;

const EDGES: &str = "legs = [[\"B1\",\"T1\"],[\"B2\",\"T1\"],[\"B2\",\"T2\"],[\"B3\",\"T2\"],[\"B3\",\"T3\"],[\"B1\",\"T3\"]]\n";
const HEXAGONS: &str = "legs = [[\"B1\",\"T1\"],[\"B2\",\"T2\"],[\"B3\",\"T3\"],[\"B4\",\"T4\"],[\"B5\",\"T5\"],[\"B6\",\"T6\"]]\n";

fn whole(rng: &mut Rng, least: i64, most: i64) -> i64 {
    least + (rng.next_u64() % (most - least + 1).cast_unsigned()).cast_signed()
}

fn one_of<'a, T>(rng: &mut Rng, list: &'a [T]) -> &'a T {
    &list[usize::try_from(rng.next_u64() % list.len() as u64).unwrap()]
}

/// A fraction, a whole number or a quotient over a root, of about ten.
fn number(rng: &mut Rng) -> String {
    match whole(rng, 0, 3) {
        0 => format!("{}", whole(rng, -12, 12)),
        1 => format!("\"{}*sqrt({})\"", whole(rng, 1, 5), one_of(rng, &[2, 3, 5])),
        _ => format!("\"{}/{}\"", whole(rng, -40, 40), whole(rng, 2, 9)),
    }
}

/// An octahedral platform of exact numbers, as a file.
fn octahedral(rng: &mut Rng) -> String {
    let mut text = format!("name = \"octahedral\"\nunits = \"mm\"\n{EDGES}");
    for (body, joint) in [("base", 'B'), ("platform", 'T')] {
        writeln!(text, "[{body}]").unwrap();
        let turned = whole(rng, 0, 2) == 0;
        let (radius, angle) = (whole(rng, 3, 12), 15 * whole(rng, 0, 23));
        // corners far apart, so that no triangle is flat
        for (k, far) in (0..).zip([(0, 0), (20, 0), (0, 20)]) {
            let place = if turned {
                format!("{{ radius = {radius}, angle_deg = {} }}", angle + 120 * k)
            } else {
                format!(
                    "[\"{} + {}/7\", \"{} + {}/5\", {}]",
                    far.0,
                    whole(rng, 1, 20),
                    far.1,
                    whole(rng, 1, 20),
                    number(rng)
                )
            };
            writeln!(text, "{joint}{} = {place}", k + 1).unwrap();
        }
    }
    text
}

/// Regular or semi-regular hexagons at multiples of 15 degrees: of equal angles, of exchanged ones, of any.
fn hexagons(rng: &mut Rng) -> String {
    let mut text = format!("name = \"hexagons\"\nunits = \"mm\"\n{HEXAGONS}");
    let angles: Vec<i64> = (0..6).map(|k| 60 * k + 15 * whole(rng, 0, 3)).collect();
    let kind = whole(rng, 0, 2);
    let turn = 15 * whole(rng, 0, 23);
    for (body, joint, radius) in [("base", 'B', whole(rng, 8, 12)), ("platform", 'T', whole(rng, 3, 7))] {
        writeln!(text, "[{body}]").unwrap();
        for (k, of_base) in (0..).zip(&angles) {
            let angle = match (joint, kind) {
                ('B', _) => *of_base,
                (_, 0) => of_base + turn,
                (_, 1) => turn - of_base,
                _ => 60 * k + 15 * whole(rng, 0, 3),
            };
            writeln!(text, "{joint}{} = {{ radius = {radius}, angle_deg = {angle} }}", k + 1).unwrap();
        }
    }
    text
}

/// A design that was drawn.
struct Drawn {
    kind: String,
    text: String,
    /// An octahedral platform that it was made from.
    from: Option<String>,
}

/// A platform on the edges of an octahedral one, singular on request; as exact joints, as their doubles, or to so many
/// decimals.
fn moved(rng: &mut Rng, singular: bool, digits: Option<i32>) -> Option<Drawn> {
    let from = octahedral(rng);
    let original: Design = from.parse().unwrap();
    let class = original.equivalents().ok()?;
    let family = Family::octahedral();
    let members = family.members();
    let pattern = if singular { "S123456".parse().ok()? } else { one_of(rng, members).pattern.clone() };
    let mut shares: Vec<f64> = pattern.offsets().iter().map(|_| whole(rng, 1, 19) as f64 / 20.0).collect();
    if singular {
        for k in [1, 3, 5] {
            shares[k] = 1.0 - shares[k - 1];
        }
    }
    let (design, _) = class.build(&pattern, &shares).ok()?;
    let kind = format!("{pattern} {shares:?}, {digits:?} digits");
    let Some(digits) = digits else { return Some(Drawn { kind, text: design.to_toml(), from: Some(from) }) };
    let scale = 10f64.powi(digits);
    let round = |x: f64| if digits > 15 { x } else { (x * scale).round() / scale };
    let legs = design
        .manipulator()
        .legs()
        .map(|leg| Leg { base: leg.base.map(round), platform: leg.platform.map(round) });
    let rounded = Design::new("rounded", &design.units, Manipulator::from_legs(legs).ok()?);
    Some(Drawn { kind, text: rounded.to_toml(), from: Some(from) })
}

/// Design `n`: one in three of a class of `bench`, the others exact or rounded.
fn drawn(n: u64) -> Option<Drawn> {
    let mut rng = Rng::stream(4011, n);
    match n % 6 {
        0 | 3 => {
            let classes: Vec<Class> = Class::ALL.iter().copied().chain(Class::topologies()).collect();
            let class = *classes.iter().cycle().nth(usize::try_from(n / 3).ok()?)?;
            let m = problem(class, LengthsFrom::Pose, 40, n).ok()?.manipulator;
            Some(Drawn { kind: class.to_string(), text: Design::new("drawn", "mm", m).to_toml(), from: None })
        }
        1 => moved(&mut rng, (n / 6).is_multiple_of(2), None),
        2 => Some(Drawn { kind: "hexagons".to_owned(), text: hexagons(&mut rng), from: None }),
        4 => {
            let digits = if (n / 12).is_multiple_of(2) { 16 } else { 3 };
            moved(&mut rng, (n / 6).is_multiple_of(2), Some(digits))
        }
        _ => {
            let text = octahedral(&mut rng);
            Some(Drawn { kind: "octahedral".to_owned(), from: Some(text.clone()), text })
        }
    }
}

/// The exit code and the answer of a command. A panic, an internal failure, and a refusal that the design cannot cause
/// are no answers.
fn answered(args: &[&str]) -> (i32, Value) {
    let (code, answer) = asked(args);
    let may_refuse = ["family", "components"].contains(&args[1]);
    let code = code.filter(|code| matches!(code, 0 | 1 | 3) || (*code == 2 && may_refuse));
    (code.unwrap_or_else(|| panic!("{args:?}: {answer}")), answer)
}

/// The answers of all commands to one question.
struct Answers {
    question: &'static str,
    words: Vec<(&'static str, String)>,
}

impl Answers {
    fn to(question: &'static str) -> Self {
        Self { question, words: Vec::new() }
    }

    fn says(&mut self, who: &'static str, what: &impl ToString) {
        self.words.push((who, what.to_string()));
    }

    fn differ(&self) -> bool {
        self.words.iter().any(|(_, what)| *what != self.words[0].1)
    }
}

/// The relation of two designs by `map` and `verify`: word with level, and exit code.
fn relations(from: &str, to: &str) -> [(&'static str, String, i32); 2] {
    let (code, map) = answered(&["equivalents", "map", from, to]);
    let (of_verify, verify) = answered(&["verify", from, to, "--samples", "1"]);
    let of_map = map["relation"].as_str().unwrap_or("undecided");
    let verdict = match verify["verdict"].as_str() {
        Some("not_equivalent") => "unrelated",
        Some("inconclusive") | None => "undecided",
        Some(word) => word,
    };
    let said = |word: &str, level: &Value| format!("{word}, {}", level.as_str().unwrap_or("no level"));
    [
        ("map", said(of_map, &map["level"]), code),
        ("verify", said(verdict, &verify["map"]["level"]), of_verify),
    ]
}

/// The exit code that a relation has.
fn exit_of(relation: &str) -> i32 {
    match relation.split(',').next() {
        Some("equivalent") => 0,
        Some("singular" | "unrelated") => 1,
        _ => 3,
    }
}

/// `singular` of a sweep over this one design: the condition that keeps its row.
fn swept(design: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let [plan, out] = ["plan.toml", "out"].map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    for singular in [true, false] {
        let text = format!(
            "name = \"one\"\ndesign = '{design}'\ncompute = [\"check\", \"lengths\"]\nkeep = [\"singular == {singular}\"]\n[[vary]]\nby = \"list\"\n[vary.values]\n\"pose.yaw_deg\" = [1]\n"
        );
        std::fs::write(&plan, text).unwrap();
        let (_, found) =
            answered(&["sweep", "run", &plan, "--shards", "1", "-o", &format!("{out}-{singular}")]);
        if found["rows"] == 1 {
            return singular.into();
        }
        assert_eq!(found["rows"], 0, "{found}");
    }
    Value::Null
}

/// The record of the page about the design: whether it is singular. The design is the platform shown first or the
/// equivalent that the page starts with.
fn on_the_page(design: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html");
    answered(&["view", design, "-o", page.to_str().unwrap(), "--core", "none"]);
    let page = std::fs::read_to_string(page).unwrap();
    let (_, data) = page.split_once("id=\"data\"").unwrap();
    let (data, _) = data.split_once('>').unwrap().1.split_once("</script>").unwrap();
    let open = serde_json::from_str::<Value>(data).unwrap()["recorded"]["open"].take();
    open[if open["kind"] == "equivalent" { "start_singular" } else { "singular" }].clone()
}

/// Is the design architecturally singular? Which statement is proved? Which answers follow from it?
fn singular(path: &str, with_sweep: bool, with_page: bool) -> Vec<Answers> {
    let [mut singular, mut exit] = ["architecturally singular?", "exit code?"].map(Answers::to);
    let [mut rank, mut poses] = ["rank of the leg vectors?", "are there isolated poses?"].map(Answers::to);
    let mut of_all = Answers::to("architecturally singular, by what shows or keeps it?");
    let (code, check) = answered(&["check", path]);
    // a design that is not singular is equivalent to itself
    let word = match check["architecturally_singular"].as_bool() {
        Some(true) => "singular",
        Some(false) => "equivalent",
        None => "undecided",
    };
    let level = check["level"].as_str().unwrap_or("no level");
    singular.says("check", &format!("{word}, {level}"));
    exit.says("what check says", &if check["singular_home"].is_null() { exit_of(word) } else { 1 });
    exit.says("check", &code);
    let of_relation = exit_of(word);
    let mut exit_of_relations = Answers::to("exit code of the relation to itself?");
    exit_of_relations.says("what check says", &of_relation);
    for (who, said, code) in relations(path, path) {
        singular.says(who, &said);
        exit_of_relations.says(who, &code);
    }
    let (code, family) = answered(&["equivalents", "family", path]);
    match family["error"]["code"].as_str() {
        Some("family::singular") => singular.says("family", &format!("singular, {level}")),
        None if code == 0 => singular.says("family", &format!("equivalent, {level}")),
        _ => {}
    }
    rank.says("check", &check["leg_rank"]);
    let (_, components) = answered(&["equivalents", "components", path]);
    if components["error"].is_null() {
        rank.says("components", &components["leg_rank"]);
    }
    of_all.says("check", &check["architecturally_singular"]);
    if with_sweep {
        of_all.says("sweep", &swept(path));
    }
    if with_page {
        of_all.says("page", &on_the_page(path));
    }
    if word != "undecided" {
        poses.says("what check says", &(word == "equivalent"));
        poses.says("pose count of check", &(check["pose_count"]["finite"] != 0));
    }
    vec![singular, exit, exit_of_relations, rank, poses, of_all]
}

/// Are the designs equivalent?
fn equivalent(a: &str, b: &str) -> Vec<Answers> {
    let [mut words, mut exit] = ["equivalent?", "exit code of that?"].map(Answers::to);
    for (from, to, there) in [(a, b, true), (b, a, false)] {
        for (who, said, code) in relations(from, to) {
            let who = if there { who } else { ["map back", "verify back"][usize::from(who == "verify")] };
            exit.says("the relation", &exit_of(&said));
            exit.says(who, &code);
            words.says(who, &said);
        }
    }
    vec![words, exit]
}

/// Prints the findings so far, for whoever runs this alone.
fn note(text: &str) {
    #[allow(clippy::print_stderr, reason = "a test of an hour says what it has found before it ends")]
    {
        eprintln!("{text}");
    }
}

/// `EVIDENCE=full` puts 1,000 designs to all commands.
#[test]
fn no_two_commands_contradict_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let count = size(6, 1000);
    let (mut seen, mut words) = (0, std::collections::BTreeMap::<String, usize>::new());
    let mut contradictions = Vec::new();
    for n in 0..count {
        let Some(drawn) = drawn(n) else { continue };
        let design = path("design.toml", &drawn.text);
        // both compute much else, which takes its time
        let mut all = singular(&design, size(n == 1, true), size(false, n % 3 == 2));
        if let Some(from) = &drawn.from {
            all.extend(equivalent(&path("from.toml", from), &design));
        }
        seen += 1;
        for answers in all.into_iter().filter(|a| !a.words.is_empty()) {
            *words.entry(answers.words[0].1.clone()).or_default() += 1;
            if answers.differ() {
                let Answers { question, words } = answers;
                let found = format!("{n} ({}): {question} {words:?}\n{}", drawn.kind, drawn.text);
                note(&found);
                contradictions.push(found);
            }
        }
    }
    note(&format!("{seen} designs: {words:?}"));
    assert!(contradictions.is_empty(), "{} of {seen}:\n{}", contradictions.len(), contradictions.join("\n"));
    let of = |word: &str| words.iter().filter(|(w, _)| w.starts_with(word)).map(|(_, n)| n).sum::<usize>();
    assert!(seen * 10 >= count * 9, "{seen} of {count}");
    assert!(["singular", "equivalent"].iter().all(|w| of(w) > 0), "{words:?}");
}
