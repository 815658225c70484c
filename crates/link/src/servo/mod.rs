//! A consumer of setpoints: the mock servo, and the example for a servo stack of your own.
//!
//! A servo stack does three things. [`Servo::receive`] takes what has arrived and counts what has
//! not. [`Servo::demand`] says what the joints are to do at any moment, between two setpoints too:
//! setpoints carry the time at which they are to be applied, one period after they are computed, so
//! delivery may be late by nearly a period without harm. And if setpoints stay away in motion for longer
//! than the servo's patience, it stops the joints by itself, with limits of its own, and stays stopped
//! until [`Servo::rearm`]: neither the path nor the interpolator is known any more.
//!
//! Where the interpolator takes the position from the drives, setpoints with a new
//! [`Setpoint::reference`] do not continue those before. The servo then has no demand until one of
//! them is at rest with power on, and begins there; it never goes from the old position to the new
//! one. As long as it has none, the drives are to stay where they are. Whoever knows where the drives
//! are says so with [`Servo::rearm_at`]: then the servo begins only where they stand.
//!
//! A servo also stops the joints by itself when it is told to ([`Servo::stop`]: a drive failed, and
//! the others are to rest), and when a setpoint would have them jump ([`JumpLimits`]). Why it
//! stopped, [`Servo::stopped`] says.
//!
//! A real-time thread takes its setpoints from a [`ring`], which another thread fills: then neither
//! [`Servo::receive`] nor [`Servo::demand`] makes a system call or an allocation.
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
mod guard;
mod hermite;
mod player;
mod ring;
mod stop;

pub use count::ServoCounts;
pub use guard::{Jump, JumpLimits, JumpOf};
pub use hermite::{JointState, quintic};
pub use player::JointStates;
pub use ring::{RingFiller, RingSource, ring};
pub use stop::{Stop, StopLimits};

use crate::{LinkError, MachineState, Record, RecordError, Setpoint, Subscriber};
use core::fmt;
use count::Sequel;
use glidepath_geometry::AXES;
use player::Player;

/// The settings of a servo: what it does when setpoints stay away, or jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ServoSettings {
    /// How long after the time of the last setpoint the joints go on at constant acceleration, ns.
    pub patience_ns: u64,
    /// What each joint's own stop may use.
    pub stop: [StopLimits; AXES],
    /// What each joint is never asked for.
    pub jump: [JumpLimits; AXES],
}

impl Default for ServoSettings {
    /// Three periods of 4 ms; 2000 mm/s² and 40 000 mm/s³; no guard against jumps.
    fn default() -> Self {
        let stop = StopLimits {
            acceleration: 2000.0,
            jerk: 40_000.0,
        };
        Self {
            patience_ns: 12_000_000,
            stop: [stop; AXES],
            jump: [JumpLimits::default(); AXES],
        }
    }
}

/// The reason why a servo stopped the joints by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OwnStop {
    /// Setpoints stayed away.
    Silence,
    /// [`Servo::stop`] was called.
    Asked,
    /// A setpoint jumped.
    Jump(Jump),
}

impl fmt::Display for OwnStop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Silence => f.write_str("setpoints stayed away"),
            Self::Asked => f.write_str("it was asked to stop"),
            Self::Jump(jump) => jump.fmt(f),
        }
    }
}

/// Where the drives stand, and how near the first setpoint has to be.
#[derive(Debug, Clone, Copy)]
struct Stand {
    actual: [f64; AXES],
    window: [f64; AXES],
}

impl Stand {
    fn is_met_by(&self, setpoint: &Setpoint) -> bool {
        let places = self.actual.iter().zip(&setpoint.joint_position);
        let mut places = places.zip(&self.window);
        places.all(|((actual, told), window)| (told - actual).abs() <= *window)
    }
}

/// A consumer of setpoints.
pub struct Servo<S: Subscriber<Setpoint> = Box<dyn Subscriber<Setpoint>>> {
    source: S,
    player: Player,
    counts: ServoCounts,
    last: Option<Setpoint>,
    last_refusal: Option<RecordError>,
    /// Whether setpoints are played. Not those of an interpolator that was started before or after the one
    /// this began with: it may take the machine to be elsewhere.
    armed: bool,
    /// Whether it has to be handed the position, by a setpoint at rest, before it plays any.
    waits: bool,
    /// Where it has to be handed it, if that was said.
    stand: Option<Stand>,
    stopped: Option<OwnStop>,
    /// The time that was demanded for last: a stop goes on from there.
    played_ns: Option<u64>,
}

/// Whether no joint is told to move.
fn is_at_rest(setpoint: &Setpoint) -> bool {
    let rates = setpoint.joint_velocity.iter();
    rates
        .chain(&setpoint.joint_acceleration)
        .all(|rate| *rate == 0.0)
}

impl<S: Subscriber<Setpoint>> fmt::Debug for Servo<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Servo")
            .field("counts", &self.counts)
            .field("last", &self.last)
            .field("armed", &self.armed)
            .finish_non_exhaustive()
    }
}

impl<S: Subscriber<Setpoint>> Servo<S> {
    /// A servo that listens to a subscriber's end. It plays setpoints from the first on; one that
    /// knows where its drives are calls [`Servo::rearm_at`] before it receives any.
    #[must_use]
    pub fn new(source: S, settings: ServoSettings) -> Self {
        let player = Player::new(settings.patience_ns, settings.stop, settings.jump);
        let counts = ServoCounts::default();
        Self {
            source,
            player,
            counts,
            last: None,
            last_refusal: None,
            armed: true,
            waits: false,
            stand: None,
            stopped: None,
            played_ns: None,
        }
    }

