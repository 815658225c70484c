//! The witness of what the machine was told to do: how near the setpoints of an epoch came to the limits of the axes,
//! how many of them there were, and how late. Velocity, acceleration and jerk are finite differences of the positions at
//! the period: what a drive makes of them.

use crate::config::MachineConfig;
use glidepath_geometry::{AXES, Axis};
use glidepath_link::{MachineState, Setpoint};
use glidepath_program::Limits;
use serde_json::{Map, Value, json};
use std::collections::VecDeque;
use std::ops::RangeInclusive;

/// Epochs that are remembered. A job that probes has several.
const KEPT: usize = 64;
/// What is measured of every axis.
const KINDS: [&str; 3] = ["velocity", "acceleration", "jerk"];

/// Looks at every setpoint.
#[derive(Debug)]
pub(super) struct Witness {
    axes: Vec<Axis>,
    /// mm/s, mm/s², mm/s³, or the same of degrees.
    limits: [[f64; AXES]; 3],
    period_t: f64,
    before: Option<Before>,
    epochs: VecDeque<Seen>,
}

/// The setpoint before, and the finite differences of the positions up to it.
#[derive(Debug, Clone, Copy)]
struct Before {
    setpoint: Setpoint,
    velocity: [f64; AXES],
    acceleration: [f64; AXES],
    /// Setpoints without a gap up to it.
    count: u64,
}

/// What was seen of an epoch.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Seen {
    epoch: u64,
    /// It was seen from its first frame on.
    is_whole: bool,
    setpoints: u64,
    /// Setpoints that did not come here.
    lost: u64,
    missed_ticks: u64,
    late_ns: u64,
    /// The largest part of a limit, and the axis that it is of.
    most: [(f64, usize); 3],
}

impl Witness {
    pub(super) fn new(config: &MachineConfig) -> Self {
        // Joints limit an axis that has no limit of its own: what it does is no part of one.
        let limits = config.own_limits();
        Self {
            axes: config.axis_names(),
            limits: [limits.velocity, limits.acceleration, limits.jerk].map(|of| {
                <[f64; AXES]>::from(of).map(|limit| {
                    if limit < Limits::UNLIMITED {
                        limit
                    } else {
                        f64::INFINITY
                    }
                })
            }),
            period_t: config.period_t(),
            before: None,
            epochs: VecDeque::new(),
        }
    }

    /// Takes the next setpoint.
    pub(super) fn take(&mut self, setpoint: &Setpoint) {
        let before = self.before.filter(|before| {
            let before = &before.setpoint;
            (before.boot_id, before.reference) == (setpoint.boot_id, setpoint.reference)
        });
        let gap = before.map_or(0, |it| {
            setpoint.number.saturating_sub(it.setpoint.number + 1)
        });
        // Behind a missed tick the way is that of two.
        let is_next = |before: &Before| before.setpoint.tick + 1 == setpoint.tick;
        let (now, jerk) = self.differences(before.filter(is_next), setpoint);
        self.before = Some(now);
        if setpoint.epoch == 0 || !is_of_a_program(setpoint) {
            return;
        }
        if self.epochs.back().map(|seen| seen.epoch) != Some(setpoint.epoch) {
            if self.epochs.len() == KEPT {
                self.epochs.pop_front();
            }
            self.epochs.push_back(Seen::new(setpoint));
        }
        let Some(seen) = self.epochs.back_mut() else {
            return;
        };
        seen.setpoints += 1;
        seen.late_ns = seen.late_ns.max(setpoint.lateness_ns);
        seen.lost += gap;
        let missed = before.map_or(0, |it| {
            setpoint
                .missed_ticks
                .saturating_sub(it.setpoint.missed_ticks)
        });
        seen.missed_ticks += missed;
        let values = [now.velocity, now.acceleration, jerk];
        for ((most, values), limits) in seen.most.iter_mut().zip(values).zip(self.limits) {
            for (i, (value, limit)) in values.iter().zip(limits).enumerate() {
                let part = value.abs() / limit;
                if part > most.0 {
                    *most = (part, i);
                }
            }
        }
    }

    /// The finite differences of the positions at a setpoint. What a gap leaves unknown is 0.
    fn differences(&self, before: Option<Before>, setpoint: &Setpoint) -> (Before, [f64; AXES]) {
        let none = [0.0; AXES];
        let mut now = Before {
            setpoint: *setpoint,
            velocity: none,
            acceleration: none,
            count: 1,
        };
        let Some(before) = before else {
            return (now, none);
        };
        let rate = |to: &[f64; AXES], from: &[f64; AXES]| {
            let mut rate = none;
            for (rate, (to, from)) in rate.iter_mut().zip(to.iter().zip(from)) {
                *rate = (to - from) / self.period_t;
            }
            rate
        };
        now.count = before.count + 1;
        now.velocity = rate(&setpoint.position, &before.setpoint.position);
        if before.count > 1 {
            now.acceleration = rate(&now.velocity, &before.velocity);
        }
        let jerk = if before.count > 2 {
            rate(&now.acceleration, &before.acceleration)
        } else {
            none
        };
        (now, jerk)
    }

