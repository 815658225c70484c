//! The state store: it writes what the planner keeps of the programs it has executed.
//!
//! ```text
//!   program ─read far ahead─▶ ChangeLog ─when the machine has come so far─▶ PersistentState ─▶ a thread ─▶ files
//! ```
//!
//! Files are written and waited for in a thread of their own: the planner must not be kept waiting
//! by a disk while the machine moves.

use crate::config::MachineConfig;
use crate::persistence::convert::{left_variables, left_with, merge, merge_tools};
use crate::persistence::error::StateError;
use crate::persistence::input_log::Journal;
use crate::persistence::machine::fingerprint;
use crate::persistence::read::{of_machine, set_up, set_up_as_begun, table, table_fingerprint};
use crate::persistence::seen;
use glidepath_gcode::ToolTable;
use glidepath_geometry::AxisVector;
use glidepath_persistence::{
    Directory, DirectoryLock, Offsets, PersistentState, Rest, Store, UnderWay,
};
use glidepath_planner::{ChangeLog, SetUp};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;

/// Keeps what a planner has executed. While it lives, nobody else writes.
#[derive(Debug)]
pub(crate) struct StateStore {
    kept: PersistentState,
    /// What the program began with.
    before: (Offsets, Arc<ToolTable>),
    log: ChangeLog,
    is_resumed: bool,
    /// The program under way before it.
    replaced: Option<UnderWay>,
    folder: PathBuf,
    store: Writing,
    _lock: DirectoryLock,
}

/// Who writes: the store itself until the program begins, then a thread.
#[derive(Debug)]
enum Writing {
    Here(Store<Directory>),
    Thread(Writer),
}

/// The thread that writes the newest of what it is given.
#[derive(Debug)]
struct Writer {
    sender: Sender<PersistentState>,
    thread: JoinHandle<Result<(), StateError>>,
}

impl StateStore {
    /// Takes the right to write, and puts what is kept into the configuration; `None` for a machine
    /// that keeps nothing. The second part is what somebody has to know.
    ///
    /// # Errors
    /// Another process writes, or what is kept cannot be read or is another machine's.
    pub(crate) fn open(
        config: &mut MachineConfig,
    ) -> Result<Option<(Self, Vec<String>)>, StateError> {
        let Some(folder) = config.state_directory.clone() else {
            return Ok(None);
        };
        let directory = Directory::open(&folder)?;
        let lock = directory.lock()?;
        let store = Store::new(directory);
        let mut notes = Vec::new();
        let kept = match seen::read(&store, &folder)? {
            Some((_, kept)) => {
                of_machine(config, &folder, &kept)?;
                notes = set_up(config, &kept);
                kept
            }
            None => PersistentState {
                configuration: fingerprint(config),
                ..PersistentState::default()
            },
        };
        let state_store = Self {
            before: (kept.offsets.clone(), table(config)),
            kept,
            log: ChangeLog::default(),
            is_resumed: false,
            replaced: None,
            folder,
            store: Writing::Here(store),
            _lock: lock,
        };
        Ok(Some((state_store, notes)))
    }

    /// Where the source of the program notes its changes.
    pub(crate) fn log(&self) -> ChangeLog {
        self.log.clone()
    }

    /// What the program is told by inputs and the probe: what it was told so far, or from its beginning
    /// on.
    ///
    /// # Errors
    /// It cannot be read or written.
    pub(crate) fn journal(&self, program: u64, goes_on: bool) -> Result<Journal, StateError> {
        if goes_on {
            Journal::go_on(&self.folder, program)
        } else {
            Journal::begin(&self.folder, program)
        }
    }

    /// Puts what the program began with that is to be resumed into the configuration; false if that
    /// is not known.
    pub(crate) fn resume(&mut self, program: u64, config: &mut MachineConfig) -> bool {
        let Some(begun) = set_up_as_begun(config, &self.kept, program) else {
            return false;
        };
        self.before = (begun.offsets.clone(), table(config));
        self.is_resumed = true;
        true
    }

