//! The kinds of lines of a sender: what each wants.

use crate::LETTERS;
use crate::error::ErrorNumber;
use crate::words::{Word, without_comments};

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
    /// Whether it only asks.
    pub(crate) const fn is_question(&self) -> bool {
        matches!(
            self,
            Self::Help
                | Self::Settings
                | Self::Parameters
                | Self::Modes
                | Self::BuildInfo
                | Self::StartupLines
        )
    }

    /// Whether it is refused while the machine moves.
    pub(crate) const fn is_for_rest(&self) -> bool {
        matches!(
            self,
            Self::Jog(_) | Self::Set(..) | Self::Check | Self::Home(_) | Self::Sleep
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

/// Why a line is refused to senders that the machine's language takes: grbl refuses it, and it does nothing, or what no
/// sender shows.
pub(crate) fn not_of_senders(words: &[Word]) -> Option<(ErrorNumber, &'static str)> {
    let has = |letter: char, value: f64| {
        let is_it = |word: &Word| word.letter == letter && word.value == Some(value);
        words.iter().any(is_it)
    };
    let sets_system = has('G', 10.0) && (has('L', 2.0) || has('L', 20.0));
    if sets_system && words.iter().any(|word| word.letter == 'R') {
        let why = "R turns the coordinate system, which no sender shows: have a program of the machine do it";
        return Some((ErrorNumber::UNSUPPORTED, why));
    }
    if sets_system && !names_axis(words) {
        return Some((ErrorNumber::NO_AXES, "G10 without an axis sets nothing"));
    }
    if has('G', 43.1) && !names_axis(words) {
        return Some((ErrorNumber::NO_LENGTH, "G43.1 without Z sets no length"));
    }
    None
}

/// Whether a line is about machine coordinates (G53) and names no axis: grbl takes it, and nothing moves.
pub(crate) fn is_idle_g53(words: &[Word]) -> bool {
    let is_g53 = |word: &Word| word.letter == 'G' && word.value == Some(53.0);
    words.iter().any(is_g53) && !names_axis(words)
}

fn names_axis(words: &[Word]) -> bool {
    words.iter().any(|word| LETTERS.contains(&word.letter))
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
