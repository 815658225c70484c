//! CYCLE97: a thread along Z, outside or inside, in passes of G33; what it has in common with a chain of
//! threads ([`thread_chain`](super::thread_chain)).
//!
//! ```text
//!            FPL               SPL          X is DM1 at SPL, DM2 at FPL: diameters in every mode
//!    ROP ◄──┤   ├───────────────┤ ├── APP
//!           ●◄──────────────────────● _VRT (1 mm) off the thread
//!                 TDEP deep
//! ```
//!
//! | VARI | passes down to TDEP less FAL |
//! |---|---|
//! | 1, 2 | outside, inside; each as deep as the one before |
//! | 3, 4 | outside, inside; each of the same cross-section: the depth grows with the root of their number |
//!
//! NRC passes lead there, one takes FAL, NID more cut nothing. With IANG the passes go down along the flank
//! behind the tool, the first one where the program says; below zero along both flanks by turns. The thread
//! starts at NSP degrees; NUMT threads lie beside each other, one after the other.

use glidepath_geometry::{Axis, Plane};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::interpreter::Interpreter;

/// How far off the thread the tool goes back where _VRT does not say so, mm.
const OFF_MM: f64 = 1.0;
/// Most passes of one kind, and threads beside each other.
const MOST: f64 = 1000.0;
/// Lines of a pass.
const LINES: f64 = 4.0;
/// Steepest slope of the infeed, degrees.
const STEEPEST: f64 = 60.0;

/// Where a cycle has the arguments that say how often it passes.
pub(super) struct PassPlaces {
    pub(super) left: usize,
    pub(super) angle: usize,
    pub(super) rough: usize,
    pub(super) empty: usize,
    pub(super) variant: usize,
    pub(super) beside: usize,
}

/// Those of CYCLE97.
const PLACES: PassPlaces = PassPlaces {
    left: 9,
    angle: 11,
    rough: 12,
    empty: 13,
    variant: 14,
    beside: 15,
};

/// A part of a thread, in the units in force: where it ends, Z and X, and its lead along the axis that goes further.
pub(super) struct Part {
    pub(super) to: [f64; 2],
    pub(super) pitch: f64,
}

/// A thread of one part or several, in the units in force; X is a radius.
pub(super) struct Thread {
    /// Z and X of its surface, the run-in included.
    pub(super) from: [f64; 2],
    /// The run-out is that of the last one.
    pub(super) parts: Vec<Part>,
    /// 1 outside, -1 inside.
    pub(super) out: f64,
    /// Where the tool goes back, X.
    pub(super) off: f64,
    /// How far a pass is shifted along the thread for its depth; below zero on both flanks by turns.
    pub(super) slope: f64,
    pub(super) depth: f64,
}

impl Thread {
    /// How far along the thread a pass lies that is so deep.
    fn shift(&self, index: usize, deep: f64) -> f64 {
        let slope = self.slope.abs();
        let aside = slope * (self.depth - deep);
        if self.slope >= 0.0 || index.is_multiple_of(2) {
            slope * self.depth - aside
        } else {
            slope * self.depth + aside
        }
    }

    /// All passes of a thread that starts at an angle.
    fn cut(&self, lines: &mut Lines, depths: &[f64], angle: f64) {
        let first = self.parts.first().map_or(self.from, |part| part.to);
        let forward = (first[0] - self.from[0]).signum();
        let slant = (first[1] - self.from[1]) / (first[0] - self.from[0]);
        for (index, deep) in depths.iter().enumerate() {
            let aside = forward * self.shift(index, *deep);
            // The ends are those of the thread for every pass.
            let z = self.from[0] + aside;
            let x = self.from[1] + slant * aside - self.out * deep;
            lines.go("G0", [Some(z), None, None]);
            lines.go("G0", [None, Some(x), None]);
            let mut start = format!(" Q[{angle}]");
            for Part { to, pitch } in &self.parts {
                let end = [Some(to[0]), Some(to[1] - self.out * deep), None];
                lines.go(&format!("G33 K[{pitch}]{start}"), end);
                start.clear();
            }
            lines.go("G0", [None, Some(self.off), None]);
        }
    }

    /// The lines of all threads that lie beside each other.
    pub(super) fn lines(&self, arguments: Arguments<'_>, places: &PassPlaces) -> Outcome<Lines> {
        let depths = depths(arguments, self.depth, places)?;
        let meaning = "how many threads lie beside each other";
        let beside = count(arguments, places.beside, "NUMT", meaning)?.max(1.0);
        let angle = arguments.or_zero(places.angle);
        if !(0.0..360.0).contains(&angle) {
            return Err(arguments
                .refused(format!("NSP is {angle}"), "it is an angle of the spindle")
                .help("write 0 or more, and less than 360 degrees"));
        }
        let [passes, parts] = [depths.len(), self.parts.len()]
            .map(|n| f64::from(u32::try_from(n).unwrap_or(u32::MAX)));
        Lines::check_count(beside * passes * (LINES + parts) + 3.0, arguments)?;
        let mut lines = Lines::new([Axis::Z, Axis::X, Axis::Y]);
        lines.go("G0", [Some(self.from[0]), Some(self.off), None]);
        let mut number = 0.0;
        while number < beside {
            let start = (angle + 360.0 * number / beside) % 360.0;
            self.cut(&mut lines, &depths, start);
            number += 1.0;
        }
        lines.go("G0", [Some(self.from[0]), None, None]);
        Ok(lines)
    }
}

impl Interpreter {
    /// CYCLE97.
    pub(super) fn cut_thread(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        self.thread_of_cycle(arguments)?.lines(arguments, &PLACES)
    }

