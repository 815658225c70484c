//! The conversion of `RS274NGC_STARTUP_CODE`: the block that LinuxCNC executes before anything else.

use super::Machine;
use super::path::usable_tolerance;
use crate::draft::float;
use crate::inputs::{At, Fate};

/// Where it stands: the key of today, and what it was called before.
const KEYS: [(&str, &str); 3] = [
    ("RS274NGC", "RS274NGC_STARTUP_CODE"),
    ("RS274NGC", "STARTUP_CODE"),
    ("EMC", "RS274NGC_STARTUP_CODE"),
];

/// What programs begin in here, too.
const SAME: [&str; 17] = [
    "G8", "G17", "G21", "G40", "G49", "G54", "G64", "G80", "G90", "G91.1", "G92.1", "G92.2", "G94",
    "G97", "G98", "M5", "M9",
];

/// Codes that programs do not begin in here, and what they begin in.
const OTHERS: [(&str, &str); 16] = [
    ("G7", "G8"),
    ("G18", "G17"),
    ("G19", "G17"),
    ("G20", "G21"),
    ("G55", "G54, or in the system that is kept"),
    ("G56", "G54, or in the system that is kept"),
    ("G57", "G54, or in the system that is kept"),
    ("G58", "G54, or in the system that is kept"),
    ("G59", "G54, or in the system that is kept"),
    (
        "G61",
        "G64 (smoothing = \"exact-stop\" of [path] stops at all corners)",
    ),
    (
        "G61.1",
        "G64 (smoothing = \"exact-stop\" of [path] stops at all corners)",
    ),
    ("G90.1", "G91.1"),
    ("G91", "G90"),
    ("G93", "G94"),
    ("G95", "G94"),
    ("G99", "G98"),
];

/// Feedrates that path.default_feed takes, mm/min.
const FEEDS: core::ops::RangeInclusive<f64> = 1e-3..=1e7;

/// A word of the block.
struct Word {
    letter: char,
    value: f64,
}

impl Word {
    fn text(&self) -> String {
        format!("{}{}", self.letter, self.value)
    }
}

/// What became of the words.
#[derive(Default)]
struct Verdicts {
    converted: Vec<String>,
    same: Vec<String>,
    lost: Vec<String>,
}

impl Machine {
    /// The tolerance that programs begin with, mm, where the block says one.
    pub(super) fn startup(&mut self) -> Option<(At, f64)> {
        let found = KEYS
            .iter()
            .find_map(|(section, key)| self.inputs.text(section, key));
        let (at, text) = found?;
        let Some(words) = words(text) else {
            let note = "not a block of words alone: programs begin in G17 G21 G54 G64 G90 G94; write what else \
                        they need into them";
            self.inputs.decide(at, Fate::NoCounterpart, note);
            return None;
        };
        let mut verdicts = Verdicts::default();
        let tolerance = self.tolerance_of(&words, &mut verdicts);
        self.feed_of(at, &words, &mut verdicts);
        for word in &words {
            let code = word.text();
            let other = OTHERS.iter().find(|(known, _)| *known == code);
            match (word.letter, other) {
                ('P' | 'Q' | 'F', _) => {}
                _ if SAME.contains(&code.as_str()) => verdicts.same.push(code),
                (_, Some((_, begins))) => {
                    let lost = format!("{code}, as programs begin in {begins}");
                    verdicts.lost.push(lost);
                }
                _ => verdicts.lost.push(code),
            }
        }
        self.judge_startup(at, &verdicts);
        tolerance.map(|mm| (at, mm))
    }

    /// P of G64, and Q beside it.
    fn tolerance_of(&self, words: &[Word], verdicts: &mut Verdicts) -> Option<f64> {
        let value = |letter| words.iter().find(|word| word.letter == letter);
        let has_g64 = words.iter().any(|word| word.text() == "G64");
        let mut tolerance = None;
        if let Some(p) = value('P') {
            let mm = self.unit_of(words).map(|unit| p.value * unit);
            tolerance = mm.filter(|mm| has_g64 && usable_tolerance(*mm));
            match tolerance {
                Some(mm) => {
                    let note = format!("{} of G64 as path.tolerance, {} mm", p.text(), float(mm));
                    verdicts.converted.push(note);
                }
                None => verdicts.lost.push(p.text()),
            }
        }
        if let Some(q) = value('Q') {
            verdicts.lost.push(format!(
                "{}, as lines are merged inside the tolerance",
                q.text()
            ));
        }
        tolerance
    }

