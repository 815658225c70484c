//! The rule of the feed that is kept: a line or an arc on which the feed was reached, and is reached again, is run at
//! the feed in between.

use super::matched_sample::MatchedSample;
use super::round::is_bound_by_feed;
use crate::piece::Shape;
use crate::settings::AuditSettings;
use crate::violation::{ViolationKind, ViolationList};
use glidepath_geometry::ROTARY_ABC;

/// Speed is the feed if it is off by no more than this share. One that is faster is none: at the corner from a slow move
/// to a rapid, the end of the slow one is driven faster than its feed.
const REACHED_R: f64 = 0.005;
/// A motion has slowed down if it is below the feed by more than this share: as far as that, it is a cruise.
const SLOW_R: f64 = 0.05;

/// A move that may be slowed down on.
#[derive(Debug)]
pub(crate) struct SlowDown {
    settings: AuditSettings,
    /// Speed along a move may be bound by joints, which no move asks the same of all along it.
    has_joints: bool,
    run: Option<Run>,
}

/// Samples in a row on one piece.
#[derive(Debug)]
struct Run {
    piece: u64,
    feed_v: f64,
    /// It was the feed.
    is_reached: bool,
    /// The slowest sample since, if it is slower than a cruise.
    slowest: Option<Slow>,
}

#[derive(Debug, Clone, Copy)]
struct Slow {
    tick: u64,
    line: u32,
    speed_v: f64,
}

impl SlowDown {
    pub(crate) const fn new(settings: &AuditSettings) -> Self {
        Self {
            settings: *settings,
            has_joints: false,
            run: None,
        }
    }

    /// On a machine whose joints are not its axes nothing is judged.
    pub(crate) const fn leave_to_joints(&mut self) {
        self.has_joints = true;
    }

    /// The next sample.
    pub(crate) fn next(&mut self, place: &MatchedSample, found: &mut ViolationList) {
        let Some(piece) = place.piece.as_ref().filter(|_| self.is_judged(place)) else {
            self.run = None;
            return;
        };
        #[allow(clippy::float_cmp, reason = "the feed of a piece is one number")]
        let goes_on = |run: &Run| run.piece == piece.number && run.feed_v == place.feed_v;
        self.run = self.run.take().filter(goes_on);
        let run = self.run.get_or_insert(Run {
            piece: piece.number,
            feed_v: place.feed_v,
            is_reached: false,
            slowest: None,
        });
        if (place.speed_v - place.feed_v).abs() <= REACHED_R * place.feed_v {
            run.is_reached = true;
            if let Some(slow) = run.slowest.take() {
                let kind = ViolationKind::SlowedDown {
                    speed_v: slow.speed_v,
                    feed_v: place.feed_v,
                };
                found.push(slow.tick, slow.line, kind);
            }
        } else if run.is_reached
            && place.speed_v < (1.0 - SLOW_R) * place.feed_v
            && run.slowest.is_none_or(|slow| place.speed_v < slow.speed_v)
        {
            run.slowest = Some(Slow {
                tick: place.tick,
                line: place.line,
                speed_v: place.speed_v,
            });
        }
    }

    /// Where the motion is on the program is not known any more.
    pub(crate) fn lose(&mut self) {
        self.run = None;
    }

    /// True where nothing but the feed bounds the speed: where program time runs at its own rate, on a line in
    /// space, or on an arc that leaves the axes room.
    fn is_judged(&self, place: &MatchedSample) -> bool {
        if self.has_joints
            || place.is_between_frames
            || place.ticks != 1
            || !place.feed_v.is_finite()
        {
            return false;
        }
        let Some(piece) = &place.piece else {
            return false;
        };
        // The least motion of X, Y and Z hides the speed of the rotary axes.
        if ROTARY_ABC.into_iter().any(|axis| !piece.still[axis]) {
            return false;
        }
        match piece.shape {
            Shape::Line => true,
            Shape::Arc { plane, center } => {
                let (first, second) = plane.axes();
                let off = |i: usize, center_mm: f64| place.position[i] - center_mm;
                let radius_mm = off(first.index(), center[0]).hypot(off(second.index(), center[1]));
                let limits = &self.settings.limits;
                radius_mm > 0.0
                    && is_bound_by_feed(place.feed_v, radius_mm, [first, second], limits)
            }
            Shape::Other => false,
        }
    }
}