    /// Refuses a thread in another plane than that of a lathe.
    pub(super) fn check_thread_plane(&self, arguments: Arguments<'_>) -> Outcome<()> {
        if self.state.modal.plane == Plane::Zx {
            return Ok(());
        }
        Err(arguments
            .refused(
                "a plane other than G18",
                "the thread is one of a lathe, along Z",
            )
            .help("write G18 before it"))
    }

    /// How far off the thread the tool goes back.
    pub(super) fn off_thread(&self, arguments: Arguments<'_>, index: usize) -> Outcome<f64> {
        let meaning = "how far off the thread the tool goes back";
        let off = arguments.not_negative(index, "_VRT", meaning)?;
        Ok(if off > 0.0 {
            off
        } else {
            OFF_MM / self.state.modal.units.mm()
        })
    }

    fn thread_of_cycle(&self, arguments: Arguments<'_>) -> Outcome<Thread> {
        self.check_thread_plane(arguments)?;
        let pitch = self.metric_pitch_at(arguments, 1, 0)?.abs();
        let begin = arguments.need(2, "SPL", "where the thread begins, along Z")?;
        let end = arguments.need(3, "FPL", "where the thread ends, along Z")?;
        let first = arguments.positive(4, "DM1", "the diameter at the beginning")?;
        let last = arguments.positive(5, "DM2", "the diameter at the end")?;
        let run_in = arguments.not_negative(6, "APP", "the run-in")?;
        let run_out = arguments.not_negative(7, "ROP", "the run-out")?;
        let depth = arguments.positive(8, "TDEP", "the depth of the thread")?;
        let variant = arguments.choice(14, "VARI", &[1, 2, 3, 4])?;
        let off = self.off_thread(arguments, 16)?;
        let way = end - begin;
        let rise = 0.5 * (last - first);
        if way == 0.0 || rise.abs() > way.abs() {
            return Err(too_steep(arguments));
        }
        let out = if variant % 2 == 1 { 1.0 } else { -1.0 };
        // The cone goes on over run-in and run-out.
        let forward = way.signum();
        let at = |z: f64| [z, 0.5 * first + rise * (z - begin) / way];
        let (from, to) = (at(begin - forward * run_in), at(end + forward * run_out));
        let surface = if out > 0.0 {
            from[1].max(to[1])
        } else {
            from[1].min(to[1])
        };
        let back = surface + out * off;
        check_room(arguments, back, from[1].min(to[1]) - out * depth)?;
        let angle = arguments.or_zero(10);
        if angle.abs() > STEEPEST || (angle < 0.0 && rise != 0.0) {
            return Err(arguments
                .refused(
                    format!("IANG is {angle}"),
                    "it is the slope of one flank, below zero of both by turns, which a cone does not have",
                )
                .help(format!("write an angle up to {STEEPEST} degrees, not below zero of a cone")));
        }
        let slope = angle.to_radians().tan();
        if 2.0 * slope.abs() * depth >= (to[0] - from[0]).abs() {
            return Err(arguments
                .refused(
                    "a thread that IANG shifts beyond its end",
                    "the passes begin ever later",
                )
                .help("write a smaller IANG, or a longer run-in"));
        }
        Ok(Thread {
            from,
            parts: vec![Part { to, pitch }],
            out,
            off: back,
            slope,
            depth,
        })
    }
}

#[cold]
pub(super) fn too_steep(arguments: Arguments<'_>) -> Box<BlockDiagnostic> {
    arguments
        .refused(
            "a thread steeper than 45 degrees",
            "it is one of the face, whose depth goes along Z: not made here",
        )
        .help("write a G33 with I for each pass")
}

/// Refuses a thread, or a way back beside it, beyond the axis of the spindle.
pub(super) fn check_room(arguments: Arguments<'_>, back: f64, bottom: f64) -> Outcome<()> {
    if back > 0.0 && bottom > 0.0 {
        return Ok(());
    }
    Err(arguments
        .refused(
            "the tool would go through the axis of the spindle",
            "the thread, or the way back beside it, is wider than there is room",
        )
        .help("check the diameters, TDEP and _VRT"))
}

/// A whole number that an argument counts.
fn count(arguments: Arguments<'_>, index: usize, name: &str, meaning: &str) -> Outcome<f64> {
    let value = arguments.not_negative(index, name, meaning)?;
    if value.fract() == 0.0 && value <= MOST {
        return Ok(value);
    }
    Err(arguments
        .refused(format!("{name} is {value}"), meaning)
        .help(format!("write a whole number up to {MOST}")))
}

/// The depths of all passes.
fn depths(arguments: Arguments<'_>, depth: f64, places: &PassPlaces) -> Outcome<Vec<f64>> {
    let left = arguments.not_negative(places.left, "FAL", "what the last pass takes")?;
    if left >= depth {
        return Err(arguments
            .refused(
                "FAL is as much as the depth",
                "nothing would be left for the other passes",
            )
            .help("check FAL and TDEP"));
    }
    let rough = count(
        arguments,
        places.rough,
        "NRC",
        "how many passes lead to the depth",
    )?;
    let empty = count(
        arguments,
        places.empty,
        "NID",
        "how many passes cut nothing",
    )?;
    if rough < 1.0 {
        return Err(arguments
            .refused("NRC is 0", "it says how many passes lead to the depth")
            .help("write 1 or more"));
    }
    let is_even = arguments.or_zero(places.variant) <= 2.0;
    let mut depths = Vec::new();
    let mut pass = 1.0;
    while pass <= rough {
        let share: f64 = pass / rough;
        let share = if is_even { share } else { share.sqrt() };
        depths.push((depth - left) * share);
        pass += 1.0;
    }
    let mut more = if left > 0.0 { empty + 1.0 } else { empty };
    while more > 0.0 {
        depths.push(depth);
        more -= 1.0;
    }
    Ok(depths)
}
