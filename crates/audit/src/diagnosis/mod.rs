//! Diagnosis: which limit keeps a motion from being faster, where, and what that costs.
//!
//! Fed with the program and the frames, each in order, like the [auditor](crate::Audit), it tells
//! for every period which limit is used fully ([`Binding`]), and in the end the share of time of
//! each and the places where most time is lost against the programmed feed. It judges what it
//! sees, whoever planned it: positions by finite differences, the deviation from the program, the
//! speed told. Beside that it tells how smooth the motion is, in all and where the feed binds
//! ([`crate::smoothness`]), and how true its shape is ([`crate::shape`]).
//!
//! Work is linear in frames and items; memory is bounded by how far the program is fed ahead.

mod binding;
mod differences;
mod joint_differences;
mod places;

pub use binding::Binding;
pub use places::SlowPlace;

use crate::AuditSettings;
use crate::follow::{Follow, Nearby};
use crate::joints::JointBounds;
use crate::passed_points::PassedPoints;
use crate::shape::{Shape, ShapeReport};
use crate::smoothness::{Smoothness, SmoothnessReport};
use binding::COUNT;
use differences::Differences;
use glidepath_geometry::Axis;
use glidepath_program::{Frame, FrameFlags, Item};
use joint_differences::JointDifferences;
use places::{Places, Visit};

/// A limit counts as used fully from this share on. Plans keep some parts in a thousand below.
const FULLY_R: f64 = 0.98;
/// The same of a joint. Along a piece of a path plans keep to what its joints can do where they can do least, so that
/// they are some parts in a hundred below on the rest of it.
const JOINT_FULLY_R: f64 = 0.95;

/// A diagnosis under way.
#[derive(Debug)]
pub struct Diagnosis {
    differences: Differences,
    /// Of the joints, where they are not the axes.
    joints: Option<JointDifferences>,
    period_t: f64,
    follow: Follow,
    passed: PassedPoints,
    counts: [u64; COUNT],
    places: Places,
    smoothness: Smoothness,
    shape: Shape,
    deviation: Deviation,
    feed_v: f64,
}

/// The distance between motion and program at a frame, and how large it may be.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deviation {
    /// The deviation at the frame, mm, both ways, as the [auditor](crate::Audit) means it: how far the frame is from
    /// the program, or how far the motion stays from a point of the program that it has just passed, if that is more.
    /// The largest of a motion is what the auditor finds.
    pub distance_mm: f64,
    /// Tolerance there, mm.
    pub tolerance_mm: f64,
}

/// The result of a diagnosis.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Share of the time for which each limit binds, largest first; those that never do left out.
    pub shares: Vec<(Binding, f64)>,
    /// The places where most time is lost against the programmed feed, the worst first, at most
    /// ten.
    pub slowest: Vec<SlowPlace>,
    /// How smooth the motion is, in all and where the feed binds.
    pub smoothness: SmoothnessReport,
    /// How true the shape of the motion is.
    pub shape: ShapeReport,
}

impl Diagnosis {
    /// A diagnosis with nothing seen yet.
    #[must_use]
    pub fn new(settings: &AuditSettings) -> Self {
        Self {
            differences: Differences::new(&settings.limits, settings.period_t),
            joints: None,
            period_t: settings.period_t,
            follow: Follow::new(settings),
            passed: PassedPoints::default(),
            counts: [0; COUNT],
            places: Places::new(settings.period_t),
            smoothness: Smoothness::new(settings.period_t),
            shape: Shape::new(settings.corners),
            deviation: Deviation::default(),
            feed_v: 0.0,
        }
    }

    /// A diagnosis that tells of joints, too, where they are not the axes: [`joints`](Self::joints) is to be told where
    /// they are.
    #[must_use]
    pub fn with_joints(mut self, bounds: &[JointBounds]) -> Self {
        self.joints = Some(JointDifferences::new(bounds, self.period_t));
        self
    }

    /// Where the joints are at the next frame, mm or degrees: before that frame, or its passing, is told.
    pub fn joints(&mut self, positions: &[f64]) {
        if let Some(joints) = &mut self.joints {
            joints.next(positions);
        }
    }

    /// A motion begins where the joints are now.
    fn begin_joints(&mut self) {
        if let Some(joints) = &mut self.joints {
            joints.rest();
        }
    }

    /// The next item of the program.
    pub fn program(&mut self, item: &Item) {
        self.follow.program(item);
        self.shape.program(item);
    }

    /// The next frame is passed again, on a way back or onward again: it is not diagnosed once more.
    pub fn pass(&mut self, frame: &Frame) {
        self.differences.next(&frame.position, false);
        self.passed.pass(&frame.position);
        self.smoothness.pass(&frame.position);
    }

