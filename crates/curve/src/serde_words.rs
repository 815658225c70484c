//! The messages of a file's reader in the words of its users: types as TOML has them, keys, values.

/// A message of serde, so said; any other as it is.
pub(crate) fn in_words(message: &str) -> String {
    let named = |rest: &str| rest.split('`').next().unwrap_or_default().to_owned();
    if let Some(rest) = message.strip_prefix("unknown field `") {
        return format!("unknown key `{}`", named(rest));
    }
    if let Some(rest) = message.strip_prefix("missing field `") {
        return format!("the key `{}` is missing", named(rest));
    }
    if let Some(rest) = message.strip_prefix("unknown variant `") {
        return format!("\"{}\" is not known", named(rest));
    }
    if let Some(rest) = message.strip_prefix("invalid length ") {
        let length = rest.split(',').next().unwrap_or_default();
        return format!("this is a list of {length}, not a list of three numbers");
    }
    if message.contains("untagged enum Number") {
        return "this is neither a number nor a formula in quotes".to_owned();
    }
    if message.contains("untagged enum RawEnd") {
        return "this is neither \"closed\", nor a point, nor a length".to_owned();
    }
    if message.starts_with("wanted string") {
        return "this is not text in quotes".to_owned();
    }
    let types = ["invalid type: ", "invalid value: "];
    let types = types.iter().find_map(|words| message.strip_prefix(words));
    types
        .and_then(|types| types.split_once(", expected "))
        .map_or_else(
            || message.to_owned(),
            |(found, wanted)| format!("this is {}, not {}", kind_found(found), kind_wanted(wanted)),
        )
}

/// What serde says it found.
fn kind_found(found: &str) -> &'static str {
    let kinds = [
        ("string", "text"),
        ("floating point", "a number with a decimal point"),
        ("integer `-", "a negative number"),
        ("integer", "a whole number"),
        ("boolean", "true or false"),
        ("sequence", "a list"),
        ("map", "a table"),
    ];
    let kind = kinds.iter().find(|(begins, _)| found.starts_with(begins));
    kind.map_or("something else", |(_, words)| words)
}

/// What serde says it wants.
fn kind_wanted(wanted: &str) -> &'static str {
    if wanted.contains("array of length 3") || wanted.contains("tuple of size 3") {
        "a list of three numbers"
    } else if wanted.contains("sequence") {
        "a list"
    } else if wanted.contains("string") || wanted.contains("enum") {
        "text in quotes"
    } else if wanted.contains('f') && wanted.contains("64") {
        "a number"
    } else if wanted.contains("64") {
        "a whole number of its range"
    } else {
        "what stands at such a key"
    }
}
