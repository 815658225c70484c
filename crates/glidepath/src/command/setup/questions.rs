//! The questions of a set-up: asked in a terminal or read from a pipe, with a suggested answer each.

use crate::command::failure::Failure;
use crate::output;
use std::io::{self, BufRead as _};

/// Whoever asks.
#[derive(Debug)]
pub(super) struct Questions {
    /// Every question gets its suggested answer.
    takes_suggested: bool,
}

impl Questions {
    pub(super) const fn new(takes_suggested: bool) -> Self {
        Self { takes_suggested }
    }

    /// Says something between questions.
    pub(super) fn say(&self, text: &str) {
        if !self.takes_suggested {
            output::result(&format!("\n{text}\n"));
        }
    }

    /// One of some names.
    ///
    /// # Errors
    /// The answers have ended.
    pub(super) fn choice<T: Copy>(
        &self,
        question: &str,
        choices: &[(&str, T)],
        suggested: &str,
    ) -> Result<T, Failure> {
        let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
        let names = names.join(", ");
        self.ask(&format!("{question} ({names})"), suggested, |answer| {
            let answer = answer.to_ascii_lowercase();
            let found = choices.iter().find(|(name, _)| *name == answer);
            found
                .map(|(_, value)| *value)
                .ok_or_else(|| format!("answer one of: {names}"))
        })
    }

    /// Yes or no.
    ///
    /// # Errors
    /// The answers have ended.
    pub(super) fn yes(&self, question: &str, suggested: bool) -> Result<bool, Failure> {
        let choices = [("yes", true), ("no", false), ("y", true), ("n", false)];
        let suggested = if suggested { "yes" } else { "no" };
        self.ask(&format!("{question} (yes, no)"), suggested, |answer| {
            let answer = answer.to_ascii_lowercase();
            let found = choices.iter().find(|(name, _)| *name == answer);
            found
                .map(|(_, value)| *value)
                .ok_or_else(|| "answer yes or no".to_owned())
        })
    }

    /// A number in a range.
    ///
    /// # Errors
    /// The answers have ended.
    pub(super) fn number(
        &self,
        question: &str,
        unit: &str,
        suggested: f64,
        (least, most): (f64, f64),
    ) -> Result<f64, Failure> {
        self.ask(
            &format!("{question}, {unit}"),
            &suggested.to_string(),
            |answer| {
                let number = answer.trim_end_matches(unit).trim();
                if number.contains(',') {
                    return Err("write a decimal point, as in 12.5, and no comma".to_owned());
                }
                let number: f64 = number
                    .parse()
                    .map_err(|_| format!("give a number of {unit}, such as {suggested}"))?;
                if (least..=most).contains(&number) {
                    Ok(number)
                } else {
                    Err(format!("give {least} to {most} {unit}"))
                }
            },
        )
    }

    /// Asks until an answer is understood.
    fn ask<T>(
        &self,
        question: &str,
        suggested: &str,
        understand: impl Fn(&str) -> Result<T, String>,
    ) -> Result<T, Failure> {
        let failed = || Failure::Unanswered {
            question: question.to_owned(),
        };
        if self.takes_suggested {
            return understand(suggested).map_err(|_| failed());
        }
        loop {
            output::result(&format!("{question} [{suggested}]: "));
            let mut line = String::new();
            let read = io::stdin().lock().read_line(&mut line);
            if read.map_err(|_| failed())? == 0 {
                output::result("\n");
                return Err(failed());
            }
            let answer = match line.trim() {
                "" => suggested,
                answer => answer,
            };
            match understand(answer) {
                Ok(understood) => return Ok(understood),
                Err(why) => output::result(&format!("  {why}\n")),
            }
        }
    }
}
