//! The use of a block's axis words: by a code that acts once, or by a motion mode.

use glidepath_geometry::{AXES, Axis};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::setup::fanuc::FanucControl;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::frame_codes::FrameCode;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{Distance, Motion, NonModal, ToolLength, Turning};
use crate::syntax::word_check::missing;

impl Interpreter {
    /// The motion the block makes, if any: its own code, or the modal one if it has axis words
    /// that nothing else takes.
    pub(crate) fn motion_of(&self, block: &Block) -> Outcome<Option<Motion>> {
        let non_modal = block
            .codes
            .non_modal
            .filter(|non_modal| non_modal.code.takes_axes());
        let length = block.codes.tool_length.filter(|length| match length.code {
            ToolLength::FromWords => true,
            ToolLength::Add => block.get(b'H').is_none(),
            _ => false,
        });
        let fanuc = block.dialect == Dialect::Fanuc;
        if has_other_axes(block) {
            return Ok(None);
        }
        if let Some(read_over) = block.codes.read_over.filter(|_| block.has_axes()) {
            return Err(conflict(read_over.span));
        }
        let taken = non_modal.is_some() || length.is_some();
        let has_axes = block.has_axes();
        if let (Some(_), Some(Coded { span, .. })) = (non_modal, length) {
            return Err(conflict(span));
        }
        match (block.codes.motion, taken) {
            (
                Some(Coded {
                    code: Some(_),
                    span,
                }),
                true,
            ) => Err(conflict(span)),
            (Some(Coded { code: None, .. }), false) if has_axes && fanuc => {
                Ok(Some(self.motion_beside_cycles()))
            }
            (Some(Coded { code: None, span }), false) if has_axes => Err(BlockDiagnostic::new(
                DiagnosticCode::NoMotionMode,
                span,
                "axis words in a block with G80",
            )
            .because("G80 ends the motion mode, so nothing uses them")
            .help("remove G80 or the axis words")),
            (
                Some(Coded {
                    code: Some(motion),
                    span,
                }),
                false,
            ) => {
                // The first block of FANUC's G76 goes nowhere.
                let is_setup = fanuc && motion == Motion::ThreadCycle;
                let needs = matches!(
                    motion,
                    Motion::Cycle(_)
                        | Motion::Probe(_)
                        | Motion::Thread
                        | Motion::RigidTap
                        | Motion::ArcThrough
                        | Motion::ArcTangent
                        | Motion::TapIn
                        | Motion::TapOut
                        | Motion::ThreadCycle
                        | Motion::Turning(_)
                ) && !is_setup
                    && !self.is_in_header(motion);
                if needs && !has_axes {
                    let meaning = "where to go";
                    return Err(missing(
                        span,
                        "a cycle, a thread or a probing move",
                        "an axis",
                        meaning,
                    ));
                }
                let may_lack = motion.may_lack_axes() || matches!(motion, Motion::Groove(_));
                Ok((has_axes || is_setup || may_lack).then_some(motion))
            }
            (_, true) => Ok(None),
            (_, false) => self.modal_motion(block, has_axes),
        }
    }

    /// True for G90 of a lathe of system A, which stands in headers: without an axis it cuts nothing. G92 and G94, and the
    /// G20 of system C, stay refused there: on other systems they limit the spindle, or say what F or inches are.
    const fn is_in_header(&self, motion: Motion) -> bool {
        let is_of_a = matches!(
            self.options.fanuc.control,
            None | Some(FanucControl::LatheA)
        );
        is_of_a && matches!(motion, Motion::Turning(Turning::Turn))
    }

    fn modal_motion(&self, block: &Block, has_axes: bool) -> Outcome<Option<Motion>> {
        let modal = self.state.modal.motion;
        if has_axes {
            return modal.map(Some).ok_or_else(|| {
                let span = block.motion_span();
                BlockDiagnostic::new(
                    DiagnosticCode::NoMotionMode,
                    span,
                    "axis words without a motion mode",
                )
                .because("no G0, G1, G2, G3 or cycle is in force")
                .help("write the motion code in front of them")
            });
        }
        let is_fanuc = block.dialect == Dialect::Fanuc;
        if is_fanuc && matches!(modal, Some(Motion::Cycle(_))) && block.get(b'R').is_some() {
            // Another R drills again where the tool is.
            return Ok(modal);
        }
        let center = block.has_any(Letters::of(b"IJK"));
        Ok(modal.filter(|motion| center && motion.may_lack_axes()))
    }

    pub(crate) fn check_axes(&self, block: &Block) -> Outcome<()> {
        if block.has_increments() && block.get(b'H').is_some() {
            self.check_axis_of_h(block)?;
        }
        if !block.has_any(self.lacking) || block.has_increments() && self.has_lathe_axes(block) {
            return Ok(());
        }
        // In FANUC's G76 A is the angle of the tool.
        let is_thread = block.dialect == Dialect::Fanuc
            && block
                .codes
                .motion
                .is_some_and(|coded| coded.code == Some(Motion::ThreadCycle));
        // X and U of a dwell are seconds.
        let is_dwell = block.dialect == Dialect::Fanuc
            && block
                .codes
                .non_modal
                .is_some_and(|coded| coded.code == NonModal::Dwell);
        let has = |axis: Axis| {
            self.options.machine.has(axis)
                || is_dwell && matches!(axis, Axis::X | Axis::U)
                || is_thread && axis == Axis::A
                || axis == Axis::W && homes_without_mesh(block)
        };
        match block.axes().find(|(axis, _)| !has(*axis)) {
            None => Ok(()),
            Some((axis, _)) => {
                let message = format!("the machine has no {axis} axis");
                let names: String = Axis::ALL
                    .into_iter()
                    .filter(|a| self.options.machine.has(*a))
                    .flat_map(|a| [' ', a.letter()])
                    .collect();
                Err(BlockDiagnostic::new(
                    DiagnosticCode::AxisNotConfigured,
                    block.axis_span(axis),
                    message,
                )
                .because(format!("its configuration has:{names}"))
                .help("remove the word, or configure the axis"))
            }
        }
    }

