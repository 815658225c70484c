//! The course of a jog: the axes move together along a straight line, or each for itself.
//!
//! From rest, and as long as what is wanted lies in the same direction, the axes go along a line at
//! limits that all of them can keep. When another direction is wanted while they move, each axis
//! takes its own way to its own velocity or place: that is quicker than to stop first, and nobody
//! expects a straight line then. At rest the next line begins.

use super::line::{AxesMotion, Line};
use super::travel::Travel;
use crate::shared::rest::SAME_POSITION;
use crate::shared::tracker::{Bounds, Motion, Profile, Target, Tracker};
use glidepath_geometry::{AXES, AxisVector};
use glidepath_program::Limits;

/// The goal of a course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Goal {
    /// Rest, wherever.
    Stop,
    /// To go on at these velocities, as far as travel allows.
    Speeds(AxisVector),
    /// To rest at a place.
    Place(AxisVector),
}

/// The axes, each for itself.
#[derive(Debug, Clone, Copy)]
struct Single {
    trackers: [Tracker; AXES],
    bounds: [Bounds; AXES],
}

/// How the axes move.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "nothing may be allocated, and there is one of it"
)]
enum MotionForm {
    Rest(AxisVector),
    Line(Line),
    Single(Single),
}

/// The limits of a jog.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JogLimits {
    /// Of the machine, with the velocities of jogging.
    pub(crate) jog: Limits,
    /// Most speed along the way that is wanted now, and of the mechanism where it is.
    pub(crate) most_v: f64,
    /// What the operator leaves of the speed, 0 to 1.
    pub(crate) override_ratio: f64,
}

/// A motion by hand.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JogMotion {
    way: MotionForm,
}

impl JogMotion {
    pub(crate) const fn at_rest(position: AxisVector) -> Self {
        Self {
            way: MotionForm::Rest(position),
        }
    }

    pub(crate) fn motion(&self) -> AxesMotion {
        match &self.way {
            MotionForm::Rest(position) => AxesMotion {
                position: *position,
                velocity: AxisVector::zeros(),
                acceleration: AxisVector::zeros(),
            },
            MotionForm::Line(line) => line.motion(),
            MotionForm::Single(single) => single.motion(),
        }
    }

    /// The direction of a motion along a line.
    pub(crate) const fn direction(&self) -> Option<&AxisVector> {
        match &self.way {
            MotionForm::Line(line) => Some(&line.direction),
            MotionForm::Rest(_) | MotionForm::Single(_) => None,
        }
    }

    /// Whether nothing moves.
    pub(crate) const fn is_resting(&self) -> bool {
        matches!(self.way, MotionForm::Rest(_))
    }

    /// Lets time pass.
    pub(crate) fn advance(&mut self, t: f64) {
        let has_ended = match &mut self.way {
            MotionForm::Rest(_) => false,
            MotionForm::Line(line) => {
                line.tracker.advance(t);
                is_done(&line.tracker)
            }
            MotionForm::Single(single) => {
                for tracker in &mut single.trackers {
                    tracker.advance(t);
                }
                single.trackers.iter().all(is_done)
            }
        };
        if has_ended {
            self.way = MotionForm::Rest(self.motion().position);
        }
    }

    /// Comes to rest as soon as possible.
    pub(crate) fn brake(&mut self) {
        match &mut self.way {
            MotionForm::Rest(_) => {}
            MotionForm::Line(line) => line.brake(),
            MotionForm::Single(single) => single.brake(),
        }
    }

    /// Sets out for a goal, inside travel and limits.
    pub(crate) fn aim(&mut self, goal: &Goal, travel: &Travel, limits: &JogLimits) {
        let position = self.motion().position;
        let (goal, vector) = match goal {
            Goal::Stop => {
                self.brake();
                return;
            }
            Goal::Speeds(speeds) => {
                let speeds = self.open_speeds(speeds, &position, travel);
                (Goal::Speeds(speeds), speeds)
            }
            Goal::Place(place) => (*goal, place - position),
        };
        let goal = &goal;
        if let MotionForm::Rest(position) = self.way {
            match Line::from_rest(position, &vector, &limits.jog) {
                Some(line) => self.way = MotionForm::Line(line),
                None => return,
            }
        }
        if let MotionForm::Line(line) = &mut self.way
            && aim_along(line, goal, travel, limits)
        {
            return;
        }
        let mut single = match &self.way {
            MotionForm::Single(single) => *single,
            MotionForm::Line(_) | MotionForm::Rest(_) => Single::from(&self.motion(), &limits.jog),
        };
        single.aim(goal, travel, limits);
        self.way = MotionForm::Single(single);
    }

