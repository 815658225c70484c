//! The forecast of a program: how far it is, and how long it takes yet. It is planned beside the
//! machine, since planned time is run time.

mod spectator;
mod stretches;

use super::begins_with::{begin_on_machine, program_start, ratio_begun_with};
use super::changed::{Change, Changed};
use super::fitting::{is_all_that_is_wrong, without_travel};
use super::program_diagnostics::refusal_text;
use super::reading::for_program;
use super::session;
use super::text_lines::TextLines;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::file_error::FileError;
use crate::persistence::read::set_up_as_begun;
use crate::program_file::ProgramFile;
use crate::report::ProgramPlace;
use glidepath_gcode::{Lacking, ReadingWatch};
use glidepath_geometry::AxisVector;
use glidepath_link::Status;
use glidepath_planner::{FileSource, Pipeline, Refusal, Step};
use glidepath_program::Frame;
pub(super) use spectator::Spectator;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use stretches::Stretches;

/// Larger programs are shown without the text of their blocks.
const MOST_TEXT: u64 = 64 << 20;
/// Blocks that are remembered; longer programs are shown without progress.
const MOST_BLOCKS: usize = 4_000_000;

/// Where a block begins.
#[derive(Debug, Clone, Copy)]
struct Begin {
    block: u32,
    line: u32,
    sequence: u64,
    path_s: f64,
}

/// Blocks that the way to a line has at most: three moves, and what spindle, coolant and outputs have to be.
const MOST_WAY: u32 = 64;

/// What a program is planned for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PlannedFor {
    /// To know where a machine is in it. With its fingerprint, where the machine executes it: then it is planned with
    /// what it began with.
    Following(Option<u64>),
    /// To be looked at. Where a machine is in it is not known.
    Preview,
}

/// What is known of the plan so far.
#[derive(Debug, Default)]
struct Plan {
    /// Which program it is, once that is known.
    fingerprint: Option<u64>,
    /// Where blocks begin, if a machine is followed in it.
    begins: Option<Vec<Begin>>,
    /// What its time obeys, if a machine is followed in it.
    stretches: Stretches,
    frames: u64,
    path_s: f64,
    /// The whole program was planned.
    is_whole: bool,
    /// It cannot be planned, or not be remembered.
    has_failed: bool,
}

/// A program that is planned in the background.
pub(super) struct Forecast {
    name: String,
    lines: TextLines,
    period_t: f64,
    begins: AxisVector,
    plan: Arc<Mutex<Plan>>,
    over: Arc<AtomicBool>,
    /// Ends the reading of a program that is not wanted any more.
    watch: ReadingWatch,
    planner: Option<JoinHandle<()>>,
}

impl Forecast {
    /// Begins to plan a program before a spectator.
    pub(super) fn start(
        path: &Path,
        config: &MachineConfig,
        planned_for: PlannedFor,
        spectator: impl Spectator + 'static,
    ) -> Result<Self, Failure> {
        Self::changed(path, config, planned_for, Change::NONE, spectator)
    }

    /// The same with something changed, to see what that would bring.
    pub(super) fn changed(
        path: &Path,
        config: &MachineConfig,
        planned_for: PlannedFor,
        change: Change,
        mut spectator: impl Spectator + 'static,
    ) -> Result<Self, Failure> {
        let size = std::fs::metadata(path)
            .map_err(FileError::open(path))?
            .len();
        let lines = if size <= MOST_TEXT {
            TextLines::of(std::fs::read(path).map_err(FileError::open(path))?)
        } else {
            TextLines::default()
        };
        // Read as the planner does: with what the machine keeps, and has in force.
        let mut machine = for_program(&ProgramFile::named(path), config);
        // What cannot be read is said where the program is begun.
        let begins = begin_on_machine(&mut machine).unwrap_or_default();
        if let (Some(kept), PlannedFor::Following(Some(program))) = (begins.kept, planned_for) {
            // Of one that is not under way any more, what is kept now is all that is known.
            let _known = set_up_as_begun(&mut machine, &kept, program);
        }
        if let PlannedFor::Following(program) = planned_for
            && let Some(start) = program_start(&machine, program)
        {
            machine.program.stands = Some(start);
        }
        if let PlannedFor::Following(program) = planned_for {
            let link = session::link(&session::named_instance(&machine), &machine);
            let ratio = ratio_begun_with(&link, |note| match program {
                Some(program) => note.fingerprint == program,
                None => path.canonicalize().is_ok_and(|path| path == note.file),
            });
            if let Some(ratio) = ratio {
                machine.use_tolerance_ratio(ratio);
            }
        }
        change.machine(&mut machine);
        let watch = ReadingWatch::default();
        machine.program.watch = Some(watch.clone());
        let plan = Plan {
            begins: (planned_for != PlannedFor::Preview).then(Vec::new),
            ..Plan::default()
        };
        let (plan, over) = (Arc::new(Mutex::new(plan)), Arc::<AtomicBool>::default());
        let begins = machine.start();
        let planner = {
            let (path, plan, over) = (path.to_owned(), Arc::clone(&plan), Arc::clone(&over));
            let lines = lines.clone();
            std::thread::spawn(move || {
                spectator.text(&lines);
                let machine = (&machine, change);
                let trouble = work(&path, machine, (&plan, &over), &mut spectator);
                spectator.end(trouble.as_deref());
            })
        };
        Ok(Self {
            name: path.display().to_string(),
            lines,
            period_t: config.period_t(),
            begins,
            plan,
            over,
            watch,
            planner: Some(planner),
        })
    }

