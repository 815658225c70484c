//! The outline of a file, from a first look: which motions are in it, and how they went.

use super::led::Led;
use super::trace::LOST;
use glidepath_geometry::AxisVector;
use glidepath_link::{EndOfEpoch, MachineState, Setpoint};

/// The outline of a file.
#[derive(Default)]
pub(super) struct Outline {
    /// Epochs with motion in them.
    pub(super) epochs: Vec<u64>,
    /// Whether the first of them is there from its beginning, and where it begins.
    pub(super) begin: Option<AxisVector>,
    pub(super) overrides: Option<(f64, f64)>,
    is_away: bool,
    /// Whether the motion went back along the path.
    pub(super) goes_back: bool,
    /// The machine came to the end of what it did.
    pub(super) is_idle: bool,
    /// The drives lost their power in the motion.
    pub(super) is_cut: bool,
    led: Led,
    pub(super) end: Option<EndOfEpoch>,
    pub(super) has_statuses: bool,
    /// Fingerprint of the program that was executed, and where the machine stood when it began.
    pub(super) program: Option<(u64, AxisVector)>,
}

impl Outline {
    pub(super) fn take(&mut self, setpoint: &Setpoint, last: Option<&Setpoint>) {
        let state = setpoint.state();
        self.is_idle = state == Ok(MachineState::Idle);
        let is_led = self.led.see(setpoint);
        self.is_cut |= is_led && self.epochs.last() == Some(&setpoint.epoch);
        // Behind a motion the machine rests in its epoch.
        let is_lost = state.is_ok_and(|state| LOST.contains(&state));
        if setpoint.epoch == 0 || self.is_idle || is_lost || is_led {
            return;
        }
        let is_new = self.epochs.last() != Some(&setpoint.epoch);
        if is_new {
            if self.epochs.is_empty() {
                let stood = last.map(|last| AxisVector::from(last.position));
                let begins = setpoint.sequence == 0 || stood.is_some();
                let place = stood.unwrap_or_else(|| setpoint.position.into());
                self.begin = begins.then_some(place);
            }
            self.epochs.push(setpoint.epoch);
        }
        self.goes_back |= setpoint.feed_v < 0.0;
        self.is_away |= setpoint.away.iter().any(|away| *away != 0.0);
        if state == Ok(MachineState::Running) {
            let now = setpoint.effective_override;
            let (least, most) = self.overrides.unwrap_or((now, now));
            self.overrides = Some((least.min(now), most.max(now)));
        }
    }

    /// Why the path is not judged by the program.
    pub(super) const fn unjudged(&self) -> Option<&'static str> {
        match (self.epochs.as_slice(), &self.begin) {
            ([], _) => Some("nothing moved: there is no path to judge"),
            ([_], None) => Some("it begins in the middle of the program: its path is not judged"),
            ([_], Some(_)) if self.is_away => {
                Some("axes left the path, by hand or into a tapped hole: it is not judged")
            }
            ([_], Some(_)) if self.goes_back => Some(
                "the motion went back along its path, and rows do not tell how far: it is not judged",
            ),
            ([_], Some(_)) => None,
            _ => Some("there are several motions in it: their paths are not judged"),
        }
    }
}
