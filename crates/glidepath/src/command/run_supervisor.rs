//! The run supervisor, the work of a planner besides planning: it tells how far it has come, and
//! keeps what the programs it has executed leave behind.

use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::output;
use crate::persistence::input_log::Journal;
use crate::persistence::state_store::StateStore;
use crate::position_offsets_note::PositionOffsetsNote;
use crate::report::driven;
use glidepath_gcode::{Connections, PositionOffsets};
use glidepath_geometry::AxisVector;
use glidepath_planner::{
    FramePublisher, InputArbiter, Notice, PositionOffsetsLog, RemarkLog, ResumeError, RunChannels,
    RunError, Statistics,
};
use std::cell::{Cell, RefCell};
use std::path::PathBuf;

/// Supervises the run of one program.
#[derive(Debug)]
pub(super) struct RunSupervisor {
    quiet: bool,
    /// The epoch of which a frame was delivered first.
    first_epoch: Cell<Option<u64>>,
    /// Nobody answered any more when the motion ended.
    lost: Cell<bool>,
    state_store: RefCell<Option<StateStore>>,
    position_offsets: PositionOffsetsLog,
    /// Where the offsets in force are noted.
    note: PositionOffsetsNote,
    remarks: RemarkLog,
    inputs: InputArbiter,
}

impl RunSupervisor {
    /// Puts what is kept into the configuration, if the machine keeps anything. `directory`: that of the
    /// instance.
    ///
    /// # Errors
    /// What is kept cannot be used.
    pub(super) fn new(
        config: &mut MachineConfig,
        directory: PathBuf,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let opened = StateStore::open(config)?;
        let state_store = opened.map(|(state_store, notes)| {
            notes
                .iter()
                .filter(|_| !quiet)
                .for_each(|note| output::note(note));
            state_store
        });
        Ok(Self {
            quiet,
            first_epoch: Cell::new(None),
            lost: Cell::new(false),
            state_store: RefCell::new(state_store),
            position_offsets: PositionOffsetsLog::default(),
            note: PositionOffsetsNote::new(directory),
            remarks: RemarkLog::default(),
            inputs: InputArbiter::default(),
        })
    }

    pub(super) const fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// What the source of the program shares with this.
    pub(super) fn channels(&self) -> RunChannels {
        RunChannels {
            changes: self.state_store.borrow().as_ref().map(StateStore::log),
            position_offsets: Some(self.position_offsets.clone()),
            remarks: Some(self.remarks.clone()),
            inputs: Some(self.inputs.clone()),
        }
    }

    /// Has the publisher tell what the program says, and answer what it asks of inputs, where they
    /// are the machine's.
    ///
    /// # Errors
    /// Feedback cannot be received.
    pub(super) fn attach(
        &self,
        publisher: &mut FramePublisher<'_>,
        config: &MachineConfig,
    ) -> Result<(), Failure> {
        publisher.attend_remarks(self.remarks.clone());
        if config.program.connections == Connections::Real {
            publisher.attend_inputs(self.inputs.clone())?;
        }
        Ok(())
    }

    /// Whether a frame was delivered.
    pub(super) fn has_started(&self) -> bool {
        self.first_epoch.get().is_some()
    }

    /// Whether the machine came into the program: what it says of blocks and of its end is of this one. A frame
    /// that was delivered may have been too late for that.
    pub(super) fn has_begun(&self, publisher: &FramePublisher<'_>) -> bool {
        let first = self.first_epoch.get();
        first
            .zip(publisher.epoch())
            .is_some_and(|(first, now)| now >= first)
    }

    /// Whether nobody knows any more how far the machine came in the program: its interpolator ended in it, or does
    /// not answer.
    pub(super) fn is_lost(&self) -> bool {
        self.has_started() && self.lost.get()
    }

    /// Whether what programs leave behind is kept in files.
    pub(super) fn keeps(&self) -> bool {
        self.state_store.borrow().is_some()
    }

    /// The program begins with a block: what it says before is not said.
    ///
    /// # Errors
    /// As [`RunSupervisor::begin_here`].
    pub(super) fn begin_with(&self, block: u32) -> Result<(), Failure> {
        self.remarks.begin_with(block);
        self.begin_here()
    }

    /// The program is read up to where it is to begin: what it asks behind is asked anew.
    ///
    /// # Errors
    /// That cannot be written.
    pub(super) fn begin_here(&self) -> Result<(), Failure> {
        self.inputs.begin_here().map_err(Failure::Answers)
    }

    /// Has what the program asks answered as it was when it came there before.
    ///
    /// # Errors
    /// That cannot be read.
    pub(super) fn recall(&self, program: u64) -> Result<(), Failure> {
        self.keep_answers(program, true)
    }

    fn keep_answers(&self, program: u64, goes_on: bool) -> Result<(), Failure> {
        if let Some(state_store) = &*self.state_store.borrow()
            && program != 0
        {
            let journal = state_store.journal(program, goes_on)?;
            self.inputs.keep_in(Box::new(journal), goes_on);
        }
        Ok(())
    }

    /// Has the program that is resumed begin with what it began with, and told what it was told.
    ///
    /// # Errors
    /// What it was told cannot be read.
    pub(super) fn resume(&self, program: u64, config: &mut MachineConfig) -> Result<(), Failure> {
        if let Some(state_store) = &mut *self.state_store.borrow_mut()
            && !state_store.resume(program, config)
        {
            output::note(
                "planner: the offsets this program began with are not kept; it is read with those of now",
            );
        }
        self.recall(program)
    }

