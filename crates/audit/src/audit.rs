//! An audit under way: samples and items in, verdict out.

use crate::along::AlongAudit;
use crate::end::End;
use crate::event_places::EventPlaces;
use crate::joints::{JointAudit, JointBounds};
use crate::limits::LimitAudit;
use crate::matching::Matching;
use crate::report::AuditReport;
use crate::sample::{Sample, Seen};
use crate::settings::AuditSettings;
use crate::tool_axis::ToolAxis;
use crate::travel::TravelAudit;
use glidepath_program::{Event, Frame, Item};

/// An audit under way.
///
/// Program items and samples may be fed in any interleaving that keeps each in order; what is
/// fed first waits for the other.
#[derive(Debug)]
pub struct Audit {
    limits: LimitAudit,
    joints: Option<JointAudit>,
    period_t: f64,
    travel: TravelAudit,
    along: AlongAudit,
    matching: Matching,
    events: EventPlaces,
}

impl Audit {
    /// An audit with nothing seen yet.
    #[must_use]
    pub fn new(settings: &AuditSettings) -> Self {
        Self {
            limits: LimitAudit::new(settings),
            joints: None,
            period_t: settings.period_t,
            travel: TravelAudit::new(settings),
            along: AlongAudit::new(settings),
            matching: Matching::new(settings),
            events: EventPlaces::new(settings.period_t),
        }
    }

    /// Judges joints, too, J0 first: where they are has to be told ([`Audit::joints`]).
    #[must_use]
    pub fn with_joints(mut self, bounds: Vec<JointBounds>) -> Self {
        self.joints = Some(JointAudit::new(bounds, self.period_t));
        self.matching.slow_down.leave_to_joints();
        self
    }

    /// Judges the direction of the tool, too, and no longer the rotary axes that turn it so.
    #[must_use]
    pub fn with_tool(mut self, tool: Option<ToolAxis>) -> Self {
        if tool.is_some() {
            self.matching.slow_down.leave_to_joints();
        }
        self.matching.rows.tool = tool;
        self
    }

    /// Allows the feed times a factor > 0: the largest override at which the motion was run.
    #[must_use]
    pub const fn with_override(mut self, factor: f64) -> Self {
        self.matching.feed_factor = factor;
        self
    }

    /// From the samples that were not judged yet on, allows the feed times a factor, if that is more
    /// than it was: the operator has raised the override.
    pub const fn raise_override(&mut self, factor: f64) {
        self.matching.feed_factor = self.matching.feed_factor.max(factor);
    }

    /// The next item of the program.
    pub fn program(&mut self, item: &Item) {
        self.matching.program(item);
        self.events.program(item);
    }

    /// The next sample of the motion.
    pub fn sample(&mut self, sample: &Sample) {
        self.see(&sample.into());
    }

    /// Where the joints are at a tick, J0 first, mm or degrees. Ticks follow each other; of a motion that was
    /// not seen everywhere each part counts by itself.
    pub fn joints(&mut self, tick: u64, line: u32, positions: &[f64]) {
        if let Some(joints) = &mut self.joints {
            joints.sample(tick, line, positions);
        }
    }

    /// An event happens before the next sample, so many ns after the last one.
    pub fn event(&mut self, event: Event, offset_ns: u32) {
        self.events.happens(event, offset_ns);
    }

    /// The largest tolerance of the program so far, mm or degrees: how far a motion that goes back along its path may be
    /// from where it went before ([`crate::Passed`]), which is the chords of that.
    #[must_use]
    pub fn tolerance_mm(&self) -> f64 {
        self.matching.rows.max_tolerance_mm()
    }

    /// The next sample of the motion, away from the path: it is judged by limits and travel alone. The
    /// motion comes back to where it left the path.
    pub fn sample_away(&mut self, sample: &Sample) {
        let seen = sample.into();
        self.limits.sample(&seen);
        self.travel.sample(&seen);
        self.events.sample_away(&sample.position);
    }

    /// The next sample of the motion and its path position, whose limits are judged too.
    pub fn sample_at(&mut self, sample: &Sample, path_s: f64) {
        let seen = sample.into();
        self.along.sample(&seen, path_s);
        self.see(&seen);
    }

    /// The next sample of the motion: a frame, its events, its path position and all.
    pub fn frame(&mut self, frame: &Frame) {
        for told in frame.events.as_slice() {
            self.events.happens(told.event, told.offset_ns);
        }
        let seen = frame.into();
        self.along.sample(&seen, frame.path_s);
        self.see(&seen);
    }

    fn see(&mut self, seen: &Seen<'_>) {
        self.limits.sample(seen);
        self.travel.sample(seen);
        self.matching.sample(seen);
        self.events.sample(seen.position);
    }

