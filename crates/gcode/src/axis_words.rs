//! What takes the axis words of a block: a code that acts once, or a motion mode.

use glidepath_geometry::{AXES, Axis};

use crate::block::{AXIS_WORDS, Block, Letters};
use crate::codes::{Coded, Motion};
use crate::diagnostic::{Code, Fault, Outcome};
use crate::interpreter::Interpreter;

impl Interpreter {
    /// The motion the block makes, if any: its own code, or the modal one if it has axis words
    /// that nothing else takes.
    pub(crate) fn motion_of(&self, block: &Block) -> Outcome<Option<Motion>> {
        let taken = block.codes.once.filter(|once| once.code.takes_axes());
        let has_axes = block.has_any(AXIS_WORDS);
        match (block.codes.motion, taken) {
            (
                Some(Coded {
                    code: Some(_),
                    span,
                }),
                Some(_),
            ) => Err(Fault::new(
                Code::AxisWordsConflict,
                span,
                "two codes want the axis words",
            )
            .because("G10, G28, G30, G52 and G92 take them for themselves")
            .help("write two blocks")),
            (Some(Coded { code: None, span }), None) if has_axes => {
                Err(
                    Fault::new(Code::NoMotionMode, span, "axis words in a block with G80")
                        .because("G80 ends the motion mode, so nothing uses them")
                        .help("remove G80 or the axis words"),
                )
            }
            (
                Some(Coded {
                    code: Some(motion), ..
                }),
                None,
            ) => {
                let arc = matches!(motion, Motion::ArcClockwise | Motion::ArcCounterclockwise);
                let moves = has_axes || arc;
                Ok(moves.then_some(motion))
            }
            (_, Some(_)) => Ok(None),
            (_, None) => self.modal_motion(block, has_axes),
        }
    }

    fn modal_motion(&self, block: &Block, has_axes: bool) -> Outcome<Option<Motion>> {
        let modal = self.state.modal.motion;
        if has_axes {
            return modal.map(Some).ok_or_else(|| {
                let first = block.axes().map(|(axis, _)| block.axis_span(axis));
                let span = first.min_by_key(|span| span.start).unwrap_or_default();
                Fault::new(Code::NoMotionMode, span, "axis words without a motion mode")
                    .because("no G0, G1, G2 or G3 is in force")
                    .help("write the motion code in front of them")
            });
        }
        let center = block.has_any(Letters::of(b"IJK"));
        Ok(modal.filter(|motion| {
            center && matches!(motion, Motion::ArcClockwise | Motion::ArcCounterclockwise)
        }))
    }

    pub(crate) fn check_axes(&self, block: &Block) -> Outcome<()> {
        if !block.has_any(AXIS_WORDS) {
            return Ok(());
        }
        match block
            .axes()
            .find(|(axis, _)| !self.options.machine.has(*axis))
        {
            None => Ok(()),
            Some((axis, _)) => {
                let message = format!("the machine has no {axis} axis");
                let names: String = Axis::ALL
                    .into_iter()
                    .filter(|a| self.options.machine.has(*a))
                    .flat_map(|a| [' ', a.letter()])
                    .collect();
                Err(
                    Fault::new(Code::AxisNotConfigured, block.axis_span(axis), message)
                        .because(format!("its configuration has:{names}"))
                        .help("remove the word, or configure the axis"),
                )
            }
        }
    }
    /// Axis words in mm and degrees.
    pub(crate) fn axis_values(&self, block: &Block) -> [Option<f64>; AXES] {
        let scale = self.state.modal.units.mm();
        let mut values = [None; AXES];
        for (axis, value) in block.axes() {
            values[axis.index()] = Some(if axis.is_rotary() {
                value
            } else {
                value * scale
            });
        }
        values
    }
}
