//! The check of continuity between setpoints: their numbers, their times, the limits of every axis
//! by finite differences, its travel, and whether an axis stands still that says it moves.

use super::axis_state::AxisState;
use super::finding::{Finding, Findings};
use super::led::Led;
use super::trace::LOST;
use crate::config::MachineConfig;
use bytemuck::Zeroable as _;
use glidepath_geometry::{AXES, Axis};
use glidepath_link::{MachineState, Record as _, Setpoint, Status};
use glidepath_program::Travel;

/// A limit counts as kept up to this factor, as in the audit of a plan.
const SLACK: f64 = 1.0 + 1e-6;
/// Rounding of a difference of third order, in units in the last place of the positions.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// An axis that says it goes further than this in a period does not repeat its position, mm or
/// degrees.
const GOES_MM: f64 = 1e-5;
/// Periods are told in whole nanoseconds; the clock is not asked.
const TIME_NS: u64 = 1000;

/// The judge of one setpoint after the other.
pub(super) struct Continuity {
    axes: Vec<AxisState>,
    period_ns: u64,
    period_t: f64,
    /// The last setpoint, and whether it was led by the drives.
    last: Option<(Setpoint, bool)>,
    led: Led,
    /// A joint did not know where it is, as a status told last.
    is_lost: bool,
    pub(super) findings: Findings,
    pub(super) setpoints: u64,
    /// The largest velocity, acceleration and jerk over its limit.
    pub(super) most: [f64; 3],
}

impl Continuity {
    pub(super) fn new(config: &MachineConfig) -> Self {
        let limits = config.axis_limits();
        let axes = config.axis_names().into_iter().map(|axis| {
            let i = axis.index();
            let of_axis = [limits.velocity[i], limits.acceleration[i], limits.jerk[i]];
            let travel = [limits.travel.lowest[i], limits.travel.highest[i]];
            AxisState::new(axis, of_axis, travel)
        });
        let superposed = config.superposition.iter().map(|of| AxisState {
            is_superposed: true,
            ..AxisState::new(of.axis, [of.velocity, of.acceleration, of.jerk], of.range)
        });
        Self {
            axes: axes.chain(superposed).collect(),
            period_ns: config.period_ns(),
            period_t: config.period_t(),
            last: None,
            led: Led::default(),
            is_lost: false,
            findings: Findings::default(),
            setpoints: 0,
            most: [0.0; 3],
        }
    }

    /// Takes what a status tells of the joints that know where they are.
    pub(super) fn know(&mut self, status: &Status) {
        self.is_lost = status.joints & !status.homed != 0;
        if self.last.is_none() && status.epoch != 0 {
            let mut began = Setpoint::zeroed();
            began.position = status.program_start;
            self.begin_at(&began);
        }
    }

    pub(super) fn take(&mut self, setpoint: &Setpoint) {
        self.setpoints += 1;
        if let Err(error) = setpoint.check() {
            self.find(setpoint, "broken", error.to_string());
        }
        let is_led = self.led.see(setpoint);
        if !is_led {
            self.judge_travel(setpoint);
        }
        let last = self.last.replace((*setpoint, is_led));
        // Another life of the interpolator, or a position that was taken over from the drives.
        let continues = |(last, _): &(Setpoint, bool)| {
            (last.boot_id, last.reference) == (setpoint.boot_id, setpoint.reference)
        };
        let Some((last, was_led)) = last.filter(continues) else {
            self.begin();
            return;
        };
        if setpoint.number <= last.number {
            let text = format!("setpoint {} comes after {}", setpoint.number, last.number);
            self.find(setpoint, "order", text);
            self.begin();
            return;
        }
        let missing = setpoint.number - last.number - 1;
        if missing > 0 {
            let text = format!(
                "{missing} setpoints are missing before number {}",
                setpoint.number
            );
            self.find(setpoint, "gap", text);
            self.begin();
        }
        self.judge_time(&last, setpoint, missing);
        if was_led || is_led {
            self.begin();
        } else {
            self.judge_motion(&last, setpoint, missing == 0);
        }
    }

    fn begin(&mut self) {
        for axis in &mut self.axes {
            axis.run = 0;
        }
    }

    fn find(&mut self, setpoint: &Setpoint, kind: &'static str, text: String) {
        let (tick, line) = (setpoint.tick, setpoint.line);
        self.findings.push(Finding {
            kind,
            tick,
            line,
            text,
        });
    }

    /// In a program every axis is inside its travel, but for what it swings over between two frames. One that stood
    /// outside when the program began goes no further out; by hand it is brought back. The ends of travel are places
    /// of a machine that knows where it is: on the way home, and before that, they mean nothing.
    fn judge_travel(&mut self, setpoint: &Setpoint) {
        let state = setpoint.state();
        let by_hand = setpoint.epoch == 0 || state == Ok(MachineState::Jogging);
        // Rows of values say nothing of epochs.
        let is_row = setpoint.boot_id == 0;
        // No program runs before all joints are at home: a status may be older than that.
        let is_out_of_program = matches!(
            state,
            Ok(MachineState::Idle | MachineState::Stopping | MachineState::Faulted)
        );
        let is_lost = state.is_ok_and(|state| LOST.contains(&state));
        let is_lost = is_lost || (self.is_lost && is_out_of_program);
        if (by_hand && !is_row) || is_lost {
            self.begin_at(setpoint);
            return;
        }
        self.watch_beginning(setpoint);
        let swing_per_jerk = Travel::SWING_R * self.period_t.powi(3);
        let beyond = self.axes.iter().find_map(|state| {
            let at = state.place(setpoint);
            let [low, high] = state.reach;
            let end = at.max(low).min(high);
            let most = if setpoint.is_between_frames() {
                state.limits[2] * swing_per_jerk + Travel::ROUNDING
            } else {
                Travel::ROUNDING
            };
            ((at - end).abs() > most).then(|| {
                let (name, off) = (state.name(), (at - end).abs());
                let unit = unit(state.axis);
                format!(
                    "{name} is at {at:.6}{unit}, {off:.6}{unit} beyond the end of its {} at {end}{unit}",
                    state.range_word()
                )
            })
        });
        if let Some(text) = beyond {
            self.find(setpoint, "limit", text);
        }
    }

