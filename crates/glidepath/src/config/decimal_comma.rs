//! Numbers with a decimal comma, which is no TOML.

use super::diagnostic::ConfigDiagnostic;
use core::ops::Range;

/// A text with points in place of its decimal commas, and what is told of each of them. Everything else stands
/// where it stood.
pub(super) struct Mended {
    pub(super) text: String,
    pub(super) found: Vec<ConfigDiagnostic>,
}

/// Mends the decimal commas of a text, if one of them is where its syntax is wrong.
pub(super) fn mended(text: &str, wrong: Option<&Range<usize>>) -> Option<Mended> {
    let mut mended = String::with_capacity(text.len());
    let mut found = Vec::new();
    let mut table = "";
    let mut is_there = wrong.is_none();
    for line in text.split_inclusive('\n') {
        let start = mended.len();
        let bare = line.split('#').next().unwrap_or_default();
        if let Some(name) = bare.trim().strip_prefix('[') {
            table = name.trim_end_matches(']').trim();
        }
        let value = bare.split_once('=').map(|(_, value)| value.trim());
        let number = value.and_then(|value| Some((value, point(value)?)));
        let (Some((name, _)), Some((value, number))) = (bare.split_once('='), number) else {
            mended.push_str(line);
            continue;
        };
        let (name, at) = (name.trim(), name.len() + 1);
        let gap = line
            .get(at..)
            .map_or(0, |behind| behind.len() - behind.trim_start().len());
        let span = start + at + gap..start + at + gap + value.len();
        is_there |= wrong.is_some_and(|wrong| (start..=start + line.len()).contains(&wrong.start));
        found.push(told(table, name, value, &number, span));
        mended.push_str(line.get(..at + gap).unwrap_or_default());
        // As long as it was: what stood between thousands are blanks behind it.
        mended.push_str(&format!("{number:width$}", width = value.len()));
        mended.push_str(line.get(at + gap + value.len()..).unwrap_or_default());
    }
    (is_there && !found.is_empty()).then_some(Mended {
        text: mended,
        found,
    })
}

fn told(
    table: &str,
    name: &str,
    value: &str,
    number: &str,
    span: Range<usize>,
) -> ConfigDiagnostic {
    let key = [table, name].join(if table.is_empty() { "" } else { "." });
    let mut help = format!("the decimal sign is a point: {name} = {number}");
    if let Some((whole, thousand)) = number.split_once('.')
        && thousand.len() == 3
        && !value.contains('.')
    {
        help.push_str(&format!(
            ". If the comma parts thousands, leave it out: {name} = {whole}{thousand}"
        ));
    }
    ConfigDiagnostic {
        message: format!("{key} = {value} has a decimal comma"),
        key,
        help: Some(help),
        span: Some(span),
    }
}

/// A number with a decimal comma as one with a point: `100,5`, also `1.000,5`.
pub(super) fn point(value: &str) -> Option<String> {
    let (whole, rest) = value.split_once(',')?;
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let mut parts = whole.trim_start_matches(['+', '-']).split('.');
    let first = parts.next().is_some_and(digits);
    let are_thousands = first && parts.all(|part| part.len() == 3 && digits(part));
    (are_thousands && digits(rest)).then(|| format!("{}.{rest}", whole.replace('.', "")))
}

#[cfg(test)]
mod tests {
    use super::point;

    #[test]
    fn a_decimal_comma_is_told_from_a_list() {
        for (value, number) in [
            ("100,5", Some("100.5")),
            ("-0,02", Some("-0.02")),
            ("1.000,5", Some("1000.5")),
            ("100.5", None),
            ("1,2,3", None),
            ("1.5,3", None),
            ("1, 2", None),
            (",5", None),
            ("5,", None),
            ("\"a,b\"", None),
        ] {
            assert_eq!(point(value).as_deref(), number, "{value}");
        }
    }
}
