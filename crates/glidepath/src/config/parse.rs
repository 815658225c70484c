//! The parser of a configuration, from text to the shapes of a file: the syntax, the names of keys,
//! and the types of values.
//!
//! Reading ends at the first thing that does not fit. That is put aside and the text is read again,
//! until all of it fits: so everything that is wrong is told at once.

use super::decimal_comma::{mended, point};
use super::diagnostic::ConfigDiagnostic;
use super::keys;
use super::tree::{TABLES, Tree};
use core::ops::Range;
use serde::de::DeserializeOwned;

/// The file in which every key of a machine is explained.
pub(super) const EXPLAINED: &str = "config/mill.toml";

/// Most things of this stage that are told at once.
const MOST: usize = 50;

/// Reads the text: what is there, and what is wrong with it. Nothing is there if it is not TOML.
/// `explained` is where its keys are explained.
pub(super) fn parse<T: DeserializeOwned>(
    text: &str,
    explained: &str,
) -> (Option<T>, Vec<ConfigDiagnostic>) {
    let mut found = Vec::new();
    let mut tree = match Tree::parse(text) {
        Ok(tree) => tree,
        Err(error) => {
            // What else is wrong is told beside the commas.
            if let Some(mut mended) = mended(text, error.span().as_ref()) {
                let (raw, found) = parse(&mended.text, explained);
                mended.found.extend(found);
                return (raw, mended.found);
            }
            let help =
                "the file is TOML: tables such as [axis.X], and lines such as max_jerk = 40000.0";
            found.push(ConfigDiagnostic {
                key: String::new(),
                message: first_line(error.message()),
                help: Some(help.to_owned()),
                span: error.span(),
            });
            return (None, found);
        }
    };
    loop {
        let error = match T::deserialize(toml::de::Deserializer::from(tree.root.clone())) {
            Ok(raw) => return (Some(raw), found),
            Err(error) => error,
        };
        let message = first_line(error.message());
        let at = error.span().unwrap_or(0..0);
        // A key that was misspelt is not missing, too.
        let is_misspelt = missing(&message).is_some_and(|key| {
            let meant = format!("did you mean `{key}`");
            let helps = found
                .iter()
                .filter_map(|told: &ConfigDiagnostic| told.help.as_ref());
            helps.into_iter().any(|help| help.starts_with(&meant))
        });
        if !is_misspelt {
            found.push(told((&tree, text), &message, &at, explained));
        }
        if found.len() >= MOST || !put_aside(&mut tree, &message, &at) {
            return (None, found);
        }
    }
}

fn first_line(message: &str) -> String {
    message.lines().next().unwrap_or_default().to_owned()
}

/// Changes the tree so that reading gets beyond an error; false if that is not possible.
fn put_aside(tree: &mut Tree<'_>, message: &str, at: &Range<usize>) -> bool {
    if message.starts_with("unknown field") {
        return tree.take_out(at);
    }
    if let Some(key) = missing(message) {
        let value = match key {
            "axis" => "{}",
            "layout" => "'table-table'",
            "tilt" => "'A'",
            _ => "1.0",
        };
        return tree.add(at, key, value);
    }
    let (_, kind) = tree.described(at);
    wanted(kind, message).is_some_and(|(_, value)| tree.replace(at, value))
}

/// The key that a message says is missing.
fn missing(message: &str) -> Option<&str> {
    message.strip_prefix("missing field `")?.split('`').next()
}

/// What is wanted in place of something of this kind. serde takes a list for a table whose values
/// come in order, and then speaks of the first of them.
fn wanted(kind: &str, message: &str) -> Option<(&'static str, &'static str)> {
    if kind == TABLES {
        return Some(("a table", "{}"));
    }
    expected(message)
}

/// What a message says is wanted, in words, and a value of that kind.
fn expected(message: &str) -> Option<(&'static str, &'static str)> {
    let wanted = message.split("expected ").nth(1)?;
    let is = |word: &str| wanted.contains(word);
    Some(if is("array of length 3") || is("tuple of size 3") {
        ("a list of three numbers", "[1.0, 1.0, 1.0]")
    } else if is("sequence") || is("array") {
        ("a list", "[]")
    } else if is("struct") || is("map") || is("table") {
        ("a table", "{}")
    } else if is("string") {
        ("text in quotes", "''")
    } else if is("bool") {
        ("true or false", "false")
    } else if is("f64") || is("float") {
        ("a number", "1.0")
    } else if is("i64") || is("integer") {
        ("a whole number", "1")
    } else {
        return None;
    })
}