    /// Where it begins: where the machine stood.
    pub(super) const fn begins(&self) -> AxisVector {
        self.begins
    }

    /// Lines of its text; none if it is too long.
    pub(super) const fn lines(&self) -> &TextLines {
        &self.lines
    }

    /// Which program it is; `None` while that is not known, and of a file that cannot be read.
    pub(super) fn fingerprint(&self) -> Option<u64> {
        let plan = self.plan.lock().unwrap_or_else(PoisonError::into_inner);
        plan.fingerprint
    }

    /// Frames planned so far.
    pub(super) fn frames(&self) -> u64 {
        let plan = self.plan.lock().unwrap_or_else(PoisonError::into_inner);
        plan.frames
    }

    /// How long it takes, s; `None` while that is not known.
    pub(super) fn planned_t(&self) -> Option<f64> {
        let plan = self.plan.lock().unwrap_or_else(PoisonError::into_inner);
        plan.is_whole.then(|| self.time(plan.frames))
    }

    /// How much of it is planned, s.
    pub(super) fn so_far_t(&self) -> f64 {
        self.time(self.frames())
    }

    #[allow(clippy::cast_precision_loss, reason = "counts of frames are exact")]
    fn time(&self, frames: u64) -> f64 {
        frames as f64 * self.period_t
    }

    /// Whether a machine executes this program, or has executed it last.
    pub(super) fn is_of(&self, status: &Status) -> bool {
        let plan = self.plan.lock().unwrap_or_else(PoisonError::into_inner);
        status.program != 0 && plan.fingerprint == Some(status.program)
    }

    /// Where a machine is in the program; `None` if it executes another one.
    pub(super) fn place(&self, status: &Status) -> Option<ProgramPlace> {
        let line = usize::try_from(status.line).ok()?.checked_sub(1);
        let text = line.and_then(|line| self.lines.get(line));
        let plan = self.plan.lock().unwrap_or_else(PoisonError::into_inner);
        if plan.fingerprint != Some(status.program) {
            return None;
        }
        let now = plan.at(status);
        let whole = plan.is_whole.then_some(plan.frames);
        let time = |frames: u64| self.time(frames);
        Some(ProgramPlace {
            program: self.name.clone(),
            text: text.unwrap_or_default().to_owned(),
            planned_t: whole.map(time),
            elapsed_t: now.map(|at| time(at.sequence)),
            ahead: whole
                .zip(now)
                .map(|(whole, at)| plan.stretches.ahead(at.sequence, whole, self.period_t)),
            is_on_its_way: now.is_some_and(|at| at.is_on_its_way),
            has_failed: plan.has_failed,
        })
    }
}

impl Drop for Forecast {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        self.watch.end();
        // What a planner that failed had to say is said.
        let _ended = self.planner.take().map(JoinHandle::join);
    }
}

