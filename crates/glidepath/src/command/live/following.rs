//! The choice of the program that the page shows: the one that the machine executes, whoever began
//! it.
//!
//! ```text
//!  status: fingerprint ──► the planner's note of that fingerprint ──► its file ──► text, path and plan
//!          └──────── text and place are shown as long as both are the same ────────┘
//! ```
//!
//! A program that was given on the command line is shown until the machine executes another one.

use super::planned::{self, Planned, Reading};
use super::shown::Shown;
use crate::command::active_program::active_program;
use crate::command::begins_with::ratio_begun_with;
use crate::command::failure::Failure;
use crate::command::forecast::{Forecast, PlannedFor};
use crate::config::MachineConfig;
use crate::persistence::read::read;
use crate::report::ProgramPlace;
use glidepath_link::{ActiveProgram, EndOfEpoch, LinkConfig, Status};
use glidepath_persistence::{Offsets, Tool};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Between two looks at the note of a program that is not known.
const LOOK_EVERY: Duration = Duration::from_millis(250);

/// The program that is shown, and how it came to that.
pub(super) struct Following {
    config: MachineConfig,
    link: LinkConfig,
    shown: Arc<Shown>,
    program: Option<Followed>,
    /// The program of the machine for which a note was looked for, and when; and the note.
    looked: Option<(u64, Instant)>,
    active: Option<ActiveProgram>,
    /// The program whose file could not be read.
    unreadable: Option<u64>,
}

/// A program that is read and planned.
struct Followed {
    /// Which one the machine executes; `None` where it was given on the command line.
    fingerprint: Option<u64>,
    /// The epoch that was looked at last, and what the program began with there.
    epoch: u64,
    begun: Begun,
    forecast: Forecast,
    _reading: Reading,
}

impl Following {
    /// Shows a program that was given, or none yet.
    ///
    /// # Errors
    /// The program cannot be read.
    pub(super) fn new(
        (config, link): (&MachineConfig, &LinkConfig),
        shown: Arc<Shown>,
        given: Option<(&Path, &Path)>,
    ) -> Result<Self, Failure> {
        let mut following = Self {
            config: config.clone(),
            link: link.clone(),
            shown,
            program: None,
            looked: None,
            active: None,
            unreadable: None,
        };
        if let Some((path, name)) = given {
            following.program = Some(following.follow(path, &name.display().to_string(), None)?);
        }
        Ok(following)
    }

    fn follow(
        &self,
        path: &Path,
        name: &str,
        fingerprint: Option<u64>,
    ) -> Result<Followed, Failure> {
        let board = self.shown.begin(Some(name));
        let planned = Planned::new(&self.config, board.clone());
        let begun = fingerprint.map_or(Begun::AS_CONFIGURED, |program| {
            begun((&self.config, &self.link), program)
        });
        let planned_for = PlannedFor::Following(fingerprint);
        board.file(path, planned_for);
        let forecast = Forecast::start(path, &self.config, planned_for, planned)?;
        board.text(forecast.lines());
        let reading = planned::read(path, &self.config, forecast.begins(), board);
        Ok(Followed {
            fingerprint,
            epoch: 0,
            begun,
            forecast,
            _reading: reading,
        })
    }

    /// Looks what the machine executes, and shows that from now on.
    pub(super) fn look(&mut self, status: &Status) {
        self.look_for_note(status);
        let is_open = status.end_of_epoch() == Ok(EndOfEpoch::Open);
        if !is_open && self.program.is_some() {
            return;
        }
        if let Some(shown) = &mut self.program
            && shown.forecast.is_of(status)
            && !shown.has_begun_anew(status, (&self.config, &self.link))
        {
            return;
        }
        let Some(active) = &self.active else {
            // A line, a pipe, or nobody has said: then the program that is shown is not that of the machine.
            return;
        };
        let (program, name) = (active.fingerprint, active.name());
        // One that is still read, or that has become another text.
        let is_tried = self.program.as_ref().is_some_and(|shown| {
            shown.fingerprint == Some(program) && !shown.forecast.is_of(status)
        });
        if is_tried || self.unreadable == Some(program) {
            return;
        }
        let followed = self.follow(&active.file, &name, Some(program));
        let followed = followed.map_err(|failure| {
            let board = self.shown.begin(Some(&name));
            board.trouble(&failure.to_string());
        });
        self.unreadable = followed.is_err().then_some(program);
        self.replace(followed.ok());
    }

