//! The levels of canned cycles along the normal axis: the initial level, R, the bottom, and the level to which
//! the tool comes out.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::canned_cycle::Hole;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::sticky_words::StickyWords;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{CannedCycle, Distance, Motion, Retract};

impl Interpreter {
    /// The initial level of a series that begins here: the place of the program, with the length of the tool
    /// that its next move has.
    pub(super) fn level_before(&self) -> f64 {
        let normal = self.state.modal.plane.normal();
        let program = self.state.offsets.to_program(self.state.position);
        program[normal.index()] + self.length_on_way()[normal.index()]
    }

    /// The R plane and the bottom, coordinates. A FANUC keeps them as such: words of a block before mean
    /// what they meant there.
    pub(super) fn levels(&self, block: &Block, sticky: &StickyWords, initial: f64) -> [f64; 2] {
        let normal = self.state.modal.plane.normal();
        let is_incremental = self.state.modal.distance == Distance::Incremental;
        let last = self.state.cycles.last;
        let kept = last.filter(|_| block.dialect == Dialect::Fanuc);
        let kept = kept.and_then(|last| last.levels_mm);
        let says_depth = block.axes().any(|(axis, _)| axis == normal);
        let from = |base: f64| if is_incremental { base } else { 0.0 };
        let r = match kept {
            Some([r, _]) if block.get(b'R').is_none() => r,
            _ => from(initial) + sticky.r,
        };
        let bottom = match kept {
            Some([_, bottom]) if !says_depth => bottom,
            _ => from(r) + sticky.depth,
        };
        [r, bottom]
    }

    /// Refuses another plane on a FANUC while a cycle is in force: its levels are those of the axis before.
    pub(crate) fn check_plane_of_cycle(&self, block: &Block) -> Outcome<()> {
        let modal = &self.state.modal;
        let is_on = matches!(modal.motion, Some(Motion::Cycle(_)));
        let changed = block.codes.plane.filter(|plane| plane.code != modal.plane);
        let (Some(plane), true, Dialect::Fanuc, false) =
            (changed, is_on, block.dialect, block.is_lathe)
        else {
            return Ok(());
        };
        let ends = block
            .codes
            .motion
            .is_some_and(|motion| !matches!(motion.code, Some(Motion::Cycle(_))));
        if ends {
            return Ok(());
        }
        let message = "another plane while a drilling cycle is in force";
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, plane.span, message)
                .because("R and the depth of the cycle are of the axis that it began with")
                .help("write G80 before it, and the cycle with all its words behind it"),
        )
    }

    /// Refuses an R plane below the bottom.
    pub(super) fn check_levels(&self, block: &Block, [r, bottom]: [f64; 2]) -> Outcome<()> {
        if r >= bottom {
            return Ok(());
        }
        let message = "the R plane is below the bottom of the hole";
        let letter = self.state.modal.plane.normal().letter();
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, block.span(b'R'), message)
                .because(format!(
                    "the cycle goes from R down to {letter}; with G91 the depth counts from R"
                ))
                .help("check both words, and G90 or G91"),
        )
    }

    /// The level to which a cycle comes out. A FANUC goes back to where the cycle began, below R, too.
    ///
    /// # Errors
    ///
    /// That level is no higher than the bottom, or below R on a Haas: the way to it, and across to the next
    /// hole, would lead through the part.
    pub(super) fn way_out(
        &self,
        block: &Block,
        cycle: CannedCycle,
        [initial, r, bottom]: [f64; 3],
    ) -> Outcome<f64> {
        let is_fanuc = block.dialect == Dialect::Fanuc && cycle != CannedCycle::BackBore;
        let to_r = !block.has_increments() && cycle != CannedCycle::BackBore;
        if self.state.modal.retract == Retract::RPlane && to_r {
            return Ok(r);
        }
        if !is_fanuc || initial >= r {
            return Ok(initial.max(r));
        }
        let is_haas = self.options.fanuc.is_haas();
        let (message, why) = if initial <= bottom {
            (
                "the cycle begins below the bottom of its hole",
                "it comes out at rapid to the level where it began, through the bottom",
            )
        } else if is_haas {
            (
                "the cycle begins below its R plane",
                "it comes out to the level where it began, and what a Haas makes of one below R is not known",
            )
        } else {
            return Ok(initial);
        };
        let letter = self.state.modal.plane.normal().letter();
        let help = if to_r {
            format!("write G99, or a higher {letter} before it")
        } else {
            format!("write a higher {letter} before it")
        };
        let span = block.motion_span();
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                .because(why)
                .help(help),
        )
    }

    /// The hole that the cycle in force makes; `None` if none is, or a lathe's.
    pub(super) fn hole_of_series(&self, block: &Block) -> Outcome<Option<Hole>> {
        let series = &self.state.cycles;
        let is_on = matches!(self.state.modal.motion, Some(Motion::Cycle(_)));
        let last = series.last.filter(|_| is_on);
        let levels = last.and_then(|sticky| sticky.levels_mm).zip(series.initial);
        let (Some(sticky), Some(([r, bottom], initial))) = (last, levels) else {
            return Ok(None);
        };
        let clear = self.way_out(block, sticky.cycle, [initial, r, bottom])?;
        Ok(Some(Hole {
            sticky,
            r,
            bottom,
            clear,
        }))
    }
}
