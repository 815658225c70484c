//! The verdict on a motion.

use crate::along::AlongAudit;
use crate::event_places::EventPlaces;
use crate::joints::{JointAudit, WorstJoint};
use crate::limits::LimitAudit;
use crate::matching::Matching;
use crate::travel::TravelAudit;
use crate::tremor::TREMORS_ARE_VIOLATIONS;
use crate::violation::{KEPT_VIOLATIONS, Violation, Worst};
use glidepath_geometry::AxisVector;

/// The verdict on a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct AuditReport {
    /// Samples seen.
    pub samples: u64,
    /// Largest velocity over limit, of any axis.
    pub max_velocity_ratio: Worst,
    /// Largest acceleration over limit, of any axis.
    pub max_acceleration_ratio: Worst,
    /// Largest jerk over limit, of any axis.
    pub max_jerk_ratio: Worst,
    /// Velocity, acceleration and jerk of joints that are not the axes over their limits, where they were
    /// judged.
    pub max_joint_ratios: Option<[WorstJoint; 3]>,
    /// Largest path speed over programmed feed, between two samples.
    pub max_feed_ratio: Worst,
    /// Largest acceleration along and across the path and jerk along it, over their limits.
    pub max_path_ratios: [Worst; 3],
    /// Largest velocity of each axis, mm/s or °/s.
    pub max_velocity: AxisVector,
    /// Largest acceleration of each axis.
    pub max_acceleration: AxisVector,
    /// Largest jerk of each axis.
    pub max_jerk: AxisVector,
    /// How far an axis was beyond an end of its travel at most, mm or degrees; 0 if none was.
    pub max_beyond_travel_mm: f64,
    /// Largest distance met by a best matching of motion and program, both ways and in order, mm
    /// (degrees for rotary axes); not less than its resolution of 1e-6. Where the motion is out of
    /// tolerance it may be an over-estimate; the violation has the distance.
    pub max_deviation_mm: f64,
    /// Tick where it was met.
    pub max_deviation_tick: u64,
    /// Line where it was met.
    pub max_deviation_line: u32,
    /// Largest angle at a sample between the direction of the tool and the programmed one, degrees; `None` where it is
    /// not judged. The programmed one is the nearest of those that the motion can have come to there.
    pub max_direction_deg: Option<f64>,
    /// Line where it was met.
    pub max_direction_line: u32,
    /// The largest tolerance in force for a move of the program that uses it (G64), mm; the
    /// configured one if there is none.
    pub tolerance_mm: f64,
    /// The smallest one likewise, mm.
    pub least_tolerance_mm: f64,
    /// Whether the motion ran through the whole program, in order.
    pub is_complete: bool,
    /// Moves in the program.
    pub segments: u64,
    /// Length of the program's path, without the moves of rotary axes alone, mm.
    pub path_length_mm: f64,
    /// Path of the moves of rotary axes alone, degrees.
    pub turn_length_deg: f64,
    /// Tick at which motion starts: the last sample at the first position.
    pub first_motion_tick: u64,
    /// Tick at which the last motion ends.
    pub last_motion_tick: u64,
    /// How long the program takes, s: from the first to the last motion, with the dwells in between,
    /// before the first and, where the motion ran through all of it, behind the last.
    pub cycle_time_s: f64,
    /// Events that do not stop the motion.
    pub events: u64,
    /// How far from its place the motion was when one of them happened, at most, mm.
    pub max_event_off_mm: f64,
    /// The line of that event.
    pub max_event_off_line: u32,
    /// The same in the mean, mm.
    pub mean_event_off_mm: f64,
    /// Position of the last sample.
    pub final_position: AxisVector,
    /// The first violations, in the order found.
    pub violations: Vec<Violation>,
    /// All violations, kept or not.
    pub violation_count: u64,
    /// The first tremors ([`crate::tremor`]), in the order of their ticks.
    pub tremors: Vec<Violation>,
    /// All tremors, kept or not. They count as violations only if
    /// [`TREMORS_ARE_VIOLATIONS`](crate::tremor::TREMORS_ARE_VIOLATIONS).
    pub tremor_count: u64,
}

impl AuditReport {
    /// True if nothing was found.
    #[must_use]
    pub const fn is_clean(&self) -> bool {
        self.violation_count == 0
    }

    pub(crate) fn new(
        (limits, joints, travel): (&LimitAudit, Option<&JointAudit>, &TravelAudit),
        along: &AlongAudit,
        matching: &Matching,
        events: &EventPlaces,
    ) -> Self {
        let mut violations = limits.violations.kept.clone();
        let of_joints = joints.map(|joints| &joints.violations);
        violations.extend(
            of_joints
                .iter()
                .flat_map(|found| found.kept.iter().copied()),
        );
        violations.extend_from_slice(&travel.violations.kept);
        violations.extend_from_slice(&along.violations.kept);
        violations.extend_from_slice(&matching.violations.kept);
        let mut tremors = matching.tremors.kept.clone();
        tremors.sort_by_key(|tremor| tremor.tick);
        let mut hard_tremors = 0;
        if TREMORS_ARE_VIOLATIONS {
            violations.extend_from_slice(&tremors);
            hard_tremors = matching.tremors.count;
        }
        violations.sort_by_key(|violation| violation.tick);
        violations.truncate(KEPT_VIOLATIONS);
        let amount = matching.rows.amount();
        let [least_tolerance_mm, tolerance_mm] =
            (amount.tolerances_mm).unwrap_or_else(|| [matching.rows.max_tolerance_mm(); 2]);
        let [before_t, behind_t] = amount.rests_t;
        let behind_t = if matching.is_complete { behind_t } else { 0.0 };
        Self {
            samples: limits.samples,
            max_velocity_ratio: limits.worst[0],
            max_acceleration_ratio: limits.worst[1],
            max_jerk_ratio: limits.worst[2],
            max_joint_ratios: joints.map(|joints| joints.worst),
            max_feed_ratio: matching.max_feed,
            max_path_ratios: along.worst,
            max_velocity: limits.maxima[0],
            max_acceleration: limits.maxima[1],
            max_jerk: limits.maxima[2],
            max_beyond_travel_mm: travel.most,
            max_deviation_mm: matching.max_deviation.ratio,
            max_deviation_tick: matching.max_deviation.tick,
            max_deviation_line: matching.max_deviation.line,
            max_direction_deg: matching.rows.tool.map(|_| matching.max_turn.ratio),
            max_direction_line: matching.max_turn.line,
            tolerance_mm,
            least_tolerance_mm,
            is_complete: matching.is_complete,
            segments: amount.moves,
            path_length_mm: amount.path_length_mm,
            turn_length_deg: amount.turn_length_deg,
            first_motion_tick: limits.first_motion_tick.unwrap_or(0),
            last_motion_tick: limits.last_motion_tick,
            cycle_time_s: limits.motion_time_s() + before_t + behind_t,
            events: events.count,
            max_event_off_mm: events.most_off.0,
            max_event_off_line: events.most_off.1,
            mean_event_off_mm: events.mean_mm(),
            final_position: limits.last_position(),
            violations,
            violation_count: limits.violations.count
                + of_joints.map_or(0, |found| found.count)
                + travel.violations.count
                + along.violations.count
                + matching.violations.count
                + hard_tremors,
            tremors,
            tremor_count: matching.tremors.count,
        }
    }
}