    /// The program is about to move the machine, with so many times its tolerance.
    ///
    /// # Errors
    /// That cannot be written: nothing may move.
    pub(super) fn begin(
        &self,
        (program, tolerance_ratio): (u64, f64),
        start: &AxisVector,
    ) -> Result<(), Failure> {
        let state_store = self.state_store.take();
        if let Some(state_store) = state_store {
            self.state_store
                .replace(Some(state_store.begin(program, tolerance_ratio, start)?));
        }
        if self.inputs.keeps() {
            return Ok(());
        }
        self.keep_answers(program, false)
    }

    /// Takes notice of how the run goes, and says nothing of it.
    pub(super) fn notice(&self, notice: &Notice<'_>, config: &MachineConfig) {
        match notice {
            Notice::Started { epoch } => {
                let first = self.first_epoch.get().unwrap_or(*epoch);
                self.first_epoch.set(Some(first));
            }
            Notice::Progress(progress) => {
                self.note_position_offsets(self.position_offsets.executed(progress.block));
                if let Some(state_store) = &mut *self.state_store.borrow_mut() {
                    state_store.executed(progress.block, config);
                }
            }
            _ => {}
        }
    }

    /// Notes which offsets are in force from now on. Where that fails the program goes on all the
    /// same: whoever shows positions shows them with the one before.
    fn note_position_offsets(&self, offsets: Option<PositionOffsets>) {
        let noted = offsets.map(|offsets| self.note.leave(&offsets));
        if let Some(Err(error)) = noted {
            output::note(&format!(
                "planner: positions are shown without the offsets now in force: {error}"
            ));
        }
    }

    /// The motion is over, for better or worse. When this returns, what was executed is kept.
    ///
    /// # Errors
    /// It cannot be written.
    pub(super) fn end(
        &self,
        published: &Result<Statistics, RunError>,
        publisher: &FramePublisher<'_>,
        config: &MachineConfig,
    ) -> Result<(), Failure> {
        // Where nobody answers any more, nobody knows whether the machine rests, or how far it came.
        let is_lost = matches!(
            published,
            Err(RunError::InterpolatorLost
                | RunError::InterpolatorSilent { .. }
                | RunError::Link(_))
        );
        self.lost.set(is_lost);
        let point = publisher.resume_point();
        // Before the program has begun, the machine tells of the one before it.
        let has_begun = self.has_begun(publisher);
        self.note_position_offsets(match (published, &point) {
            (Ok(_), _) => self.position_offsets.all_executed(),
            (Err(_), Err(RunError::Resume(ResumeError::Completed))) if has_begun => {
                self.position_offsets.all_executed()
            }
            (Err(_), Ok(point)) if has_begun => self.position_offsets.executed(point.block),
            (Err(_), _) => None,
        });
        let Some(state_store) = self.state_store.take() else {
            return Ok(());
        };
        let kept = match (published, point) {
            (Ok(_), _) => state_store.completed(publisher.position(), config),
            (Err(_), Err(RunError::Resume(ResumeError::Completed))) if has_begun => {
                state_store.completed(publisher.position(), config)
            }
            (Err(_), Ok(point)) if has_begun => {
                let position = (!is_lost).then_some(point.position);
                state_store.left(point.block, position, config)
            }
            (Err(_), _) if has_begun || is_lost => state_store.left(0, None, config),
            (Err(_), _) => state_store.not_begun(),
        };
        let failed = kept.map_err(Failure::from);
        // The run has failed already, and is told as that.
        if let (Err(_), Err(failure)) = (published, &failed) {
            output::note(&format!("planner: {failure}"));
        }
        failed
    }
}

/// For a program that is only read again: what it asks is answered as it was.
pub(super) fn recalling(config: &MachineConfig, program: u64) -> RunChannels {
    let arbiter = InputArbiter::default();
    let folder = config.state_directory.as_deref().filter(|_| program != 0);
    // What cannot be read is not known: the reading ends there.
    if let Some(Ok(journal)) = folder.map(|folder| Journal::go_on(folder, program)) {
        arbiter.keep_in(Box::new(journal), true);
    }
    RunChannels {
        inputs: Some(arbiter),
        ..RunChannels::default()
    }
}

/// Says what happens.
pub(super) fn tell(notice: &Notice<'_>, quiet: bool) {
    let words = match notice {
        Notice::NoInterpolator => "waiting for an interpolator".to_owned(),
        Notice::NotReady(state) => {
            format!("the machine is not ready for a program: {}", state.text())
        }
        Notice::Listening => "ready: it takes lines, programs and streams".to_owned(),
        Notice::StreamOpened { .. } => "a client streams a program".to_owned(),
        Notice::StreamExecuted(statistics) => {
            format!("executed; {}", driven(statistics.segments))
        }
        Notice::StreamBroken(error) => format!("the stream broke off: {error}"),
        Notice::Started { epoch } => format!("epoch {epoch} starts"),
        Notice::Remark(remark) => {
            // Also in the output of a process that started this one, and is quiet.
            output::note(&format!("line {}: {}", remark.line, remark.text));
            return;
        }
        Notice::Progress(_) => return,
    };
    if !quiet {
        output::note(&format!("planner: {words}"));
    }
}
