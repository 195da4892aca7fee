//! JSON Schema as far as the schemas of answers use it, read closed: a key that no schema names is a fault.

use std::collections::BTreeSet;

use serde_json::{Map, Value};

/// The first thing that is wrong, at the deepest place where alternatives differ.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fault {
    depth: usize,
    text: String,
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

/// Keys of an object that a schema names, one set for each way in which the object fits its alternatives.
type Named = Vec<BTreeSet<String>>;

/// A schema with its definitions.
pub(crate) struct Validator<'a> {
    root: &'a Map<String, Value>,
}

impl<'a> Validator<'a> {
    pub(crate) fn new(root: &'a Map<String, Value>) -> Self {
        Self { root }
    }

    /// Whether a document fits, with no key that the schema does not name.
    pub(crate) fn check(&self, document: &Value) -> Result<(), Fault> {
        let start = self.root["$ref"].as_str().unwrap();
        self.closed(self.resolve(start), document, &mut Vec::new())
    }

    fn resolve(&self, reference: &str) -> &'a Value {
        let name = reference.strip_prefix("#/$defs/").unwrap();
        &self.root["$defs"][name]
    }

    fn closed(&self, schema: &Value, value: &Value, path: &mut Vec<String>) -> Result<(), Fault> {
        let ways = self.fits(schema, value, path)?;
        let Some(fields) = value.as_object() else { return Ok(()) };
        if ways.iter().any(|named| fields.keys().all(|key| named.contains(key))) {
            return Ok(());
        }
        let unknown = fields.keys().find(|key| !ways.iter().any(|named| named.contains(*key)));
        Err(fault(path, &format!("no schema names the keys together, or at all {unknown:?}")))
    }

    /// The ways in which a value fits a schema that is open.
    fn fits(&self, schema: &Value, value: &Value, path: &mut Vec<String>) -> Result<Named, Fault> {
        let rules = match schema {
            Value::Bool(true) => return Ok(vec![all_keys(value)]),
            Value::Object(rules) => rules,
            _ => return Err(fault(path, "nothing may stand here")),
        };
        let mut ways: Named = vec![BTreeSet::new()];
        for (keyword, rule) in rules {
            let more = match keyword.as_str() {
                "$ref" => self.fits(self.resolve(rule.as_str().unwrap()), value, path)?,
                "allOf" => {
                    let mut all: Named = vec![BTreeSet::new()];
                    for part in rule.as_array().unwrap() {
                        all = product(&all, &self.fits(part, value, path)?);
                    }
                    all
                }
                "anyOf" | "oneOf" => self.one_of(rule.as_array().unwrap(), value, path)?,
                "propertyNames" => {
                    for key in value.as_object().into_iter().flat_map(Map::keys) {
                        self.fits(rule, &Value::String(key.clone()), path)?;
                    }
                    continue;
                }
                "not" => {
                    if self.fits(rule, value, path).is_ok() {
                        return Err(fault(path, "fits what it must not"));
                    }
                    continue;
                }
                "properties" | "additionalProperties" | "patternProperties" => {
                    self.fields(keyword, rules, value, path)?
                }
                "items" | "prefixItems" => {
                    self.elements(keyword, rules, value, path)?;
                    continue;
                }
                "dependentSchemas" => {
                    for (key, part) in rule.as_object().unwrap() {
                        if value.get(key).is_some() {
                            self.fits(part, value, path)?;
                        }
                    }
                    continue;
                }
                _ => {
                    plain(keyword, rule, value).map_err(|text| fault(path, &text))?;
                    continue;
                }
            };
            ways = product(&ways, &more);
        }
        Ok(ways)
    }

    fn one_of(&self, list: &[Value], value: &Value, path: &mut Vec<String>) -> Result<Named, Fault> {
        let tried: Vec<Result<Named, Fault>> = list.iter().map(|part| self.fits(part, value, path)).collect();
        let ways: Named = tried.iter().flatten().flatten().cloned().collect();
        let deepest = tried.into_iter().filter_map(Result::err).max_by_key(|f| f.depth);
        if ways.is_empty() { Err(deepest.unwrap_or_else(|| fault(path, "no alternative"))) } else { Ok(ways) }
    }

    /// What one of the three keywords on fields says; the keys it names.
    fn fields(
        &self,
        keyword: &str,
        rules: &Map<String, Value>,
        value: &Value,
        path: &mut Vec<String>,
    ) -> Result<Named, Fault> {
        let Some(fields) = value.as_object() else { return Ok(vec![BTreeSet::new()]) };
        let rule = &rules[keyword];
        let is_property = |key: &str| rules.get("properties").is_some_and(|p| p.get(key).is_some());
        let patterns = rules.get("patternProperties").and_then(Value::as_object);
        let pattern = |key: &str| patterns?.iter().find(|(p, _)| matches(p, key)).map(|(_, part)| part);
        let mut named = BTreeSet::new();
        for (key, field) in fields {
            let part = match keyword {
                "properties" => rule.get(key),
                "patternProperties" => pattern(key),
                _ => Some(rule).filter(|_| !is_property(key) && pattern(key).is_none()),
            };
            if let Some(part) = part {
                path.push(key.clone());
                self.closed(part, field, path)?;
                path.pop();
                named.insert(key.clone());
            }
        }
        Ok(vec![named])
    }

    fn elements(
        &self,
        keyword: &str,
        rules: &Map<String, Value>,
        value: &Value,
        path: &mut Vec<String>,
    ) -> Result<(), Fault> {
        let Some(list) = value.as_array() else { return Ok(()) };
        let first = rules.get("prefixItems").and_then(Value::as_array).map_or(0, Vec::len);
        for (k, element) in list.iter().enumerate() {
            let part = match keyword {
                "prefixItems" => rules[keyword].get(k),
                _ => Some(&rules[keyword]).filter(|_| k >= first),
            };
            if let Some(part) = part {
                path.push(k.to_string());
                self.closed(part, element, path)?;
                path.pop();
            }
        }
        Ok(())
    }
}

