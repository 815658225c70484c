//! The draft of a configuration: tables of keys that are known, or asked for.

use crate::conversion::{Asked, Conversion, KeyVerdict};
use crate::inputs::{Fate, Inputs};
use core::fmt::Write as _;

/// Widest line of the lists.
const WIDTH: usize = 100;

/// A line of a table.
#[derive(Debug)]
enum Line {
    Known {
        key: String,
        value: String,
        from: String,
    },
    /// Not said: the key stays commented, and the loader misses it.
    Asked {
        key: String,
        why: String,
    },
    /// Not said, and the loader would do without: text that it refuses stands in its place.
    ToChoose {
        key: String,
        why: String,
    },
    Remark(String),
}

/// The tables of a configuration, in their order.
#[derive(Debug, Default)]
pub(crate) struct Draft {
    tables: Vec<(String, Vec<Line>)>,
}

/// A number as TOML has it, without the noise of a conversion of units behind its ninth decimal.
pub(crate) fn float(value: f64) -> String {
    let rounded = (value * 1e9).round() / 1e9;
    let value = if rounded.is_finite() { rounded } else { value };
    // No negative zero.
    format!("{:?}", value + 0.0)
}

/// Text as TOML has it.
pub(crate) fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

impl Draft {
    fn table(&mut self, name: &str) -> &mut Vec<Line> {
        let at = self.tables.iter().position(|(known, _)| known == name);
        let at = at.unwrap_or_else(|| {
            self.tables.push((name.to_owned(), Vec::new()));
            self.tables.len() - 1
        });
        &mut self.tables[at].1
    }

    pub(crate) fn known(&mut self, table: &str, key: &str, value: String, from: &str) {
        self.table(table).push(Line::Known {
            key: key.to_owned(),
            value,
            from: from.to_owned(),
        });
    }

    pub(crate) fn ask(&mut self, table: &str, key: &str, why: &str) {
        self.table(table).push(Line::Asked {
            key: key.to_owned(),
            why: why.to_owned(),
        });
    }

    /// Everything of an axis.
    pub(crate) fn ask_axis(&mut self, letter: &str, why: &str) {
        let table = format!("axis.{letter}");
        for key in [
            "min_position",
            "max_position",
            "max_velocity",
            "max_acceleration",
            "max_jerk",
        ] {
            self.ask(&table, key, why);
        }
    }

    pub(crate) fn choose(&mut self, table: &str, key: &str, why: &str) {
        self.table(table).push(Line::ToChoose {
            key: key.to_owned(),
            why: why.to_owned(),
        });
    }

    pub(crate) fn remark(&mut self, table: &str, text: &str) {
        self.table(table).push(Line::Remark(text.to_owned()));
    }

    /// Where joints are not the axes, axes do without limits of their own: nobody is asked for them.
    fn leave_out_what_joints_limit(&mut self) {
        let is_of_joints = self.tables.iter().any(|(table, lines)| {
            let is_mechanism = |line: &Line| {
                matches!(line, Line::Known { key, value, .. }
                    if key == "kinematics" && *value != quoted("trivial"))
            };
            table == "machine" && lines.iter().any(is_mechanism)
        });
        if !is_of_joints {
            return;
        }
        let is_limit = |key: &str| ["max_velocity", "max_acceleration", "max_jerk"].contains(&key);
        let axes = self
            .tables
            .iter_mut()
            .filter(|(table, _)| table.starts_with("axis."));
        for (_, lines) in axes {
            lines.retain(|line| !matches!(line, Line::Asked { key, .. } if is_limit(key)));
        }
    }

    /// The configuration, and the lists.
    pub(crate) fn finish(mut self, inputs: &Inputs, of: &str) -> Conversion {
        self.leave_out_what_joints_limit();
        let asked = self.asked();
        let [converted, changed, no_counterpart] =
            [Fate::Converted, Fate::Changed, Fate::NoCounterpart].map(|fate| inputs.of(fate));
        let mut text = format!("# Converted from {of}.\n");
        if !asked.is_empty() {
            text.push_str(
                "# It does not load before every key that has no value yet has one: they are asked for where\n\
                 # they stand, and listed at the end. `glidepath config --explain KEY` explains each.\n",
            );
        }
        for (name, lines) in &self.tables {
            let _ = write!(text, "\n[{name}]\n");
            for line in lines {
                line.write(&mut text);
            }
        }
        list(&mut text, "Converted", &converted);
        list(&mut text, "Changed in meaning", &changed);
        list(&mut text, "No counterpart", &no_counterpart);
        if !asked.is_empty() {
            text.push_str("\n# To be written, before this loads:\n");
            for Asked { key, why } in &asked {
                wrapped(&mut text, &format!("{key}: {why}"));
            }
        }
        Conversion {
            configuration: text,
            converted,
            changed,
            no_counterpart,
            asked,
        }
    }

    fn asked(&self) -> Vec<Asked> {
        let lines = self.tables.iter().flat_map(|(table, lines)| {
            lines.iter().filter_map(move |line| match line {
                Line::Asked { key, why } | Line::ToChoose { key, why } => Some(Asked {
                    key: format!("{table}.{key}"),
                    why: why.clone(),
                }),
                Line::Known { .. } | Line::Remark(_) => None,
            })
        });
        lines.collect()
    }
}

impl Line {
    fn write(&self, text: &mut String) {
        match self {
            Self::Known { key, value, from } => {
                let line = format!("{key} = {value}");
                let _ = writeln!(text, "{line:<32}  # {from}");
            }
            Self::Asked { key, why } => {
                wrapped(text, why);
                let _ = writeln!(text, "# {key} =");
            }
            Self::ToChoose { key, why } => {
                wrapped(text, why);
                let _ = writeln!(text, "{key} = \"to be chosen\"");
            }
            Self::Remark(remark) => wrapped(text, remark),
        }
    }
}

fn list(text: &mut String, title: &str, verdicts: &[KeyVerdict]) {
    if verdicts.is_empty() {
        return;
    }
    let _ = write!(text, "\n# {title}:\n");
    for verdict in verdicts {
        let KeyVerdict {
            key,
            place,
            value,
            note,
        } = verdict;
        let value: String = value.chars().take(40).collect();
        wrapped(text, &format!("{key} = {value} ({place}): {note}"));
    }
}

/// A comment in lines that are not too wide.
fn wrapped(text: &mut String, words: &str) {
    let mut line = String::from("#");
    for word in words.split_whitespace() {
        // What comes from the input may have anything in it.
        let word: String = word.chars().filter(|c| !c.is_control()).collect();
        if line.chars().count() + word.chars().count() + 1 > WIDTH && line != "#" {
            text.push_str(&line);
            text.push_str("\n#  ");
            line.clear();
        }
        line.push(' ');
        line.push_str(&word);
    }
    text.push_str(&line);
    text.push('\n');
}
