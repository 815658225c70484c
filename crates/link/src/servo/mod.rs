//! A consumer of setpoints: the mock servo, and the example for a servo stack of your own.
//!
//! A servo stack does three things. [`Servo::receive`] takes what has arrived and counts what has
//! not. [`Servo::demand`] says what the joints are to do at any moment, between two setpoints too:
//! setpoints carry the time at which they are to be applied, one period after they are computed, so
//! delivery may be late by nearly a period without harm. And if setpoints stay away for longer than
//! the servo's patience, it stops the joints by itself, with limits of its own, and stays stopped
//! until [`Servo::rearm`]: neither the path nor the interpolator is known any more.
//!
//! Where the interpolator takes the position from the drives, setpoints with a new
//! [`Setpoint::reference`] do not continue those before. The servo then has no demand until one of
//! them is at rest with power on, and begins there; it never goes from the old position to the new
//! one. As long as it has none, the drives are to stay where they are.
//!
//! ```no_run
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! # fn monotonic_ns() -> u64 { 0 }
//! use glidepath_link::servo::{Servo, ServoSettings};
//! use glidepath_link::{Ipc, LinkConfig, Transport};
//!
//! let link = Ipc::connect(&LinkConfig::new("default"))?;
//! let mut servo = Servo::new(link.setpoint_source()?, ServoSettings::default());
//! loop {
//!     let now_ns = monotonic_ns(); // of CLOCK_MONOTONIC
//!     while let Some(setpoint) = servo.receive(now_ns)? {
//!         // for a log
//! #       let _ = setpoint;
//!     }
//!     if let Some(joints) = servo.demand(now_ns) {
//!         // to the drives
//! #       let _ = joints;
//!     }
//! #   break;
//! }
//! # Ok(())
//! # }
//! ```

mod count;
mod hermite;
mod player;
mod stop;

pub use count::ServoCounts;
pub use hermite::{JointState, quintic};
pub use player::JointStates;
pub use stop::{Stop, StopLimits};

use crate::{LinkError, MachineState, Record, RecordError, Setpoint, Subscriber};
use core::fmt;
use count::Sequel;
use glidepath_geometry::AXES;
use player::Player;

/// How a servo behaves when setpoints stay away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ServoSettings {
    /// How long after the time of the last setpoint the joints go on at constant acceleration, ns.
    pub patience_ns: u64,
    /// What each joint's own stop may use.
    pub stop: [StopLimits; AXES],
}

impl Default for ServoSettings {
    /// Three periods of 4 ms; 2000 mm/s² and 40 000 mm/s³.
    fn default() -> Self {
        let stop = StopLimits {
            acceleration: 2000.0,
            jerk: 40_000.0,
        };
        Self {
            patience_ns: 12_000_000,
            stop: [stop; AXES],
        }
    }
}

/// A consumer of setpoints.
pub struct Servo {
    source: Box<dyn Subscriber<Setpoint>>,
    player: Player,
    counts: ServoCounts,
    last: Option<Setpoint>,
    last_refusal: Option<RecordError>,
    /// Whether setpoints are played. Not those of another life of the interpolator than the one
    /// this began with: it may take the machine to be elsewhere.
    armed: bool,
    /// Whether it has to be handed the position, by a setpoint at rest, before it plays any.
    waits: bool,
}

/// Whether no joint is told to move.
fn is_at_rest(setpoint: &Setpoint) -> bool {
    let rates = setpoint.joint_velocity.iter();
    rates
        .chain(&setpoint.joint_acceleration)
        .all(|rate| *rate == 0.0)
}

impl fmt::Debug for Servo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Servo")
            .field("counts", &self.counts)
            .field("last", &self.last)
            .field("armed", &self.armed)
            .finish_non_exhaustive()
    }
}

impl Servo {
    /// A servo that listens to a subscriber's end.
    #[must_use]
    pub fn new(source: Box<dyn Subscriber<Setpoint>>, settings: ServoSettings) -> Self {
        let player = Player::new(settings.patience_ns, settings.stop);
        let counts = ServoCounts::default();
        Self {
            source,
            player,
            counts,
            last: None,
            last_refusal: None,
            armed: true,
            waits: false,
        }
    }

    /// The next new setpoint that has arrived, `None` if there is no more yet. Duplicates and
    /// records that fail their check are counted and left out. `now_ns` is of `CLOCK_MONOTONIC`.
    ///
    /// # Errors
    ///
    /// A failure of the transport.
    pub fn receive(&mut self, now_ns: u64) -> Result<Option<Setpoint>, LinkError> {
        while let Some(setpoint) = self.source.take()? {
            if let Err(refusal) = setpoint.check() {
                self.counts.refused += 1;
                self.last_refusal = Some(refusal);
                continue;
            }
            match self.counts.count(self.last.as_ref(), &setpoint, now_ns) {
                Sequel::Duplicate => continue,
                Sequel::New => {}
                Sequel::Reference => {
                    // The drives were asked where they are: whatever stopped this is settled.
                    self.armed = true;
                    self.wait();
                }
                Sequel::Restart => self.armed = self.last.is_none(),
            }
            self.last = Some(setpoint);
            self.play(&setpoint);
            return Ok(Some(setpoint));
        }
        Ok(None)
    }

    fn wait(&mut self) {
        self.waits = true;
        self.player.reset();
    }

    fn play(&mut self, setpoint: &Setpoint) {
        let is_off = setpoint.enable == 0 || setpoint.state == MachineState::Off.code();
        if is_off {
            self.wait();
        } else if self.armed && self.waits {
            if is_at_rest(setpoint) {
                self.player.stand_at(setpoint);
                self.waits = false;
            }
        } else if self.armed {
            self.player.push(setpoint);
        }
    }

    /// What the joints are to do at a time; `None` before the first setpoint's, and while the drives
    /// are off, until the position was taken over from them. Times do not go back from call to
    /// call.
    pub fn demand(&mut self, now_ns: u64) -> Option<JointStates> {
        let was_stopping = self.player.is_stopping();
        let demand = self.player.demand(now_ns);
        if self.player.is_stopping() && !was_stopping {
            self.counts.stops += 1;
            self.armed = false;
        }
        demand
    }

    /// Whether setpoints are played. Not after an own stop or a new start of the interpolator.
    #[must_use]
    pub const fn is_armed(&self) -> bool {
        self.armed
    }

    /// Plays setpoints again, from the next one on. For an operator who has made sure that the
    /// joints are where the interpolator takes them to be.
    pub fn rearm(&mut self) {
        self.player.reset();
        self.armed = true;
    }

    /// What arrived so far.
    #[must_use]
    pub const fn counts(&self) -> &ServoCounts {
        &self.counts
    }

    /// The last setpoint that arrived.
    #[must_use]
    pub const fn last(&self) -> Option<&Setpoint> {
        self.last.as_ref()
    }

    /// What was wrong with the last record that failed its check.
    #[must_use]
    pub const fn last_refusal(&self) -> Option<&RecordError> {
        self.last_refusal.as_ref()
    }
}
