//! Lines: one or some of an operator, and those of senders as they come.

use std::io::Cursor;

use glidepath_gcode::{InForce, Options, Program};
use glidepath_geometry::AxisVector;
use glidepath_planner::{LineInbox, Pipeline, ProgramSource, Refusal, SentLines};

use super::run_context::RunContext;
use super::state::{JobExecutor, of_sender, unwatched};
use super::stop::{End, Stop, refusal};
use crate::command::left_in_force::JobLeft;
use crate::command::run_supervisor::recalling;
use crate::config::MachineConfig;
use crate::report::{counted, driven};

/// The line or lines of an operator as a program.
type LineSource = ProgramSource<Cursor<Vec<u8>>>;

impl JobExecutor<'_> {
    /// Lines, as they come: what was read is executed, and what it left is in force.
    pub(super) fn lines(
        &mut self,
        inbox: &LineInbox,
        start: AxisVector,
        context: &mut RunContext<'_, '_, '_>,
    ) -> End {
        let (config, supervisor) = self.set_up(1.0, context.publisher, context.control)?;
        let config = of_sender(config);
        self.board.clear();
        let options = Options {
            stops_at_m1: false,
            ..config.program_options(start)
        };
        let source = SentLines::new(inbox.clone(), options, supervisor.channels());
        let pipeline = Pipeline::new(source, config.settings(), start).of_stream();
        let (run, in_force) = context.publish(pipeline, (&config, &supervisor), start, |s| {
            Some(s.in_force())
        });
        // Where the motion ended before the lines did, what its executed part has left.
        let left = in_force.or_else(|| {
            if !supervisor.has_begun(context.publisher) {
                return None;
            }
            let ended = JobLeft::of(context.publisher, context.control);
            let in_force = inbox.in_force_at(context.publisher.block())?;
            let began = self.in_force.as_ref().map_or(0, InForce::tool);
            Some(ended.with_its_tool(in_force, began))
        });
        self.in_force = left.or_else(|| self.in_force.take());
        let statistics = run?;
        Ok(format!(
            "executed; {}, {}",
            counted(statistics.lines, "line"),
            driven(statistics.segments)
        ))
    }

    /// A line: refused as a whole, or executed, and then what it left is in force.
    pub(super) fn line(
        &mut self,
        text: &str,
        start: AxisVector,
        context: &mut RunContext<'_, '_, '_>,
    ) -> End {
        if text.contains(['\n', '\r']) {
            return Err(Stop::Refused("give one line at a time".to_owned()));
        }
        self.typed(text, |config| config, start, context)
    }

    /// Lines that belong together: judged before the first, and one job to its end. The first that fails is the last.
    /// They are those of a page, and say the same whatever dialect programs are in.
    pub(super) fn sequence(
        &mut self,
        text: &str,
        start: AxisVector,
        context: &mut RunContext<'_, '_, '_>,
    ) -> End {
        self.typed(text, of_sender, start, context)
    }

    fn typed(
        &mut self,
        text: &str,
        read_as: fn(MachineConfig) -> MachineConfig,
        start: AxisVector,
        context: &mut RunContext<'_, '_, '_>,
    ) -> End {
        let (config, supervisor) = self.set_up(1.0, context.publisher, context.control)?;
        let config = read_as(config);
        let text = format!("{text}\n").into_bytes();
        let options = || config.program_options(start);
        let judge = || Program::new(text.as_slice(), options()).find_map(Result::err);
        if let Some(diagnostic) = context.work("checking", judge)? {
            return Err(refusal(&Refusal::Program {
                diagnostics: vec![diagnostic],
                unlisted: 0,
            }));
        }
        self.board.clear();
        let source = |options| LineSource::new(Cursor::new(text.clone()), options);
        let attended = source(options()).attended(supervisor.channels());
        self.keep_resume_point(context.publisher);
        let pipeline = Pipeline::new(attended, config.settings(), start);
        let (mut run, in_force) = context.publish(pipeline, (&config, &supervisor), start, |p| {
            Some(p.in_force())
        });
        self.commit_state(&mut run, in_force, context, &supervisor, || {
            let options = unwatched(&config).program_options(start);
            Ok(Some(source(options).attended(recalling(&config, 0))))
        });
        let statistics = run?;
        Ok(format!(
            "executed; {}{}",
            driven(statistics.segments),
            self.lost_later(&config)
        ))
    }

    /// What is to be known of a line that has set the machine up, where nothing is kept over a restart.
    fn lost_later(&self, before: &MachineConfig) -> &'static str {
        let now = self
            .in_force
            .as_ref()
            .filter(|_| before.state_directory.is_none());
        let has_set_up = now.is_some_and(|now| {
            let (was, is) = (&before.program.offsets, now.work_offsets());
            let offsets = (&is.systems, &is.reference, &is.saved_shift);
            offsets != (&was.systems, &was.reference, &was.saved_shift)
                || now.tools() != before.program.tools.as_ref()
        });
        if has_set_up {
            "; what it has set up is lost when the planner ends, because [state] names no directory"
        } else {
            ""
        }
    }
}
