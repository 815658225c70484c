//! Codes that act once (group 0): coordinate systems, offsets, reference positions.

use glidepath_geometry::{AXES, AxisVector};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::block_words::require_axes;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::offsets::overlay;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{Distance, Motion, NonModal};
use crate::syntax::word_check::{missing, unused, whole};

#[cold]
fn dwell_with_axes(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "G4 beside words of axes";
    BlockDiagnostic::new(DiagnosticCode::UnusedWord, span, message)
        .because("on a SINUMERIK a dwell has a block of its own")
        .help("write two blocks")
}

impl Interpreter {
    pub(crate) fn act_non_modal(
        &mut self,
        block: &Block,
        non_modal: Coded<NonModal>,
        motion: Option<Motion>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let position = self.state.position;
        let keeps_frame = block.dialect == Dialect::Fanuc && non_modal.code == NonModal::SetData;
        if !keeps_frame {
            self.check_frame(non_modal)?;
        }
        match non_modal.code {
            // The dwell comes earlier, the machine coordinates with the motion.
            NonModal::Dwell if block.dialect == Dialect::Siemens && block.has_axes() => {
                return Err(dwell_with_axes(block.motion_span()));
            }
            NonModal::Dwell => {}
            // A block of it alone moves nothing.
            NonModal::MachineCoordinates
                if block.dialect == Dialect::Siemens && !block.has_axes() => {}
            NonModal::MachineCoordinates => {
                self.check_machine_coordinates(block, non_modal.span, motion)?;
            }
            NonModal::SetData if block.dialect == Dialect::Fanuc => {
                self.set_fanuc_data(block, non_modal.span)?;
            }
            NonModal::SetData => self.set_data(block, non_modal.span)?,
            NonModal::GoToReference(index) => {
                check_second_reference(block, index)?;
                self.go_to_reference(block, index, out)?;
            }
            NonModal::SetReference(index) => {
                if let Some(reference) = self.state.offsets.reference.get_mut(index) {
                    *reference = position;
                }
            }
            NonModal::SetPole(from) => self.set_pole(block, from, non_modal.span)?,
            NonModal::LocalOffset => {
                let values = self.axis_values(block)?;
                require_axes(block, non_modal.span, "G52")?;
                if block.dialect == Dialect::Fanuc {
                    let fanuc = &mut self.state.offsets.fanuc;
                    fanuc.local = overlay(fanuc.local, &values);
                    return Ok(());
                }
                self.state.offsets.shift = overlay(self.state.offsets.shift, &values);
                self.state.offsets.saved_shift = self.state.offsets.shift;
            }
            NonModal::LatheSetting => {
                if block.has_axes() {
                    let values = self.named_places(block, non_modal.span)?;
                    self.end_local_offset(&values);
                    self.state.offsets.set_shift(position, &values);
                }
            }
            NonModal::SetOffset => {
                let values = self.named_places(block, non_modal.span)?;
                require_axes(block, non_modal.span, "G92")?;
                self.end_local_offset(&values);
                self.state.offsets.set_shift(position, &values);
            }
            NonModal::PresetSystem => self.preset_system(block, non_modal.span)?,
            NonModal::ClearOffset => {
                self.state.offsets.shift = AxisVector::zeros();
                self.state.offsets.saved_shift = AxisVector::zeros();
            }
            NonModal::SuspendOffset => self.state.offsets.shift = AxisVector::zeros(),
            NonModal::RestoreOffset => self.state.offsets.shift = self.state.offsets.saved_shift,
        }
        Ok(())
    }

    /// The coordinates that G92 gives the place of the machine. In G91 those of a FANUC are added to the present
    /// ones; the other controls count them from zero in both.
    fn named_places(&self, block: &Block, span: SourceSpan) -> Outcome<[Option<f64>; AXES]> {
        let mut values = self.axis_values(block)?;
        let is_added =
            block.dialect == Dialect::Fanuc && self.state.modal.distance == Distance::Incremental;
        if !is_added {
            return Ok(values);
        }
        if self.options.fanuc.is_haas() {
            let message = "G92 with incremental distances (G91) on a Haas";
            return Err(BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because("whether its words are added to the coordinates, as a FANUC does, or are the coordinates is not known here")
                .help("write G90 into this block, or before it"));
        }
        let program = self.state.offsets.to_program(self.state.position);
        for (value, here) in values.iter_mut().zip(program.iter()) {
            *value = value.map(|value| value + here);
        }
        Ok(values)
    }

    /// G92 ends the local offset (G52) of the axes that it names.
    fn end_local_offset(&mut self, values: &[Option<f64>; AXES]) {
        for (local, value) in self.state.offsets.fanuc.local.iter_mut().zip(values) {
            if value.is_some() {
                *local = 0.0;
            }
        }
    }

