//! A joint with its drive as a state machine: one file for each state.
//!
//! ```text
//!        enable            has power            home
//!  Off ─────────► Enabling ─────────► Following ◄────► Homing
//!   ▲                │ refused            │ disable        │
//!   └── Stopping ◄───┴────────────────────┴────────────────┘
//!   └── Faulted ◄── from anywhere, when the drive says so; left by a reset
//! ```

mod drive_io;
mod enabling;
mod faulted;
mod following;
mod homing;
mod off;
mod step;
mod stopping;

pub(crate) use drive_io::{DriveCommand, DriveInputs};

use crate::bus_fault::BusFault;
use crate::event::Event;
use crate::feed_forward::Offsets;
use crate::image::{Inputs, Outputs};
use crate::probe::ProbeUse;
use crate::settings::DriveSettings;
use crate::state;
use enabling::Enabling;
use faulted::Faulted;
use following::Following;
use glidepath_link::DriveState;
use homing::Homing;
use step::{Next, Step};
use stopping::Stopping;

#[derive(Debug, Clone)]
enum Phase {
    Off,
    Enabling(Enabling),
    Following(Following),
    Homing(Homing),
    Stopping(Stopping),
    Faulted(Faulted),
}

/// A joint and its drive.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    pub(crate) settings: DriveSettings,
    phase: Phase,
    outputs: Outputs,
    is_homed: bool,
    /// It had trouble, and gets power again only when that was taken from it and asked for anew.
    is_latched: bool,
    /// Fault that was told.
    told: u16,
}

impl Axis {
    pub(crate) const fn new(settings: DriveSettings) -> Self {
        Self {
            phase: Phase::Off,
            outputs: Outputs {
                control: 0,
                target: 0,
                mode: crate::image::CYCLIC_POSITION,
                offsets: Offsets::NONE,
                probe: ProbeUse::Off,
                asks_probe: false,
            },
            is_homed: settings.homing.is_none(),
            is_latched: false,
            told: 0,
            settings,
        }
    }

    /// Whether it has power and follows, or looks for its home.
    pub(crate) const fn is_enabled(&self) -> bool {
        matches!(self.phase, Phase::Following(_) | Phase::Homing(_))
    }

    /// Whether it has power, or has had it in this moment: its counts keep what they mean.
    pub(crate) const fn is_led(&self) -> bool {
        matches!(
            self.phase,
            Phase::Following(_) | Phase::Homing(_) | Phase::Stopping(_)
        )
    }

    pub(crate) const fn is_homed(&self) -> bool {
        self.is_homed
    }

    /// The home that its drive has found does not hold any more.
    pub(crate) const fn lose_home(&mut self) {
        self.is_homed = self.settings.homing.is_none();
    }

    pub(crate) const fn is_homing(&self) -> bool {
        matches!(&self.phase, Phase::Homing(homing) if homing.is_under_way())
    }

    pub(crate) const fn is_off(&self) -> bool {
        matches!(self.phase, Phase::Off | Phase::Faulted(_))
    }

    /// Whether only the others keep it from power.
    pub(crate) fn is_ready(&self, inputs: &Inputs) -> bool {
        let state = state::of(inputs.status);
        let has_come = matches!(state, DriveState::SwitchedOn | DriveState::OperationEnabled);
        self.is_enabled() || (matches!(self.phase, Phase::Enabling(_)) && has_come)
    }

    /// Has no power until it is asked for anew.
    pub(crate) const fn latch(&mut self) {
        self.is_latched = true;
    }

    /// A cycle: what the drive is to be told, from what it told last and what is wanted.
    pub(crate) fn step(
        &mut self,
        drive_inputs: &DriveInputs,
        drive_command: &DriveCommand,
        tell: &mut dyn FnMut(Event),
    ) -> Outputs {
        let joint = self.settings.joint;
        self.is_latched &= drive_command.enable;
        let drive_command = DriveCommand {
            enable: drive_command.enable && !self.is_latched,
            ..*drive_command
        };
        let mut step = Step {
            settings: &self.settings,
            drive_inputs,
            drive_command: &drive_command,
            outputs: self.outputs,
        };
        let is_faulted = matches!(self.phase, Phase::Faulted(_));
        let next = if drive_inputs.is_faulted() && !is_faulted {
            faulted::rest(&mut step);
            Next::Fault
        } else {
            match &mut self.phase {
                Phase::Off => off::step(&mut step),
                Phase::Enabling(enabling) => enabling.step(&mut step),
                Phase::Following(following) => following.step(&mut step),
                Phase::Homing(homing) => homing.step(&mut step),
                Phase::Stopping(stopping) => stopping.step(&mut step),
                Phase::Faulted(faulted) => faulted.step(&mut step),
            }
        };
        self.outputs = step.outputs;
        self.enter(next, drive_inputs, drive_command.reset, tell);
        if drive_inputs.fault != self.told {
            self.told = drive_inputs.fault;
            if drive_inputs.fault != 0 {
                tell(Event::Fault(joint, drive_inputs.fault));
            }
        }
        self.outputs
    }

    fn enter(
        &mut self,
        next: Next,
        drive_inputs: &DriveInputs,
        resets: bool,
        tell: &mut dyn FnMut(Event),
    ) {
        let (now_ns, joint) = (drive_inputs.now_ns, self.settings.joint);
        self.phase = match next {
            Next::Stay => return,
            Next::Off => {
                if matches!(self.phase, Phase::Faulted(_)) {
                    tell(Event::Reset(joint));
                } else {
                    tell(Event::Off(joint));
                }
                Phase::Off
            }
            Next::Enable => Phase::Enabling(Enabling::new(now_ns)),
            Next::Refuse(trouble) => {
                self.is_latched = true;
                tell(Event::Trouble(trouble));
                return;
            }
            Next::Follow => {
                if !matches!(self.phase, Phase::Homing(_)) {
                    tell(Event::Follows(joint));
                }
                Phase::Following(Following::new(self.outputs.target))
            }
            Next::Home => {
                self.is_homed = false;
                tell(Event::Homing(joint));
                Phase::Homing(Homing::new(now_ns))
            }
            Next::Found => {
                self.is_homed = true;
                tell(Event::Home(joint));
                return;
            }
            Next::Stop(trouble) => {
                if let Some(trouble) = trouble {
                    self.is_latched = true;
                    tell(Event::Trouble(trouble));
                }
                Phase::Stopping(Stopping::new(now_ns))
            }
            Next::Fault => Phase::Faulted(Faulted::new(resets)),
        };
    }
}

/// Whether a trouble takes the power from all.
pub(crate) const fn is_common(event: &Event) -> bool {
    matches!(event, Event::Trouble(trouble) if BusFault::is_common(*trouble))
}