    /// The next new setpoint that has arrived, `None` if there is no more yet. Duplicates and
    /// records that fail their check are counted and left out. One that jumps is given out, but not
    /// played: the joints stop, from the time of the last demand on. `now_ns` is of
    /// `CLOCK_MONOTONIC`, and decides what is counted as late.
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
                    (self.armed, self.stand, self.stopped) = (true, None, None);
                    self.wait();
                }
                Sequel::Restart => self.armed &= self.last.is_none(),
            }
            self.last = Some(setpoint);
            self.play(&setpoint, now_ns);
            return Ok(Some(setpoint));
        }
        Ok(None)
    }

    fn wait(&mut self) {
        self.waits = true;
        self.player.reset();
    }

    fn play(&mut self, setpoint: &Setpoint, now_ns: u64) {
        let is_off = setpoint.enable == 0 || setpoint.state == MachineState::Off.code();
        if is_off {
            self.wait();
        } else if self.armed && self.waits {
            if is_at_rest(setpoint) && self.stand.is_none_or(|stand| stand.is_met_by(setpoint)) {
                self.player.stand_at(setpoint);
                (self.waits, self.stand) = (false, None);
            }
        } else if self.armed
            && let Err(jump) = self.player.push(setpoint)
        {
            self.counts.jumps += 1;
            self.begin_stop(now_ns, OwnStop::Jump(jump));
        }
    }

    fn begin_stop(&mut self, now_ns: u64, why: OwnStop) {
        let was_stopping = self.player.is_stopping();
        self.player.stop(self.played_ns.unwrap_or(now_ns));
        self.note_stop(was_stopping, why);
        self.armed = false;
        // The first cause is the one to know, if there was a motion to stop or none.
        self.stopped.get_or_insert(why);
    }

    fn note_stop(&mut self, was_stopping: bool, why: OwnStop) {
        if self.player.is_stopping() && !was_stopping {
            self.counts.stops += 1;
            self.armed = false;
            // The way back to a setpoint may be the jump, too.
            let why = self.player.jump().map_or(why, OwnStop::Jump);
            self.counts.jumps += u64::from(self.player.jump().is_some());
            self.stopped = Some(why);
        }
    }

    /// Brings the joints to rest within their own limits, off the path if need be, and plays no
    /// setpoint until [`Servo::rearm`] or a new reference: a drive failed, the bus is lost, or
    /// whoever drives the joints ends. The interpolator does not know of it; tell it by feedback,
    /// or with an abort.
    ///
    /// They stop from the time of the last demand on, so that a servo that plays setpoints later than
    /// they say stops where it has come to; from `now_ns`, of `CLOCK_MONOTONIC`, where there was none.
    pub fn stop(&mut self, now_ns: u64) {
        self.begin_stop(now_ns, OwnStop::Asked);
    }

    /// Whether playing goes on to a rest: the newest setpoint is one, or there is none.
    #[must_use]
    pub fn comes_to_rest(&self) -> bool {
        self.last.as_ref().is_none_or(is_at_rest)
    }

    /// The demand of the joints at a time; `None` before the first setpoint's, and while the drives
    /// are off, until the position was taken over from them. Times do not go back from call to
    /// call.
    pub fn demand(&mut self, now_ns: u64) -> Option<JointStates> {
        self.played_ns = Some(now_ns);
        let was_stopping = self.player.is_stopping();
        let demand = self.player.demand(now_ns);
        self.note_stop(was_stopping, OwnStop::Silence);
        let moves = |joints: &JointStates| joints.iter().any(|joint| joint.velocity != 0.0);
        self.counts.coasts +=
            u64::from(self.player.is_coasting() && demand.as_ref().is_some_and(moves));
        demand
    }

    /// Whether setpoints are played. Not after an own stop or a new start of the interpolator. What
    /// is armed may still wait for the first setpoint that it can begin at.
    #[must_use]
    pub const fn is_armed(&self) -> bool {
        self.armed
    }

    /// Plays setpoints again, from the next one on. For an operator who has made sure that the
    /// joints are where the interpolator takes them to be.
    pub fn rearm(&mut self) {
        self.player.reset();
        (self.armed, self.stand, self.stopped) = (true, None, None);
    }

    /// Plays setpoints again once one of them is at rest with power on and tells every joint to
    /// stand within `window` of `actual`, where its drive says that it stands; both mm or degrees.
    /// Until then there is no demand. `f64::INFINITY` is a window for a joint that there is not.
    ///
    /// For servo stacks that know where their drives are: at their start, and after an own stop. A
    /// new [`Setpoint::reference`] was taken from the drives and takes the place of `actual`.
    pub fn rearm_at(&mut self, actual: &[f64; AXES], window: &[f64; AXES]) {
        self.rearm();
        self.wait();
        self.stand = Some(Stand {
            actual: *actual,
            window: *window,
        });
    }

    /// The reason why the servo stopped the joints by itself; `None` if they were not, or setpoints
    /// are played again.
    #[must_use]
    pub const fn stopped(&self) -> Option<&OwnStop> {
        self.stopped.as_ref()
    }

    /// The counts of what arrived so far.
    #[must_use]
    pub const fn counts(&self) -> &ServoCounts {
        &self.counts
    }

    /// The last setpoint that arrived.
    #[must_use]
    pub const fn last(&self) -> Option<&Setpoint> {
        self.last.as_ref()
    }

    /// The error of the last record that failed its check.
    #[must_use]
    pub const fn last_refusal(&self) -> Option<&RecordError> {
        self.last_refusal.as_ref()
    }
}
