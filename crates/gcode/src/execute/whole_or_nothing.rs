//! A block has its whole effect, or none.
//!
//! All that a block may change is the [`State`](crate::execute::state::program_state::State) of the interpreter. A
//! copy of it is made in front of a block, and comes in its place where the block is refused: there is no list of
//! parts that one could be missing in. What is added to the state is given back without a word about it here.
//!
//! The copy has to be cheap, since nearly no block is refused:
//!
//! * Modes, places and what is open are copied: some hundred numbers.
//! * Offsets, saved states and the places of a printer are [`Shared`](crate::execute::state::shared::Shared) with the
//!   copy until a block changes them, and so is the tool table. A log of changes would be cheaper still, but every
//!   place that changes something would have to write it.
//! * The control points of a NURBS, of which there may be a hundred thousand, are a log of their own, of which the
//!   state has the length ([`SplineLog`](crate::execute::state::open_spline::SplineLog)).
//! * Plain straight moves, which nearly all lines of a long program are, need no copy: all that may be refused
//!   about one is looked at before anything is changed ([`plain_move`](crate::execute::motion::plain_move)).
//!
//! Parameters are none of the state. They are assigned behind the block, when it was not refused.

use std::io::BufRead;
use std::sync::Arc;

use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::interpreter::Interpreter;
use crate::execute::program::Program;
use crate::execute::state::program_state::State;

/// What was there before something that may be refused.
struct Before {
    state: State,
    /// Items that were given out.
    given: usize,
}

impl Before {
    fn of(interpreter: &Interpreter, out: &[Item]) -> Self {
        Self {
            state: interpreter.state.clone(),
            given: out.len(),
        }
    }
}

impl<R: BufRead> Program<R> {
    /// The same of a line that is more than a block, with what it assigns.
    pub(crate) fn whole_statement<T>(
        &mut self,
        act: impl FnOnce(&mut Self) -> Outcome<T>,
    ) -> Outcome<T> {
        let before = Before::of(&self.interpreter, &self.items);
        let variables = self.siemens.variables.clone();
        self.parameters.begin_log();
        let result = act(self);
        let is_done = result.is_ok();
        self.interpreter.settle(before, is_done, &mut self.items);
        self.parameters.end_log(is_done);
        if !is_done {
            self.siemens.variables = variables;
        }
        result
    }
}

impl Interpreter {
    /// Does what may be refused: then the state is the one from before, and nothing was added to `out`.
    pub(crate) fn whole_or_nothing<T>(
        &mut self,
        out: &mut Vec<Item>,
        act: impl FnOnce(&mut Self, &mut Vec<Item>) -> Outcome<T>,
    ) -> Outcome<T> {
        let before = Before::of(self, out);
        let result = act(self, out);
        self.settle(before, result.is_ok(), out);
        result
    }

    /// Keeps what was done, or takes it back.
    fn settle(&mut self, before: Before, is_done: bool, out: &mut Vec<Item>) {
        if is_done {
            self.count_changes(&before.state);
        } else {
            self.state = before.state;
            out.truncate(before.given);
        }
    }

    /// Counts what changed coordinate systems, reference positions, the offset of G92 or tools.
    fn count_changes(&mut self, before: &State) {
        let state = &mut self.state;
        let has_same_tools = match (&before.tools, &state.tools) {
            // A tool table that was changed is another one.
            (Some(before), Some(now)) => Arc::ptr_eq(before, now),
            (before, now) => before.is_some() == now.is_some(),
        };
        let has_same_offsets = state.offsets.is_same(&before.offsets)
            || state.offsets.set_up() == before.offsets.set_up();
        let is_counted = state.changes != before.changes;
        if !(is_counted || has_same_tools && has_same_offsets) {
            state.changes = state.changes.saturating_add(1);
        }
    }
}

#[cfg(test)]
mod tests;
