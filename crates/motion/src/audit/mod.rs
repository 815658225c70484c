//! The auditor: judges a motion against its program and the machine's limits.
//!
//! It shares nothing with the planner but the evaluation of programmed segments, and trusts nothing
//! but positions. Fed with the program and the samples, each in order, it checks
//!
//! * every axis' velocity, acceleration and jerk by finite differences (`limits`), with the machine
//!   at rest before the first and after the last sample;
//! * the reported velocity and acceleration against those differences, and the sequence for gaps;
//! * the deviation, both ways and in order (`matching`): each sample and the straight line between
//!   two samples is within tolerance of the programmed path, each programmed point within tolerance
//!   of the motion, and both are passed in the same order;
//! * exact stops, dwells, the programmed feed, and that the path was run to its end.
//!
//! Memory is bounded by how far the program is fed ahead of the samples; work is linear in both.

mod along;
mod column;
mod free_space;
mod judge;
mod limits;
mod matching;
mod program;
mod report;
mod widen;

pub use report::{Inconsistency, Report, Violation, ViolationKind, Worst};

use crate::{Frame, Item, Limits};
use along::AlongAudit;
use glidepath_geometry::AxisVector;
use limits::LimitAudit;
use matching::Matching;

/// What a motion is judged by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AuditSettings {
    /// What each axis can do.
    pub limits: Limits,
    /// Interpolation period in seconds, > 0.
    pub period_t: f64,
    /// Tolerance in mm where the program gives none (G64 P), > 0: for XYZ together, for UVW
    /// together, and in degrees for each rotary axis.
    pub tolerance_mm: f64,
}

/// One sample of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Index on the period grid; consecutive.
    pub tick: u64,
    /// Source line, for reports.
    pub line: u32,
    /// Position, mm or degrees.
    pub position: AxisVector,
    /// Velocity and acceleration as reported, if they are to be checked.
    pub reported: Option<[AxisVector; 2]>,
}

/// A sample where it lies: a frame is not copied to be judged.
#[derive(Debug, Clone, Copy)]
struct Seen<'a> {
    tick: u64,
    line: u32,
    position: &'a AxisVector,
    reported: Option<[&'a AxisVector; 2]>,
}

impl<'a> From<&'a Sample> for Seen<'a> {
    fn from(sample: &'a Sample) -> Self {
        Self {
            tick: sample.tick,
            line: sample.line,
            position: &sample.position,
            reported: sample.reported.as_ref().map(|[v, a]| [v, a]),
        }
    }
}

impl<'a> From<&'a Frame> for Seen<'a> {
    fn from(frame: &'a Frame) -> Self {
        Self {
            tick: frame.sequence,
            line: frame.line,
            position: &frame.position,
            reported: Some([&frame.velocity, &frame.acceleration]),
        }
    }
}

impl From<&Frame> for Sample {
    fn from(frame: &Frame) -> Self {
        Self {
            tick: frame.sequence,
            line: frame.line,
            position: frame.position,
            reported: Some([frame.velocity, frame.acceleration]),
        }
    }
}

/// An audit under way.
///
/// Program items and samples may be fed in any interleaving that keeps each in order; what is
/// fed first waits for the other.
#[derive(Debug)]
pub struct Audit {
    limits: LimitAudit,
    along: AlongAudit,
    matching: Matching,
}

impl Audit {
    /// An audit with nothing seen yet.
    #[must_use]
    pub fn new(settings: &AuditSettings) -> Self {
        Self {
            limits: LimitAudit::new(settings),
            along: AlongAudit::new(settings),
            matching: Matching::new(settings),
        }
    }

    /// Allows the feed times a factor > 0: the largest override at which the motion was run.
    #[must_use]
    pub const fn with_override(mut self, factor: f64) -> Self {
        self.matching.feed_factor = factor;
        self
    }

    /// The next item of the program.
    pub fn program(&mut self, item: &Item) {
        self.matching.program(item);
    }

    /// The next sample of the motion.
    pub fn sample(&mut self, sample: &Sample) {
        self.see(&sample.into());
    }

    /// The next sample of the motion and its path position, whose limits are judged too.
    pub fn sample_at(&mut self, sample: &Sample, path_s: f64) {
        let seen = sample.into();
        self.along.sample(&seen, path_s);
        self.see(&seen);
    }

    /// The next sample of the motion: a frame, its path position and all.
    pub fn frame(&mut self, frame: &Frame) {
        let seen = frame.into();
        self.along.sample(&seen, frame.path_s);
        self.see(&seen);
    }

    fn see(&mut self, seen: &Seen<'_>) {
        self.limits.sample(seen);
        self.matching.sample(seen);
    }

    /// The verdict, after the last sample: the machine rests there from now on.
    #[must_use]
    pub fn finish(mut self) -> Report {
        self.matching.finish();
        self.limits.finish();
        Report::new(&self.limits, &self.along, &self.matching)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ItemKind, PathMode, Rate};
    use glidepath_geometry::{Arc, Plane, Segment};

    fn settings() -> AuditSettings {
        let limits = Limits::uniform(1e9, 1e9, 1e12);
        AuditSettings {
            limits,
            period_t: 0.004,
            tolerance_mm: 0.02,
        }
    }

    fn item(segment: Segment) -> Item {
        let mode = PathMode::Continuous { tolerance_mm: None };
        Item {
            line: 1,
            kind: ItemKind::Move {
                segment,
                rate: Rate::Rapid,
                mode,
            },
        }
    }

    fn spiral(k: u32) -> AxisVector {
        let angle = 0.002 * f64::from(k);
        let mut point = AxisVector::zeros();
        (point[0], point[1]) = (angle * angle.cos(), angle * angle.sin());
        point
    }

    #[test]
    fn a_long_program_is_audited_in_little_memory() {
        let mut audit = Audit::new(&settings());
        let mut most = 0;
        for k in 0..100_000 {
            audit.program(&item(Segment::line(spiral(k), spiral(k + 1))));
            let position = spiral(k);
            audit.sample(&Sample {
                tick: u64::from(k),
                line: 1,
                position,
                reported: None,
            });
            most = most.max(audit.matching.kept());
        }
        audit.sample(&Sample {
            tick: 100_000,
            line: 1,
            position: spiral(100_000),
            reported: None,
        });
        assert!(audit.finish().is_clean());
        assert!(most < 5000, "{most}");
    }

    #[test]
    fn an_arc_of_many_turns_is_audited_in_little_memory() {
        let start = spiral(10_000);
        let arc = Arc {
            start,
            end: start,
            plane: Plane::Xy,
            center: [0.0, 0.0],
            sweep_rad: core::f64::consts::TAU * 100.0,
        };
        let mut audit = Audit::new(&settings());
        audit.program(&item(Segment::Arc(arc)));
        let mut most = 0;
        for k in 0..=20_000_u32 {
            let position = arc.jet(arc.length() * f64::from(k) / 2e4).position;
            audit.sample(&Sample {
                tick: u64::from(k),
                line: 1,
                position,
                reported: None,
            });
            most = most.max(audit.matching.kept());
        }
        assert!(most < 5000, "{most}");
        let report = audit.finish();
        // Two hundred chords a turn.
        let sagitta = 20.0 * (1.0 - (core::f64::consts::PI / 200.0).cos());
        assert!(
            report.is_clean() && report.is_complete,
            "{:?}",
            report.violations
        );
        assert!(
            (report.max_deviation_mm - sagitta).abs() < 2e-6,
            "{}",
            report.max_deviation_mm
        );
    }
}
