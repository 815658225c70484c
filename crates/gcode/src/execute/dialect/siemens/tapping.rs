//! CYCLE84: a hole that is tapped rigidly; CYCLE840: one with a tap in a chuck that gives way.
//!
//! CYCLE840 goes at the feed of pitch and speed, or of F where no pitch is given, in the direction in
//! which the spindle turns, which is reversed at the bottom. Where SDR says the direction of the way out,
//! the spindle turns behind it as SDAC says; else (SDR 0) as before the cycle.
//!
//! CYCLE84 goes from SDIS above the surface with the spindle to the bottom and out again, then to RTP. The
//! pitch is PIT, or that of the metric thread MPIT (3: M3); below zero it is a left-hand one. A
//! spindle that is an axis begins at the angle POSS, dwells for DTB, comes out at SST1, and goes DAM
//! deep at a time (VARI 1: back by VRT, 2: all the way out); one that is followed can do none of it.

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::cycle::plane_axes;
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::spindle::SpindleDirection;
use crate::syntax::modes::FeedMode;

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

/// How far the tap comes back to break the chip where VRT does not say so, mm.
const BACK_MM: f64 = 1.0;

impl Interpreter {
    /// CYCLE84.
    pub(super) fn tap_hole(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let levels = arguments.levels(arguments.get(4))?;
        let behind = arguments.choice(6, "SDAC", &[0, 3, 4, 5])?;
        let pitch = self.metric_pitch(arguments)?;
        let speed = arguments.positive(10, "SST", "the speed of the spindle, rev/min")?;
        arguments.choice(12, "AXN", &[0, 3])?;
        arguments.choice(13, "PITA", &[0, 1])?;
        arguments.choice(14, "TECHNO", &[0])?;
        let mut lines = Lines::new(plane_axes(self, arguments)?);
        lines.along("G0", levels.clear);
        if let Some(axis) = self.spindle_axis() {
            let words = self.words_of_tap(arguments, speed)?;
            lines.line(format!("S[{speed}] M5"));
            if let Some(angle) = arguments.get(9) {
                let letter = axis.letter();
                let angle = nearest(angle, coordinate_of(self, axis));
                lines.line(format!("G0 {letter}[{angle}]"));
            }
            lines.along(&format!("G33.1 K[{pitch}]{words}"), levels.bottom);
        } else {
            check_followed(arguments, speed)?;
            lines.line(format!("S[{speed}] M{}", if pitch < 0.0 { 4 } else { 3 }));
            let pitch = pitch.abs();
            lines.along(&format!("G33.1 K[{pitch}]"), levels.bottom);
        }
        if behind != 0 {
            lines.line(format!("M{behind}"));
        }
        lines.along("G0", levels.retract);
        Ok(lines)
    }

    /// CYCLE840.
    pub(super) fn tap_with_chuck(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let levels = arguments.levels(arguments.get(4))?;
        let dwell = arguments.not_negative(5, "DTB", "seconds at the bottom")?;
        let out = arguments.choice(6, "SDR", &[0, 3, 4])?;
        let behind = arguments.choice(7, "SDAC", &[0, 3, 4, 5])?;
        // With an encoder or without one: the feed is that of the pitch.
        arguments.choice(8, "ENC", &[0, 1])?;
        arguments.choice(11, "AXN", &[0, 3])?;
        arguments.choice(12, "PITA", &[0, 1])?;
        arguments.choice(13, "TECHNO", &[0])?;
        let spindle = &self.state.spindle;
        let turning = spindle
            .turning
            .filter(|_| spindle.speed > 0.0)
            .ok_or_else(|| {
                arguments
                    .refused(
                        "the spindle does not turn",
                        "the tap goes into the hole as the spindle turns",
                    )
                    .help("write S and M3, or M4 for a left-hand thread, before it")
            })?;
        let back = match turning {
            SpindleDirection::Clockwise => 4,
            SpindleDirection::Counterclockwise => 3,
        };
        if out != 0 && out != back {
            let message = format!("SDR {out} is the direction in which the tap goes in");
            return Err(arguments
                .refused(
                    message,
                    "the tap comes out of its thread the other way round",
                )
                .help(format!("write {back}, or 0")));
        }
        let mut lines = self.above(arguments, levels)?;
        let has_pitch = [9, 10].iter().any(|at| arguments.or_zero(*at) != 0.0);
        if has_pitch {
            let pitch = self.metric_pitch_at(arguments, 9, 10)?.abs();
            let per_revolution = self.state.modal.feed_mode == FeedMode::PerRevolution;
            lines.feed(if per_revolution {
                pitch
            } else {
                pitch * spindle.speed
            });
        }
        let cycle = if back == 4 { "G84" } else { "G74" };
        let words = format!("G99 {cycle} R[{}] P[{dwell}]", levels.clear);
        lines.along(&words, levels.bottom);
        lines.line("G80");
        if out != 0 && behind != 0 {
            lines.line(format!("M{behind}"));
        }
        lines.along("G0", levels.retract);
        Ok(lines)
    }

