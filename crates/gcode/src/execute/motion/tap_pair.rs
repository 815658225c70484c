//! SINUMERIK's G331 and G332: into a hole and out of it, each in a block of its own.
//!
//! Where a tap turns back depends on the spindle, so both are made together, when the way out is
//! known: as G33.1, from where the tool stands to the bottom and back, and from there to the end of
//! G332. The sign of the pitch says which way the spindle turns into the hole; on the control it is
//! an axis meanwhile, and stands behind it.

use glidepath_geometry::Axis;
use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::planned_tap::TappedHole;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Pace;
use crate::execute::state::open_tap::OpenTap;
use crate::execute::state::spindle::SpindleDirection;
use crate::syntax::block::Block;
use crate::syntax::modes::Motion;
use crate::syntax::word_check::missing;

impl Interpreter {
    /// Refuses what stands between the way in and the way out.
    pub(crate) fn check_open_tap(&self, block: &Block, motion: Option<Motion>) -> Outcome<()> {
        if self.state.open.tap.is_none() || motion == Some(Motion::TapOut) {
            return Ok(());
        }
        Err(not_out(block.first_span()))
    }

    /// The end of the program: a tap has to be out of its hole.
    pub(crate) fn check_tap_complete(&self) -> Outcome<()> {
        match self.state.open.tap {
            None => Ok(()),
            Some(_) => Err(not_out(SourceSpan::default())),
        }
    }

    /// G331: keeps the way into the hole.
    pub(crate) fn tap_in(&mut self, block: &Block) -> Outcome<()> {
        let pitch_mm = self.pitch_of_pair(block, "G331")?;
        let bottom = self.target(block)?;
        self.state.open.tap = Some(OpenTap {
            bottom,
            pitch_mm,
            line: self.line,
        });
        self.state.position = bottom;
        Ok(())
    }

    /// G332: both ways.
    pub(crate) fn tap_out(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let span = block.motion_span();
        let pitch_mm = self.pitch_of_pair(block, "G332")?;
        let Some(tap) = self.state.open.tap.take() else {
            let message = "G332 without G331 in the block before it";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("it is the way out of a hole that was tapped")
                    .help("write G331 with the depth before it"),
            );
        };
        if (tap.pitch_mm - pitch_mm).abs() > MIN_MOVE {
            let message = "G332 with another pitch than G331";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                    .because("the tap goes out along its own thread")
                    .help("write the same pitch, with the same sign"),
            );
        }
        let end = self.target(block)?;
        let start = self.state.path_end;
        self.state.position = start;
        let into = tap.bottom - start;
        let beyond = end - start;
        let is_back = beyond.dot(&into) <= 0.0;
        let is_beside = Axis::ALL.into_iter().any(|axis| {
            let i = axis.index();
            into[i].abs() <= MIN_MOVE && beyond[i].abs() > MIN_MOVE
        });
        if !is_back || is_beside {
            let message = "G332 does not lead out of the hole";
            return Err(BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because("the tap goes in and out at once: it comes back to where G331 began, or goes on from there")
                .help("write the place where G331 began as the end of G332"));
        }
        let line = self.line;
        self.line = tap.line;
        let made = self.tap_both_ways(block, &tap, out);
        self.line = line;
        made?;
        self.straight(block, end, Pace::Rapid, out)
    }

    fn tap_both_ways(&mut self, block: &Block, tap: &OpenTap, out: &mut Vec<Item>) -> Outcome<()> {
        let direction = if tap.pitch_mm > 0.0 {
            SpindleDirection::Clockwise
        } else {
            SpindleDirection::Counterclockwise
        };
        if self
            .state
            .spindle
            .turning
            .is_some_and(|turning| turning != direction)
        {
            let message = "the spindle turns the other way than the pitch of the tap says";
            let span = block.motion_span();
            return Err(BlockDiagnostic::new(DiagnosticCode::Spindle, span, message)
                .because("a pitch above zero is of a right-hand thread, which M3 cuts")
                .help("write SPOS or M5 before G331, or correct the sign of the pitch"));
        }
        if let Some(axis) = self.options.spindle_axis {
            let hole = TappedHole {
                bottom: tap.bottom,
                pitch_mm: tap.pitch_mm.abs(),
                turning: direction,
                dwell_s: 0.0,
                speed_out_r: 1.0,
                peck_mm: None,
                back_mm: None,
            };
            return self.tap_by_axis(block, &axis, &hole, out);
        }
        let starts = self.state.spindle.turning.is_none();
        if starts {
            self.turn_spindle(Some(direction));
            self.push(out, ItemKind::Event(Event::MCode(direction.code())));
        }
        self.tap_to(block, tap.bottom, tap.pitch_mm.abs(), out)?;
        if starts {
            self.turn_spindle(None);
            self.push(out, ItemKind::Event(Event::MCode(5)));
        }
        Ok(())
    }

    /// The pitch of a block: I, J or K of the axis that it names.
    fn pitch_of_pair(&self, block: &Block, code: &str) -> Outcome<f64> {
        let letters = [b'I', b'J', b'K'];
        let given = letters.into_iter().filter_map(|letter| block.get(letter));
        let values: Vec<f64> = given.collect();
        let [pitch] = values[..] else {
            let meaning = "the pitch of the tap along X, Y or Z";
            return Err(missing(
                block.motion_span(),
                code,
                "one of I, J and K",
                meaning,
            ));
        };
        if pitch == 0.0 || block.get(b'F').is_some() {
            let message = format!("{code} takes a pitch other than zero, and no F");
            let span = block.motion_span();
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                    .because("the spindle alone gives the speed of a tap")
                    .help("write the way of a revolution as K, below zero for a left-hand thread"),
            );
        }
        Ok(pitch * self.state.modal.units.mm())
    }
}

#[cold]
fn not_out(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "a tap that does not come out of its hole";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("behind G331 comes G332, in the next block: both ways are made at once")
        .help("write G332 behind it; a dwell in the hole is an argument of CYCLE84")
}