    fn look_for_note(&mut self, status: &Status) {
        let is_known = self
            .active
            .as_ref()
            .is_some_and(|active| active.fingerprint == status.program);
        let was_looked = self
            .looked
            .is_some_and(|(program, at)| program == status.program && at.elapsed() < LOOK_EVERY);
        if !is_known && !was_looked {
            self.looked = Some((status.program, Instant::now()));
            self.active = active_program(&self.link, status);
        }
    }

    /// The one before ends in its own time: it may be reading a long text.
    fn replace(&mut self, followed: Option<Followed>) {
        let before = core::mem::replace(&mut self.program, followed);
        std::thread::spawn(move || drop(before));
    }

    /// The note of the program that the machine executes, or has executed last.
    pub(super) const fn active(&self) -> Option<&ActiveProgram> {
        self.active.as_ref()
    }

    /// Whether the program that is shown is that of the machine.
    pub(super) fn is_of(&self, status: &Status) -> bool {
        self.program
            .as_ref()
            .is_some_and(|shown| shown.forecast.is_of(status))
    }

    /// Where the machine is in it.
    pub(super) fn place(&self, status: &Status) -> Option<ProgramPlace> {
        self.program.as_ref()?.forecast.place(status)
    }

    /// What is known of the plan of the program that the machine executes, or has executed last: how long it takes, and
    /// how far it is from the program. Null if the one that is shown is another one, or is not planned to its end.
    pub(super) fn plan(&self, status: &Status) -> Value {
        let object = self.shown.object();
        let report = &object["report"];
        if !self.is_of(status) || !report.is_object() {
            return Value::Null;
        }
        let forecast = self.program.as_ref().map(|shown| &shown.forecast);
        json!({
            "planned_s": forecast.and_then(Forecast::planned_t),
            "max_deviation_mm": report["max_deviation_mm"],
            "tolerance_mm": report["tolerance_mm"],
        })
    }

    /// Frames planned of it so far.
    pub(super) fn frames(&self) -> u64 {
        let program = self.program.as_ref();
        program.map_or(0, |shown| shown.forecast.frames())
    }
}

impl Followed {
    /// Whether it runs another time, with other offsets or tools than those that it was planned with.
    fn has_begun_anew(&mut self, status: &Status, machine: (&MachineConfig, &LinkConfig)) -> bool {
        if core::mem::replace(&mut self.epoch, status.epoch) == status.epoch {
            return false;
        }
        let begun = begun(machine, status.program);
        core::mem::replace(&mut self.begun, begun) != self.begun
    }
}

/// What a program began with, as far as it is kept, and how many times its tolerance it uses.
#[derive(PartialEq)]
struct Begun {
    kept: Option<(Offsets, Vec<Tool>)>,
    tolerance_ratio: f64,
}

impl Begun {
    /// Nothing is known of it.
    const AS_CONFIGURED: Self = Self {
        kept: None,
        tolerance_ratio: 1.0,
    };
}

fn begun((config, link): (&MachineConfig, &LinkConfig), program: u64) -> Begun {
    let ratio = ratio_begun_with(link, |note| note.fingerprint == program);
    Begun {
        kept: kept(config, program),
        tolerance_ratio: ratio.unwrap_or(1.0),
    }
}

fn kept(config: &MachineConfig, program: u64) -> Option<(Offsets, Vec<Tool>)> {
    let kept = read(config).ok()??;
    let begun = kept.under_way.filter(|begun| begun.program == program);
    Some(begun.map_or((kept.offsets, kept.tools), |begun| {
        (begun.offsets, begun.tools)
    }))
}
