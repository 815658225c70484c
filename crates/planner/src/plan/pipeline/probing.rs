//! The end of a plan at a probing move, and the way on behind it.

use glidepath_geometry::AxisVector;

use super::Pipeline;
use crate::run::refusal::Refusal;
use crate::source::item_source::{ItemSource, Supply};

impl<S: ItemSource> Pipeline<S> {
    /// Whether what was planned ends with a probing move, after which the program goes on. One that
    /// the probe has ended may have been planned in part only.
    ///
    /// # Errors
    /// Nobody may answer what the probe found.
    pub(crate) fn comes_to_probe(&mut self, is_tripped: bool) -> Result<bool, Refusal> {
        // What is left out is counted, so that blocks are those of a program that is read again.
        let known = self.history.as_ref();
        while let Some(kept) = known.and_then(|known| known.item_after(self.planning.items())) {
            if kept.is_aside {
                self.planning.pass_aside();
            } else {
                self.planning.pass();
            }
        }
        while is_tripped && !self.is_at_probe && !self.is_exhausted {
            match self.source.next_item() {
                Supply::Item(_) => self.planning.pass(),
                Supply::Pending => std::thread::yield_now(),
                Supply::Probe => self.is_at_probe = true,
                Supply::End => self.is_exhausted = true,
                Supply::Refused(refusal) => return Err(refusal),
            }
        }
        Ok(self.is_at_probe)
    }

    /// Goes on behind a probing move, from where the machine came to rest: `position` (mm, degrees)
    /// and `path_s` (mm).
    pub(crate) fn go_on_from(&mut self, position: AxisVector, path_s: f64) {
        self.frames_before += self.planning.frames();
        self.planning = self.planning.behind(self.settings, position, path_s);
        (self.is_exhausted, self.is_at_probe) = (false, false);
        self.goes_on = false;
        self.history = None;
    }
}