    /// Dwell, depths and the speed out of the hole, where the spindle is an axis.
    fn words_of_tap(&self, arguments: Arguments<'_>, speed: f64) -> Outcome<String> {
        let mut words = String::new();
        let dwell = arguments.not_negative(5, "DTB", "the seconds at the bottom")?;
        if dwell > 0.0 {
            words += &format!(" P[{dwell}]");
        }
        let outwards = arguments.not_negative(11, "SST1", "the speed out of the hole, rev/min")?;
        if outwards > 0.0 {
            words += &format!(" I[{}]", outwards / speed);
        }
        let variant = arguments.choice(15, "VARI", &[0, 1, 2])?;
        if variant != 0 {
            let depth = arguments.positive(16, "DAM", "how deep the tap goes at a time")?;
            words += &format!(" Q[{depth}]");
        }
        if variant == 1 {
            let back = arguments.not_negative(17, "VRT", "how far the tap comes back")?;
            let default = BACK_MM / self.state.modal.units.mm();
            words += &format!(" R[{}]", if back > 0.0 { back } else { default });
        }
        Ok(words)
    }

    /// The pitch in the units in force, below zero of a left-hand thread.
    fn metric_pitch(&self, arguments: Arguments<'_>) -> Outcome<f64> {
        self.metric_pitch_at(arguments, 7, 8)
    }

    /// The same, where the arguments MPIT and PIT are.
    pub(super) fn metric_pitch_at(
        &self,
        arguments: Arguments<'_>,
        size_at: usize,
        pitch_at: usize,
    ) -> Outcome<f64> {
        let size = arguments.or_zero(size_at);
        let is_it = |(of, _): &&(f64, f64)| (of - size.abs()).abs() < 1e-9;
        let of_size = METRIC.iter().find(is_it).map(|(_, pitch_mm)| *pitch_mm);
        if let Some(pitch) = arguments.get(pitch_at).filter(|pitch| *pitch != 0.0) {
            let pitch_mm = pitch.abs() * self.state.modal.units.mm();
            let agree = of_size.is_some_and(|of_size| (of_size - pitch_mm).abs() < 1e-6);
            if size == 0.0 || agree {
                return Ok(pitch);
            }
            return Err(arguments
                .refused(
                    format!("PIT is {pitch}, and MPIT {size}, a thread with another pitch"),
                    "the control stops at two pitches that contradict each other",
                )
                .help("leave MPIT out"));
        }
        let Some(pitch_mm) = of_size else {
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

/// Refuses what a spindle that is followed cannot do.
fn check_followed(arguments: Arguments<'_>, speed: f64) -> Outcome<()> {
    let outwards = arguments.or_zero(11);
    let (name, reason) = if arguments.or_zero(5) != 0.0 {
        ("DTB", "the spindle turns back at once")
    } else if arguments.or_zero(9) != 0.0 {
        ("POSS", "the angle that the tap begins at is not chosen")
    } else if outwards != 0.0 && (outwards - speed).abs() > 0.0 {
        ("SST1", "the tap comes out as fast as it went in")
    } else if arguments.or_zero(15) != 0.0 {
        ("VARI", "the tap would begin again beside its thread")
    } else {
        return Ok(());
    };
    Err(arguments
        .refused(format!("{name} is not supported"), reason)
        .help(format!(
            "leave {name} out, or write 0; a spindle that is an axis can do it (`axis` of [spindle])"
        )))
}

/// The angle nearest to where the spindle is, degrees, among those that are the same in a turn.
fn nearest(angle: f64, present: f64) -> f64 {
    angle + 360.0 * ((present - angle) / 360.0).round()
}

/// Where the program has an axis that turns, degrees.
fn coordinate_of(interpreter: &Interpreter, axis: Axis) -> f64 {
    interpreter
        .state
        .offsets
        .to_program(interpreter.state.position)[axis.index()]
}
