//! The block of a lathe cycle: its words, and the way to where it starts.

use glidepath_geometry::{Axis, Plane};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::compensation::element::Point;
use crate::execute::interpreter::Interpreter;
use crate::execute::lathe_cycle::open::LatheCycleWords;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Pace;
use crate::syntax::block::Block;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{FeedMode, LatheCycle};
use crate::syntax::word_check::{missing, negative, whole};

/// Most finishing passes of a cycle.
const MAX_FINISHING: u32 = 1000;
/// Largest label of a subroutine.
const MAX_LABEL: u32 = 9_999_999;

impl Interpreter {
    /// Brings the tool to where the cycle starts.
    pub(crate) fn begin_lathe_cycle(
        &mut self,
        block: &Block,
        cycle: LatheCycle,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        self.check_lathe_cycle(block)?;
        self.lathe_words(block, cycle)?;
        let target = self.target(block)?;
        self.rapid_without_compensation(block, target, out)?;
        // No axis word behind the cycle can be meant for it.
        self.state.modal.motion = None;
        Ok(())
    }

    /// A rapid move that starts cutter radius compensation again at its end, if it is on.
    pub(crate) fn rapid_without_compensation(
        &mut self,
        block: &Block,
        target: glidepath_geometry::AxisVector,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let compensation = self.state.open.compensation.clone();
        self.end_compensation(out)?;
        if (target - self.state.path_end).amax() > MIN_MOVE {
            self.straight(block, target, Pace::Rapid, out)?;
        }
        self.state.position = target;
        self.state.leaving_contour = false;
        self.state.open.compensation = compensation.map(|on| on.again(self.state.path_end));
        Ok(())
    }

    /// Refuses a cycle that cannot be made here.
    fn check_lathe_cycle(&self, block: &Block) -> Outcome<()> {
        let span = block.motion_span();
        let refuse = |span: SourceSpan, message: &str, reason: &str, help: &str| {
            Err(
                BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                    .because(reason)
                    .help(help),
            )
        };
        if self.state.modal.plane != Plane::Zx {
            return refuse(
                span,
                "a lathe cycle outside the ZX plane",
                "its profile is drawn in Z and X",
                "write G18 before it",
            );
        }
        if self.state.offsets.is_turned() {
            return refuse(
                span,
                "a lathe cycle in a rotated coordinate system",
                "its plane would be no plane of the machine",
                "set the rotation to zero (G10 L2 R0)",
            );
        }
        if self.state.modal.feed_mode == FeedMode::InverseTime {
            return refuse(
                span,
                "a lathe cycle with inverse-time feed (G93)",
                "the time of the block would be shared by several moves",
                "write G94 or G95",
            );
        }
        let other = |axis: &Axis| !matches!(axis, Axis::X | Axis::Z);
        if let Some(axis) = block.axes().map(|(axis, _)| axis).find(other) {
            return refuse(
                block.axis_span(axis),
                &format!("{axis} in a lathe cycle"),
                "it moves X and Z alone",
                "move the other axes in a block of their own",
            );
        }
        match block.codes.stop {
            Some(stop) => refuse(
                stop.span,
                "a stop in the block of a lathe cycle",
                "the passes come after everything else of the block",
                "give it a block of its own",
            ),
            None => Ok(()),
        }
    }

    pub(super) fn lathe_words(&self, block: &Block, cycle: LatheCycle) -> Outcome<LatheCycleWords> {
        let scale = self.state.modal.units.mm();
        let get = |letter: u8, meaning: &str, default: f64| match block.get(letter) {
            Some(value) if value < 0.0 => Err(negative(block, letter, meaning)),
            value => Ok(value.unwrap_or(default) * scale),
        };
        let finishing = whole(block, b'P', MAX_FINISHING)?.unwrap_or(1);
        let increment_mm = get(b'I', "the depth of a pass", 1.0)?;
        let none = [(b'P', finishing == 0), (b'I', increment_mm <= 0.0)];
        if let Some((letter, _)) = none.into_iter().find(|(_, none)| *none) {
            let message = format!("{}0 cuts nothing", char::from(letter));
            return Err(BlockDiagnostic::new(
                DiagnosticCode::CannedCycle,
                block.span(letter),
                message,
            )
            .because("P counts the finishing passes, and I is the depth of a roughing pass")
            .help("write a number above zero"));
        }
        Ok(LatheCycleWords {
            cycle,
            distance_mm: get(b'D', "the distance from the profile", 0.0)?,
            end_mm: get(b'E', "the distance from the profile", 0.0)?,
            finishing,
            increment_mm,
            retract_mm: get(b'R', "the retreat", 0.5)?,
            first_level: 0.0,
            repeating: None,
        })
    }

    /// Z and X of the tool, program coordinates.
    pub(crate) fn lathe_point(&self) -> Point {
        let program = self.state.offsets.to_program(self.state.position);
        [program[Axis::Z.index()], program[Axis::X.index()]]
    }
}

/// The subroutine of a cycle.
pub(crate) fn label(block: &Block) -> Outcome<u32> {
    whole(block, b'Q', MAX_LABEL)?.ok_or_else(|| {
        let meaning = "the number of the subroutine with the profile";
        let found = missing(block.motion_span(), "a lathe cycle", "Q", meaning);
        if block.has_any(Letters::of(b"DIPRE")) {
            return found;
        }
        found.help("add the Q word; if units are meant, as G70 and G71 are on other controls, write G20 (inches) or G21 (mm)")
    })
}
