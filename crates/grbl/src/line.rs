//! The kinds of lines of a sender: what each wants.

use crate::LETTERS;
use crate::error::ErrorNumber;

/// What a line wants.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Wanted {
    /// Nothing: it is empty, a comment, or the percent line of a file.
    Nothing,
    /// That the interpreter of programs executes it.
    Code,
    /// A jog, as it stands behind `$J=`.
    Jog(String),
    Help,
    Settings,
    Set(u32, f64),
    Parameters,
    Modes,
    BuildInfo,
    StartupLines,
    Check,
    Unlock,
    Home(Option<usize>),
    Sleep,
    /// A `$` line that is not known, or not allowed.
    Refused(ErrorNumber, &'static str),
}

impl Wanted {
    /// Whether it is refused while the machine moves.
    pub(crate) const fn is_for_rest(&self) -> bool {
        matches!(
            self,
            Self::Jog(_)
                | Self::Settings
                | Self::Set(..)
                | Self::Parameters
                | Self::Check
                | Self::Home(_)
                | Self::Sleep
        )
    }
}

/// What a line wants.
pub(crate) fn wanted(text: &str) -> Wanted {
    let bare = without_comments(text);
    if bare.is_empty() || bare == "%" {
        return Wanted::Nothing;
    }
    let Some(statement) = bare.strip_prefix('$') else {
        return Wanted::Code;
    };
    match statement {
        "" => Wanted::Help,
        "$" => Wanted::Settings,
        "#" => Wanted::Parameters,
        "G" => Wanted::Modes,
        "I" => Wanted::BuildInfo,
        "N" => Wanted::StartupLines,
        "C" => Wanted::Check,
        "X" => Wanted::Unlock,
        "H" => Wanted::Home(None),
        "SLP" => Wanted::Sleep,
        _ => other(statement),
    }
}

fn other(statement: &str) -> Wanted {
    const CONFIGURED: &str = "a sender does not set the machine up: its configuration does";
    if let Some(jog) = statement.strip_prefix("J=") {
        return Wanted::Jog(jog.to_owned());
    }
    if let Some(axis) = statement.strip_prefix('H')
        && let Some(index) = LETTERS.iter().position(|it| axis == it.to_string())
    {
        return Wanted::Home(Some(index));
    }
    if statement.starts_with("RST=") || statement.starts_with("I=") || statement.starts_with('N') {
        return Wanted::Refused(ErrorNumber::STATEMENT, CONFIGURED);
    }
    match statement.split_once('=') {
        Some((number, value)) => match (number.parse(), value.parse()) {
            (Ok(number), Ok(value)) => Wanted::Set(number, value),
            _ => Wanted::Refused(ErrorNumber::STATEMENT, "this statement is not known"),
        },
        None => Wanted::Refused(ErrorNumber::STATEMENT, "this statement is not known"),
    }
}

/// A line without comments and spaces, in capitals.
pub(crate) fn without_comments(text: &str) -> String {
    let mut bare = String::with_capacity(text.len());
    let mut is_comment = false;
    for character in text.chars() {
        match character {
            ')' => is_comment = false,
            _ if is_comment => {}
            '(' => is_comment = true,
            ';' => break,
            ' ' | '\t' => {}
            _ => bare.push(character.to_ascii_uppercase()),
        }
    }
    bare
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_are_told_from_code() {
        assert_eq!(wanted("  (a comment) ; $X"), Wanted::Nothing);
        assert_eq!(wanted("%"), Wanted::Nothing);
        assert_eq!(wanted("g0 x1 (over)"), Wanted::Code);
        assert_eq!(wanted("$j=g91 x1 f100"), Wanted::Jog("G91X1F100".into()));
        assert_eq!(wanted("$hx"), Wanted::Home(Some(0)));
        assert_eq!(wanted("$10=3"), Wanted::Set(10, 3.0));
        for refused in ["$Q", "$RST=*", "$N0=G21", "$I=me", "$x=y", "$J"] {
            assert!(
                matches!(wanted(refused), Wanted::Refused(ErrorNumber::STATEMENT, _)),
                "{refused}"
            );
        }
    }
}
