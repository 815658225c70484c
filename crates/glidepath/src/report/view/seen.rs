//! The content of the view: what is known of a machine that works.

use super::ahead::Ahead;
use crate::report::machine::AwaitedEvent;
use crate::report::work_offset::WorkOffset;
use core::time::Duration;
use glidepath_geometry::Axis;
use glidepath_link::{Auxiliary, Status};

/// The place of the machine in a program that is known.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProgramPlace {
    /// The program's name.
    pub program: String,
    /// Text of the line that is executed; empty if it is not known.
    pub text: String,
    /// How long the whole of it takes, s; `None` while that is not known yet.
    pub planned_t: Option<f64>,
    /// How much of that is done, s.
    pub elapsed_t: Option<f64>,
    /// The rest of it; `None` while how long the whole takes is not known yet.
    pub ahead: Option<Ahead>,
    /// It is on its way to where that much counts as done: to the line that it is to begin with. How long the way takes
    /// is not known.
    pub is_on_its_way: bool,
    /// It could not be planned here.
    pub has_failed: bool,
}

/// The content of the view.
#[derive(Debug)]
pub struct View<'a> {
    /// Name of the machine's instance.
    pub instance: &'a str,
    /// What the interpolator says.
    pub status: &'a Status,
    /// What spindle, coolant and tool are to do; `None` if nobody said yet.
    pub auxiliary: Option<&'a Auxiliary>,
    /// What the machine waits for.
    pub asked: AwaitedEvent,
    /// The machine's axes.
    pub axes: &'a [Axis],
    /// Those that do not know where they are: their positions mean nothing yet.
    pub not_homed: &'a [Axis],
    /// Where it is in the program; `None` if that is not known.
    pub place: Option<ProgramPlace>,
    /// The coordinate system in force; `None` if none is kept.
    pub offsets: Option<WorkOffset>,
    /// What happened lately, the newest first, and how long ago.
    pub events: Vec<(Duration, String)>,
}

/// A time as people read it: 1:02:03, 2:03 or 3.4 s.
pub(super) fn clock(t: f64) -> String {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a time that is not negative"
    )]
    let s = t.max(0.0).round() as u64;
    match (s / 3600, s / 60 % 60, s % 60) {
        (0, 0, _) if t < 10.0 => format!("{t:.1} s"),
        (0, 0, s) => format!("{s} s"),
        (0, min, s) => format!("{min}:{s:02}"),
        (h, min, s) => format!("{h}:{min:02}:{s:02}"),
    }
}

impl View<'_> {
    /// What is done of the program, 0 to 1.
    pub(super) fn progress(&self) -> Option<f64> {
        let place = self.place.as_ref()?;
        let (all, done) = (place.planned_t?, place.elapsed_t?);
        (all > 0.0).then(|| (done / all).clamp(0.0, 1.0))
    }

    /// How long it takes yet under the present overrides, s.
    pub(super) fn left_t(&self) -> Option<f64> {
        let place = self.place.as_ref()?;
        if place.is_on_its_way {
            return None;
        }
        self.left_behind_t()
    }

    /// The same from the place on that [`ProgramPlace::elapsed_t`] tells.
    pub(super) fn left_behind_t(&self) -> Option<f64> {
        self.place.as_ref()?.ahead?.lasting_t(self.status)
    }
}
