//! A segment that waits for what follows it.

use crate::joint::Leg;
use crate::merge::{Dropped, MERGE_SHARE_R};
use crate::override_::ProgrammedRate;
use crate::speed_limit;
use crate::{Event, PathMode, Rate, Settings, Smoothing};
use glidepath_geometry::Segment;

/// A segment whose end is not decided yet.
#[derive(Debug)]
pub(crate) struct Pending {
    pub segment: Segment,
    pub length_s: f64,
    pub rate: ProgrammedRate,
    /// The rate under the override at hand, where the segment can be driven at it.
    pub rate_v: f64,
    pub line: u32,
    pub mode: PathMode,
    /// Length at the start that the joint before has replaced.
    pub trimmed_s: f64,
    pub events: Vec<Event>,
    pub dropped: Dropped,
}

impl Pending {
    pub(crate) fn leg(&self) -> Leg<'_> {
        Leg {
            segment: &self.segment,
            mode: self.mode,
            length_s: self.length_s,
            rate_v: self.rate_v,
            error_mm: self.dropped.error_mm,
        }
    }

    /// Draws the next segment together with this one, if both are lines driven alike and the
    /// tolerance allows it.
    pub(crate) fn merge(&mut self, next: &Self, settings: &Settings) -> bool {
        let (Segment::Line(line), Segment::Line(following)) = (self.segment, next.segment) else {
            return false;
        };
        let alike = self.rate.rate == next.rate.rate
            && matches!(self.rate.rate, Rate::Feed(_))
            && self.mode == next.mode
            && matches!(self.mode, PathMode::Continuous { .. })
            && next.events.is_empty()
            && settings.smoothing != Smoothing::ExactStop;
        let allowed_mm = MERGE_SHARE_R * self.mode.tolerance_mm(settings);
        if !alike
            || !self
                .dropped
                .extend(&line.start, &line.end, &following.end, allowed_mm)
        {
            return false;
        }
        self.segment = Segment::line(line.start, following.end);
        self.length_s = self.segment.length();
        self.rate.axes_v = axes_speed(&self.segment, settings);
        true
    }
}

/// The speed at which some axis reaches its velocity limit, mm/s.
pub(crate) fn axes_speed(segment: &Segment, settings: &Settings) -> f64 {
    speed_limit::straight(&segment.jet(0.0).d1, f64::INFINITY, &settings.limits).top_v
}
