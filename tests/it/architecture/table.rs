//! Which module may name which: the table of `docs/architecture.md` as data.

/// One row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Row<'a> {
    /// Module; files of submodules without a row of their own belong to it.
    pub(crate) module: &'a str,
    /// Modules it may name, besides itself.
    pub(crate) imports: Vec<&'a str>,
    /// External crates and, where only one file may name them, that file.
    pub(crate) external: Vec<(&'a str, Option<&'a str>)>,
}

type Line = (&'static str, &'static [&'static str], &'static [(&'static str, Option<&'static str>)]);

const COMPLEX: (&str, Option<&str>) = ("num_complex", None);
const MATRICES: (&str, Option<&str>) = ("nalgebra", None);
const INTEGERS: (&str, Option<&str>) = ("num_bigint", None);
const ERRORS: (&str, Option<&str>) = ("thiserror", None);

const LINES: &[Line] = &[
    ("names", &[], &[ERRORS]),
    (
        "num",
        &[],
        &[
            ("faer", Some("dense.rs")),
            ("clarabel", Some("conic.rs")),
            INTEGERS,
            ("num_integer", None),
            ("num_rational", Some("exact.rs")),
            ("num_traits", None),
            ("pulp", Some("vector_unit.rs")),
            MATRICES,
            COMPLEX,
            ERRORS,
        ],
    ),
    ("geom", &["num", "manipulator"], &[MATRICES, COMPLEX, ERRORS]),
    (
        "poly",
        &["num"],
        &[INTEGERS, COMPLEX, ("num_integer", None), ("num_traits", None), ("pulp", Some("roots.rs")), ERRORS],
    ),
    ("manipulator", &["num", "geom"], &[MATRICES, ERRORS]),
    (
        "solve",
        &["num", "geom", "poly", "manipulator"],
        &[MATRICES, COMPLEX, INTEGERS, ("num_integer", None), ("sha2", None), ERRORS],
    ),
    ("solve::certify", &["num", "geom", "manipulator"], &[MATRICES, COMPLEX, ("pulp", None), ERRORS]),
    (
        "solve::homotopy",
        &["num", "geom", "manipulator", "solve"],
        &[MATRICES, COMPLEX, ("pulp", None), ERRORS],
    ),
    (
        "distance",
        &["num", "geom", "poly", "manipulator", "topology"],
        &[MATRICES, INTEGERS, COMPLEX, ("pulp", None), ERRORS],
    ),
    (
        "fk",
        &[
            "num",
            "geom",
            "poly",
            "manipulator",
            "topology",
            "distance",
            "solve",
            "solve::certify",
            "solve::homotopy",
            "names",
        ],
        &[MATRICES, COMPLEX, ("pulp", None), ERRORS],
    ),
    ("requirements", &["num", "geom", "manipulator"], &[MATRICES, ERRORS]),
    ("dynamics", &["num", "geom", "manipulator", "requirements"], &[MATRICES, ERRORS]),
    ("reach", &["num", "geom", "manipulator", "requirements"], &[MATRICES]),
    ("calibration", &["names", "num", "geom", "manipulator"], &[MATRICES, ERRORS]),
    ("topology", &["num", "manipulator"], &[]),
    ("rotary", &["num", "geom", "manipulator", "fk"], &[MATRICES, ERRORS]),
    ("coupled", &["num", "geom", "manipulator", "requirements", "fk"], &[MATRICES, ERRORS]),
    (
        "synthesis",
        &["num", "geom", "poly", "manipulator", "topology", "names"],
        &[MATRICES, INTEGERS, ERRORS],
    ),
    ("dimensional", &["num", "geom", "manipulator", "requirements", "synthesis"], &[MATRICES, ERRORS]),
    ("singularity", &["num", "geom", "manipulator", "topology", "synthesis"], &[MATRICES, COMPLEX, ERRORS]),
    ("offsets", &["num", "geom", "manipulator", "synthesis"], &[MATRICES, ERRORS]),
    (
        "equivalence",
        &["num", "geom", "manipulator", "synthesis", "fk", "solve::certify"],
        &[MATRICES, COMPLEX, ERRORS],
    ),
    (
        "manufacture",
        &["num", "geom", "manipulator", "requirements", "synthesis", "singularity", "fk", "equivalence"],
        &[MATRICES, ERRORS],
    ),
    (
        "design",
        &["num", "geom", "manipulator", "requirements", "rotary", "names"],
        &[
            MATRICES,
            ("serde", None),
            ("serde_json", None),
            ("toml", None),
            ("jsonc_parser", None),
            ("roxmltree", None),
            ("strsim", None),
            ERRORS,
        ],
    ),
    (
        "records",
        &[
            "num",
            "geom",
            "poly",
            "manipulator",
            "topology",
            "requirements",
            "dynamics",
            "reach",
            "calibration",
            "distance",
            "solve",
            "solve::certify",
            "fk",
            "rotary",
            "coupled",
            "synthesis",
            "singularity",
            "offsets",
            "dimensional",
            "equivalence",
            "manufacture",
            "design",
            "export",
            "plot",
            "bench",
            "equivalents",
            "entrance",
        ],
        &[
            MATRICES,
            COMPLEX,
            ("serde", None),
            ("serde_json", None),
            ("schemars", None),
            ("sha2", Some("provenance.rs")),
        ],
    ),
    (
        "export",
        &[
            "num",
            "geom",
            "manipulator",
            "requirements",
            "reach",
            "fk",
            "rotary",
            "coupled",
            "design",
            "plot",
            "names",
        ],
        &[MATRICES, ("serde", Some("json.rs")), ("serde_json", Some("json.rs")), ERRORS],
    ),
    ("equivalents", &["manipulator", "singularity", "synthesis", "design"], &[MATRICES]),
    (
        "entrance",
        &[
            "names",
            "num",
            "geom",
            "manipulator",
            "requirements",
            "dynamics",
            "reach",
            "calibration",
            "synthesis",
            "singularity",
            "solve",
            "fk",
            "rotary",
            "offsets",
            "dimensional",
            "equivalence",
            "manufacture",
            "design",
            "export",
            "equivalents",
        ],
        &[MATRICES, ERRORS],
    ),
    (
        "page",
        &[
            "geom",
            "manipulator",
            "requirements",
            "fk",
            "rotary",
            "synthesis",
            "singularity",
            "offsets",
            "equivalence",
            "design",
            "plot",
            "equivalents",
            "records",
            "entrance",
        ],
        &[MATRICES, ("serde", None), ("serde_json", None), ("sha2", Some("html.rs")), ERRORS],
    ),
    ("plot", &["geom", "manipulator", "topology", "distance"], &[MATRICES]),
    (
        "report",
        &["design", "page", "plot", "records"],
        &[MATRICES, ("percent_encoding", None), ("serde_json", None)],
    ),
    (
        "bench",
        &["num", "geom", "manipulator", "topology", "distance", "fk", "solve::certify"],
        &[MATRICES, COMPLEX, ERRORS],
    ),
    (
        "sweep",
        &[
            "num",
            "geom",
            "manipulator",
            "requirements",
            "fk",
            "synthesis",
            "singularity",
            "manufacture",
            "design",
            "equivalents",
            "entrance",
            "records",
        ],
        &[
            MATRICES,
            COMPLEX,
            ("parquet", Some("part.rs")),
            ("serde", None),
            ("serde_json", None),
            ("sha2", Some("digest.rs")),
            ERRORS,
        ],
    ),
    (
        "cli",
        &[
            "num",
            "geom",
            "poly",
            "manipulator",
            "topology",
            "requirements",
            "dynamics",
            "reach",
            "calibration",
            "distance",
            "solve",
            "solve::certify",
            "solve::homotopy",
            "fk",
            "rotary",
            "coupled",
            "synthesis",
            "singularity",
            "offsets",
            "dimensional",
            "equivalence",
            "manufacture",
            "design",
            "export",
            "page",
            "plot",
            "report",
            "bench",
            "records",
            "equivalents",
            "entrance",
            "sweep",
        ],
        &[
            MATRICES,
            COMPLEX,
            ("serde", None),
            ("serde_json", None),
            ("toml", None),
            ("clap", None),
            ("clap_complete", Some("commands/shell/completions.rs")),
            ("clap_mangen", Some("commands/shell/man.rs")),
            ("ctrlc", None),
            ("anstream", None),
            ("anstyle", None),
            ERRORS,
        ],
    ),
    (
        "python",
        &[
            "names",
            "num",
            "geom",
            "manipulator",
            "requirements",
            "fk",
            "rotary",
            "synthesis",
            "design",
            "records",
            "entrance",
            "cli",
        ],
        &[
            MATRICES,
            COMPLEX,
            ("ndarray", None),
            ("numpy", None),
            ("pyo3", None),
            ("serde", None),
            ("serde_json", None),
        ],
    ),
    ("capi", &["geom", "manipulator", "requirements", "reach", "fk", "design", "entrance"], &[MATRICES]),
    ("main", &["cli"], &[]),
];

/// Two groups of modules that must not reach each other, not even through others.
pub(crate) const APART: [(&[&str], &[&str]); 2] = [
    (
        &["fk", "solve", "solve::certify", "solve::homotopy"],
        &["synthesis", "singularity", "offsets", "dimensional"],
    ),
    (&["solve::certify"], &["solve::homotopy", "fk"]),
];

/// The table.
pub(crate) fn table() -> Vec<Row<'static>> {
    let row = |&(module, imports, external): &Line| Row {
        module,
        imports: imports.to_vec(),
        external: external.to_vec(),
    };
    LINES.iter().map(row).collect()
}

