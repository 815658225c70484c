//! The switch between two kinematics by M428 and M429, on LinuxCNC's five-axis machines.
//!
//! M428 is the one that the machine starts with, where the tip of the tool is followed; with M429 the
//! axes are the machine's own. The machine comes to rest in between, and stays where it is. A machine
//! without five axes knows them only where its configuration declares them.

use glidepath_program::{Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::tip::Tip;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::refused::refused_m;

impl Interpreter {
    pub(crate) fn switch_kinematics(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let declared = block.codes.user.filter(|coded| is_switch(coded.code));
        let Some(Coded { code, span }) = block.codes.kinematics.or(declared) else {
            return Ok(());
        };
        if self.options.five_axis.is_none() {
            return match declared {
                Some(_) => Ok(()),
                None => Err(refused_m(code, f64::from(code), span)),
            };
        }
        let tip = match code {
            428 => Tip::PLAIN,
            429 => Tip::Stands,
            _ => {
                let message = "M430 (kinematics of the user) is not supported";
                return Err(
                    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                        .because("what they are is made for each machine, and not known here")
                        .help("write M428 or M429"),
                );
            }
        };
        if self.state.on_contour || self.state.leaving_contour {
            let message = format!("M{code} with cutter radius compensation on");
            return Err(BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
                .because("the tool stands beside the programmed point, at a place that depends on the next move")
                .help("write G40 and a move before it"));
        }
        if self.state.tip != tip {
            self.push(out, ItemKind::Dwell(0.0));
            self.set_tip(tip);
        }
        Ok(())
    }
}

/// True for the codes that switch the kinematics.
const fn is_switch(number: u32) -> bool {
    matches!(number, 428..=430)
}