    /// The verdict, after the last sample: the machine rests there from now on, at the end of the
    /// program.
    #[must_use]
    pub fn finish(self) -> AuditReport {
        self.finish_at(End::OfProgram)
    }

    /// The verdict on a motion that was ended before its program, or was not seen to the end: it is
    /// judged as far as it went, wherever that is.
    #[must_use]
    pub fn finish_early(self) -> AuditReport {
        self.finish_at(End::Anywhere)
    }

    fn finish_at(mut self, end: End) -> AuditReport {
        self.matching.finish(end);
        self.limits.finish();
        if let Some(joints) = &mut self.joints {
            joints.finish();
        }
        AuditReport::new(
            (&self.limits, self.joints.as_ref(), &self.travel),
            &self.along,
            &self.matching,
            &self.events,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::AxisTurn;
    use glidepath_geometry::{Arc, Axis, AxisVector, Plane, Segment};
    use glidepath_program::{ItemKind, Limits, PathMode, Rate};

    fn settings() -> AuditSettings {
        let limits = Limits::uniform(1e9, 1e9, 1e12);
        AuditSettings {
            limits,
            period_t: 0.004,
            tolerance_mm: 0.02,
            direction: glidepath_program::DirectionTolerance::default(),
            corners: glidepath_program::Corners::default(),
        }
    }

    fn item(segment: Segment) -> Item {
        let mode = PathMode::Continuous { tolerance_mm: None };
        Item {
            block: 0,
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
                is_between_frames: false,
            });
            most = most.max(audit.matching.kept());
        }
        audit.sample(&Sample {
            tick: 100_000,
            line: 1,
            position: spiral(100_000),
            reported: None,
            is_between_frames: false,
        });
        assert!(audit.finish().is_clean());
        assert!(most < 5000, "{most}");
    }

    #[test]
    fn what_is_away_from_the_path_is_judged_by_limits_alone() {
        let judged = |is_away: bool, jump_mm: f64| {
            let limits = Limits::uniform(100.0, 1e6, 1e9);
            let mut audit = Audit::new(&AuditSettings {
                limits,
                ..settings()
            });
            let to = AxisVector::x() * 0.2;
            audit.program(&item(Segment::line(AxisVector::zeros(), to)));
            let aside = AxisVector::z() * jump_mm;
            for (tick, position) in [to * 0.0, to * 0.5, to * 0.5 + aside, to * 0.5, to]
                .into_iter()
                .enumerate()
            {
                let sample = Sample {
                    tick: tick as u64,
                    line: 1,
                    position,
                    reported: None,
                    is_between_frames: false,
                };
                if is_away && tick == 2 {
                    audit.sample_away(&sample);
                } else {
                    audit.sample(&sample);
                }
            }
            audit.finish().is_clean()
        };
        assert!(!judged(false, 0.3));
        assert!(judged(true, 0.3));
        // 0.5 mm in 4 ms is too fast for 100 mm/s.
        assert!(!judged(true, 0.5));
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
                is_between_frames: false,
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

    /// C turns by a hundred rounds what leans by nothing, by less than the tolerance, and by more.
    #[test]
    fn a_turn_by_the_pole_is_audited_in_little_memory() {
        let turn = |axis, about| AxisTurn { axis, about };
        let tool = ToolAxis::new(&[
            turn(Axis::C, [0.0, 0.0, 1.0]),
            turn(Axis::A, [1.0, 0.0, 0.0]),
        ]);
        for (lean_deg, ticks, rows) in [
            (0.0, 4000_u32, 20),
            (0.009, 4000, 3000),
            (0.02, 4000, 3000),
            (45.0, 20_000, 3000),
        ] {
            let mut audit = Audit::new(&settings()).with_tool(Some(tool));
            let place = |share: f64| {
                let mut at = AxisVector::zeros();
                at[Axis::A.index()] = lean_deg;
                at[Axis::C.index()] = 36_000.0 * share;
                at
            };
            audit.program(&item(Segment::line(place(0.0), place(1.0))));
            let mut most = 0;
            for k in 0..=ticks {
                audit.sample(&Sample {
                    tick: u64::from(k),
                    line: 1,
                    position: place(f64::from(k) / f64::from(ticks)),
                    reported: None,
                    is_between_frames: false,
                });
                most = most.max(audit.matching.rows.kept());
            }
            assert!(most <= rows, "{lean_deg}: {most}");
            let report = audit.finish();
            let is_clean = report.is_clean() && report.is_complete;
            assert!(is_clean, "{lean_deg}: {:?}", report.violations);
        }
    }
}
