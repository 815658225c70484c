//! The part of a tick that adds the superposition to what program and hand ask for.

use super::state::Interpolator;
use crate::real_time::superposition::PathMotion;
use glidepath_link::{FaultCause, Setpoint};

impl Interpolator<'_> {
    /// Writes into the setpoint what the joints are to do for its axes and for what is superposed. On a machine with a
    /// superposition alone.
    #[cold]
    #[inline(never)]
    pub(super) fn write_superposed(&mut self, tick: u64, setpoint: &mut Setpoint) {
        self.superpose(setpoint);
        let Some(superposed) = &self.superposed else {
            return;
        };
        match self.output.write_superposed(setpoint, superposed) {
            Ok(written) => self.judge(written, tick),
            // As where nothing is superposed.
            Err(_) => self.fail(FaultCause::Output),
        }
    }

    /// Lets the offset go on by a period, and writes it.
    fn superpose(&mut self, setpoint: &mut Setpoint) {
        let path = self.path_motion(setpoint);
        let demand = self.drives.seen().superposition;
        let Some(superposed) = &mut self.superposed else {
            return;
        };
        if !self.track.is_empty() {
            superposed.step(setpoint, path, demand);
            superposed.hear(setpoint);
            self.offset_moves = !superposed.is_at_rest();
        }
        if let Some(slot) = setpoint.superposed.get_mut(superposed.axis().index()) {
            *slot = superposed.now().x;
        }
    }

    /// How the motion goes along its path.
    fn path_motion(&self, setpoint: &Setpoint) -> PathMotion {
        let is_hindered = self.requests.holds(self.is_rapid())
            || self.requests.is_stopping()
            || self.requests.retraces()
            || self.jog.owns_axes()
            || self.wait.is_standing();
        let programmed_v = self.track.frame(setpoint.sequence).map_or(0.0, |frame| {
            let next = self.track.frame(setpoint.sequence + 1);
            next.map_or(frame.programmed_v, |next| {
                frame.programmed_v.max(next.programmed_v)
            })
        });
        let (feed_override, _) = self.requests.overrides();
        let wanted_v = programmed_v * feed_override.abs();
        PathMotion {
            goes_on: !is_hindered && setpoint.feed_v > 0.0,
            is_probing: self.probing.is_looking(),
            feed_r: if wanted_v > 0.0 {
                setpoint.feed_v / wanted_v
            } else {
                0.0
            },
        }
    }

    /// The epoch has ended, and nothing moves: the offset is part of the position from now on.
    pub(super) fn take_superposed(&mut self) {
        let Some(superposed) = &mut self.superposed else {
            return;
        };
        let (axis, offset) = (superposed.axis(), superposed.now().x);
        superposed.forget();
        self.offset_moves = false;
        if offset != 0.0 {
            self.output.take_superposed(axis, offset);
        }
    }
}