    /// The velocities that are wanted, without those of axes that stand at the end of their travel.
    fn open_speeds(
        &self,
        speeds: &AxisVector,
        position: &AxisVector,
        travel: &Travel,
    ) -> AxisVector {
        let open = travel.open_to(position, speeds);
        match &self.way {
            MotionForm::Rest(_) => open,
            // One that is on its way to the end comes to rest there, together with the others.
            MotionForm::Line(line) => {
                open.zip_zip_map(speeds, &line.direction, |open, speed, along| {
                    if along == 0.0 { open } else { speed }
                })
            }
            MotionForm::Single(_) => *speeds,
        }
    }

    /// How the axes come to rest if they stop at once.
    pub(crate) fn stop(&self) -> Stop {
        match &self.way {
            MotionForm::Rest(position) => Stop::At(*position),
            MotionForm::Line(line) => Stop::Line(*line, line.tracker.stop(&line.bounds)),
            MotionForm::Single(single) => {
                let mut stops = [Profile::steady(Motion::at(0.0)); AXES];
                for ((stop, tracker), bounds) in
                    stops.iter_mut().zip(&single.trackers).zip(&single.bounds)
                {
                    *stop = tracker.stop(bounds);
                }
                Stop::Single(stops)
            }
        }
    }
}

/// Sets out along a line, if the goal lies on it.
fn aim_along(line: &mut Line, goal: &Goal, travel: &Travel, limits: &JogLimits) -> bool {
    let most_v = line.bounds.v.min(limits.most_v);
    let ratio = limits.override_ratio;
    let (low, high) = line.room(travel.lowest(), travel.highest());
    match goal {
        Goal::Stop => line.brake(),
        Goal::Speeds(speeds) => {
            let Some(v) = line.along(speeds) else {
                return false;
            };
            let end = if v < 0.0 { low } else { high };
            let most_v = v.abs().min(most_v) * ratio;
            if end.is_finite() {
                line.aim_at_way(end, None, most_v);
            } else {
                line.aim_at_speed(most_v.copysign(v));
            }
        }
        Goal::Place(place) => {
            let Some(way) = line.way_to(place) else {
                return false;
            };
            let inside = way.max(low).min(high);
            // A place at the end of travel is meant, whatever rounding makes of the way there.
            let (way, place) = if (inside - way).abs() <= SAME_POSITION {
                (way, Some(place))
            } else {
                (inside, None)
            };
            line.aim_at_way(way, place, most_v * ratio);
        }
    }
    true
}

impl Single {
    fn from(motion: &AxesMotion, limits: &Limits) -> Self {
        let start = |axis: usize| {
            let of = |vector: &AxisVector| vector.get(axis).copied().unwrap_or(0.0);
            Motion {
                x: of(&motion.position),
                v: of(&motion.velocity),
                a: of(&motion.acceleration),
            }
        };
        let bounds = |axis: usize| {
            let of = |vector: &AxisVector| vector.get(axis).copied().unwrap_or(f64::INFINITY);
            Bounds {
                v: of(&limits.velocity),
                a: of(&limits.acceleration),
                j: of(&limits.jerk),
            }
        };
        Self {
            trackers: core::array::from_fn(|axis| Tracker::new(start(axis))),
            bounds: core::array::from_fn(bounds),
        }
    }

    fn motion(&self) -> AxesMotion {
        let now = self.trackers.map(|tracker| tracker.now());
        AxesMotion {
            position: now.map(|motion| motion.x).into(),
            velocity: now.map(|motion| motion.v).into(),
            acceleration: now.map(|motion| motion.a).into(),
        }
    }

