//! `[m_codes.M…]`: the M codes that the machine has of its own, and those that are waited for.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::{Optional, RawMCode};
use crate::config::settings::MCodeRule;
use glidepath_gcode::{MCodes, WaitsAt};
use glidepath_interpolator::{AnswerSource, MAX_M_CODE_WAITS, MCodeWait};
use std::collections::BTreeMap;
use std::time::Duration;
use toml::Spanned;

/// Codes of every program that may be waited for: those at which the machine is at rest anyway.
const MAY_WAIT: [u32; 9] = [3, 4, 5, 6, 7, 8, 9, 19, 61];

/// The rules of M66 and, where there is no other, of M6 are the machine's own.
const MOST: usize = MAX_M_CODE_WAITS - 2;

impl Judge {
    pub(super) fn m_codes(
        &mut self,
        raw: BTreeMap<Spanned<String>, Spanned<RawMCode>>,
    ) -> Vec<MCodeRule> {
        let mut rules = Vec::new();
        for (name, raw) in raw {
            let key = format!("m_codes.{}", name.as_ref());
            let raw = raw.into_inner();
            let seconds = Range {
                min: 0.1,
                max: 86_400.0,
                unit: "s",
                help: "longer than it ever takes when all is well",
            };
            let timeout_key = format!("{key}.timeout_s");
            let within = raw
                .timeout_s
                .as_ref()
                .map(|value| self.number(&timeout_key, value, &seconds))
                .map(Duration::from_secs_f64);
            let answer = self.answer(&format!("{key}.done"), raw.done);
            let at = self.choice(
                &format!("{key}.at"),
                raw.at,
                &[
                    ("code", WaitsAt::Code),
                    ("next-feed", WaitsAt::NextFeed),
                    ("block-end", WaitsAt::BlockEnd),
                ],
            );
            match codes(name.as_ref()) {
                Some((first, last)) if (first..=last).all(is_possible) => rules.push(MCodeRule {
                    m_code_wait: MCodeWait {
                        first,
                        last,
                        answer,
                        within,
                        is_late: at != WaitsAt::Code,
                    },
                    at: if answer == AnswerSource::Nobody {
                        WaitsAt::Code
                    } else {
                        at
                    },
                }),
                _ => self.diagnostics.push(ConfigDiagnostic {
                    message: format!("{key} names no M code that can be declared"),
                    key,
                    help: Some(
                        "give a code or a range such as M428 or M100-M199; of the codes of every \
                         program, M3 to M9, M19 and M61 can be waited for"
                            .to_owned(),
                    ),
                    span: Some(name.span()),
                }),
            }
        }
        // The more particular rule counts.
        rules.sort_by_key(|rule| {
            (
                rule.m_code_wait.last - rule.m_code_wait.first,
                rule.m_code_wait.first,
            )
        });
        if rules.len() > MOST {
            self.diagnostics.push(ConfigDiagnostic {
                key: "m_codes".to_owned(),
                message: format!("more than {MOST} rules for M codes"),
                help: Some("give ranges such as M100-M199".to_owned()),
                span: None,
            });
        }
        rules
    }

    /// What ends the wait for a code.
    fn answer(&mut self, key: &str, done: Optional<String>) -> AnswerSource {
        let Some(done) = done else {
            return AnswerSource::Acknowledgement;
        };
        let answer = match done.as_ref().as_str() {
            "nothing" => Some(AnswerSource::Nobody),
            "acknowledge" => Some(AnswerSource::Acknowledgement),
            "spindle-at-speed" => Some(AnswerSource::SpindleAtSpeed),
            "spindle-stopped" => Some(AnswerSource::SpindleStopped),
            "spindle-oriented" => Some(AnswerSource::SpindleOriented),
            "spindle-in-gear" => Some(AnswerSource::SpindleInGear),
            other => input(other),
        };
        if answer.is_none() {
            self.diagnostics.push(ConfigDiagnostic {
                key: key.to_owned(),
                message: format!("{key} = \"{}\" is not known", done.as_ref()),
                help: Some(
                    "give \"acknowledge\", \"spindle-at-speed\", \"spindle-stopped\", \
                     \"spindle-oriented\", \"spindle-in-gear\", \"input 3 high\", \"input 3 low\" or \
                     \"nothing\""
                        .to_owned(),
                ),
                span: Some(done.span()),
            });
        }
        answer.unwrap_or(AnswerSource::Nobody)
    }
}

fn input(text: &str) -> Option<AnswerSource> {
    let (number, level) = text.strip_prefix("input ")?.split_once(' ')?;
    let number = number.parse().ok().filter(|number| *number < 64)?;
    match level {
        "high" => Some(AnswerSource::Input { number, high: true }),
        "low" => Some(AnswerSource::Input {
            number,
            high: false,
        }),
        _ => None,
    }
}

/// The codes of a name such as M428 or M100-M199.
fn codes(name: &str) -> Option<(u32, u32)> {
    let code = |name: &str| {
        let digits = name.strip_prefix('M')?;
        let is_plain = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        let number = digits.parse().ok().filter(|number| *number < 10_000)?;
        is_plain.then_some(number)
    };
    match name.split_once('-') {
        None => Some((code(name)?, code(name)?)),
        Some((first, last)) => {
            let (first, last) = (code(first)?, code(last)?);
            (first <= last).then_some((first, last))
        }
    }
}

fn is_possible(code: u32) -> bool {
    MCodes::is_free(code) || MAY_WAIT.contains(&code)
}