fn fault(path: &[String], text: &str) -> Fault {
    Fault { depth: path.len(), text: format!("{}: {text}", path.join("/")) }
}

fn all_keys(value: &Value) -> BTreeSet<String> {
    value.as_object().into_iter().flatten().map(|(key, _)| key.clone()).collect()
}

fn product(a: &Named, b: &Named) -> Named {
    let mut out: Named = a.iter().flat_map(|x| b.iter().map(move |y| x | y)).collect();
    out.sort();
    out.dedup();
    out
}

/// Keywords without schemas in them. One that is not known here would pass unseen, and ends the test.
fn plain(keyword: &str, rule: &Value, value: &Value) -> Result<(), String> {
    let number = |v: &Value| v.as_f64();
    let limit = || number(rule).unwrap();
    let count = || usize::try_from(rule.as_u64().unwrap()).unwrap();
    let keys = |list: &Value| -> Vec<String> {
        list.as_array().unwrap().iter().map(|k| k.as_str().unwrap().to_owned()).collect()
    };
    let fine = match keyword {
        "$schema" | "$defs" | "title" | "description" | "default" | "format" => true,
        "type" => match rule {
            Value::Array(list) => list.iter().any(|t| is_of(t.as_str().unwrap(), value)),
            one => is_of(one.as_str().unwrap(), value),
        },
        "const" => rule == value,
        "enum" => rule.as_array().unwrap().contains(value),
        "minimum" => number(value).is_none_or(|x| x >= limit()),
        "maximum" => number(value).is_none_or(|x| x <= limit()),
        "exclusiveMinimum" => number(value).is_none_or(|x| x > limit()),
        "exclusiveMaximum" => number(value).is_none_or(|x| x < limit()),
        "minLength" => value.as_str().is_none_or(|s| s.chars().count() >= count()),
        "maxLength" => value.as_str().is_none_or(|s| s.chars().count() <= count()),
        "minItems" => value.as_array().is_none_or(|l| l.len() >= count()),
        "maxItems" => value.as_array().is_none_or(|l| l.len() <= count()),
        "minProperties" => value.as_object().is_none_or(|o| o.len() >= count()),
        "required" => value.as_object().is_none_or(|o| keys(rule).iter().all(|k| o.contains_key(k))),
        "dependentRequired" => value.as_object().is_none_or(|o| {
            let rules = rule.as_object().unwrap();
            rules.iter().all(|(k, needs)| !o.contains_key(k) || keys(needs).iter().all(|n| o.contains_key(n)))
        }),
        "pattern" => value.as_str().is_none_or(|s| matches(rule.as_str().unwrap(), s)),
        _ => panic!("the keyword {keyword} is not known to this validator"),
    };
    if fine { Ok(()) } else { Err(format!("{keyword} {rule} does not hold for {value:.100}")) }
}

fn is_of(name: &str, value: &Value) -> bool {
    match name {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64() || value.as_f64().is_some_and(|x| x.fract() == 0.0),
        _ => panic!("the type {name} is not known to this validator"),
    }
}

/// The regular expressions that the schemas use, each by hand: there are few.
fn matches(pattern: &str, text: &str) -> bool {
    let digits = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
    match pattern {
        r"^-?[0-9]+$" | r"^-?\d+$" => digits(text.strip_prefix('-').unwrap_or(text)),
        r"^[0-9]+$" | r"^\d+$" => digits(text),
        "^[0-9a-f]{64}$" => text.len() == 64 && text.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f')),
        "^T(0[1-9]|[12][0-9]|3[0-4])$" => {
            let number = text.strip_prefix('T').filter(|n| n.len() == 2 && digits(n));
            number.is_some_and(|n| (1..=34).contains(&n.parse::<u8>().unwrap()))
        }
        "^[-0+]{6}$" => text.len() == 6 && text.bytes().all(|b| matches!(b, b'-' | b'0' | b'+')),
        "^[A-Za-z_][A-Za-z0-9_]*$" => {
            let name = |b: u8| b.is_ascii_alphanumeric() || b == b'_';
            text.bytes().all(name) && text.bytes().next().is_some_and(|b| !b.is_ascii_digit())
        }
        r"\S" => text.chars().any(|c| !c.is_whitespace()),
        _ => panic!("the pattern {pattern} is not known to this validator"),
    }
}
