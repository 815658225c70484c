//! The rule of the cruise: at constant feed on a line or an arc, there is no jerk but that of the
//! piece.

use super::matched_sample::MatchedSample;
use super::round::is_bound_by_feed;
use super::settling::settling_ticks;
use crate::piece::{Piece, Shape};
use crate::settings::AuditSettings;
use crate::violation::{ViolationKind, ViolationList};
use glidepath_geometry::{AXES, Axis, AxisVector};
use std::collections::VecDeque;

/// A cruise goes on as long as speed is off the feed by no more than this share.
const FEED_R: f64 = 0.05;
/// It begins where speed comes as near as this to the feed, and ends where it was so near last: what
/// leads there and away is a ramp. On an arc, whose curvature takes its share of acceleration and jerk, a
/// ramp is longer in the band of [`FEED_R`] than the limits of the axes tell.
const REACHED_R: f64 = 0.005;
/// How far jerk may be off that of the piece, as a share of it.
const PIECE_SLACK_R: f64 = 0.1;
/// How far in addition, as a share of the limit of the axis.
const LIMIT_SLACK_R: f64 = 0.01;
/// Jerk below this share of what it may be off is not summed.
const QUIET_R: f64 = 0.1;

/// Most jerks of a run that are kept open: one whose speed is never the feed again has no end.
const MOST_OPEN: usize = 1 << 12;

/// A cruise under way.
#[derive(Debug)]
pub(crate) struct Cruise {
    settings: AuditSettings,
    run: Option<Run>,
}

/// Samples in a row on one piece, at its feed.
#[derive(Debug)]
struct Run {
    piece: Piece,
    feed_v: f64,
    /// When speed was the feed first.
    reached: Option<u64>,
    settling_ticks: u64,
    /// The last positions, newest first; only the first `known` count.
    recent: [AxisVector; 3],
    known: usize,
    /// Squares of the jerk that was too much, and when, by axis, over the settling time.
    heard: [VecDeque<(u64, f64)>; AXES],
    heard_ticks: u64,
    /// Too much jerk, as long as it is open whether the run goes on for the settling time.
    open: VecDeque<Jerk>,
}

#[derive(Debug, Clone, Copy)]
struct Jerk {
    tick: u64,
    line: u32,
    kind: ViolationKind,
}

impl Cruise {
    pub(crate) const fn new(settings: &AuditSettings) -> Self {
        Self {
            settings: *settings,
            run: None,
        }
    }

    /// The next sample.
    pub(crate) fn next(&mut self, place: &MatchedSample, found: &mut ViolationList) {
        let Some(piece) = place.piece.filter(|_| is_cruising(place)) else {
            self.run = None;
            return;
        };
        #[allow(clippy::float_cmp, reason = "the feed of a piece is one number")]
        let goes_on = self.run.as_ref().is_some_and(|run| {
            run.piece.number == piece.number && run.feed_v == place.feed_v && place.ticks == 1
        });
        if !goes_on {
            self.run = Some(self.begin(place, piece));
        }
        let Some(run) = &mut self.run else {
            return;
        };
        let is_reached = is_within(place, REACHED_R);
        if is_reached {
            run.reached = run.reached.or(Some(place.tick));
        }
        let is_settled = run
            .reached
            .is_some_and(|reached| place.tick - reached >= run.settling_ticks);
        if run.known == run.recent.len() && is_settled {
            let [p1, p2, p3] = run.recent;
            let third = place.position - 3.0 * (p1 - p2) - p3;
            let jerk = third / self.settings.period_t.powi(3);
            judge(run, place, &jerk, &self.settings);
        }
        let [p1, p2, _] = run.recent;
        run.recent = [place.position, p1, p2];
        run.known = (run.known + 1).min(run.recent.len());
        if !is_reached {
            return;
        }
        let settled = place.tick.saturating_sub(run.settling_ticks);
        while let Some(jerk) = run.open.front().copied().filter(|jerk| jerk.tick < settled) {
            found.push(jerk.tick, jerk.line, jerk.kind);
            run.open.pop_front();
        }
    }

    /// Where the motion is on the program is not known any more.
    pub(crate) fn lose(&mut self) {
        self.run = None;
    }

