//! Rigid tapping by a spindle that is an axis of the machine: straight moves of both.
//!
//! ```text
//!   start ●  at rest, and so is the spindle
//!         │  one line of both axes: 360° for each pitch, at the speed S
//!  bottom ●  at rest, for the dwell
//!         │  the same line back
//!   start ●  to the bit
//! ```
//!
//! With a depth at a time (Q) the tap comes out after each, all the way or by so much, and goes in
//! again along the same line: into the thread that is there.

use glidepath_geometry::{Axis, AxisVector, LINEAR_XYZ, Segment};
use glidepath_program::{Item, ItemKind, PathMode, Rate};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::{MIN_MOVE, settled};
use crate::execute::state::spindle::SpindleDirection;
use crate::setup::spindle_axis::SpindleAxis;
use crate::syntax::block::Block;

/// Depths as near to the bottom as this are the bottom, mm.
const BOTTOM_MM: f64 = 1e-6;
/// Most depths of one hole.
const MAX_DEPTHS: f64 = 10_000.0;

/// A hole to be tapped, and how.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TappedHole {
    /// Its bottom, machine coordinates.
    pub(crate) bottom: AxisVector,
    /// Way of a revolution, mm, > 0.
    pub(crate) pitch_mm: f64,
    /// Which way the spindle turns into it.
    pub(crate) turning: SpindleDirection,
    /// Time at rest at the bottom, s, ≥ 0.
    pub(crate) dwell_s: f64,
    /// The speed of the spindle out of it, in parts of that into it, > 0.
    pub(crate) speed_out_r: f64,
    /// How deep it goes at a time, mm, > 0; `None`: to the bottom at once.
    pub(crate) peck_mm: Option<f64>,
    /// How far it comes back after each, mm, > 0; `None`: all the way.
    pub(crate) back_mm: Option<f64>,
}

/// The line of a hole: from the start into it, and round.
#[derive(Debug, Clone, Copy)]
struct HoleLine {
    start: AxisVector,
    /// What a millimetre into the hole moves.
    direction: AxisVector,
}

impl HoleLine {
    fn at(&self, depth_mm: f64) -> AxisVector {
        self.start + self.direction * depth_mm
    }
}

impl Interpreter {
    /// Taps from where the tool is, which ends where it began.
    pub(crate) fn tap_by_axis(
        &mut self,
        block: &Block,
        spindle: &SpindleAxis,
        hole: &TappedHole,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let span = block.motion_span();
        let speed = self.tapping_speed(span)?;
        let start = self.state.path_end;
        let way = settled(start, hole.bottom, [None, None]) - start;
        let length_mm = way.fixed_rows::<3>(0).norm();
        let is_straight = Axis::ALL
            .into_iter()
            .all(|axis| LINEAR_XYZ.contains(&axis.index()) || way[axis.index()] == 0.0);
        if length_mm <= MIN_MOVE || !is_straight {
            let message = "a tap that goes nowhere, or of other axes than X, Y and Z";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("a straight way goes with the spindle")
                    .help("write another depth than where the tool is, and leave other axes out"),
            );
        }
        let turns = match hole.turning {
            SpindleDirection::Clockwise => 1.0,
            SpindleDirection::Counterclockwise => -1.0,
        };
        let mut direction = way / length_mm;
        direction[spindle.axis.index()] = turns * 360.0 / hole.pitch_mm;
        let line = HoleLine { start, direction };
        let whole = Segment::line(start, line.at(length_mm));
        let in_v = hole.pitch_mm * speed / 60.0;
        let out_v = in_v * hole.speed_out_r;
        check_speed(span, spindle, &whole, speed, [in_v, out_v])?;
        let peck_mm = hole.peck_mm.unwrap_or(length_mm);
        if length_mm / peck_mm > MAX_DEPTHS {
            let message = format!("{:.0} depths of one hole", length_mm / peck_mm);
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                    .because(format!("one hole has at most {MAX_DEPTHS}"))
                    .help("write a larger Q"),
            );
        }
        self.spindle_to_axis(out);
        // The corner to the move before is not rounded.
        self.push(out, ItemKind::Dwell(0.0));
        let (low, high) = whole.bounding_box();
        self.check_limits(block, &low, &high, "the way into the hole")?;
        let (mut at_mm, mut next_mm) = (0.0, peck_mm);
        loop {
            let is_last = next_mm > length_mm - BOTTOM_MM;
            let depth_mm = if is_last { length_mm } else { next_mm };
            self.tap_along(&line, [at_mm, depth_mm], in_v, out);
            if is_last {
                self.push(out, ItemKind::Dwell(hole.dwell_s));
                self.tap_along(&line, [depth_mm, 0.0], out_v, out);
                break;
            }
            at_mm = hole
                .back_mm
                .map_or(0.0, |back_mm| (depth_mm - back_mm).max(0.0));
            self.tap_along(&line, [depth_mm, at_mm], out_v, out);
            next_mm += peck_mm;
        }
        self.state.leaving_contour = false;
        Ok(())
    }

    /// A move from one depth to another, at a speed that overrides lower and never raise.
    fn tap_along(&mut self, line: &HoleLine, depths: [f64; 2], most_v: f64, out: &mut Vec<Item>) {
        let [from, to] = depths.map(|depth_mm| line.at(depth_mm));
        let kind = ItemKind::Move {
            segment: Segment::line(from, to),
            rate: Rate::FeedUpTo {
                feed_v: most_v,
                most_v,
            },
            mode: PathMode::ExactStop,
        };
        self.push(out, kind);
    }

    /// The speed of the spindle, rev/min.
    fn tapping_speed(&self, span: SourceSpan) -> Outcome<f64> {
        let spindle = &self.state.spindle;
        let message = if spindle.speed <= 0.0 {
            "a tap with a spindle without a speed"
        } else if spindle.follows_tool() {
            "a tap with a spindle whose speed follows the tool (G96)"
        } else if self.state.open.compensation.is_some() {
            "a tap with cutter radius compensation"
        } else {
            return Ok(spindle.speed);
        };
        Err(BlockDiagnostic::new(DiagnosticCode::Spindle, span, message)
            .because("the tap goes in at the speed S, along its own line")
            .help("write G97, G40 and an S word before it"))
    }
}

/// Refuses speeds that the axes cannot do.
fn check_speed(
    span: SourceSpan,
    spindle: &SpindleAxis,
    hole: &Segment,
    speed: f64,
    speeds_v: [f64; 2],
) -> Outcome<()> {
    let most_v = spindle.most_v(&hole.jet(0.0).d1);
    let fastest_v = speeds_v[0].max(speeds_v[1]);
    if fastest_v <= most_v {
        return Ok(());
    }
    let most = (speed * most_v / fastest_v).floor();
    let message = format!(
        "the tap takes {:.0} mm/min, and {:.0} rev/min of {}",
        fastest_v * 60.0,
        speed * fastest_v / speeds_v[0],
        spindle.axis,
    );
    let reason = format!("the axes go {:.0} mm/min there at most", most_v * 60.0);
    Err(
        BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
            .because(reason)
            .help(format!("write S{most} or less")),
    )
}