    /// A program begins to move the machine, with so many times its tolerance. When this returns, that is kept.
    ///
    /// # Errors
    /// It cannot be written: nothing may move.
    pub(crate) fn begin(
        mut self,
        program: u64,
        tolerance_ratio: f64,
        start: &AxisVector,
    ) -> Result<Self, StateError> {
        let begun = self.kept.under_way.take();
        self.replaced.clone_from(&begun);
        // A program that is resumed began when it did; one from a pipe cannot be resumed.
        self.kept.under_way = begun.filter(|_| self.is_resumed).or_else(|| {
            let begun = UnderWay {
                program,
                offsets: self.before.0.clone(),
                tools: self.kept.tools.clone(),
                variables: self.kept.variables.clone(),
                tolerance_ratio,
            };
            (program != 0).then_some(begun)
        });
        self.rest_at(start, false);
        if let Writing::Here(mut store) = self.store {
            seen::write(&mut store, &self.folder, &self.kept)?;
            self.store = Writing::Thread(Writer::start(store, self.folder.clone()));
        }
        Ok(self)
    }

    /// The machine is on a block: keeps what was changed in front of it.
    pub(crate) fn executed(&mut self, block: u32, config: &MachineConfig) {
        if let Some(set_up) = self.log.executed(block) {
            self.take(&set_up, config);
            if let Writing::Thread(writer) = &self.store {
                // Why a thread ended is told at the end.
                writer.sender.send(self.kept.clone()).ok();
            }
        }
    }

    /// The program was executed to its end.
    pub(crate) fn completed(
        mut self,
        position: Option<AxisVector>,
        config: &MachineConfig,
    ) -> Result<(), StateError> {
        if let Some(set_up) = self.log.all_executed() {
            self.take(&set_up, config);
        }
        self.kept.under_way = None;
        self.end(position)
    }

    /// The motion ended before the program did, in a block.
    pub(crate) fn left(
        mut self,
        block: u32,
        position: Option<AxisVector>,
        config: &MachineConfig,
    ) -> Result<(), StateError> {
        if let Some(set_up) = self.log.executed(block) {
            self.take(&set_up, config);
        }
        self.end(position)
    }

    /// Programs begin in G54 from now on: the machine was reset.
    ///
    /// # Errors
    /// It cannot be written.
    pub(crate) fn in_first_system(mut self) -> Result<(), StateError> {
        if self.kept.offsets.active == 1 {
            return Ok(());
        }
        self.kept.offsets.active = 1;
        self.end(None)
    }

    /// Nothing of the program was executed: what was left before it is what can be resumed.
    pub(crate) fn not_begun(mut self) -> Result<(), StateError> {
        self.kept.under_way = self.replaced.take();
        self.end(None)
    }

    fn end(mut self, position: Option<AxisVector>) -> Result<(), StateError> {
        if let Some(position) = position {
            self.rest_at(&position, true);
        }
        match self.store {
            Writing::Here(mut store) => seen::write(&mut store, &self.folder, &self.kept),
            Writing::Thread(Writer { sender, thread }) => {
                sender.send(self.kept.clone()).ok();
                drop(sender);
                thread.join().unwrap_or(Err(StateError::NoWriter))
            }
        }
    }

    fn rest_at(&mut self, position: &AxisVector, clean: bool) {
        let mut rest = Rest {
            position: [0.0; glidepath_persistence::AXES],
            clean,
        };
        for (slot, value) in rest.position.iter_mut().zip(position.iter()) {
            *slot = *value;
        }
        self.kept.rest = Some(rest);
    }

    fn take(&mut self, set_up: &SetUp, config: &MachineConfig) {
        let (offsets, tools) = &self.before;
        merge(&mut self.kept.offsets, offsets, &left_with(&set_up.offsets));
        self.kept.spindle_tool = set_up.tool;
        self.kept.variables = left_variables(&set_up.variables);
        if let Some(changed) = &set_up.tools
            && changed != tools
        {
            let fingerprint = table_fingerprint(config);
            // Changes of another table are those of other tools.
            if self.kept.tool_table != fingerprint {
                self.kept.tools.clear();
                self.kept.tool_table = fingerprint;
            }
            merge_tools(&mut self.kept.tools, tools, changed);
            self.before.1.clone_from(changed);
        }
        // What it takes back later is a change, too.
        self.before.0 = left_with(&set_up.offsets);
    }
}

impl Writer {
    fn start(mut store: Store<Directory>, folder: PathBuf) -> Self {
        let (sender, receiver) = channel::<PersistentState>();
        let thread = std::thread::spawn(move || {
            while let Ok(mut kept) = receiver.recv() {
                // Only the newest counts.
                while let Ok(newer) = receiver.try_recv() {
                    kept = newer;
                }
                seen::write(&mut store, &folder, &kept)?;
            }
            Ok(())
        });
        Self { sender, thread }
    }
}
