//! Planning again from an earlier frame, for a caller that is ahead of the machine.

use glidepath_program::Override;

use super::Pipeline;
use crate::plan::history::History;
use crate::plan::step::Step;
use crate::run::refusal::Refusal;
use crate::source::item_source::ItemSource;

impl<S: ItemSource> Pipeline<S> {
    /// From now on keeps what [`Pipeline::replan`] needs.
    pub(crate) fn keep_history(&mut self) {
        self.history = Some(History::new(&self.planning, self.settings.period_t));
    }

    /// Forgets what is needed to go back to where fewer frames than these were made.
    pub(crate) fn forget_before(&mut self, frames: u64) {
        if let Some(history) = &mut self.history {
            history.forget_before(frames);
        }
    }

    /// True if the history is long enough.
    pub(crate) fn remembers_enough(&self) -> bool {
        self.history.as_ref().is_some_and(History::is_full)
    }

    /// Goes back to where so many frames were made, and plans what follows with this override. An
    /// error that was told meanwhile is told again in its place. Needs the history from there on.
    pub(crate) fn replan(&mut self, frames: u64, wanted: Override, told: Option<Refusal>) {
        // An error of the planner may not come again; if it does, it comes by itself.
        let told = told.filter(|refusal| !refusal.leaves_motion_open());
        self.refusal = self.refusal.take().or(told);
        self.timed(|pipeline| {
            let Some(history) = &mut pipeline.history else {
                return;
            };
            pipeline.planning = history.back_to(frames);
            while pipeline.planning.frames() < frames {
                // All of this went well before.
                if matches!(pipeline.go_on(), Ok(Step::End) | Err(_)) {
                    break;
                }
            }
            if let Some(history) = &mut pipeline.history {
                history.mark_override(&pipeline.planning, wanted);
            }
            pipeline.planning.follow_override(wanted);
        });
    }
}
