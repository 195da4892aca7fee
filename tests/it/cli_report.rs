//! The process `equipod report`: a saved answer stands on the page as its command prints it.

use super::cli_frame::equipod;

/// Commands, each with the heading of its answer on the page.
const COMMANDS: [(&str, &str); 6] = [
    ("equivalents components designs/rbt-octahedral.toml --samples 1", "Replaceable legs"),
    ("singular motion designs/rbt-midline.toml --sections 0 --turn 0.2", "Self-motions"),
    ("equivalents topologies designs/rbt-octahedral.toml", "Topologies"),
    ("equivalents move designs/rbt-octahedral.toml --move 1:1:1/5 --move 2:4:1/3", "Moved legs"),
    (
        "equivalents move designs/rbt-griffis-duffy.toml --search --no-shared-joints --count 2",
        "Equivalent platforms",
    ),
    ("equivalents nearest designs/symmetric-hexapod.toml", "Nearest octahedral platform"),
];

/// The words between the tags.
fn words(html: &str) -> Vec<String> {
    let mut text = String::new();
    for part in html.split('<') {
        text += part.split_once('>').map_or(part, |(_, after)| after);
        text.push(' ');
    }
    let known = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&amp;", "&")];
    let text = known.iter().fold(text, |text, (entity, sign)| text.replace(entity, sign));
    text.split_whitespace().map(str::to_owned).collect()
}

#[test]
fn saved_answers_have_on_the_page_the_words_that_their_commands_print() {
    for (command, heading) in COMMANDS {
        let asked: Vec<&str> = command.split(' ').collect();
        let printed = String::from_utf8(equipod(&asked).stdout).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let saved = equipod(&[&asked[..], &["--json"]].concat()).stdout;
        std::fs::write(folder.path().join("answer.json"), saved).unwrap();
        assert_eq!(equipod(&["report", folder.path().to_str().unwrap()]).status.code(), Some(0));
        let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
        let result = page.split("id=\"results\"").nth(1).unwrap();
        let (title, rest) = result.split_once("</summary>").unwrap();
        assert!(title.contains(&format!("<h3>{heading}")), "{command}: {title}");
        let shown = words(rest.split("<p class=\"note\">From").next().unwrap());
        let printed: Vec<String> = printed.split_whitespace().map(str::to_owned).collect();
        assert!(printed.len() > 20, "{command}: {printed:?}");
        assert_eq!(shown, printed, "{command}");
    }
}