/// Plans to the end; tells why it could not.
fn work(
    path: &Path,
    (config, change): (&MachineConfig, Change),
    (plan, over): (&Mutex<Plan>, &AtomicBool),
    spectator: &mut impl Spectator,
) -> Option<String> {
    // What was found is of that text, too.
    let open = |config: &MachineConfig| -> Result<(FileSource, Lacking), Refusal> {
        let options = config.program_options(config.start());
        let looked = FileSource::look(path, options, &config.settings())?;
        let mut plan = plan.lock().unwrap_or_else(PoisonError::into_inner);
        plan.fingerprint = Some(looked.fingerprint).filter(|fingerprint| *fingerprint != 0);
        plan.has_failed = looked.source.is_err();
        Ok((looked.source?, looked.lacks))
    };
    let wide = without_travel(config);
    let ((source, lacks), config, beyond) = match open(config) {
        Ok(opened) => (opened, config, None),
        // Where it goes is to be seen also while its offset is not set yet.
        Err(refusal) if is_of_the_travel(&refusal) => match open(&wide) {
            Ok(opened) => (opened, &wide, Some(refusal_text(&refusal))),
            Err(refusal) => return Some(refusal_text(&refusal)),
        },
        // The planner said what is wrong with it.
        Err(refusal) => return Some(refusal_text(&refusal)),
    };
    spectator.lacks(lacks);
    let changed = Changed { source, change };
    let steps = Pipeline::new(changed, config.settings(), config.start());
    let mut steps = steps.with_joints(config.limited_mechanism());
    while !over.load(Ordering::Relaxed) {
        let step = steps.step();
        let mut plan = plan.lock().unwrap_or_else(PoisonError::into_inner);
        match step {
            Ok(Step::Frame) => {
                plan.take(steps.frame());
                spectator.frame(steps.frame());
            }
            Ok(Step::Item) => spectator.item(steps.item()),
            Ok(Step::Pending) => {}
            Ok(Step::End) => {
                plan.is_whole = !plan.has_failed;
                return beyond;
            }
            Err(refusal) => {
                plan.has_failed = true;
                return Some(refusal_text(&refusal));
            }
        }
        if plan.has_failed {
            return Some("it has too many blocks".to_owned());
        }
    }
    Some("interrupted".to_owned())
}

/// Whether a program is refused for nothing but where it goes.
fn is_of_the_travel(refusal: &Refusal) -> bool {
    matches!(refusal, Refusal::Program { diagnostics, .. } if is_all_that_is_wrong(diagnostics))
}

impl Plan {
    fn take(&mut self, frame: &Frame) {
        self.frames = frame.sequence + 1;
        self.path_s = frame.path_s;
        let Some(begins) = &mut self.begins else {
            return;
        };
        let last = begins.last();
        if last.is_none_or(|last| last.block != frame.block) {
            begins.push(Begin {
                block: frame.block,
                line: frame.line,
                sequence: frame.sequence,
                path_s: frame.path_s,
            });
        }
        self.stretches.take(frame);
        self.has_failed = begins.len().max(self.stretches.count()) > MOST_BLOCKS;
    }

    /// The place in the plan of what is executed: by the block and the part of its path that is done, so
    /// that it holds under overrides and after a program was gone on with. On the way to a line that the program
    /// begins with it is the beginning of that line: the way is of no plan.
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "counts of frames are exact, and a part of them is below"
    )]
    fn at(&self, status: &Status) -> Option<At> {
        let begins = self.begins.as_ref()?;
        let at = begins.partition_point(|begin| begin.block <= status.block);
        let begin = begins.get(at.checked_sub(1)?)?;
        if let Some(ahead) = line_ahead(begin, begins.get(at..)?, status) {
            return Some(At {
                sequence: ahead.sequence,
                is_on_its_way: true,
            });
        }
        // Behind the way to a line near the beginning, which has more blocks than there are in front of that line, blocks
        // have higher numbers than in the plan.
        let mut back = begins.get(..at)?.iter().rev().take(MOST_WAY as usize);
        let back = back.position(|begin| begin.line == status.line);
        let at = at - back.unwrap_or(0);
        let begin = begins.get(at.checked_sub(1)?)?;
        let (end, end_s) = match begins.get(at) {
            Some(next) => (next.sequence, next.path_s),
            None => (self.frames, self.path_s),
        };
        let way = end_s - begin.path_s;
        let done = status.path_s - status.block_path_s;
        let part = if way > 0.0 {
            (done / way).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let frames = end.saturating_sub(begin.sequence) as f64 * part;
        Some(At {
            sequence: begin.sequence + frames as u64,
            is_on_its_way: false,
        })
    }
}

/// A place in the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct At {
    sequence: u64,
    /// The machine is on its way there.
    is_on_its_way: bool,
}

/// Where the line begins to which the machine is on its way. Such a way is executed under that line, and under the
/// numbers of the blocks in front of it, which are those of other lines.
fn line_ahead<'b>(begin: &Begin, ahead: &'b [Begin], status: &Status) -> Option<&'b Begin> {
    if status.line == 0 || begin.line == status.line {
        return None;
    }
    let near = ahead
        .iter()
        .take_while(|next| next.block - status.block <= MOST_WAY);
    near.into_iter().find(|next| next.line == status.line)
}

#[cfg(test)]
mod tests;
