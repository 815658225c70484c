//! Rigid tapping: G33.1, and the holes of G84 and G74 where these tap rigidly.
//!
//! A spindle that is an axis is planned with the others: [`planned_tap`]. Behind any other one, where
//! the tap turns back depends on the spindle, so the way is no move: it is an event at rest,
//! and the machine is where it was when it has happened.
//!
//! ```text
//!   start ●  at rest, beside a spindle at speed
//!         │  run-in: the axis comes to the speed of the spindle
//!         │  with the spindle
//!         ┆  the spindle is told to turn back: at the bottom, or before it by what it runs on
//!  bottom ●  and out again, up to where it began
//!         ┆
//! deepest ●  where the machine stops the tap, if the spindle has not turned back by then
//! ```

use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_program::{Event, Item, ItemKind, TAP_DEPTHS_UM};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::planned_tap::TappedHole;
use crate::execute::motion::settled::settled;
use crate::execute::state::spindle::SpindleDirection;
use crate::setup::threading::Threading;
use crate::syntax::block::Block;
use crate::syntax::word_check::{missing, negative};

/// Periods that a tap goes on before its stop begins.
const STOP_PERIODS: f64 = 2.0;

impl Interpreter {
    /// G33.1.
    pub(crate) fn rigid_tap(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let span = block.motion_span();
        let Some(pitch) = block.get(b'K') else {
            return Err(missing(span, "G33.1", "K", "the pitch of the tap"));
        };
        let axis = self.options.spindle_axis;
        let turning = self.state.spindle.turning;
        // A spindle that stands is told by the sign of the pitch.
        let is_signed = axis.is_some() && turning.is_none();
        let is_pitch = if is_signed { pitch != 0.0 } else { pitch > 0.0 };
        if !is_pitch || block.get(b'F').is_some() {
            let message = "G33.1 takes a pitch K above zero, and no F";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                    .because("the spindle alone gives the speed of a tap")
                    .help("write the way of a revolution as K, and the axis word of the hole"),
            );
        }
        let scale = self.state.modal.units.mm();
        let bottom = self.target(block)?;
        let Some(axis) = axis else {
            return match b"IPQR".iter().find(|letter| block.get(**letter).is_some()) {
                Some(letter) => Err(needs_axis(block, *letter)),
                None => self.tap_to(block, bottom, pitch * scale, out),
            };
        };
        let above_zero = |letter: u8, scale: f64, meaning: &str| match block.get(letter) {
            Some(value) if value <= 0.0 => {
                let message = format!("{} is not above zero", char::from(letter));
                let fault =
                    BlockDiagnostic::new(DiagnosticCode::InvalidValue, block.span(letter), message);
                Err(fault
                    .because(meaning)
                    .help("write a value above zero, or leave it out"))
            }
            value => Ok(value.map(|value| value * scale)),
        };
        let by_sign = if pitch > 0.0 {
            SpindleDirection::Clockwise
        } else {
            SpindleDirection::Counterclockwise
        };
        let dwell_s = block.get(b'P').unwrap_or(0.0);
        if dwell_s < 0.0 {
            return Err(
                negative(block, b'P', "the dwell").because("P is the seconds at the bottom")
            );
        }
        let hole = TappedHole {
            bottom,
            pitch_mm: pitch.abs() * scale,
            turning: turning.unwrap_or(by_sign),
            dwell_s,
            speed_out_r: above_zero(b'I', 1.0, "I is how much faster the tap comes out")?
                .unwrap_or(1.0),
            peck_mm: above_zero(b'Q', scale, "Q is how deep the tap goes at a time")?,
            back_mm: above_zero(b'R', scale, "R is how far it comes back after each depth")?,
        };
        self.tap_by_axis(block, &axis, &hole, out)
    }

    /// Taps from where the tool is to the bottom of a hole, machine coordinates, with so many mm of
    /// way for each revolution, > 0.
    pub(crate) fn tap_to(
        &mut self,
        block: &Block,
        bottom: AxisVector,
        pitch_mm: f64,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let span = block.motion_span();
        let threading = self.check_spindle(span)?;
        let start = self.state.path_end;
        let (axis, along) = hole_axis(span, &start, &bottom)?;
        let end = settled(start, bottom, [None, None]);
        let hole = Segment::line(start, end);
        let speed_v = self.check_groove(span, &threading, &hole, pitch_mm, [true, true])?;
        let turn_mm = self.turn_mm(span, &threading, &hole, pitch_mm, speed_v)?;
        let depth_um = (turn_mm * 1e3).round();
        let mut deepest = start;
        let deepest_mm = depth_um * 1e-3 + threading.overtravel * pitch_mm;
        deepest[axis.index()] += deepest_mm.copysign(along);
        let what = "the deepest that the tap may go, with `overtravel` of [spindle],";
        self.check_limits(block, &deepest, &deepest, what)?;
        if depth_um >= f64::from(TAP_DEPTHS_UM) {
            let message = "a hole of more than a metre";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                    .because("depths are kept up to that")
                    .help("check the axis word, and the units it is in"),
            );
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "range checked"
        )]
        let tap = Event::Tap {
            axis: axis.index() as u32,
            pitch_mm: pitch_mm.copysign(along),
            depth_um: depth_um as u32,
        };
        self.push(out, ItemKind::Event(tap));
        Ok(())
    }

    /// How deep the tap is when the spindle is told to turn back, mm.
    fn turn_mm(
        &self,
        span: SourceSpan,
        threading: &Threading,
        hole: &Segment,
        pitch_mm: f64,
        speed_v: f64,
    ) -> Outcome<f64> {
        let speed = self.state.spindle.speed;
        let direction = hole.jet(0.0).d1;
        let turning_a = threading.spindle_a.unwrap_or_default() * pitch_mm;
        let most_a = threading.most_a(&direction);
        if turning_a > most_a {
            let message =
                format!("the axis goes with {turning_a:.0} mm/s² where the spindle turns back");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                    .because(format!("it can do {most_a:.0} mm/s²"))
                    .help(
                        "let the spindle turn back more slowly, and say so by `acceleration` of \
                     [spindle]",
                    ),
            );
        }
        let run_in_mm = threading.run_in_mm(&direction, speed_v);
        let run_on_mm = threading.run_on_mm(pitch_mm, speed / 60.0);
        let length_mm = hole.length();
        let turn_mm = length_mm - run_on_mm;
        if turn_mm < run_in_mm {
            let message = format!("a hole of {length_mm:.3} mm is too short at S{speed}");
            return Err(BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                .because(format!(
                    "the tap needs {run_in_mm:.3} mm to come to the speed of the spindle, which \
                     runs on for {run_on_mm:.3} mm"
                ))
                .help("begin higher above the hole, or turn more slowly"));
        }
        // As long as it comes to its speed it comes to rest, in less than the run-in of the plan.
        let stop_mm = run_in_mm + STOP_PERIODS * threading.period_t * speed_v;
        let least = (run_on_mm + stop_mm) / pitch_mm;
        if threading.overtravel < least {
            let overtravel = threading.overtravel;
            let message =
                format!("at S{speed} the tap goes on for more than {overtravel} revolutions");
            return Err(BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                .because(format!(
                    "the spindle runs on for {:.2} revolutions when it is told to turn back, and to \
                     stop the tap takes {:.2}: that is beyond `overtravel` of [spindle], where the \
                     machine stops in the hole",
                    run_on_mm / pitch_mm,
                    stop_mm / pitch_mm
                ))
                .help("turn more slowly, or let the tap go on further, where there is room below"));
        }
        Ok(turn_mm)
    }
}