/// The table in a Markdown page: lines that begin with ``| ` ``, three cells, names in backticks.
pub(crate) fn in_page(page: &str) -> Vec<Row<'_>> {
    page.lines().filter(|l| l.starts_with("| `")).filter_map(row_of).collect()
}

fn row_of(line: &str) -> Option<Row<'_>> {
    let cells: Vec<&str> = line.split('|').map(str::trim).collect();
    let [_, module, imports, external, _] = cells[..] else { return None };
    Some(Row {
        module: quoted(module).next()?,
        imports: quoted(imports).collect(),
        external: external
            .split(',')
            .filter_map(|item| {
                let mut names = quoted(item);
                Some((names.next()?, names.next()))
            })
            .collect(),
    })
}

fn quoted(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// The row of a module path: the longest that is a prefix of it.
pub(crate) fn row_for<'t, 'a>(table: &'t [Row<'a>], path: &str) -> Option<&'t Row<'a>> {
    let holds =
        |r: &&Row| path == r.module || path.strip_prefix(r.module).is_some_and(|p| p.starts_with("::"));
    table.iter().filter(holds).max_by_key(|r| r.module.len())
}

/// Everything `module` reaches through the table.
pub(crate) fn reach<'a>(table: &[Row<'a>], module: &'a str) -> Vec<&'a str> {
    let mut known = vec![module];
    let mut next = 0;
    while next < known.len() {
        let imports = table.iter().filter(|r| r.module == known[next]).flat_map(|r| r.imports.clone());
        for m in imports.collect::<Vec<_>>() {
            if !known.contains(&m) {
                known.push(m);
            }
        }
        next += 1;
    }
    known
}
