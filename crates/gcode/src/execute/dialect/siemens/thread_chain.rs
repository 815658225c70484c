//! CYCLE98: three threads that follow each other along Z, each with its own lead, in passes that go through
//! all of them.
//!
//! ```text
//!        PO4      PO3            PO2        PO1      X is DM1 to DM4 there: diameters in every mode
//!  ROP ◄──┤  PP3  ┤     PP2      ┤    PP1    ├── APP
//!         ●◄──────●◄─────────────●◄──────────────● _VRT (1 mm) off the thread
//! ```
//!
//! The passes are those of CYCLE97 ([`thread_cutting`](super::thread_cutting)), straight down: whether IANG
//! shifts the places where the lead changes, too, is not known.

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::dialect::siemens::thread_cutting::{
    Part, PassPlaces, Thread, check_room, too_steep,
};
use crate::execute::interpreter::Interpreter;

const PLACES: PassPlaces = PassPlaces {
    left: 11,
    angle: 13,
    rough: 14,
    empty: 15,
    variant: 19,
    beside: 20,
};

/// Names of the points, their diameters, and the leads between them.
const POINTS: [&str; 4] = ["PO1", "PO2", "PO3", "PO4"];
const DIAMETERS: [&str; 4] = ["DM1", "DM2", "DM3", "DM4"];
const LEADS: [&str; 3] = ["PP1", "PP2", "PP3"];
/// Where the first lead is among the arguments.
const FIRST_LEAD: usize = 16;

impl Interpreter {
    /// CYCLE98.
    pub(super) fn cut_thread_chain(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        self.check_thread_plane(arguments)?;
        let points = points(arguments)?;
        let run_in = arguments.not_negative(8, "APP", "the run-in")?;
        let run_out = arguments.not_negative(9, "ROP", "the run-out")?;
        let depth = arguments.positive(10, "TDEP", "the depth of the thread")?;
        if arguments.or_zero(12) != 0.0 {
            return Err(arguments
                .refused(
                    "IANG beside several leads",
                    "whether the places where the lead changes are shifted, too, is not known here",
                )
                .help("leave IANG out: the passes go straight down"));
        }
        let variant = arguments.choice(PLACES.variant, "VARI", &[1, 2, 3, 4])?;
        let out = if variant % 2 == 1 { 1.0 } else { -1.0 };
        let off = self.off_thread(arguments, 21)?;
        let [first, second, third, last] = points;
        // The cones at both ends go on over run-in and run-out.
        let from = beyond(second, first, run_in);
        let end = beyond(third, last, run_out);
        let mut parts = Vec::new();
        for (index, to) in [second, third, end].into_iter().enumerate() {
            let meaning = "the lead of a part of the thread";
            let pitch = arguments.positive(FIRST_LEAD + index, LEADS[index], meaning)?;
            parts.push(Part { to, pitch });
        }
        let radii = [from[1], second[1], third[1], end[1]];
        let [least, most] = [
            radii.into_iter().fold(f64::INFINITY, f64::min),
            radii.into_iter().fold(0.0, f64::max),
        ];
        let back = if out > 0.0 { most + off } else { least - off };
        check_room(arguments, back, least - out * depth)?;
        let thread = Thread {
            from,
            parts,
            out,
            off: back,
            slope: 0.0,
            depth,
        };
        thread.lines(arguments, &PLACES)
    }
}

/// The four points, Z and X (a radius): they lead one way, and no part is steeper than 45 degrees.
fn points(arguments: Arguments<'_>) -> Outcome<[[f64; 2]; 4]> {
    let mut points = [[0.0; 2]; 4];
    for (index, point) in points.iter_mut().enumerate() {
        let z = arguments.need(2 * index, POINTS[index], "a point of the thread, along Z")?;
        let meaning = "the diameter at a point of the thread";
        let diameter = arguments.positive(2 * index + 1, DIAMETERS[index], meaning)?;
        *point = [z, 0.5 * diameter];
    }
    let [first, second, ..] = points;
    let forward = (second[0] - first[0]).signum();
    for (from, to) in points.iter().zip(points.iter().skip(1)) {
        let way = forward * (to[0] - from[0]);
        if way <= 0.0 {
            return Err(arguments
                .refused(
                    "points that do not follow each other along Z",
                    "each part of the thread goes on from the one before",
                )
                .help("check PO1 to PO4"));
        }
        if (to[1] - from[1]).abs() > way {
            return Err(too_steep(arguments));
        }
    }
    Ok(points)
}

/// The point so far beyond `to` along Z, on the line from `from`.
fn beyond(from: [f64; 2], to: [f64; 2], by: f64) -> [f64; 2] {
    let way = to[0] - from[0];
    let share = by / way.abs();
    [to[0] + share * way, to[1] + share * (to[1] - from[1])]
}
