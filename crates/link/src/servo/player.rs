//! The player, which plays setpoints by their time stamps.
//!
//! ```text
//!            now
//!   from ─────┼────── to ───── queue …     quintic between the two
//!   from ──┼─ ─ ─ ─                        nothing newer: constant acceleration, for a while
//!                  ·                       a newer one, half a period ahead: back to it
//!   from ─ ─ ─ ─ ─ ─ ─ ─ ┼ ╲_              nothing for too long: the joints' own stop, latched; joints that
//!                                          rest stay where they are, and go on from there
//!   from ─────┼ ╲_       × to              the next one jumps: likewise, at once
//! ```
//!
//! Position, velocity and acceleration are continuous throughout. After a gap the way back takes at
//! least half a period, because making good a small error in a shorter time would take large forces.
//! Not a whole one: setpoints arrive less than a period ahead.

use super::guard::{Jump, JumpLimits, find_jump};
use super::{JointState, Stop, StopLimits, quintic};
use crate::Setpoint;
use glidepath_geometry::AXES;
use std::collections::VecDeque;

/// Position, velocity and acceleration of every joint.
pub type JointStates = [JointState; AXES];

/// The joints at a time.
#[derive(Debug, Clone, Copy)]
struct Knot {
    at_ns: u64,
    /// The time of the newest setpoint that came in time: this one, or one that has led here.
    heard_ns: u64,
    period_ns: u64,
    joints: JointStates,
    /// No setpoint, but where one leads at constant acceleration.
    is_coasted: bool,
    /// The joints whose drives look for their home by themselves, one bit each.
    home: u32,
}

impl Knot {
    fn of(setpoint: &Setpoint) -> Self {
        let mut joints = JointStates::default();
        let derivatives = setpoint
            .joint_velocity
            .iter()
            .zip(&setpoint.joint_acceleration);
        let values = setpoint.joint_position.iter().zip(derivatives);
        for (joint, (position, (velocity, acceleration))) in joints.iter_mut().zip(values) {
            let (position, velocity, acceleration) = (*position, *velocity, *acceleration);
            *joint = JointState {
                position,
                velocity,
                acceleration,
            };
        }
        let at_ns = setpoint.apply_ns;
        Self {
            at_ns,
            heard_ns: at_ns,
            period_ns: at_ns.saturating_sub(setpoint.scheduled_ns),
            joints,
            is_coasted: false,
            home: setpoint.home,
        }
    }

    fn is_at_rest(&self) -> bool {
        let mut joints = self.joints.iter();
        joints.all(|joint| joint.velocity == 0.0 && joint.acceleration == 0.0)
    }

    fn coast(mut self, now_ns: u64) -> Self {
        let time_t = seconds(now_ns, self.at_ns);
        self.joints = self.joints.map(|joint| joint.coast(time_t));
        (self.at_ns, self.is_coasted) = (now_ns, true);
        self
    }
}

#[allow(
    clippy::large_enum_variant,
    reason = "there is one per servo, and it stays in place"
)]
#[derive(Debug, Clone, Copy)]
enum Mode {
    /// Before the first setpoint's time.
    Waiting,
    Playing {
        from: Knot,
        /// `from` is no setpoint, but where the joints went for want of one.
        coasting: bool,
    },
    Stopping {
        since_ns: u64,
        stops: [Stop; AXES],
        /// Where the way back to the setpoints would have been a jump.
        jump: Option<Jump>,
    },
}

/// What the joints are to do, from setpoints as they come.
#[derive(Debug, Clone)]
pub(super) struct Player {
    mode: Mode,
    queue: VecDeque<Knot>,
    patience_ns: u64,
    limits: [StopLimits; AXES],
    jumps: [JumpLimits; AXES],
}

impl Player {
    /// `patience_ns`: how long to go on at constant acceleration without a newer setpoint.
    pub(super) fn new(
        patience_ns: u64,
        limits: [StopLimits; AXES],
        jumps: [JumpLimits; AXES],
    ) -> Self {
        let queue = VecDeque::with_capacity(QUEUE);
        Self {
            mode: Mode::Waiting,
            queue,
            patience_ns,
            limits,
            jumps,
        }
    }

