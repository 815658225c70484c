//! G54 to G59.3, and SINUMERIK's G500 and G505 to G599: which coordinate system is in force.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::fanuc_offsets::system_key;
use crate::setup::work_offsets::CoordinateSystem;
use crate::syntax::block::Block;
use crate::syntax::codes::{Coded, NO_SYSTEM};
use crate::syntax::modes::Units;

impl Interpreter {
    /// Refuses G70 or G71 beside G91.1 where other units are in force: of Mach3 they are inches and millimetres, and
    /// which of the two codes is meant cannot be told.
    pub(crate) fn check_units_of_mach(&self, block: &Block) -> Outcome<()> {
        let written = block.codes.units.map(|coded| coded.code);
        let in_force = written.unwrap_or(self.state.modal.units);
        let Some(Coded { code, span }) = block.codes.units_of_mach.filter(|of| of.code != in_force)
        else {
            return Ok(());
        };
        let (name, meaning, other) = match code {
            Units::Inch => ("G70", "inches", "G21 (millimetres)"),
            Units::Millimetre => ("G71", "millimetres", "G20 (inches)"),
        };
        let message = format!("{name} beside {other}");
        Err(BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, span, message)
            .because(format!(
                "without words of a lathe's cycle it is Mach3's code for {meaning}, and other units are in force"
            ))
            .help("remove it, or write G20 for inches or G21 for millimetres"))
    }

    pub(crate) fn choose_system(
        &mut self,
        Coded { code: index, span }: Coded<usize>,
    ) -> Outcome<()> {
        let offsets = &mut *self.state.offsets;
        if let Some(system) = offsets.fanuc.pending.remove(&index) {
            offsets.keep_system(index, system);
        }
        let fanuc = &mut offsets.fanuc;
        if index == NO_SYSTEM {
            fanuc.extended.insert(0, CoordinateSystem::default());
            fanuc.active = Some(0);
        } else if index < offsets.systems.len() {
            offsets.active = index;
            fanuc.active = None;
        } else {
            // Those of SINUMERIK from G510 on.
            let key = system_key(index);
            if !fanuc.extended.contains_key(&key) {
                return Err(system_not_set(index, span));
            }
            fanuc.active = Some(key);
        }
        Ok(())
    }
}

#[cold]
fn system_not_set(index: usize, span: SourceSpan) -> Box<BlockDiagnostic> {
    let code = index + 501;
    let message = format!("the coordinate system of G{code} was not set");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because(
            "the machine keeps G54 to G57 and G505 to G509; a program has the others that it sets",
        )
        .help(format!(
            "write $P_UIFR[{}]=CTRANS(X,0) with its offsets before it",
            index + 1
        ))
}
