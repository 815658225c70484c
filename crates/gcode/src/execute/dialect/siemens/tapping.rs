//! CYCLE84: a hole that is tapped rigidly.
//!
//! From SDIS above the surface behind the spindle to the bottom and out again, then to RTP. The
//! pitch is PIT, or that of the metric thread MPIT (3: M3); below zero it is a left-hand one.

use crate::diagnostic::fault::Outcome;
use crate::execute::dialect::siemens::cycle::{Arguments, Lines, plane_axes};
use crate::execute::interpreter::Interpreter;

/// Metric threads of ISO 261, first choice and second, and their coarse pitch, mm.
const METRIC: [(f64, f64); 21] = [
    (3.0, 0.5),
    (4.0, 0.7),
    (5.0, 0.8),
    (6.0, 1.0),
    (8.0, 1.25),
    (10.0, 1.5),
    (12.0, 1.75),
    (14.0, 2.0),
    (16.0, 2.0),
    (18.0, 2.5),
    (20.0, 2.5),
    (22.0, 2.5),
    (24.0, 3.0),
    (27.0, 3.0),
    (30.0, 3.5),
    (33.0, 3.5),
    (36.0, 4.0),
    (39.0, 4.0),
    (42.0, 4.5),
    (45.0, 4.5),
    (48.0, 5.0),
];

impl Interpreter {
    /// CYCLE84.
    pub(super) fn tap_hole(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let levels = arguments.levels(arguments.get(4))?;
        let behind = arguments.choice(6, "SDAC", &[0, 3, 4, 5])?;
        let pitch = self.metric_pitch(arguments)?;
        let speed = arguments.positive(10, "SST", "the speed of the spindle, rev/min")?;
        let outwards = arguments.or_zero(11);
        let refused = if arguments.or_zero(5) != 0.0 {
            Some(("DTB", "the spindle turns back at once"))
        } else if arguments.or_zero(9) != 0.0 {
            Some(("POSS", "the angle that the tap begins at is not chosen"))
        } else if outwards != 0.0 && (outwards - speed).abs() > 0.0 {
            Some(("SST1", "the tap comes out as fast as it went in"))
        } else {
            None
        };
        if let Some((name, reason)) = refused {
            return Err(arguments
                .refused(format!("{name} is not supported"), reason)
                .help(format!("leave {name} out, or write 0")));
        }
        let mut lines = Lines::new(plane_axes(self, arguments)?);
        lines.along("G0", levels.clear);
        lines.line(format!("S[{speed}] M{}", if pitch < 0.0 { 4 } else { 3 }));
        let pitch = pitch.abs();
        lines.along(&format!("G33.1 K[{pitch}]"), levels.bottom);
        if behind != 0 {
            lines.line(format!("M{behind}"));
        }
        lines.along("G0", levels.retract);
        Ok(lines)
    }

    /// The pitch in the units in force, below zero of a left-hand thread.
    fn metric_pitch(&self, arguments: Arguments<'_>) -> Outcome<f64> {
        let size = arguments.or_zero(7);
        if let Some(pitch) = arguments.get(8).filter(|pitch| *pitch != 0.0) {
            return Ok(pitch);
        }
        let is_it = |(of, _): &&(f64, f64)| (of - size.abs()).abs() < 1e-9;
        let Some((_, pitch_mm)) = METRIC.iter().find(is_it) else {
            return Err(arguments
                .refused(
                    format!("MPIT is {size}, and PIT not given"),
                    "the pitch is PIT, or that of a metric thread from M3 to M48",
                )
                .help("write the pitch as PIT"));
        };
        Ok((pitch_mm / self.state.modal.units.mm()).copysign(size))
    }
}