    /// G92.1 of FANUC: the axes that it names, with 0, lose what G92 and G52 have shifted.
    fn preset_system(&mut self, block: &Block, span: SourceSpan) -> Outcome<()> {
        let values = self.axis_values(block)?;
        require_axes(block, span, "G92.1")?;
        if values.iter().flatten().any(|value| *value != 0.0) {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::InvalidValue,
                block.motion_span(),
                "G92.1 with another number than 0",
            )
            .because("its words name the axes whose offset is taken back")
            .help("write 0 behind each of them"));
        }
        self.end_local_offset(&values);
        for (shift, value) in self.state.offsets.shift.iter_mut().zip(&values) {
            if value.is_some() {
                *shift = 0.0;
            }
        }
        self.state.offsets.saved_shift = self.state.offsets.shift;
        Ok(())
    }

    /// Refuses to give places new names within a frame, whose coordinates they would not be.
    fn check_frame(&self, non_modal: Coded<NonModal>) -> Outcome<()> {
        let names_places = matches!(
            non_modal.code,
            NonModal::SetData
                | NonModal::LocalOffset
                | NonModal::LatheSetting
                | NonModal::SetOffset
                | NonModal::PresetSystem
                | NonModal::ClearOffset
                | NonModal::SuspendOffset
                | NonModal::RestoreOffset
        );
        if !names_places || !self.state.offsets.frame.is_in_force() {
            return Ok(());
        }
        let message = "an offset that is set within a frame";
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, non_modal.span, message)
                .because("its words would count in coordinates that are turned, mirrored or scaled")
                .help(
                    "end the frame in a line before it: by TRANS alone, or by G69, G50 and G50.1",
                ),
        )
    }

    fn check_machine_coordinates(
        &self,
        block: &Block,
        span: SourceSpan,
        motion: Option<Motion>,
    ) -> Outcome<()> {
        let fault =
            |message: &str| BlockDiagnostic::new(DiagnosticCode::MachineCoordinates, span, message);
        match motion {
            Some(Motion::Rapid | Motion::Linear) => {}
            _ => {
                return Err(fault("G53 without a straight move")
                    .because("machine coordinates hold for one G0 or G1 block")
                    .help("write G0 or G1 and the axis words into this block"));
            }
        }
        let increments = Letters::of(b"UVWH");
        if block.has_increments() && block.has_any(increments) {
            return Err(fault("G53 with an increment")
                .because("machine coordinates are absolute, and U, V, W and H are increments")
                .help("write X, Y, Z or C"));
        }
        if self.state.modal.distance == Distance::Incremental {
            return Err(fault("G53 with incremental distances (G91)")
                .because("machine coordinates are absolute")
                .help("write G90 into this block"));
        }
        Ok(())
    }

    /// G10.
    fn set_data(&mut self, block: &Block, span: SourceSpan) -> Outcome<()> {
        let kind = whole(block, b'L', 99)?.ok_or_else(|| {
            let meaning = "2 or 20 for a coordinate system, 1, 10 or 11 for a tool";
            missing(span, "G10", "L", meaning)
        })?;
        match kind {
            2 | 20 => {}
            1 | 10 | 11 => return self.set_tool(block, kind, span),
            _ => {
                let message = format!("G10 L{kind} is not supported");
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::NotSupported,
                    block.span(b'L'),
                    message,
                )
                .because("coordinate systems (L2, L20) and tools (L1, L10, L11) can be set"));
            }
        }
        let system = whole(block, b'P', 9)?
            .ok_or_else(|| missing(span, "G10", "P", "the coordinate system, 1 for G54"))?;
        let index = usize::try_from(system).unwrap_or_default();
        let index = index.checked_sub(1).unwrap_or(self.state.offsets.active);
        let values = self.axis_values(block)?;
        if kind == 20 {
            if block.get(b'R').is_some() {
                return Err(unused('R', block.span(b'R')));
            }
            self.state
                .offsets
                .set_current(index, self.state.position, &values);
        } else if let Some(slot) = self.state.offsets.systems.get_mut(index) {
            slot.origin = overlay(slot.origin, &values);
            slot.rotation_deg = block.get(b'R').unwrap_or(slot.rotation_deg);
        }
        Ok(())
    }
}

/// FANUC's G30 goes to the second, third or fourth reference position: P2, P3, P4.
fn check_second_reference(block: &Block, index: usize) -> Outcome<()> {
    let Some(which) = whole(block, b'P', 4)? else {
        return Ok(());
    };
    if index == 1 && which == 2 {
        return Ok(());
    }
    let message = format!("G30 P{which} is not supported");
    Err(
        BlockDiagnostic::new(DiagnosticCode::NotSupported, block.span(b'P'), message)
            .because("the machine has two reference positions, that of G28 and that of G30")
            .help("write G30, or G53 and the place"),
    )
}