    fn begin(&self, place: &MatchedSample, piece: Piece) -> Run {
        // The feed is reached with the acceleration and the jerk of the slowest axis; twice that time is
        // left to a motion that uses less of them.
        let limits = &self.settings.limits;
        let mut slowest = [limits.path.tangential_a, limits.path.jerk_j];
        for axis in (0..piece.still.len()).filter(|&axis| !piece.still[axis]) {
            slowest[0] = slowest[0].min(limits.acceleration[axis]);
            slowest[1] = slowest[1].min(limits.jerk[axis]);
        }
        let lacking_v = REACHED_R * place.feed_v;
        let ramp_t = lacking_v / slowest[0] + (2.0 * lacking_v / slowest[1]).sqrt();
        Run {
            piece,
            feed_v: place.feed_v,
            reached: None,
            settling_ticks: settling_ticks(self.settings.period_t, 2.0 * ramp_t),
            recent: [AxisVector::zeros(); 3],
            known: 0,
            heard: core::array::from_fn(|_| VecDeque::new()),
            heard_ticks: settling_ticks(self.settings.period_t, 0.0),
            open: VecDeque::new(),
        }
    }
}

/// True if the speed is the programmed feed.
fn is_cruising(place: &MatchedSample) -> bool {
    // A rapid has no feed, and what jumps may be infinitely fast.
    place.feed_v.is_finite() && is_within(place, FEED_R)
}

/// True if the speed is off the feed by no more than a share of it.
fn is_within(place: &MatchedSample, share_r: f64) -> bool {
    (place.speed_v - place.feed_v).abs() <= share_r * place.feed_v
}

/// Keeps what there is too much of jerk at a sample: of the pair of axes of an arc together, of any
/// other axis by itself.
fn judge(run: &mut Run, place: &MatchedSample, jerk: &AxisVector, settings: &AuditSettings) {
    let limit_j = &settings.limits.jerk;
    let mut round = None;
    if let Shape::Arc { plane, center } = run.piece.shape {
        let (first, second) = plane.axes();
        let pair = |of: &AxisVector| [of[first.index()], of[second.index()]];
        // A third difference belongs to the middle of its four positions.
        let [p1, p2, _] = run.recent;
        let (later, earlier) = (pair(&p1), pair(&p2));
        let way = [later[0] - earlier[0], later[1] - earlier[1]];
        let way_mm = way[0].hypot(way[1]);
        let from_center = |i: usize| 0.5 * (later[i] + earlier[i]) - center[i];
        let radius_mm = from_center(0).hypot(from_center(1));
        if way_mm <= 0.0 || radius_mm <= 0.0 {
            return;
        }
        if !is_bound_by_feed(run.feed_v, radius_mm, [first, second], &settings.limits) {
            return;
        }
        // The jerk of a circle is against its direction.
        let piece_j = (way_mm / settings.period_t).powi(3) / (radius_mm * radius_mm);
        let jerk = pair(jerk);
        let over = |i: usize| jerk[i] + piece_j * way[i] / way_mm;
        let slack_j = LIMIT_SLACK_R * limit_j[first.index()].min(limit_j[second.index()]);
        let allowed_j = PIECE_SLACK_R * piece_j + slack_j;
        run.hear(place, first, over(0).hypot(over(1)), allowed_j);
        round = Some((first, second));
    }
    for axis in Axis::ALL {
        let is_round = round.is_some_and(|(first, second)| axis == first || axis == second);
        if !is_round {
            let i = axis.index();
            run.hear(place, axis, jerk[i].abs(), LIMIT_SLACK_R * limit_j[i]);
        }
    }
}

impl Run {
    /// Takes note of what jerk of an axis is too much, and keeps it if that is no single step.
    fn hear(&mut self, place: &MatchedSample, axis: Axis, over_j: f64, allowed_j: f64) {
        // What is far below leaves the mean as it is, and is nearly all there is.
        if over_j <= QUIET_R * allowed_j {
            return;
        }
        let heard = &mut self.heard[axis.index()];
        heard.push_back((place.tick, over_j * over_j));
        let first = (place.tick + 1).saturating_sub(self.heard_ticks);
        while heard.front().is_some_and(|(tick, _)| *tick < first) {
            heard.pop_front();
        }
        if over_j <= allowed_j {
            return;
        }
        // A swing has the square of its amplitude twice in the mean square.
        let squares = heard.iter().map(|(_, square)| square);
        let mean_j2 = squares.sum::<f64>() / self.heard_ticks as f64;
        if 2.0 * mean_j2 > allowed_j * allowed_j {
            let kind = ViolationKind::Unsteady {
                axis,
                over_j,
                allowed_j,
            };
            if self.open.len() >= MOST_OPEN {
                self.open.pop_front();
            }
            self.open.push_back(Jerk {
                tick: place.tick,
                line: place.line,
                kind,
            });
        }
    }
}