    /// The next frame; tells what binds in the period that it ends. The program must have been fed
    /// as far as the frame is.
    pub fn frame(&mut self, frame: &Frame) -> Binding {
        let is_first = frame.flags.contains(FrameFlags::FIRST);
        self.differences.next(&frame.position, is_first);
        if is_first {
            self.begin_joints();
        }
        let is_at_rest = self.differences.is_at_rest();
        let nearby = self.follow.to(frame);
        self.shape.next(&frame.position, frame.line, &self.follow);
        let binding = if is_at_rest {
            Binding::Rest
        } else {
            let used = (&self.differences, self.joints.as_ref());
            classify(frame.path_v, used, (&nearby, &self.follow))
        };
        let deviation_mm = self.follow.least_deviation_mm();
        let (passed, earliest) = (self.follow.passed(), self.follow.earliest());
        let mut missed_mm = self.passed.next(&frame.position, passed, earliest);
        if frame.flags.contains(FrameFlags::LAST) {
            missed_mm = missed_mm.max(self.passed.rest());
        }
        self.deviation = Deviation {
            distance_mm: deviation_mm.max(missed_mm),
            tolerance_mm: nearby.tolerance_mm,
        };
        self.feed_v = nearby.feed_v;
        let is_at_feed = binding == Binding::Feed;
        self.smoothness
            .next(&frame.position, is_at_feed, deviation_mm);
        if let Some(count) = self.counts.get_mut(binding.index())
            && !is_first
        {
            *count += 1;
        }
        let waits = [
            FrameFlags::DWELL,
            FrameFlags::PROGRAM_STOP,
            FrameFlags::LAST,
        ];
        let is_wait = is_first || waits.iter().any(|&flag| frame.flags.contains(flag));
        self.places.next(&Visit {
            sequence: frame.sequence,
            line: frame.line,
            speed_v: if is_at_rest { 0.0 } else { frame.path_v },
            feed_v: nearby.feed_v,
            binding,
            is_wait,
        });
        binding
    }

    /// The distance between motion and program at the last frame.
    #[must_use]
    pub const fn deviation(&self) -> Deviation {
        self.deviation
    }

    /// The speed that the program wants at the last frame, overrides included, mm/s; infinite for a
    /// rapid at 100 %, and where there is no program.
    #[must_use]
    pub const fn feed_v(&self) -> f64 {
        self.feed_v
    }

    /// The summary, after the last frame.
    #[must_use]
    pub fn finish(mut self) -> Summary {
        let total: u64 = self.counts.iter().sum();
        #[allow(clippy::cast_precision_loss, reason = "shares, for people")]
        let share = |count: u64| count as f64 / total.max(1) as f64;
        let mut shares: Vec<_> = Binding::all()
            .zip(self.counts)
            .filter(|&(_, count)| count > 0)
            .map(|(binding, count)| (binding, share(count)))
            .collect();
        // Stable: equal shares keep their order.
        shares.sort_by(|a, b| b.1.total_cmp(&a.1));
        Summary {
            shares,
            slowest: self.places.finish(),
            smoothness: self.smoothness.report(),
            shape: self.shape.report(),
        }
    }
}

/// What binds in a period: of the limits that are used fully, the one whose change would help
/// first. The feed and the velocity of an axis bind whatever else does; acceleration and jerk bind
/// only until a speed is reached; the tolerance binds where none of them does.
fn classify(
    path_v: f64,
    (used, joints): (&Differences, Option<&JointDifferences>),
    (nearby, follow): (&Nearby, &Follow),
) -> Binding {
    if path_v >= FULLY_R * nearby.feed_v {
        return Binding::Feed;
    }
    let of_axes: [fn(Axis) -> Binding; 3] =
        [Binding::Velocity, Binding::Acceleration, Binding::Jerk];
    let of_joints: [fn(usize) -> Binding; 3] = [
        Binding::JointVelocity,
        Binding::JointAcceleration,
        Binding::JointJerk,
    ];
    let by_joints = joints.map_or([None; 3], JointDifferences::ratios);
    for (order, by_axis) in used.ratios().into_iter().enumerate() {
        let axis = by_axis.filter(|(_, ratio)| *ratio >= FULLY_R);
        let joint = by_joints[order].filter(|(_, ratio)| *ratio >= JOINT_FULLY_R);
        match (axis, joint) {
            (Some((_, of_axis)), Some((joint, of_joint))) if of_joint >= of_axis => {
                return of_joints[order](joint);
            }
            (Some((axis, _)), _) => return of_axes[order](axis),
            (None, Some((joint, _))) => return of_joints[order](joint),
            (None, None) => {}
        }
    }
    let chord_mm = used.chord_mm();
    let deviation_mm = follow.deviation_mm();
    let both_mm = deviation_mm + chord_mm;
    // The middle of a chord is off the path by up to both together.
    if both_mm < FULLY_R * nearby.tolerance_mm {
        Binding::None
    } else if chord_mm > deviation_mm {
        Binding::ChordError
    } else {
        Binding::Tolerance
    }
}
