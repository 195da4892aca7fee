//! The page as one text.

use data_encoding::BASE64;
use serde::Serialize;
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::request::{Chosen, Opening, PageRequest, Which};
use super::session::Session;
use files::plot::escape;
use platform::geom::Pose;
use records::PoseRecord;

/// The core compiled to WebAssembly, compressed by gzip; `tests/page/README.md` says how it is made and compared with
/// its sources.
#[cfg(not(target_arch = "wasm32"))]
pub const CORE: &[u8] = include_bytes!("core.wasm.gz");

const TEMPLATE: &str = include_str!("web/page.html");
const STYLE: [&str; 2] = [include_str!("web/layout.css"), include_str!("web/parts.css")];
/// The scripts in the order in which they depend on each other.
const SCRIPTS: [&str; 18] = [
    include_str!("web/core.js"),
    include_str!("web/task.js"),
    include_str!("web/words.js"),
    include_str!("web/camera.js"),
    include_str!("web/surface.js"),
    include_str!("web/view3d.js"),
    include_str!("web/cranks.js"),
    include_str!("web/hexagon.js"),
    include_str!("web/plane.js"),
    include_str!("web/sliders.js"),
    include_str!("web/tables.js"),
    include_str!("web/player.js"),
    include_str!("web/pose.js"),
    include_str!("web/limits.js"),
    include_str!("web/app.js"),
    include_str!("web/share.js"),
    include_str!("web/begin.js"),
    include_str!("web/actions.js"),
];

/// The script of every page, in a scope of its own.
fn script() -> String {
    format!("(() => {{\n\"use strict\";\n{}\n}})();", SCRIPTS.concat())
}

/// The source expression of a content security policy for an inline script or style with this text (W3C, Content
/// Security Policy Level 3, section 2.3.1).
fn source(text: &str) -> String {
    format!("'sha256-{}'", BASE64.encode(&Sha256::digest(text.as_bytes())))
}

/// The content security policy of the page; `styles` belong to an enclosing page, whose policy also applies to its
/// frames. It allows the one script and the style sheets by their hashes, WebAssembly, and workers from the page
/// itself, but no network. Other scripts, in elements or attributes, are not run.
#[must_use]
pub fn policy(styles: &[&str]) -> String {
    let styles: String = styles.iter().map(|text| format!(" {}", source(text))).collect::<Vec<_>>().concat();
    format!(
        "default-src 'none'; script-src {} 'wasm-unsafe-eval'; style-src {}{styles}; worker-src blob:; img-src data: blob:; base-uri 'none'; form-action 'none'",
        source(&script()),
        source(&STYLE.concat()),
    )
}

/// The policy of a page without frames, workers and network. It allows one script and one style sheet by their hashes,
/// and images contained in the page.
#[must_use]
pub fn strict_policy(script: &str, style: &str) -> String {
    format!(
        "default-src 'none'; script-src {}; style-src {}; img-src data:; base-uri 'none'; form-action 'none'",
        source(script),
        source(style)
    )
}

/// Number of recorded poses of one round.
const FRAMES: usize = 36;
/// Number of recorded poses of one round for cranks, whose frames are longer.
const CRANK_FRAMES: usize = 18;
/// Number of points along each side of the recorded plane.
const PLANE: usize = 41;

/// The page of a design: one self-contained HTML text that works without network.
///
/// `core` is the WebAssembly module, plain or compressed by gzip ([`CORE`] comes with the library). Without it, and in
/// browsers without WebAssembly, the page shows recorded answers. These are one round of poses, the assembly modes at
/// home, `det A` over two offsets, and the first self-motion.
#[must_use]
pub fn page(session: &Session, core: Option<&[u8]>) -> String {
    let data = PageData {
        opening: session.into(),
        recorded: recorded(session),
        begin: session.without_design,
        version: env!("CARGO_PKG_VERSION"),
    };
    // texts, numbers, lists and fields can always be written
    let data = serde_json::to_string(&data).unwrap_or_default();
    let title = escape(&session.design.name);
    let notices = core.map(|_| notices()).unwrap_or_default();
    let core = core.map(|bytes| BASE64.encode(bytes)).unwrap_or_default();
    let parts = [
        ("{{policy}}", policy(&[])),
        ("{{title}}", title),
        ("{{style}}", STYLE.concat()),
        ("{{licences}}", notices),
        ("{{data}}", data.replace('<', "\\u003c")),
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

/// The folded notices of the software compiled into the core. The colon of an address in them is a character reference.
/// A search of the page for addresses then finds only those that a browser would follow, and there are none.
#[cfg(not(target_arch = "wasm32"))]
fn notices() -> String {
    format!(
        "<details id=\"licences\" class=\"small\"><summary>Licences of the software in this page</summary>\
         <div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Licences\"><pre>{}</pre></div></details>",
        escape(&super::licences::notices()).replace("://", "&#58;//")
    )
}

/// The core writes no pages that contain a core.
#[cfg(target_arch = "wasm32")]
fn notices() -> String {
    String::new()
}

/// The data in a page beside its script.
#[derive(Debug, Serialize)]
struct PageData {
    opening: Opening,
    recorded: Recorded,
    /// Whether the page is for users without a design.
    begin: bool,
    version: &'static str,
}

/// Answers for browsers without WebAssembly.
#[derive(Debug, Serialize)]
struct Recorded {
    open: Value,
    frames: Vec<Value>,
    worst: Value,
    modes: Value,
    plane: Option<Value>,
    motion: Value,
    derivation: Option<Value>,
    designs: RecordedDesigns,
}

/// Both platforms as design files.
#[derive(Debug, Serialize)]
struct RecordedDesigns {
    first: Value,
    second: Option<Value>,
}

fn recorded(session: &Session) -> Recorded {
    let chosen = session.start.as_ref().map(Chosen::from);
    let frames = if session.cranks.is_some() { CRANK_FRAMES } else { FRAMES };
    let state = |p: Pose| {
        let pose = PoseRecord::from(&p);
        session.reply(PageRequest::State { pose, chosen: chosen.clone(), limits: None })
    };
    let home = PoseRecord::from(&session.home);
    let two = session.start.as_ref().filter(|s| s.offsets.len() > 1);
    let plane = |chosen| PageRequest::Plane { chosen, axes: [0, 1], range: [-0.5, 1.5], points: PLANE };
    let moving = if chosen.is_some() { Which::Second } else { Which::First };
    let design = |which| session.reply(PageRequest::Design { which, chosen: chosen.clone() });
    Recorded {
        open: session.reply(PageRequest::Open),
        frames: (0..frames).map(|k| session.along(k as f64 / frames as f64)).map(state).collect(),
        worst: session.reply(PageRequest::Worst { chosen: chosen.clone() }),
        modes: session.reply(PageRequest::Modes {
            pose: home,
            lengths: None,
            which: Which::First,
            chosen: None,
        }),
        plane: two.map(|s| session.reply(plane(s.into()))),
        motion: session.reply(PageRequest::Motion { pose: home, which: moving, chosen: chosen.clone() }),
        derivation: chosen.clone().map(|chosen| session.reply(PageRequest::Derivation { chosen })),
        designs: RecordedDesigns {
            first: design(Which::First),
            second: chosen.as_ref().map(|_| design(Which::Second)),
        },
    }
}
