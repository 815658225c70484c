//! The stop of reading at a probing move, until it is known how the move ended.

use std::io::BufRead;

use crate::diagnostic::Diagnostic;
use crate::execute::program::Program;
use crate::execute::state::probe_result::Probed;

impl<R: BufRead> Program<R> {
    /// True if everything up to a probing move was given out, and nothing more is to be read before
    /// [`Program::answer_probe`] says how that ended. Only of a machine whose probe is
    /// [real](crate::Connections::Real).
    #[must_use]
    pub fn is_at_probe(&self) -> bool {
        self.interpreter.state.search.is_some() && self.given >= self.items.len()
    }

    /// Says how the probing move ended that was given out last.
    ///
    /// # Errors
    /// It did not find what it had to.
    pub fn answer_probe(&mut self, probed: &Probed) -> Result<(), Box<Diagnostic>> {
        let Some(search) = self.interpreter.state.search.take() else {
            return Ok(());
        };
        let ended = self.interpreter.end_search(search, probed);
        ended.map_err(|fault| {
            self.end();
            Box::new(self.here().diagnostic(*fault))
        })
    }
}
