//! The errors of planning: why an item cannot be planned.

use glidepath_geometry::Axis;

/// An error of an item given to the planner.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A coordinate or length is not a finite number.
    #[error("line {line}: the move has a coordinate that is not a finite number")]
    NotFinite {
        /// Source line.
        line: u32,
    },
    /// The segment does not start where the last one ended.
    #[error("line {line}: the move starts {gap_mm} mm away from where the last one ended")]
    Gap {
        /// Source line.
        line: u32,
        /// Largest difference of an axis, mm or degrees.
        gap_mm: f64,
    },
    /// The feedrate is not a positive number.
    #[error("line {line}: the feedrate {feed_v} mm/s is not a positive number")]
    Feed {
        /// Source line.
        line: u32,
        /// The rate, mm/s.
        feed_v: f64,
    },
    /// The tolerance is not a positive number.
    #[error("line {line}: the path tolerance {tolerance_mm} mm is not a positive number")]
    Tolerance {
        /// Source line.
        line: u32,
        /// The tolerance, mm.
        tolerance_mm: f64,
    },
    /// The dwell time is not a number ≥ 0.
    #[error("line {line}: the dwell of {dwell_t} s is not a number of seconds ≥ 0")]
    Dwell {
        /// Source line.
        line: u32,
        /// The time, s.
        dwell_t: f64,
    },
    /// An override is not a positive factor, or that of rapids is above 1.
    #[error(
        "the overrides {feed_r} (feed) and {rapid_r} (rapids) are not both positive, rapids at most 1"
    )]
    Override {
        /// Factor on feedrates.
        feed_r: f64,
        /// Factor on rapids.
        rapid_r: f64,
    },
    /// No motion was found from one frame to the next. This is a defect of the planner: the frames
    /// before it stand, and none follows.
    #[error(
        "line {line}: no motion within the limits was found; no frame after this line is given out"
    )]
    NoMotion {
        /// Source line.
        line: u32,
    },
    /// The motion that was found leads an axis out of its travel: where the program keeps inside that
    /// is a defect of the planner. The frames before it stand, and none follows.
    #[error(
        "line {line}: {axis} would go to {position}, beyond the end of its travel at {end}; no frame \
         after this line is given out"
    )]
    BeyondTravel {
        /// Source line.
        line: u32,
        /// The axis.
        axis: Axis,
        /// Where it would go, mm or degrees.
        position: f64,
        /// The soft limit, mm or degrees.
        end: f64,
    },
}
