//! Text to [`RawConfig`]: the syntax and the names of keys.

use super::diagnostic::ConfigDiagnostic;
use super::raw::RawConfig;

/// Reads the text.
///
/// # Errors
/// The first thing that is not TOML, not a known key, or not of the key's type.
pub(super) fn parse(text: &str) -> Result<RawConfig, ConfigDiagnostic> {
    toml::from_str(text).map_err(|error| {
        let message = error
            .message()
            .lines()
            .next()
            .unwrap_or_default()
            .to_owned();
        let (message, help) = explain(&message);
        ConfigDiagnostic {
            key: String::new(),
            message,
            help,
            span: error.span(),
        }
    })
}

/// Turns serde's message into what, and how to mend it. serde gives the names between backquotes:
/// first the one that was found, then those it knows.
fn explain(message: &str) -> (String, Option<String>) {
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    if let (true, [unknown, known @ ..]) = (message.starts_with("unknown field"), names.as_slice())
    {
        let list = known.join(", ");
        let help = nearest(unknown, known).map_or_else(
            || format!("the keys here are: {list}"),
            |name| format!("did you mean `{name}`? The keys here are: {list}"),
        );
        return (format!("unknown key `{unknown}`"), Some(help));
    }
    if let (true, [missing, ..]) = (message.starts_with("missing field"), names.as_slice()) {
        let help = match *missing {
            "axis" => "a machine has at least one axis: add a table such as [axis.X]".to_owned(),
            key => format!("add `{key} = …` to this table; config/mill.toml explains every key"),
        };
        return (format!("the key `{missing}` is missing"), Some(help));
    }
    (message.to_owned(), None)
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
