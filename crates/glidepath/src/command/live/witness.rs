//! The witness of what the machine was told to do: how near the setpoints of an epoch came to the limits of the axes,
//! how many of them there were, and how late.

use crate::config::MachineConfig;
use glidepath_geometry::{AXES, Axis};
use glidepath_link::{MachineState, Setpoint};
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
    before: Option<Setpoint>,
    epochs: VecDeque<Seen>,
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
        let limits = config.axis_limits();
        Self {
            axes: config.axis_names(),
            limits: [limits.velocity, limits.acceleration, limits.jerk].map(Into::into),
            period_t: config.period_t(),
            before: None,
            epochs: VecDeque::new(),
        }
    }

    /// Takes the next setpoint.
    pub(super) fn take(&mut self, setpoint: &Setpoint) {
        let is_next = |before: &Setpoint| {
            (before.boot_id, before.reference) == (setpoint.boot_id, setpoint.reference)
        };
        let before = self.before.replace(*setpoint).filter(is_next);
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
        let gap = before.map_or(0, |it| setpoint.number.saturating_sub(it.number + 1));
        seen.lost += gap;
        let missed = |it: &Setpoint| setpoint.missed_ticks.saturating_sub(it.missed_ticks);
        seen.missed_ticks += before.as_ref().map_or(0, missed);
        // Behind a gap nobody knows how the acceleration went.
        let jerk = |it: &Setpoint| {
            core::array::from_fn(|i| {
                (setpoint.acceleration[i] - it.acceleration[i]) / self.period_t
            })
        };
        let jerk = before.as_ref().filter(|_| gap == 0).map(jerk);
        let values = [
            setpoint.velocity,
            setpoint.acceleration,
            jerk.unwrap_or([0.0; AXES]),
        ];
        for ((most, values), limits) in seen.most.iter_mut().zip(values).zip(self.limits) {
            for axis in &self.axes {
                let i = axis.index();
                let part = values[i].abs() / limits[i];
                if part > most.0 {
                    *most = (part, i);
                }
            }
        }
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
            .zip(seen.most)
            .map(|(kind, (part, axis))| {
                let axis = self.axes.iter().find(|it| it.index() == axis);
                let object = json!({ "part": part, "axis": axis.map(ToString::to_string) });
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
        setpoint.sequence = number;
        setpoint.state = MachineState::Running.code();
        setpoint
    }

    #[test]
    fn the_largest_part_of_a_limit_is_told_with_its_axis() {
        let config = crate::config::load(None).unwrap();
        let mut witness = Witness::new(&config);
        let [_, limit_a, limit_j] = witness.limits;
        for number in 0..10_u32 {
            let mut now = setpoint(number.into(), 4);
            now.acceleration[1] = f64::from(number % 2) * 0.25 * limit_a[1];
            now.acceleration[2] = -0.5 * limit_a[2];
            now.lateness_ns = 1000 * u64::from(number);
            witness.take(&now);
        }
        // One that did not come, and a missed tick: the step of the acceleration in between is nobody's jerk.
        let mut behind = setpoint(11, 4);
        behind.acceleration[0] = 0.4 * limit_a[0];
        behind.missed_ticks = 1;
        witness.take(&behind);
        // Nothing of another job, or of a jog behind it.
        let mut jog = setpoint(12, 4);
        (jog.state, jog.velocity[0]) = (MachineState::Jogging.code(), 1e9);
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
        let close = |told: &Value, wanted: f64| (told.as_f64().unwrap() - wanted).abs() < 1e-9;
        assert!(
            close(&told["limits"]["acceleration"]["part"], 0.5),
            "{told}"
        );
        assert_eq!(told["limits"]["acceleration"]["axis"], "Z");
        let jerk = 0.25 * limit_a[1] / config.period_t() / limit_j[1];
        assert!(close(&told["limits"]["jerk"]["part"], jerk), "{told}");
        assert!(close(&told["late_us"], 9.0), "{told}");
        assert_eq!(witness.object(&(4..=5)).unwrap()["setpoints"], 12);
        assert_eq!(witness.object(&(6..=9)), None);
    }
}
