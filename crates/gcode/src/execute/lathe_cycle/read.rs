//! The reading of a cycle's profile from its subroutine.

use std::io::BufRead;
use std::sync::Arc;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::flow::kept_lines::KeptLines;
use crate::execute::lathe_cycle::begin::label;
use crate::execute::lathe_cycle::open::OpenLatheCycle;
use crate::execute::lathe_cycle::profile::LatheProfile;
use crate::execute::line_origin::LineOrigin;
use crate::execute::program::Program;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{LatheCycle, Motion};
use crate::syntax::o_word::Label;

/// What the block of a cycle asks for.
pub(crate) struct AskedLatheCycle {
    cycle: LatheCycle,
    part: Arc<KeptLines>,
}

impl<R: BufRead> Program<R> {
    /// The cycle that a block asks for, and the subroutine of its profile.
    pub(crate) fn asked_lathe_cycle(&self, block: &Block) -> Outcome<Option<AskedLatheCycle>> {
        let Some(motion) = block.codes.motion else {
            return Ok(None);
        };
        let Some(Motion::Lathe(cycle)) = motion.code else {
            return Ok(None);
        };
        if block.dialect != Dialect::LinuxCnc {
            let message = "a lathe cycle in this dialect is not supported";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, motion.span, message)
                    .because("its words mean something else than LinuxCNC's")
                    .help("let the CAM system write the passes out"),
            );
        }
        if self.lathe_cycle.is_some() {
            let message = "a lathe cycle in the profile of another one";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CannedCycle, motion.span, message)
                    .because("a profile is drawn by G0, G1, G2 and G3 alone"),
            );
        }
        let label = Label::Number(label(block)?);
        match self.flow.subroutines.get(&label) {
            Some(part) => Ok(Some(AskedLatheCycle {
                cycle,
                part: Arc::clone(part),
            })),
            None => {
                let message = format!("there is no subroutine {label}");
                let span = block.span(b'Q');
                Err(BlockDiagnostic::new(DiagnosticCode::UnknownSubroutine, span, message)
                    .because(
                        "the profile is a subroutine of the same file, defined before the cycle",
                    )
                    .help("define it before this line"))
            }
        }
    }

    /// Begins to read the profile.
    pub(crate) fn open_lathe_cycle(&mut self, asked: &AskedLatheCycle) -> Outcome<()> {
        let block = self.block().clone();
        let words = self.interpreter.lathe_words(&block, asked.cycle)?;
        let cycle = OpenLatheCycle {
            line: self.line_of_program(),
            source: self.here(),
            level: self.parameters.call_level(),
            words,
            profile: LatheProfile::new(self.interpreter.lathe_point()),
            state: self.interpreter.state.clone(),
            block,
        };
        self.enter(&asked.part, &[], cycle.block.span(b'Q'))?;
        self.lathe_cycle = Some(Box::new(cycle));
        Ok(())
    }

    /// Draws a block of the profile. Parameters that show the position show its end.
    pub(crate) fn draw_block(&mut self) -> Outcome<()> {
        let Some(mut cycle) = self.lathe_cycle.take() else {
            return Ok(());
        };
        cycle.profile.add(self.block(), &self.interpreter)?;
        let target = self.interpreter.lathe_target(cycle.profile.at);
        self.interpreter.state.position = target;
        self.lathe_cycle = Some(cycle);
        Ok(())
    }

    /// Makes the moves of the cycle, once its profile is complete.
    pub(crate) fn close_lathe_cycle(&mut self) -> Outcome<()> {
        let level = self.parameters.call_level();
        let Some(cycle) = self.lathe_cycle.take_if(|cycle| cycle.level >= level) else {
            return Ok(());
        };
        self.origin = LineOrigin::Past(cycle.source.clone());
        self.interpreter.state = cycle.state.clone();
        self.interpreter.line = cycle.line;
        let mut items = Vec::new();
        self.interpreter.make_lathe_cycle(&cycle, &mut items)?;
        self.give(items);
        Ok(())
    }
}