/// The axis of a hole, and its way to the bottom.
fn hole_axis(span: SourceSpan, start: &AxisVector, bottom: &AxisVector) -> Outcome<(Axis, f64)> {
    let way = settled(*start, *bottom, [None, None]) - start;
    let moved = Axis::ALL
        .into_iter()
        .filter(|axis| way[axis.index()].abs() > 0.0);
    let axes: Vec<Axis> = moved.collect();
    match axes[..] {
        [axis] if !axis.is_rotary() => Ok((axis, way[axis.index()])),
        _ => {
            let message = "a tap along more than one axis, or none that is straight";
            Err(BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because("one axis goes with the spindle")
                .help(
                    "write the axis of the hole alone, with another depth than where the tool is",
                ))
        }
    }
}

/// Refuses a word of a tap that a spindle that is only followed cannot do.
#[cold]
pub(crate) fn needs_axis(block: &Block, letter: u8) -> Box<BlockDiagnostic> {
    let (what, reason) = match letter {
        b'P' => (
            "with a dwell at the bottom (P)",
            "the spindle that is followed turns back at once",
        ),
        b'I' => (
            "that comes out faster (I)",
            "the spindle that is followed turns at S both ways",
        ),
        _ => (
            "in several depths (Q, R)",
            "it would begin again at another angle of a spindle that is followed, beside its thread",
        ),
    };
    let letter_name = char::from(letter);
    BlockDiagnostic::new(
        DiagnosticCode::NotSupported,
        block.span(letter),
        format!("a rigid tap {what} is not supported"),
    )
    .because(reason)
    .help(format!(
        "leave {letter_name} out, or name the axis of a spindle with a servo: `axis` of [spindle]"
    ))
}
