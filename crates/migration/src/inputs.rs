//! The keys of a foreign configuration, each with what becomes of it.

use crate::conversion::KeyVerdict;

/// Where a key belongs among the lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fate {
    Converted,
    Changed,
    NoCounterpart,
}

/// A key as it stands in the input.
#[derive(Debug, Clone)]
pub(crate) struct Input {
    pub(crate) section: String,
    pub(crate) key: String,
    pub(crate) value: String,
    /// The file, if it is not the first one, and the line.
    pub(crate) place: String,
    fate: Option<(Fate, String)>,
}

/// All keys of the input, in its order.
#[derive(Debug, Default)]
pub(crate) struct Inputs {
    keys: Vec<Input>,
    /// How a key is written, from its section and its name.
    named: Option<fn(&str, &str) -> String>,
}

/// The number of a key.
pub(crate) type At = usize;

impl Inputs {
    pub(crate) fn named(named: fn(&str, &str) -> String) -> Self {
        Self {
            keys: Vec::new(),
            named: Some(named),
        }
    }

    pub(crate) fn add(&mut self, section: &str, key: &str, value: &str, place: String) {
        self.keys.push(Input {
            section: section.to_owned(),
            key: key.to_owned(),
            value: value.trim().to_owned(),
            place,
            fate: None,
        });
    }

    /// Appends a line to the value of the last key.
    pub(crate) fn extend_last(&mut self, text: &str) {
        if let Some(last) = self.keys.last_mut() {
            last.value.push(' ');
            last.value.push_str(text.trim());
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.keys.len()
    }

    pub(crate) fn get(&self, at: At) -> Option<&Input> {
        self.keys.get(at)
    }

    /// The first key of that name: the one that counts.
    pub(crate) fn find(&self, section: &str, key: &str) -> Option<At> {
        let is = |input: &Input| {
            input.section.eq_ignore_ascii_case(section) && input.key.eq_ignore_ascii_case(key)
        };
        self.keys.iter().position(is)
    }

    /// Whether a section has any key.
    pub(crate) fn has_section(&self, section: &str) -> bool {
        let mut keys = self.keys.iter();
        keys.any(|input| input.section.eq_ignore_ascii_case(section))
    }

    /// Its value.
    pub(crate) fn text(&self, section: &str, key: &str) -> Option<(At, &str)> {
        let at = self.find(section, key)?;
        Some((at, &self.keys.get(at)?.value))
    }

    /// Its value as a number, `Err` if it is none. What stands behind the number is no part of it.
    pub(crate) fn number(&self, section: &str, key: &str) -> Option<(At, Result<f64, String>)> {
        let (at, text) = self.text(section, key)?;
        let first = text.split_whitespace().next().unwrap_or_default();
        let number = first.parse().ok().filter(|n: &f64| n.is_finite());
        Some((at, number.ok_or_else(|| format!("`{text}` is no number"))))
    }

    /// How the key is written.
    pub(crate) fn name(&self, at: At) -> String {
        match (self.keys.get(at), self.named) {
            (Some(input), Some(named)) => named(&input.section, &input.key),
            _ => String::new(),
        }
    }

    /// Says what becomes of a key; what was said first stands.
    pub(crate) fn decide(&mut self, at: At, fate: Fate, note: impl Into<String>) {
        if let Some(input) = self.keys.get_mut(at) {
            input.fate.get_or_insert((fate, note.into()));
        }
    }

    /// Whether it is said what becomes of a key.
    pub(crate) fn is_decided(&self, at: At) -> bool {
        self.keys.get(at).is_some_and(|input| input.fate.is_some())
    }

    /// The keys whose fate is this one.
    pub(crate) fn of(&self, wanted: Fate) -> Vec<KeyVerdict> {
        let all = self.keys.iter().enumerate();
        let these = all.filter_map(|(at, input)| match &input.fate {
            Some((fate, note)) if *fate == wanted => Some(KeyVerdict {
                key: self.name(at),
                place: input.place.clone(),
                value: input.value.clone(),
                note: note.clone(),
            }),
            _ => None,
        });
        these.collect()
    }
}