    /// Where what is judged began: an epoch where the machine stood before it, what goes on behind a position that was
    /// taken over, or behind an offset that became part of it, where it is now.
    fn watch_beginning(&mut self, setpoint: &Setpoint) {
        let follows = |last: &Setpoint| {
            (last.boot_id, last.reference) == (setpoint.boot_id, setpoint.reference)
        };
        match self.last.map(|(last, _)| last) {
            Some(last) if follows(&last) && last.epoch == setpoint.epoch => {}
            Some(last) if follows(&last) => self.begin_at(&last),
            Some(_) => self.begin_at(setpoint),
            None if setpoint.state() == Ok(MachineState::Idle) => self.begin_at(setpoint),
            // In the middle of a program, of which statuses tell where it began.
            None => {}
        }
    }

    fn begin_at(&mut self, setpoint: &Setpoint) {
        for axis in &mut self.axes {
            axis.begin_at(axis.place(setpoint));
        }
    }

    fn judge_time(&mut self, last: &Setpoint, setpoint: &Setpoint, missing: u64) {
        if setpoint.tick <= last.tick {
            let text = format!("tick {} comes after {}", setpoint.tick, last.tick);
            self.find(setpoint, "order", text);
            return;
        }
        let ticks = setpoint.tick - last.tick;
        let told = setpoint.missed_ticks.saturating_sub(last.missed_ticks);
        if ticks != 1 + missing + told {
            let text =
                format!("{ticks} ticks since the setpoint before, and {told} told as missed");
            self.find(setpoint, "gap", text);
        }
        let passed_ns = setpoint.scheduled_ns.wrapping_sub(last.scheduled_ns);
        if passed_ns.abs_diff(ticks.saturating_mul(self.period_ns)) > TIME_NS {
            let text = format!("{passed_ns} ns pass in {ticks} periods");
            self.find(setpoint, "timing", text);
        }
        let ahead_ns = setpoint.apply_ns.wrapping_sub(setpoint.scheduled_ns);
        if ahead_ns.abs_diff(self.period_ns) > TIME_NS {
            let text = format!("it applies {ahead_ns} ns after its tick");
            self.find(setpoint, "timing", text);
        }
    }

    fn judge_motion(&mut self, last: &Setpoint, setpoint: &Setpoint, follows: bool) {
        let t = self.period_t;
        let mut found = Vec::new();
        for state in &mut self.axes {
            let (before, now) = (state.place(last), state.place(setpoint));
            state.magnitude = state.magnitude.max(now.abs());
            if !follows {
                continue;
            }
            let first = now - before;
            let second = first - state.differences[0];
            let third = second - state.differences[1];
            state.differences = [first, second];
            state.run += 1;
            let (axis, rounding) = (state.axis, ROUNDING * state.magnitude);
            let mut power = 1.0;
            let orders = [
                (first, "a velocity", "/s"),
                (second, "an acceleration", "/s²"),
                (third, "a jerk", "/s³"),
            ];
            for (order, (difference, name, per)) in (0_u32..).zip(orders) {
                power *= t;
                // Behind a gap a difference needs as many samples as its order, and one more.
                if state.run <= order {
                    continue;
                }
                let limit = state
                    .limits
                    .get(order as usize)
                    .copied()
                    .unwrap_or(f64::INFINITY);
                let ratio = (difference.abs() - rounding) / (limit * power);
                if let Some(most) = self.most.get_mut(order as usize) {
                    *most = most.max(ratio);
                }
                if ratio > SLACK {
                    let value = difference / power;
                    found.push((
                        "limit",
                        format!(
                            "{} has {name} of {value:.3}{}{per}, {ratio:.4} of its limit",
                            state.name(),
                            unit(axis)
                        ),
                    ));
                }
            }
            if state.is_superposed {
                continue;
            }
            let of = |values: &[f64; AXES]| values.get(axis.index()).copied().unwrap_or(0.0);
            // With a constant jerk this is how far it goes, exactly.
            let goes = (of(&last.velocity) + of(&setpoint.velocity)) * t / 2.0
                - (of(&setpoint.acceleration) - of(&last.acceleration)) * t * t / 12.0;
            if first == 0.0 && goes.abs() > GOES_MM {
                let v = of(&setpoint.velocity);
                found.push((
                    "frozen",
                    format!(
                        "{axis} stays at {now:.6}{unit} and says that it moves at {v:.3}{unit}/s",
                        unit = unit(axis)
                    ),
                ));
            }
        }
        for (kind, text) in found {
            self.find(setpoint, kind, text);
        }
    }
}

/// The unit of an axis, as it stands behind a number.
fn unit(axis: Axis) -> &'static str {
    if axis.is_rotary() { "°" } else { " mm" }
}

#[cfg(test)]
mod tests;
