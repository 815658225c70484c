//! G101 and G100 of Haas' mills: the mirror image of an axis, about the zero of the work offset, switched on
//! and off.
//!
//! `G101 X0` mirrors X, `G100 X0` ends that. They move nothing, and stand in a block of their own. To a FANUC
//! these numbers are free for macros of the machine's builder.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::codes::Codes;
use crate::syntax::word_check::missing;

impl Interpreter {
    /// Switches the axes of the block.
    pub(super) fn switch_mirror(
        &self,
        block: &Block,
        span: SourceSpan,
        begins: bool,
        mirror: &mut [Option<f64>; 3],
    ) -> Outcome<()> {
        let name = if begins { "G101" } else { "G100" };
        if !block.has_axes() {
            return Err(missing(span, name, "an axis", "which one is switched"));
        }
        let refuse = |span: SourceSpan, message: String, reason: &str, help: &str| {
            Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because(reason)
                    .help(help),
            )
        };
        if !self.options.fanuc.is_haas() {
            return refuse(
                span,
                format!("{name}, which is a code of a Haas"),
                "to a FANUC it may be a macro of the machine's builder",
                "write G51.1 and G50.1, or say that it is a Haas: `offset_memory = \"haas\"` of [program]",
            );
        }
        let others = Codes {
            frame: None,
            ..block.codes
        };
        if others.any() || block.codes.frame_ends.contains(&true) {
            return refuse(
                span,
                format!("another code beside {name}"),
                "it stands in a block of its own",
                "write two blocks",
            );
        }
        for (axis, word) in block.axes() {
            let axis_span = block.axis_span(axis);
            if word != 0.0 {
                return refuse(
                    axis_span,
                    format!("{name} {axis} with another value than 0"),
                    "a Haas mirrors about the zero of the work offset, and what the value would say is not known here",
                    "write 0",
                );
            }
            let i = axis.index();
            if begins && i > 1 {
                return refuse(
                    axis_span,
                    format!("a mirror image of {axis}"),
                    "what becomes of the length of the tool, and of rotary axes, is not known here",
                    "mirror X or Y, and write the other axes as they are to move",
                );
            }
            if begins && self.has_local_zero(i) {
                return refuse(
                    axis_span,
                    format!("{name} {axis} with a zero of G52 or G92 in force"),
                    "whether that zero is the one about which a Haas mirrors is not known here",
                    "take it back by G52 X0 Y0 or G92.1 before it",
                );
            }
            if let Some(slot) = mirror.get_mut(i) {
                *slot = begins.then_some(0.0);
            }
        }
        Ok(())
    }

    fn has_local_zero(&self, axis: usize) -> bool {
        let offsets = &self.state.offsets;
        offsets.shift[axis] != 0.0 || offsets.fanuc.local[axis] != 0.0
    }
}