    /// H of a lathe is the increment of C.
    fn check_axis_of_h(&self, block: &Block) -> Outcome<()> {
        if self.options.machine.has(Axis::C) {
            return Ok(());
        }
        let message = "the machine has no C axis";
        Err(
            BlockDiagnostic::new(DiagnosticCode::AxisNotConfigured, block.span(b'H'), message)
                .because("H is the increment of C on a FANUC's lathe")
                .help("remove the word, or configure the axis"),
        )
    }

    /// Axis words in mm and degrees, X and Y in the place of polar words, X halved in diameter
    /// mode.
    pub(crate) fn axis_values(&self, block: &Block) -> Outcome<[Option<f64>; AXES]> {
        let mut values = self.written_values(block)?;
        if block.named.are_places() {
            self.resolve_pole(block, &mut values)?;
            self.resolve_line_angle(block, &mut values)?;
            self.resolve_vector(block, &mut values)?;
        }
        self.resolve_polar(block, &mut values)?;
        self.resolve_fanuc_polar(block, &mut values)?;
        if block.dialect == Dialect::Marlin {
            self.extruder_value(block, &mut values)?;
        }
        Ok(values)
    }

    /// Axis words as they are written, in mm and degrees.
    pub(crate) fn written_values(&self, block: &Block) -> Outcome<[Option<f64>; AXES]> {
        let scale = self.state.modal.units.mm();
        let mut values = [None; AXES];
        for (axis, value) in block.axes() {
            values[axis.index()] = Some(axis_value(axis, value, scale));
        }
        if self.state.modal.diameter {
            values[0] = values[0].map(|x| 0.5 * x);
        }
        if block.has_increments() {
            self.resolve_increments(block, &mut values)?;
        }
        Ok(values)
    }

    /// Puts the E word of a printer's program into the place of its axis.
    fn extruder_value(&self, block: &Block, values: &mut [Option<f64>; AXES]) -> Outcome<()> {
        let Some(word) = block.get(b'E') else {
            return Ok(());
        };
        let Some(axis) = self.options.extruder else {
            let message = "no axis is the extruder";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::AxisNotConfigured,
                block.span(b'E'),
                message,
            )
            .because("E words move an axis of the machine")
            .help("name the axis: `extruder` of [program] in the configuration"));
        };
        let value = word * self.state.modal.units.mm();
        let program = self.state.offsets.to_program(self.state.position)[axis.index()];
        let incremental = self.state.modal.distance == Distance::Incremental;
        let names = block.codes.non_modal.is_some();
        let Some(relative) = self.state.extruder.is_relative(self.state.firmware) else {
            return Err(extruder_in_doubt(block.span(b'E')));
        };
        values[axis.index()] = Some(match (relative, incremental) {
            _ if names => value,
            (true, false) => program + value,
            (false, true) => value - program,
            _ => value,
        });
        Ok(())
    }
}

/// True where the axis words of a block are none of a motion, and none of another code that moves.
fn has_other_axes(block: &Block) -> bool {
    let codes = &block.codes;
    // On a FANUC X may be the time of a dwell, and a motion code beside G28 is only the next mode.
    let fanuc = block.dialect == Dialect::Fanuc;
    let code = codes.non_modal.map(|non_modal| non_modal.code);
    if fanuc && matches!(code, Some(NonModal::Dwell | NonModal::GoToReference(_))) {
        return true;
    }
    // They are the zero of a plane, or say about what coordinates are turned, scaled or mirrored.
    codes.tilt.is_some()
        || codes.kept_place.is_some()
        || matches!(
            codes.frame.map(|frame| frame.code),
            Some(
                FrameCode::Scale(true)
                    | FrameCode::Turn(true)
                    | FrameCode::Mirror(_)
                    | FrameCode::Switch(_)
            )
        )
}

/// An axis word in mm or degrees; `scale` is the unit of length in mm.
pub(crate) fn axis_value(axis: Axis, word: f64, scale: f64) -> f64 {
    if axis.is_rotary() { word } else { word * scale }
}

#[cold]
fn extruder_in_doubt(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "whether E is relative depends on the printer's firmware";
    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, span, message)
        .because("behind M83 G90 makes E absolute to Marlin, and leaves it relative to Klipper; M82 within G91 differs likewise")
        .help("write M82 or M83 behind G90 or G91, or say which it is: `firmware` of [program] in the configuration")
}

#[cold]
fn conflict(span: SourceSpan) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::AxisWordsConflict,
        span,
        "two codes want the axis words",
    )
    .because("G10, G28, G30, G52, G92 and G43.1 take them for themselves")
    .help("write two blocks")
}

/// True for `G28 W` of printers without such an axis: all axes go, and nothing is levelled.
pub(crate) fn homes_without_mesh(block: &Block) -> bool {
    block.dialect == Dialect::Marlin
        && block
            .codes
            .non_modal
            .is_some_and(|code| matches!(code.code, NonModal::GoToReference(_)))
}
