//! The arguments of a call of a cycle, and the levels that all cycles have.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::steps::CycleCall;
use crate::syntax::word_check::missing;

/// The arguments of a call, and where it stands.
#[derive(Clone, Copy)]
pub(super) struct Arguments<'a> {
    pub(super) call: &'a CycleCall,
    pub(super) span: SourceSpan,
}

/// The levels all cycles have, in the units in force.
#[derive(Debug, Clone, Copy)]
pub(super) struct Levels {
    /// Where to retract to.
    pub(super) retract: f64,
    /// The surface.
    pub(super) surface: f64,
    /// Where rapid moves downwards end.
    pub(super) clear: f64,
    /// The bottom.
    pub(super) bottom: f64,
}

impl Arguments<'_> {
    /// An argument, counted from zero.
    pub(super) fn get(&self, index: usize) -> Option<f64> {
        self.call.arguments.get(index).copied().flatten()
    }

    /// An argument that is zero where it is left out.
    pub(super) fn or_zero(&self, index: usize) -> f64 {
        self.get(index).unwrap_or(0.0)
    }

    /// An argument that has to be there.
    pub(super) fn need(&self, index: usize, name: &str, meaning: &str) -> Outcome<f64> {
        self.get(index)
            .ok_or_else(|| missing(self.span, self.call.name, name, meaning))
    }

    /// An argument that has to be above zero.
    pub(super) fn positive(&self, index: usize, name: &str, meaning: &str) -> Outcome<f64> {
        let value = self.need(index, name, meaning)?;
        if value > 0.0 {
            return Ok(value);
        }
        Err(self
            .refused(format!("{name} is {value}"), meaning)
            .help("write a value above zero"))
    }

    /// An argument that may not be below zero.
    pub(super) fn not_negative(&self, index: usize, name: &str, meaning: &str) -> Outcome<f64> {
        let value = self.or_zero(index);
        if value >= 0.0 {
            return Ok(value);
        }
        Err(self
            .refused(format!("{name} is {value}"), meaning)
            .help("write zero or more"))
    }

    /// An argument that chooses among whole numbers.
    pub(super) fn choice(&self, index: usize, name: &str, known: &[i32]) -> Outcome<i32> {
        let value = self.or_zero(index);
        let is_it = |choice: &&i32| (f64::from(**choice) - value).abs() < 1e-9;
        let found = known.iter().find(is_it);
        found.copied().ok_or_else(|| {
            let list: Vec<String> = known.iter().map(i32::to_string).collect();
            self.refused(
                format!("{name} {value} is not covered"),
                "other ways are not made here",
            )
            .help(format!("use one of: {}", list.join(", ")))
        })
    }

    pub(super) fn refused(&self, message: impl Into<String>, reason: &str) -> Box<BlockDiagnostic> {
        let message = format!("{}: {}", self.call.name, message.into());
        BlockDiagnostic::new(DiagnosticCode::CannedCycle, self.span, message).because(reason)
    }

    /// The levels: RTP, RFP, SDIS, DP, and DPR if the cycle has one. An argument that is left out is zero on the
    /// control, so a DPR of zero says nothing; one that does decides where DP says another depth.
    pub(super) fn levels(&self, relative: Option<f64>) -> Outcome<Levels> {
        let retract = self.need(0, "RTP", "the plane to retract to")?;
        let surface = self.need(1, "RFP", "the surface")?;
        let clearance = self.not_negative(2, "SDIS", "the clearance above the surface")?;
        let relative = relative.filter(|depth| *depth != 0.0);
        let bottom = match relative {
            Some(depth) => surface - depth.abs(),
            None => self.need(3, "DP", "the bottom, or the depth DPR")?,
        };
        // Alarm 61101.
        let is_low = match relative {
            Some(_) => retract <= surface,
            None => retract < surface,
        };
        if is_low || bottom >= surface {
            let message = format!(
                "the planes are not in order: RTP {retract}, RFP {surface}, the bottom {bottom}"
            );
            return Err(self
                .refused(
                    message,
                    "RTP is above RFP (or as high, where DP is the depth), and the bottom below it",
                )
                .help("check RTP, RFP, DP and DPR"));
        }
        Ok(Levels {
            retract,
            surface,
            clear: surface + clearance,
            bottom,
        })
    }
}
