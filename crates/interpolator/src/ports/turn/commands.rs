//! The commands of other processes: answered, and told to whoever reads the status.

use super::Ports;
use crate::ports::commands::{CommandContext, is_refusal, passes_stop};
use crate::ports::told_by_hand;
use glidepath_link::{Command, LinkError};

/// Commands served in one turn.
const COMMANDS_PER_TURN: usize = 8;

impl Ports<'_> {
    pub(super) fn serve_commands(&mut self, now_ns: u64) -> Result<(), LinkError> {
        let Some(report) = self.report else {
            return Ok(());
        };
        let number = Some(report.setpoint.number);
        let is_ordered = self.ordered_after == number || self.demanded_after == number;
        let mut desk = CommandContext {
            report,
            boot_id: self.boot_id,
            now_ns,
            drives: self.drives.as_mut(),
            acknowledgements: &mut self.acknowledgements,
            jobs: &mut self.jobs,
            frame_validator: &mut self.frame_validator,
            ends: &mut self.ends,
            spindle_override: self.spindle_override,
            is_ordered,
        };
        let (book, log) = (&mut self.book, &mut self.log);
        let auxiliary = &mut self.auxiliary;
        for _ in 0..COMMANDS_PER_TURN {
            let served = self.links.commands.serve(&mut |request| {
                let reply = desk.answer(request);
                let text = request.text.as_str();
                let command = request.command().ok().map(|command| desk.meant(command));
                let why = desk.why_it_ends(request);
                let by_hand = told_by_hand::of_command(desk.report.state, command, why);
                let has_failed = matches!(command, Some(Command::Acknowledge { done: false, .. }));
                if command == Some(Command::Tell) {
                    log(text);
                    book.message(text);
                } else if has_failed && !is_refusal(&reply) && !text.is_empty() {
                    log(text);
                    book.last_error(text);
                    self.failure_is_explained = true;
                } else if let Some(text) = by_hand.filter(|_| !is_refusal(&reply)) {
                    book.last_error(text);
                } else if passes_stop(desk.report.state, command) && !is_refusal(&reply) {
                    // Whoever lets it pass has read what the program said there.
                    book.message("");
                } else if matches!(command, Some(Command::Job { .. })) {
                    // Its planner waits for that.
                    self.status_due_ns = 0;
                }
                if let Some(Command::SpindleOverride(ratio)) = command
                    && !is_refusal(&reply)
                {
                    auxiliary.set_spindle_override(ratio);
                }
                book.status.commands_served += 1;
                book.status.commands_refused += u64::from(is_refusal(&reply));
                reply
            })?;
            if !served {
                break;
            }
        }
        if desk.is_ordered {
            self.ordered_after = number;
        }
        Ok(())
    }
}