    /// F, where it is a feed per minute.
    fn feed_of(&mut self, at: At, words: &[Word], verdicts: &mut Verdicts) {
        let Some(f) = words.iter().find(|word| word.letter == 'F') else {
            return;
        };
        let is_other = |word: &Word| ["G93", "G95"].contains(&word.text().as_str());
        let feed = self.unit_of(words).map(|unit| f.value * unit);
        match feed.filter(|feed| FEEDS.contains(feed) && !words.iter().any(is_other)) {
            Some(feed) => {
                let from = self.inputs.name(at);
                self.draft.known("path", "default_feed", float(feed), &from);
                verdicts
                    .converted
                    .push(format!("{} as path.default_feed", f.text()));
            }
            None => verdicts.lost.push(f.text()),
        }
    }

    /// What a length of the block is, mm: its G20 or G21 counts, else the machine's units.
    fn unit_of(&self, words: &[Word]) -> Option<f64> {
        let has = |code: &str| words.iter().any(|word| word.text() == code);
        match (has("G20"), has("G21")) {
            (true, _) => Some(25.4),
            (_, true) => Some(1.0),
            _ => self.units.linear_mm,
        }
    }

    fn judge_startup(&mut self, at: At, verdicts: &Verdicts) {
        let Verdicts {
            converted,
            same,
            lost,
        } = verdicts;
        let mut parts = converted.clone();
        if !same.is_empty() {
            parts.push(format!("programs begin in {} here, too", same.join(" ")));
        }
        if !lost.is_empty() {
            let told = format!(
                "without a counterpart, to be written into programs: {}",
                lost.join("; ")
            );
            self.draft
                .remark("program", &format!("{} is {told}", self.inputs.name(at)));
            parts.push(told);
        }
        let fate = match (lost.is_empty(), converted.is_empty() && same.is_empty()) {
            (true, false) => Fate::Converted,
            (false, false) => Fate::Changed,
            (_, true) => Fate::NoCounterpart,
        };
        if parts.is_empty() {
            parts.push("it is empty".to_owned());
        }
        self.inputs.decide(at, fate, parts.join("; "));
    }
}

/// The words of a block without its comments; `None` if there is anything else in it.
fn words(text: &str) -> Option<Vec<Word>> {
    let mut bare = String::new();
    let mut is_comment = false;
    for c in text.chars() {
        match c {
            ';' => break,
            '(' => is_comment = true,
            ')' => is_comment = false,
            c if !is_comment && !c.is_whitespace() => bare.push(c.to_ascii_uppercase()),
            _ => {}
        }
    }
    let mut words = Vec::new();
    let mut rest = bare.as_str();
    while let Some(letter) = rest.chars().next() {
        if !letter.is_ascii_alphabetic() {
            return None;
        }
        let behind = rest.get(1..)?;
        let end = behind.find(|c: char| !c.is_ascii_digit() && !['.', '-', '+'].contains(&c));
        let (number, next) = behind.split_at(end.unwrap_or(behind.len()));
        let value: f64 = number
            .parse()
            .ok()
            .filter(|value: &f64| value.is_finite())?;
        words.push(Word { letter, value });
        rest = next;
    }
    Some(words)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]

    use super::words;

    fn read(text: &str) -> Option<Vec<String>> {
        let words = words(text)?;
        Some(words.iter().map(super::Word::text).collect())
    }

    #[test]
    fn a_block_is_read_as_words() {
        let all = read("G17 g20 (inches) G64P0.05 G91.1 F-.5 ; the rest").unwrap();
        assert_eq!(all, ["G17", "G20", "G64", "P0.05", "G91.1", "F-0.5"]);
        assert_eq!(read("G064 G01.0").unwrap(), ["G64", "G1"]);
        assert_eq!(read("").unwrap().len(), 0);
        for text in ["o<start> call", "#1 = 2", "G1 X[1+2]", "G", "ä", "G1.2.3"] {
            assert_eq!(read(text), None, "{text}");
        }
    }
}