    fn brake(&mut self) {
        for (tracker, bounds) in self.trackers.iter_mut().zip(&self.bounds) {
            stop_axis(tracker, bounds);
        }
    }

    fn aim(&mut self, goal: &Goal, travel: &Travel, limits: &JogLimits) {
        // Of several velocities all are lowered, so that their direction stays.
        let part = match goal {
            Goal::Speeds(speeds) => (limits.most_v / speeds.norm()).min(1.0),
            Goal::Stop | Goal::Place(_) => 1.0,
        };
        let ratio = limits.override_ratio;
        let ends = travel.lowest().iter().zip(travel.highest());
        let axes = self.trackers.iter_mut().zip(&self.bounds).zip(ends);
        for (axis, ((tracker, bounds), (low, high))) in axes.enumerate() {
            let of = |vector: &AxisVector| vector.get(axis).copied().unwrap_or(0.0);
            match goal {
                Goal::Stop => stop_axis(tracker, bounds),
                Goal::Speeds(speeds) => {
                    let v = of(speeds) * part;
                    let end = if v < 0.0 { *low } else { *high };
                    let most = bounds.with_speed(bounds.v.min(v.abs()) * ratio);
                    if v == 0.0 {
                        stop_axis(tracker, bounds);
                    } else if end.is_finite() {
                        tracker.aim(Target::Rest(end), most);
                    } else {
                        tracker.aim(Target::Speed(most.v.copysign(v)), most);
                    }
                }
                Goal::Place(place) => {
                    let most = bounds.with_speed(bounds.v.min(limits.most_v) * ratio);
                    let to = of(place).max(*low).min(*high);
                    let stands = is_done(tracker) && (to - tracker.now().x).abs() <= 0.0;
                    // One that stands may be one that the machine does not have.
                    if !stands {
                        tracker.aim(Target::Rest(to), most);
                    }
                }
            }
        }
    }
}

/// Stops an axis. One that stands is left as it is: the machine may not have it, and then it has no
/// limits either.
fn stop_axis(tracker: &mut Tracker, bounds: &Bounds) {
    if !is_done(tracker) {
        tracker.aim(Target::Speed(0.0), *bounds);
    }
}

/// Whether a motion has ended at rest.
fn is_done(tracker: &Tracker) -> bool {
    let now = tracker.now();
    tracker.has_arrived() && now.v == 0.0 && now.a == 0.0
}

/// How the axes come to rest.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "nothing may be allocated, and it does not outlive the tick"
)]
pub(crate) enum Stop {
    At(AxisVector),
    Line(Line, Profile),
    Single([Profile; AXES]),
}

impl Stop {
    /// How long it takes, s.
    pub(crate) fn duration_t(&self) -> f64 {
        match self {
            Self::At(_) => 0.0,
            Self::Line(_, profile) => profile.duration_t(),
            Self::Single(stops) => stops.iter().map(Profile::duration_t).fold(0.0, f64::max),
        }
    }

    /// Where the axes are in the end.
    pub(crate) fn end(&self) -> AxisVector {
        match self {
            Self::At(position) => *position,
            Self::Line(line, profile) => line.place(profile.end().x),
            Self::Single(stops) => stops.map(|stop| stop.end().x).into(),
        }
    }

    /// Where the axes are after a time.
    pub(crate) fn at(&self, t: f64) -> AxisVector {
        match self {
            Self::At(position) => *position,
            Self::Line(line, profile) => line.place(profile.at(t).x),
            Self::Single(stops) => stops.map(|stop| stop.at(t).x).into(),
        }
    }

    /// The corners of the box that it stays in.
    pub(crate) fn extent(&self) -> (AxisVector, AxisVector) {
        match self {
            Self::At(position) => (*position, *position),
            Self::Line(line, profile) => {
                let (one, other) = profile.extent();
                let (one, other) = (line.place(one), line.place(other));
                (one.inf(&other), one.sup(&other))
            }
            Self::Single(stops) => {
                let extents = stops.map(|stop| stop.extent());
                (
                    extents.map(|(low, _)| low).into(),
                    extents.map(|(_, high)| high).into(),
                )
            }
        }
    }
}
