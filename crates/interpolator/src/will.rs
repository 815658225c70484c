//! What the operator and the faults want of the motion, and the state that follows.
//!
//! Each reason to stop is kept by itself, and the state is worked out from them: a hold during
//! starvation, or a fault during a hold, needs no case of its own.
//!
//! | reason | while moving | at rest | ends by |
//! |---|---|---|---|
//! | fault | Stopping | Faulted (the epoch has ended) | reset |
//! | abort | Stopping | Idle (the epoch has ended) | – |
//! | program stop | – | ProgramStop | resume |
//! | feed hold, or override 0 | Holding | Held | resume, or another override |
//! | too few frames | Starving | Starved | frames |
//! | none | Running | Running | |

use crate::message::{Fault, Order};
use crate::supply::Supply;
use glidepath_link::MachineState;

/// Reasons to stop, and overrides.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Will {
    fault: Option<Fault>,
    abort: bool,
    hold: bool,
    program_stop: bool,
    feed_override: f64,
    rapid_override: f64,
}

impl Default for Will {
    fn default() -> Self {
        Self {
            fault: None,
            abort: false,
            hold: false,
            program_stop: false,
            feed_override: 1.0,
            rapid_override: 1.0,
        }
    }
}

impl Will {
    /// Takes an order. Returns whether the motion is to pass the program stop it stands at.
    pub(crate) const fn obey(&mut self, order: Order, is_open: bool) -> bool {
        match order {
            Order::Hold => self.hold = is_open,
            Order::Resume => {
                self.hold = false;
                return core::mem::replace(&mut self.program_stop, false);
            }
            Order::FeedOverride(ratio) => self.feed_override = ratio,
            Order::RapidOverride(ratio) => self.rapid_override = ratio,
            Order::Abort => self.abort = is_open,
            Order::Reset if is_open => self.abort = true,
            Order::Reset => self.fault = None,
            Order::Fault(fault) => self.fail(fault),
            Order::PlannerLives => {} // For the supply.
        }
        false
    }

    /// Latches a fault. The first one stays: the others follow from it.
    pub(crate) const fn fail(&mut self, fault: Fault) {
        if self.fault.is_none() {
            self.fault = Some(fault);
        }
    }

    pub(crate) const fn fault(&self) -> Option<&Fault> {
        self.fault.as_ref()
    }

    /// True if the epoch is to end as soon as the motion has come to rest.
    pub(crate) const fn is_stopping(&self) -> bool {
        self.abort || self.fault.is_some()
    }

    /// The motion stands at a program stop.
    pub(crate) const fn wait_for_operator(&mut self) {
        self.program_stop = true;
    }

    /// An epoch begins or ends: only a latched fault and the overrides outlive it.
    pub(crate) const fn turn_over(&mut self) {
        self.abort = false;
        self.hold = false;
        self.program_stop = false;
    }

    pub(crate) const fn overrides(&self) -> (f64, f64) {
        (self.feed_override, self.rapid_override)
    }

    /// Rate of program time that is wanted, where supply does not matter.
    pub(crate) fn rate(&self, is_rapid: bool, planned_override: f64) -> f64 {
        if self.is_stopping() || self.hold {
            return 0.0;
        }
        let commanded = if is_rapid {
            self.rapid_override
        } else {
            self.feed_override
        };
        (commanded / planned_override).min(1.0)
    }

    pub(crate) fn state(&self, is_open: bool, standing: bool, supply: &Supply) -> MachineState {
        use MachineState::{
            Faulted, Held, Holding, Idle, ProgramStop, Running, Starved, Starving, Stopping,
        };
        let choose = |at_rest, moving| if standing { at_rest } else { moving };
        match (is_open, self.fault.is_some()) {
            (false, true) => Faulted,
            (false, false) => Idle,
            (true, _) if self.is_stopping() => Stopping,
            (true, _) if self.program_stop => ProgramStop,
            (true, _) if self.hold || self.feed_override <= 0.0 => choose(Held, Holding),
            (true, _) if supply.is_short() => choose(Starved, Starving),
            (true, _) if standing && (supply.is_out() || supply.is_barred()) => Starved,
            (true, _) => Running,
        }
    }
}
