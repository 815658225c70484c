//! What a job that ended before its end has left in force.

use glidepath_gcode::InForce;
use glidepath_link::{Auxiliary, SpindleState};
use glidepath_planner::{Control, FramePublisher, ItemSource as _, ProgramSource, Refusal, Supply};
use glidepath_program::{Event, ItemKind};
use std::io::BufRead;

/// What is in force on a machine whose spindle and coolant are as it tells: an abort, a fault and the loss of power stop
/// both, whatever the last program has left.
pub(super) fn as_machine_tells(in_force: &InForce, told: &Auxiliary) -> InForce {
    let stands = told.spindle() == Ok(SpindleState::Stopped);
    in_force.with_stopped(stands, told.coolant == 0)
}

/// Where a job ended, and what is known of the machine there.
#[derive(Debug, Clone, Copy)]
pub(super) struct JobLeft {
    /// The block that was executed last.
    block: u32,
    /// The event of that block was not answered.
    unanswered: bool,
    /// The tool in the spindle, if that is known.
    tool: Option<u32>,
}

impl JobLeft {
    /// Asks the interpolator.
    pub(super) fn of(publisher: &FramePublisher<'_>, control: &mut Control<'_>) -> Self {
        let lives = publisher.position().is_some();
        let record = lives.then(|| publisher.auxiliary(control).ok()).flatten();
        Self {
            block: publisher.block(),
            unanswered: publisher.resume_point().is_ok_and(|it| it.unanswered),
            tool: record.map(|record| record.tool),
        }
    }

    /// What is in force behind the blocks that were executed. The source is at its beginning.
    ///
    /// # Errors
    /// Why it cannot be read up to there.
    pub(super) fn read<R: BufRead>(
        &self,
        mut source: ProgramSource<R>,
    ) -> Result<InForce, Refusal> {
        let began = source.in_force().tool();
        let (mut last, mut line) = (None, 0);
        for _ in 0..self.block {
            match source.next_item() {
                Supply::Item(item) => (last, line) = (Some(item.kind), item.line),
                Supply::Refused(error) => return Err(error),
                // What follows depends on an answer that is not kept.
                Supply::Pending | Supply::Probe => return Err(Refusal::AnswerUnknown { line }),
                Supply::End => break,
            }
        }
        let in_force = source.in_force();
        let changes_tool = matches!(
            last,
            Some(ItemKind::Event(Event::MCode(6) | Event::Await(6)))
        );
        if self.unanswered && changes_tool {
            return Ok(in_force.before_tool_change());
        }
        Ok(self.with_its_tool(in_force, began))
    }

    /// What is in force, for the tool that is in the spindle: blocks are read as a whole, so a change that
    /// was not done yet may be in it. `began`: the tool that the job began with.
    pub(super) fn with_its_tool(&self, in_force: InForce, began: u32) -> InForce {
        let before = in_force.before_tool_change();
        let is_changed = in_force.tool() != began && self.tool != Some(in_force.tool());
        if is_changed && self.tool == Some(before.tool()) {
            before
        } else {
            in_force
        }
    }
}
