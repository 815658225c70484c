//! A line of the file of inputs.

use core::fmt;

const KNOWN: &str = "a line is `input 3 on`, `home 0 on`, `limit_low 0 on`, `limit_high 0 on`, `input 3 at J2 \
                     -7.25` or `analog 1 4.5`";

/// What an input is to programs and to the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    Input(usize),
    Home(usize),
    LimitLow(usize),
    LimitHigh(usize),
    Analog(usize),
}

impl Meaning {
    fn of(word: &str, number: usize) -> Option<Self> {
        Some(match word {
            "input" => Self::Input(number),
            "home" => Self::Home(number),
            "limit_low" => Self::LimitLow(number),
            "limit_high" => Self::LimitHigh(number),
            "analog" => Self::Analog(number),
            _ => return None,
        })
    }
}

/// What stands at it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Stands {
    On,
    Off,
    Value(f64),
    /// It is on where a joint is at a place or beyond it.
    At(usize, f64),
}

impl Stands {
    fn of(meaning: Meaning, words: &[&str]) -> Option<Self> {
        let number = |text: &str| text.parse().ok().filter(|value: &f64| value.is_finite());
        match (meaning, words) {
            (Meaning::Analog(_), [value]) => number(value).map(Self::Value),
            (Meaning::Analog(_), _) => None,
            (_, ["on" | "1"]) => Some(Self::On),
            (_, ["off" | "0"]) => Some(Self::Off),
            (_, ["at", joint, place]) => {
                let joint = joint.strip_prefix(['J', 'j'])?.parse().ok()?;
                Some(Self::At(joint, number(place)?))
            }
            _ => None,
        }
    }
}

/// What is wrong in the file, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct InputError {
    pub(super) line: usize,
    pub(super) column: usize,
    pub(super) what: String,
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.what)
    }
}

/// What a line says, and in which column; `None` if it says nothing.
pub(super) fn line_of(
    line: usize,
    written: &str,
) -> Result<Option<(Meaning, usize, Stands)>, InputError> {
    let text = written.split('#').next().unwrap_or_default();
    let column = 1 + text
        .chars()
        .take_while(|letter| letter.is_whitespace())
        .count();
    let words: Vec<&str> = text.split_whitespace().collect();
    if words.is_empty() {
        return Ok(None);
    }
    let said = || {
        let (word, number) = (words.first()?, words.get(1)?);
        let meaning = Meaning::of(word, number.parse().ok()?)?;
        Some((meaning, column, Stands::of(meaning, &words[2..])?))
    };
    let error = || InputError {
        line,
        column,
        what: KNOWN.to_owned(),
    };
    said().map(Some).ok_or_else(error)
}