    /// What was seen of a job's epochs, as pages are told; `None` if nothing was.
    pub(super) fn object(&self, epochs: &RangeInclusive<u64>) -> Option<Value> {
        let of_job = self
            .epochs
            .iter()
            .filter(|seen| epochs.contains(&seen.epoch));
        let seen = of_job.copied().reduce(Seen::with)?;
        let limits: Map<String, Value> = KINDS
            .iter()
            .zip(seen.most.iter().zip(&self.limits))
            .map(|(kind, ((part, axis), limits))| {
                let axis = self
                    .axes
                    .iter()
                    .find(|it| *part > 0.0 && it.index() == *axis);
                let object = json!({
                    "part": part,
                    "axis": axis.map(ToString::to_string),
                    "has_limit": limits.iter().any(|limit| limit.is_finite()),
                });
                ((*kind).to_owned(), object)
            })
            .collect();
        #[expect(
            clippy::cast_precision_loss,
            reason = "counts and ns are exact below 2^53"
        )]
        let (told_t, late_us) = (
            seen.setpoints as f64 * self.period_t,
            seen.late_ns as f64 * 1e-3,
        );
        Some(json!({
            "is_whole": seen.is_whole,
            "setpoints": seen.setpoints,
            "told_s": told_t,
            "lost": seen.lost,
            "missed_ticks": seen.missed_ticks,
            "late_us": late_us,
            "limits": limits,
        }))
    }
}

/// Whether a program is under way, be it at rest.
fn is_of_a_program(setpoint: &Setpoint) -> bool {
    matches!(
        setpoint.state(),
        Ok(MachineState::Running
            | MachineState::Holding
            | MachineState::Held
            | MachineState::Starving
            | MachineState::Starved
            | MachineState::ProgramStop
            | MachineState::Stopping
            | MachineState::Waiting
            | MachineState::Awaiting)
    )
}

impl Seen {
    const fn new(first: &Setpoint) -> Self {
        Self {
            epoch: first.epoch,
            is_whole: first.sequence == 0,
            setpoints: 0,
            lost: 0,
            missed_ticks: 0,
            late_ns: 0,
            most: [(0.0, 0); 3],
        }
    }

    /// Both, one behind the other.
    fn with(self, next: Self) -> Self {
        let mut most = self.most;
        for (most, next) in most.iter_mut().zip(next.most) {
            if next.0 > most.0 {
                *most = next;
            }
        }
        Self {
            epoch: next.epoch,
            is_whole: self.is_whole && next.is_whole,
            setpoints: self.setpoints + next.setpoints,
            lost: self.lost + next.lost,
            missed_ticks: self.missed_ticks + next.missed_ticks,
            late_ns: self.late_ns.max(next.late_ns),
            most,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setpoint(number: u64, epoch: u64) -> Setpoint {
        let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
        (setpoint.number, setpoint.epoch) = (number, epoch);
        (setpoint.sequence, setpoint.tick) = (number, number);
        setpoint.state = MachineState::Running.code();
        setpoint
    }

    #[test]
    fn the_largest_part_of_a_limit_is_told_with_its_axis() {
        let config = crate::config::load(None).unwrap();
        let mut witness = Witness::new(&config);
        let [_, limit_a, limit_j] = witness.limits;
        let dt = witness.period_t;
        // X goes at a tenth of its jerk, Y with half of its acceleration.
        let places = |number: u32| {
            let t = f64::from(number) * dt;
            let y = 0.25 * limit_a[1] * t * t;
            [0.1 / 6.0 * limit_j[0] * t.powi(3), y]
        };
        for number in 0..10_u32 {
            let mut now = setpoint(number.into(), 4);
            (now.position[0], now.position[1]) = (places(number)[0], places(number)[1]);
            now.lateness_ns = 1000 * u64::from(number);
            witness.take(&now);
        }
        // One that did not come, and a missed tick: the way across the gap is nobody's velocity.
        let mut behind = setpoint(11, 4);
        behind.position[0] = 1e6;
        behind.missed_ticks = 1;
        witness.take(&behind);
        // Nothing of another job, or of a jog behind it.
        let mut jog = setpoint(12, 4);
        (jog.state, jog.position[0]) = (MachineState::Jogging.code(), 2e6);
        witness.take(&jog);
        witness.take(&setpoint(13, 5));
        let told = witness.object(&(4..=4)).unwrap();
        assert_eq!(
            (
                &told["setpoints"],
                &told["lost"],
                &told["missed_ticks"],
                &told["is_whole"]
            ),
            (&11.into(), &1.into(), &1.into(), &true.into())
        );
        let close = |told: &Value, wanted: f64| (told.as_f64().unwrap() - wanted).abs() < 1e-6;
        assert!(
            close(&told["limits"]["acceleration"]["part"], 0.5),
            "{told}"
        );
        assert_eq!(told["limits"]["acceleration"]["axis"], "Y");
        assert!(close(&told["limits"]["jerk"]["part"], 0.1), "{told}");
        assert_eq!(told["limits"]["jerk"]["axis"], "X");
        assert!(close(&told["late_us"], 9.0), "{told}");
        assert_eq!(witness.object(&(4..=5)).unwrap()["setpoints"], 12);
        assert_eq!(witness.object(&(6..=9)), None);
    }
}
