//! JSON text to the spanned tree: RFC 8259 and nothing more (no comments, no trailing commas).

use jsonc_parser::ast::{Object, Value as Ast};
use jsonc_parser::common::Ranged;
use jsonc_parser::errors::ParseErrorKind;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use super::Code;
use super::tree::{Entry, MAX_DEPTH, Node, Value};
use super::violation::Findings;

const STRICT: ParseOptions = ParseOptions {
    allow_comments: false,
    allow_loose_object_property_names: false,
    allow_trailing_commas: false,
    allow_missing_commas: false,
    allow_single_quoted_strings: false,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: false,
    allow_bare_decimal_point_numbers: false,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

/// Reads the text; `None` after a syntax error, which goes to the report.
pub(super) fn read(text: &str, report: &mut Findings<'_>) -> Option<Node> {
    match parse_to_ast(text, &CollectOptions::default(), &STRICT) {
        Ok(result) => match result.value {
            Some(value) => node(&value, report, 0),
            None => None,
        },
        Err(error) => {
            let span = error.range().start..error.range().end;
            if matches!(error.kind(), ParseErrorKind::NestingDepthExceeded) {
                too_deep(report, &span);
            } else {
                let help =
                    "correct the JSON: double quotes, no comments, no trailing commas, no NaN or Infinity";
                report.refuse(Code::Syntax, &span, error.kind().to_string(), help);
            }
            None
        }
    }
}

fn too_deep(report: &mut Findings<'_>, span: &std::ops::Range<usize>) {
    let help = "a design has objects of arrays of numbers, nothing deeper";
    report.refuse(Code::NestingTooDeep, span, format!("nested deeper than {MAX_DEPTH} levels"), help);
}

fn node(value: &Ast<'_>, report: &mut Findings<'_>, depth: usize) -> Option<Node> {
    let span = value.start()..value.end();
    if depth > MAX_DEPTH {
        too_deep(report, &span);
        return None;
    }
    let value = match value {
        Ast::StringLit(s) => Value::Text(s.value.to_string()),
        Ast::NumberLit(n) => {
            n.value.parse().map_or(Value::Other("a number that cannot be read"), Value::Number)
        }
        Ast::BooleanLit(_) => Value::Other("a boolean"),
        Ast::NullKeyword(_) => Value::Other("null"),
        Ast::Object(object) => table(object, report, depth)?,
        Ast::Array(a) => {
            Value::Array(a.elements.iter().map(|v| node(v, report, depth + 1)).collect::<Option<_>>()?)
        }
    };
    Some(Node { span, value })
}

fn table(object: &Object<'_>, report: &mut Findings<'_>, depth: usize) -> Option<Value> {
    let mut entries: Vec<Entry> = Vec::with_capacity(object.properties.len());
    let mut seen = std::collections::BTreeSet::new();
    for property in &object.properties {
        let key = property.name.as_str().to_string();
        let key_span = property.name.start()..property.name.end();
        if !seen.insert(key.clone()) {
            report.refuse(Code::DuplicateKey, &key_span, "this key is defined twice", "keep one of the two");
        }
        let node = node(&property.value, report, depth + 1)?;
        entries.push(Entry { key, key_span, node });
    }
    Some(Value::Table(entries))
}
