//! The source of a program's items.
//!
//! A source hands over one [`Item`] at a time, in program order, and says when there is none *yet*
//! ([`Supply::Pending`]) as opposed to none *ever again* ([`Supply::End`]). What is planned
//! depends on the sequence of items alone, never on how often a source was pending: the same
//! program from a file, a pipe or a client of the listening planner gives the same frames.
//!
//! With one exception, so that what has arrived moves: a source that has been silent for [`SILENCE`]
//! ([`ItemSource::is_silent`]) while no planned motion is left to be published has the motion come to
//! rest at the end of what there is, as by an exact stop. What comes afterwards goes on from there.

use std::time::Duration;

use glidepath_motion::PlanError;
use glidepath_program::Item;

use crate::run::refusal::Refusal;
use crate::source::input_arbiter::InputResult;

/// How long nothing comes of a program before the motion rests at the end of what has come, if there
/// is no more of it to publish.
pub const SILENCE: Duration = Duration::from_millis(50);

/// The answer of a source that is asked for the next item.
#[allow(clippy::large_enum_variant, reason = "nearly every supply is an item")]
#[derive(Debug)]
pub enum Supply {
    /// The next item of the program.
    Item(Item),
    /// Nothing now; ask again later.
    Pending,
    /// What was handed over last moves until a probe finds something: there is more only when it is
    /// known how that ended. The machine comes to rest in between.
    Probe,
    /// The program is complete.
    End,
    /// The program is at fault from here on, or the supply broke off. The items handed over before
    /// stand; there are no more.
    Refused(Refusal),
}

/// The state of what an item asks of inputs or the probe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Settled {
    /// It asks nothing.
    Nothing,
    /// It was answered.
    Answered(InputResult),
    /// It is asked when the next item is wanted.
    Open,
}

/// A supply of items. After [`Supply::End`] or [`Supply::Refused`] it is not asked again.
pub trait ItemSource {
    /// The next item, if there is one.
    fn next_item(&mut self) -> Supply;

    /// Whether nothing has come for [`SILENCE`], of a source that is pending because it waits for
    /// somebody else. Sources that only take long to read are not silent.
    fn is_silent(&mut self) -> bool {
        false
    }

    /// The item handed over last cannot be planned; no more are asked for.
    fn unplannable(&mut self, error: &PlanError) {
        let _ = error;
    }

    /// Has what the item handed over last asks answered, before the next one is wanted: as it was
    /// answered when the program came here before, or, if that is not known, by `known`.
    ///
    /// # Errors
    /// Something else was answered before, the answer ends the program, or it cannot be kept.
    fn settle(&mut self, known: Option<InputResult>) -> Result<Settled, Refusal> {
        let _ = known;
        Ok(Settled::Nothing)
    }

    /// Lines of program text read so far; for a source without text, items received.
    fn lines_read(&self) -> u64;

    /// Identifies the text of the program, 0 if it cannot be read again.
    fn fingerprint(&self) -> u64 {
        0
    }

    /// Whether the item handed over last is on a contour beside the tool (G41, G42), which cannot
    /// be begun in its middle.
    fn is_on_contour(&self) -> bool {
        false
    }
}
