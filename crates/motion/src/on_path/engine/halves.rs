//! The engine in two halves: what settles the motion, and what samples it.
//!
//! The first takes nearly all of the work and begins anew at every rest of the program; the second
//! counts frames and path position from the start of the program to its end. So the first halves of
//! several engines may work at once, each on its part of a program, with one second half behind all
//! of them.

use super::OnPathEngine;
use crate::on_path::look_ahead::Settled;
use std::collections::VecDeque;

impl OnPathEngine {
    /// Takes away what is settled and was not sampled.
    pub(crate) fn take_settled(&mut self) -> VecDeque<Settled> {
        core::mem::take(&mut self.settled)
    }

    /// Takes in motion that another engine settled, to be sampled behind what is here.
    pub(crate) fn add_settled(&mut self, settled: VecDeque<Settled>) {
        self.settled.extend(settled);
    }
}
