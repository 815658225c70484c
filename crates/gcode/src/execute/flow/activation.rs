//! The activations of a program's parts: which kept parts are being executed, and how far.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::execute::flow::kept_lines::KeptLines;
use crate::execute::flow::recorder::Recorder;
use crate::syntax::o_word::Label;

/// Deepest nesting of subroutine calls.
pub(crate) const MAX_CALLS: usize = 64;

/// A part being executed.
#[derive(Debug)]
pub(crate) struct Activation {
    pub(crate) part: Arc<KeptLines>,
    /// The line to execute next.
    pub(crate) next: usize,
    /// True for a subroutine.
    pub(crate) is_call: bool,
    /// The line of the program that calls it.
    pub(crate) called_from: u32,
    /// `repeat` lines in progress, with the turns still to come.
    pub(crate) repeats: Vec<(usize, u32)>,
}

impl Activation {
    /// A structure of the program.
    pub(crate) const fn structure(part: Arc<KeptLines>) -> Self {
        Self {
            part,
            next: 0,
            is_call: false,
            called_from: 0,
            repeats: Vec::new(),
        }
    }

    /// A subroutine, and the line of the program that calls it.
    pub(crate) fn call(part: Arc<KeptLines>, called_from: u32) -> Self {
        Self {
            is_call: true,
            called_from,
            ..Self::structure(part)
        }
    }

    /// Forgets the counters of the loop that starts at `start`, and of those inside it.
    pub(crate) fn leave_loop(&mut self, start: usize) {
        self.repeats.retain(|(first, _)| *first < start);
    }

    /// Forgets the counters of the loops inside the one that starts at `start`.
    pub(crate) fn leave_inner_loops(&mut self, start: usize) {
        self.repeats.retain(|(first, _)| *first <= start);
    }
}

/// The kept parts of a program, and the activations of them.
#[derive(Debug, Default)]
pub(crate) struct Flow {
    pub(crate) subroutines: BTreeMap<Label, Arc<KeptLines>>,
    pub(crate) activations: Vec<Activation>,
    pub(crate) recorder: Option<Recorder>,
    /// Bytes of all subroutines kept.
    pub(crate) kept: usize,
}

impl Flow {
    /// Takes up a part that was recorded to its end.
    pub(crate) fn take_up(&mut self, recorder: Recorder) {
        let (label, part, bytes) = recorder.finish();
        match label {
            Some(label) => {
                self.kept += bytes;
                self.subroutines.insert(label, part);
            }
            None => self.activations.push(Activation::structure(part)),
        }
    }

    /// The next kept line to execute, if any is in progress.
    #[inline]
    pub(crate) fn next_line(&mut self) -> Option<(Arc<KeptLines>, usize)> {
        loop {
            let activation = self.activations.last_mut()?;
            if activation.next < activation.part.lines.len() {
                let index = activation.next;
                activation.next += 1;
                return Some((Arc::clone(&activation.part), index));
            }
            // A subroutine ends with its `endsub`, which has taken its activation away.
            self.activations.pop();
        }
    }

    /// Ends the innermost call; false if there is none.
    pub(crate) fn end_call(&mut self) -> bool {
        while let Some(activation) = self.activations.pop() {
            if activation.is_call {
                return true;
            }
        }
        false
    }
}