    /// Takes a setpoint for later. One that is not after the last in the queue is left out.
    ///
    /// # Errors
    ///
    /// The way from the setpoint before is a jump. This one was not taken.
    pub(super) fn push(&mut self, setpoint: &Setpoint) -> Result<(), Jump> {
        let knot = Knot::of(setpoint);
        if let Some(last) = self.last_setpoint() {
            if last.at_ns >= knot.at_ns {
                return Ok(());
            }
            let is_next = knot.at_ns - last.at_ns <= knot.period_ns + knot.period_ns / 4;
            let is_whole = is_next && !last.is_coasted;
            self.judge(last, &knot, is_whole).map_or(Ok(()), Err)?;
        }
        if self.queue.len() == QUEUE {
            self.queue.pop_front();
        }
        self.queue.push_back(knot);
        Ok(())
    }

    /// The last setpoint that is played or to be played. None while the joints coast: where they
    /// are when the next is taken up is not known before.
    fn last_setpoint(&self) -> Option<&Knot> {
        match &self.mode {
            Mode::Playing {
                from,
                coasting: false,
                ..
            } => Some(self.queue.back().unwrap_or(from)),
            _ => self.queue.back(),
        }
    }

    fn judge(&self, from: &Knot, to: &Knot, is_whole: bool) -> Option<Jump> {
        let span_t = seconds(to.at_ns, from.at_ns);
        let led = from.home & to.home;
        find_jump(
            &from.joints,
            &to.joints,
            span_t,
            &self.jumps,
            (is_whole, led),
        )
    }

    /// Begins anew at a setpoint at rest, at once.
    pub(super) fn stand_at(&mut self, setpoint: &Setpoint) {
        self.queue.clear();
        self.mode = Mode::Playing {
            from: Knot::of(setpoint),
            coasting: false,
        };
    }

    /// Forgets what was to come, and a stop.
    pub(super) fn reset(&mut self) {
        self.queue.clear();
        self.mode = Mode::Waiting;
    }

    pub(super) const fn is_stopping(&self) -> bool {
        matches!(self.mode, Mode::Stopping { .. })
    }

    /// Whether the last demand was for want of a setpoint.
    pub(super) const fn is_coasting(&self) -> bool {
        matches!(self.mode, Mode::Playing { coasting: true, .. })
    }

    /// The jump that the way back to the setpoints would have been, if that is why the joints stop.
    pub(super) const fn jump(&self) -> Option<Jump> {
        match &self.mode {
            Mode::Stopping { jump, .. } => *jump,
            _ => None,
        }
    }

    /// Begins the joints' own stop. Without a demand there is nothing to be stopped, and what was
    /// to come is forgotten.
    pub(super) fn stop(&mut self, now_ns: u64) {
        let joints = self.demand(now_ns);
        if self.is_stopping() {
            return;
        }
        match joints {
            Some(joints) => self.begin_stop(now_ns, &joints, None),
            None => self.reset(),
        }
    }

    fn begin_stop(&mut self, since_ns: u64, joints: &JointStates, jump: Option<Jump>) {
        let mut stops = [Stop::default(); AXES];
        for (stop, (joint, limits)) in stops.iter_mut().zip(joints.iter().zip(self.limits)) {
            *stop = Stop::new(*joint, limits);
        }
        self.mode = Mode::Stopping {
            since_ns,
            stops,
            jump,
        };
    }

    /// Begins the stop at a time that is past, and gives what the joints are to do now.
    fn stopped(
        &mut self,
        now_ns: u64,
        since_ns: u64,
        joints: &JointStates,
        jump: Option<Jump>,
    ) -> JointStates {
        self.begin_stop(since_ns, joints, jump);
        let Mode::Stopping { stops, .. } = self.mode else {
            return *joints;
        };
        stops.map(|stop| stop.at(seconds(now_ns, since_ns)))
    }