/// serde's message as what is wrong, and how to mend it. serde gives names between backquotes:
/// first the one that was found, then those it knows.
fn told(
    (tree, text): (&Tree<'_>, &str),
    message: &str,
    at: &Range<usize>,
    explained: &str,
) -> ConfigDiagnostic {
    let (key, kind) = tree.described(at);
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let unknown = message.starts_with("unknown field");
    let (key, message, help) = match (unknown, names.as_slice(), missing(message)) {
        (true, [unknown, known @ ..], _) => {
            let list = known.join(", ");
            let help = nearest(unknown, known).map_or_else(
                || format!("the keys here are: {list}"),
                |name| format!("did you mean `{name}`? The keys here are: {list}"),
            );
            (key, format!("unknown key `{unknown}`"), Some(help))
        }
        (_, _, Some(missing)) => {
            let help = match missing {
                "axis" => {
                    "a machine has at least one axis: add a table such as [axis.X]".to_owned()
                }
                key => format!("add `{key} = …` to this table; {explained} explains every key"),
            };
            let table = tree.table(at);
            let key = [table.as_str(), missing].join(if table.is_empty() { "" } else { "." });
            (key, format!("the key `{missing}` is missing"), Some(help))
        }
        _ => match wanted(kind, message) {
            Some((wanted, _)) if !key.is_empty() => {
                let name = key.rsplit('.').next().unwrap_or_default();
                let help = match wanted {
                    "a number" | "a whole number" => {
                        let written = text.get(at.clone()).unwrap_or_default();
                        let key = (explained == EXPLAINED).then_some(key.as_str());
                        let beside = |other: &str| {
                            let (table, _) = key?.rsplit_once('.')?;
                            let place = tree.place(&format!("{table}.{other}"))?;
                            let number = text.get(place)?.parse().ok();
                            number.filter(|number: &f64| number.is_finite())
                        };
                        number_help(name, key, wanted, written, beside)
                    }
                    "a table" => format!("give it a table of its own: [{key}]"),
                    wanted => format!("write {wanted}"),
                };
                (
                    key.clone(),
                    format!("{key} is {kind}, not {wanted}"),
                    Some(help),
                )
            }
            _ => (key, message.to_owned(), None),
        },
    };
    ConfigDiagnostic {
        key,
        message,
        help,
        span: Some(at.clone()),
    }
}

/// How to write a number in the place of something else: the one that was meant, or one that is allowed and gentle.
/// `key` is its name where it is one of a machine, `beside` gives the numbers beside it.
fn number_help(
    name: &str,
    key: Option<&str>,
    wanted: &str,
    written: &str,
    beside: impl Fn(&str) -> Option<f64>,
) -> String {
    let inner = written.trim_matches(['"', '\'']).trim();
    let number = inner
        .parse::<f64>()
        .ok()
        .filter(|number| number.is_finite());
    if let Some(number) = number.filter(|_| wanted == "a number") {
        let number = toml::Value::Float(number);
        return format!("write it without quotes: {name} = {number}");
    }
    if let Some(number) = point(inner) {
        return format!("write it without quotes, and with a decimal point: {name} = {number}");
    }
    let range = key.and_then(keys::known).map(|key| key.takes.words());
    let range = range.map_or(String::new(), |words| format!(" ({words})"));
    match key.and_then(|key| keys::example(key, beside)) {
        Some(example) => {
            format!("write {wanted} without quotes{range}, such as {name} = {example}")
        }
        None => format!("write {wanted} without quotes{range}"),
    }
}

/// The known name that is most like the unknown one, if any is alike.
fn nearest<'a>(unknown: &str, known: &[&'a str]) -> Option<&'a str> {
    known
        .iter()
        .map(|name| {
            (
                strsim::jaro_winkler(&unknown.to_lowercase(), &name.to_lowercase()),
                *name,
            )
        })
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}
