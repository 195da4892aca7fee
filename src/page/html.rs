//! The page as one text.

use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::base64;
use super::session::Session;
use super::wire::pose;
use crate::plot::escape;

/// The core compiled to WebAssembly, compressed by gzip; `tests/page/README.md` says how it is made and compared with its sources.
#[cfg(not(target_arch = "wasm32"))]
pub const CORE: &[u8] = include_bytes!("core.wasm.gz");

const TEMPLATE: &str = include_str!("web/page.html");
const STYLE: [&str; 2] = [include_str!("web/layout.css"), include_str!("web/parts.css")];
/// In the order in which they need each other.
const SCRIPTS: [&str; 12] = [
    include_str!("web/core.js"),
    include_str!("web/task.js"),
    include_str!("web/words.js"),
    include_str!("web/camera.js"),
    include_str!("web/view3d.js"),
    include_str!("web/hexagon.js"),
    include_str!("web/plane.js"),
    include_str!("web/sliders.js"),
    include_str!("web/tables.js"),
    include_str!("web/player.js"),
    include_str!("web/app.js"),
    include_str!("web/actions.js"),
];

/// The script of every page, closed in itself.
fn script() -> String {
    format!("(() => {{\n\"use strict\";\n{}\n}})();", SCRIPTS.concat())
}

/// What a content security policy calls an inline script or style with exactly this text (W3C, Content Security Policy Level 3, section 2.3.1).
fn source(text: &str) -> String {
    format!("'sha256-{}'", base64::encode(&Sha256::digest(text.as_bytes())))
}

/// The content security policy of the page, and with `styles` of a page around it, whose policy holds for frames in it too: the one script and the style
/// sheets by their hashes, WebAssembly, workers from the page itself, no network. An element or attribute that names another script is not run.
#[must_use]
pub fn policy(styles: &[&str]) -> String {
    let styles: String = styles.iter().map(|text| format!(" {}", source(text))).collect::<Vec<_>>().concat();
    format!(
        "default-src 'none'; script-src {} 'wasm-unsafe-eval'; style-src {}{styles}; worker-src blob:; img-src data: blob:; base-uri 'none'; form-action 'none'",
        source(&script()),
        source(&STYLE.concat()),
    )
}

/// Recorded poses of one round.
const FRAMES: usize = 36;
/// Points a side of the recorded plane.
const PLANE: usize = 41;

/// The page of a design: one HTML text that needs nothing else, no network.
///
/// `core` is the WebAssembly module, plain or compressed by gzip ([`CORE`] for the one that comes with the library). Without it, and in browsers
/// that refuse it, the page shows recorded answers: one round of poses, the assembly modes at home, `det A` over two offsets, and the first self-motion.
#[must_use]
pub fn page(session: &Session, core: Option<&[u8]>) -> String {
    let data = json!({"opening": opening(session), "recorded": recorded(session), "version": env!("CARGO_PKG_VERSION")});
    let title = escape(&session.design.name);
    let core = core.map(base64::encode).unwrap_or_default();
    let parts = [
        ("{{policy}}", policy(&[])),
        ("{{title}}", title),
        ("{{style}}", STYLE.concat()),
        ("{{data}}", data.to_string().replace('<', "\\u003c")),
        ("{{core}}", core),
        ("{{script}}", script()),
    ];
    let (mut out, mut rest) = (String::new(), TEMPLATE);
    for (mark, value) in parts {
        // each mark stands once in the template, in this order
        let (before, after) = rest.split_once(mark).unwrap_or((rest, ""));
        out.push_str(before);
        out.push_str(&value);
        rest = after;
    }
    out + rest
}

/// What [`Session::open`] needs to open the same session.
fn opening(session: &Session) -> Value {
    let trajectory = session.design.workspace.trajectory.as_ref();
    json!({
        "design": session.design.to_toml(),
        "trajectory": trajectory.map(|t| t.poses.iter().map(pose).collect::<Vec<_>>()).unwrap_or_default(),
        "start": start(session),
    })
}

fn start(session: &Session) -> Value {
    session.start.as_ref().map_or(
        Value::Null,
        |s| json!({"pattern": s.pattern.to_string(), "offsets": super::wire::numbers(s.offsets.iter().copied())}),
    )
}

/// Answers for browsers without WebAssembly.
fn recorded(session: &Session) -> Value {
    let ask = |request: Value| -> Value {
        serde_json::from_str(&session.answer(&request.to_string())).unwrap_or(Value::Null)
    };
    let chosen = start(session);
    let frames: Vec<Value> = (0..FRAMES)
        .map(|k| session.along(k as f64 / FRAMES as f64))
        .map(|p| ask(json!({"op": "state", "pose": pose(&p), "chosen": chosen})))
        .collect();
    let home = pose(&session.home);
    let equivalent = session.start.as_ref();
    let two = equivalent.filter(|s| s.offsets.len() > 1);
    let plane = two.map(|_| {
        ask(json!({"op": "plane", "chosen": chosen, "axes": [0, 1], "range": [-0.5, 1.5], "points": PLANE}))
    });
    let moving = if equivalent.is_some() { "second" } else { "first" };
    let design = |which: &str| ask(json!({"op": "design", "which": which, "chosen": chosen}));
    json!({
        "open": ask(json!({"op": "open"})),
        "frames": frames,
        "worst": ask(json!({"op": "worst", "chosen": chosen})),
        "modes": ask(json!({"op": "modes", "pose": home, "which": "first"})),
        "plane": plane,
        "motion": ask(json!({"op": "motion", "pose": home, "which": moving, "chosen": chosen})),
        "designs": {"first": design("first"), "second": equivalent.map(|_| design("second"))},
    })
}
