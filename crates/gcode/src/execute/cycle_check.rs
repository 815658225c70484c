//! What a canned cycle needs: the feed, its axes, and a spindle that turns as it should.

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::cycle_words::name;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::sticky_words::StickyWords;
use crate::execute::tapping_cycle::tap_turns;
use crate::syntax::block::Block;
use crate::syntax::modes::{CannedCycle, FeedMode};

impl Interpreter {
    /// Refuses cycles that cannot be made.
    pub(super) fn check_cycle(&self, block: &Block, sticky: &StickyWords) -> Outcome<()> {
        let (span, cycle) = (block.motion_span(), sticky.cycle);
        self.check_cycle_of_lathe(block, cycle)?;
        let refuse = |span: SourceSpan, message: String, reason: &str, help: &str| {
            Err(
                BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                    .because(reason)
                    .help(help),
            )
        };
        if self.state.modal.feed_mode == FeedMode::InverseTime {
            return refuse(
                span,
                "a canned cycle with inverse-time feed (G93)".to_owned(),
                "the time of the block would be shared by several moves",
                "write G94",
            );
        }
        let plane = self.state.modal.plane;
        let (first, second) = plane.axes();
        let of_cycle = [first, second, plane.normal()];
        let is_other = |axis: &Axis| !of_cycle.contains(axis) && !self.turns_to_hole(block, *axis);
        if let Some((axis, _)) = block.axes().find(|(axis, _)| is_other(axis)) {
            return refuse(
                block.axis_span(axis),
                format!("{axis} in a canned cycle"),
                "a cycle moves the three axes of its plane only",
                "move the other axes in a block of their own",
            );
        }
        let wrong = match (tap_turns(cycle), self.state.spindle.turning) {
            (Some(wanted), Some(turning)) => turning != wanted,
            // Behind M29, and as an axis, the cycle itself lets it turn.
            (Some(_), None) => !sticky.starts_spindle && !self.taps_by_axis(sticky),
            (None, turning) => {
                let stops = cycle == CannedCycle::BoreStop || cycle.goes_aside();
                stops && turning.is_none()
            }
        };
        if wrong {
            let message = "the spindle does not turn as the cycle needs it";
            let help = match cycle {
                CannedCycle::TapLeft if block.is_lathe => "write M4 before G184",
                CannedCycle::TapLeft => "write M4 before G74",
                CannedCycle::TapRight => "write M3 before G84",
                _ => "write M3 or M4 before the cycle",
            };
            return Err(BlockDiagnostic::new(DiagnosticCode::Spindle, span, message)
                .because("the cycle stops or reverses the spindle at the bottom")
                .help(help));
        }
        Ok(())
    }

    /// Refuses the cycles on the face that a Haas has, and FANUC's lathes have not or on the side.
    fn check_cycle_of_lathe(&self, block: &Block, cycle: CannedCycle) -> Outcome<()> {
        use CannedCycle::{BoreDwell, BoreStop, Drill, DrillDwell, TapLeft};
        let is_of_haas = matches!(cycle, Drill | DrillDwell | BoreStop | BoreDwell | TapLeft);
        if !block.is_lathe || !is_of_haas || self.options.fanuc.is_haas() {
            return Ok(());
        }
        let message = format!("{} on a lathe of FANUC", name(cycle, true));
        let why = if cycle == BoreDwell {
            "it works on the side of the part there, which is not made; on a Haas it bores the face"
        } else {
            "its cycles on the face are G83, G84 and G85; a Haas has this one"
        };
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, block.motion_span(), message)
                .because(why)
                .help(
                    "set `offset_memory = \"haas\"` of [program] if the program is of a Haas, or write G83, G84 or G85",
                ),
        )
    }
}
