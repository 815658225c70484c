//! FANUC: macro B, subprograms, and the words that are read otherwise.
//!
//! ```text
//! IF [cond] GOTO n · IF [cond] THEN #i = value · GOTO n · WHILE [cond] DO m … END m
//! G65 P n arguments · G66 P n arguments · M98 P n L k · M97 P n · M99 · M99 P n
//! #3000=n(TEXT) · #5221=… · G10 L2, L20, L10 to L13 · G43, G44, G43.4 · G45 to G48 · G51, G51.1, G68, G101
//! G16
//! ```

mod arguments;
mod assign;
pub(crate) mod call;
mod circular_pocket;
mod frames;
mod groove;
mod hole_pattern;
mod increments;
mod lathe_finish;
mod lathe_offsets;
mod lathe_profile;
mod lengthening;
mod loops;
mod mirror_switch;
mod modal_macro;
mod modes;
mod named_program;
mod numbered_program;
mod offsets;
mod plane_of_blocks;
mod polar;
mod printing;
mod profile_lines;
mod rotation_start;
mod statement;
mod tilted_plane;
mod tip;
mod tool_length;
mod tool_variables;
mod turning;
mod turret;
pub(crate) mod variables;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::setup::tool_table::MAX_TOOL;
use crate::syntax::block::Block;
use crate::syntax::word_check::whole;

impl Interpreter {
    /// The modes that are FANUC's alone.
    pub(crate) fn fanuc_modes(&mut self, block: &Block) -> Outcome<()> {
        if let Some(coded) = block.codes.dynamic {
            self.dynamic_offset(coded)?;
        }
        if !block.is_lathe
            && let Some(number) = whole(block, b'D', MAX_TOOL)?
        {
            if self.state.on_contour && block.codes.cutter_radius.is_none() {
                return Err(another_radius(block.span(b'D')));
            }
            self.state.fanuc.radius_offset = number;
        }
        if let Some(number) = block.codes.last_m {
            self.state.fanuc.m_code = number;
        }
        if let Some(coded) = block.codes.thread_end {
            self.state.fanuc.ends_thread_straight = coded.code;
        }
        self.length_without_code(block)?;
        self.check_look_ahead(block)?;
        self.extended_system(block)?;
        self.fanuc_frame(block)?;
        self.fanuc_polar(block);
        Ok(())
    }

    /// Look-ahead is switched by a word: without it the code is another one.
    fn check_look_ahead(&self, block: &Block) -> Outcome<()> {
        let Some(coded) = block.codes.read_over else {
            return Ok(());
        };
        let word = match coded.code {
            50 | 80 => b'P',
            51 => b'Q',
            _ => return Ok(()),
        };
        if block.get(word).is_some() {
            return Ok(());
        }
        let message = format!("look-ahead without {}", char::from(word));
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
                .because("the code has other meanings with other words, which are not made")
                .help(format!(
                    "write {}0 or {}1 behind it",
                    char::from(word),
                    char::from(word)
                )),
        )
    }
}

#[cold]
fn another_radius(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "another radius with cutter radius compensation on";
    BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
        .because(
            "the tool stands beside the programmed point, at a place that depends on the next move",
        )
        .help("write G40 and a move before it")
}