    /// What the joints are to do now. Times do not go back from call to call.
    pub(super) fn demand(&mut self, now_ns: u64) -> Option<JointStates> {
        self.take_up(now_ns);
        match self.mode {
            Mode::Waiting => None,
            Mode::Stopping {
                since_ns, stops, ..
            } => Some(stops.map(|stop| stop.at(seconds(now_ns, since_ns)))),
            Mode::Playing { from, coasting } => Some(self.play(from, coasting, now_ns)),
        }
    }

    /// Takes from the queue what has become the past.
    fn take_up(&mut self, now_ns: u64) {
        while let Some(next) = self.queue.front().copied() {
            match &mut self.mode {
                Mode::Stopping { .. } => self.queue.clear(),
                Mode::Playing {
                    from,
                    coasting: true,
                } => {
                    let half_ns = next.period_ns / 2;
                    if next.at_ns >= now_ns.saturating_add(half_ns) {
                        return;
                    }
                    self.queue.pop_front();
                    let leads_to_ns = next.at_ns.saturating_add(next.period_ns);
                    if self.queue.is_empty() && leads_to_ns >= now_ns.saturating_add(half_ns) {
                        // Too near to be gone to; where it leads in a period is not. Older ones
                        // count for nothing: if all are, patience ends.
                        from.heard_ns = from.heard_ns.max(next.heard_ns);
                        self.queue.push_front(next.coast(leads_to_ns));
                        return;
                    }
                }
                Mode::Playing {
                    from,
                    coasting: false,
                } => {
                    if next.at_ns > now_ns {
                        return;
                    }
                    let heard_ns = next.heard_ns.max(from.heard_ns);
                    *from = Knot { heard_ns, ..next };
                    self.queue.pop_front();
                }
                Mode::Waiting => {
                    if next.at_ns > now_ns {
                        return;
                    }
                    // One from long ago says nothing about now.
                    if now_ns - next.at_ns <= self.patience_ns {
                        self.mode = Mode::Playing {
                            from: next,
                            coasting: false,
                        };
                    }
                    self.queue.pop_front();
                }
            }
        }
    }

    fn play(&mut self, from: Knot, coasting: bool, now_ns: u64) -> JointStates {
        if let Some(to) = self.queue.front() {
            // The way between setpoints was judged when the second came.
            if coasting && let Some(jump) = self.judge(&from, to, false) {
                return self.stopped(now_ns, from.at_ns, &from.joints, Some(jump));
            }
            self.mode = Mode::Playing {
                from,
                coasting: false,
            };
            let (span_t, time_t) = (seconds(to.at_ns, from.at_ns), seconds(now_ns, from.at_ns));
            let mut joints = from.joints;
            for (joint, to) in joints.iter_mut().zip(&to.joints) {
                *joint = quintic(joint, to, span_t, time_t);
            }
            return joints;
        }
        if now_ns <= from.at_ns {
            return from.joints;
        }
        // The stop begins when patience ends, whenever this is called. At rest there is nothing to stop.
        let patience_ends_ns = if from.is_at_rest() {
            now_ns
        } else {
            from.heard_ns
                .saturating_add(self.patience_ns)
                .max(from.at_ns)
        };
        let coasted = from.coast(now_ns.min(patience_ends_ns));
        if now_ns <= patience_ends_ns {
            self.mode = Mode::Playing {
                from: coasted,
                coasting: true,
            };
            return coasted.joints;
        }
        self.stopped(now_ns, coasted.at_ns, &coasted.joints, None)
    }
}

/// Setpoints that wait for their time: far more than are ever under way.
const QUEUE: usize = 64;

#[allow(
    clippy::cast_precision_loss,
    reason = "differences of a few periods are exact"
)]
fn seconds(later_ns: u64, earlier_ns: u64) -> f64 {
    later_ns.saturating_sub(earlier_ns) as f64 * 1e-9
}
