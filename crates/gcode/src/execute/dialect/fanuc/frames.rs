//! G51, G51.1, G68, and G101 of Haas: scale, mirror image and turn of the program's coordinates.
//!
//! The machine stays where it is; the next block gives places in the new coordinates.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::fanuc_offsets::{BeforeTurn, FanucFrames, Scale, Turn};
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::frame_codes::FrameCode;
use crate::syntax::modes::Distance;
use crate::syntax::word_check::missing;

/// Factors beyond this, or below one over it, are refused.
const MAX_SCALE: f64 = 1000.0;
/// What a P without a point counts.
const STEP: f64 = 0.001;

impl Interpreter {
    /// G50, G51, G50.1, G51.1, G68, G69, G100, G101.
    pub(super) fn fanuc_frame(&mut self, block: &Block) -> Outcome<()> {
        let Some(coded) = block.codes.frame else {
            return Ok(());
        };
        for (code, ends) in FrameCode::ENDS.into_iter().zip(block.codes.frame_ends) {
            if ends {
                self.one_fanuc_frame(block, Coded { code, ..coded })?;
            }
        }
        self.one_fanuc_frame(block, coded)
    }

    fn one_fanuc_frame(&mut self, block: &Block, coded: Coded<FrameCode>) -> Outcome<()> {
        let before = self.state.offsets.fanuc.frames;
        let mut frames = before;
        let ends = !matches!(
            coded.code,
            FrameCode::Scale(true)
                | FrameCode::Mirror(true)
                | FrameCode::Switch(true)
                | FrameCode::Turn(true)
        );
        match coded.code {
            FrameCode::Scale(true) => frames.scale = Some(self.scale_words(block, coded)?),
            FrameCode::Scale(false) => frames.scale = None,
            FrameCode::Mirror(begins) | FrameCode::Switch(begins) => {
                let changes = begins || frames.mirror.iter().any(Option::is_some);
                if changes && (frames.scale.is_some() || frames.turn.is_some()) {
                    return Err(mirrors_inside(coded));
                }
                if matches!(coded.code, FrameCode::Switch(_)) {
                    self.switch_mirror(block, coded.span, begins, &mut frames.mirror)?;
                } else {
                    self.mirror_words(block, coded, begins, &mut frames.mirror)?;
                }
            }
            FrameCode::Turn(true) => frames.turn = Some(self.turn_words(block, coded)?),
            FrameCode::Turn(false) => {
                if self.state.tilted.is_some() {
                    self.check_frame_may_change(coded)?;
                }
                frames.turn = None;
                self.end_tilt();
            }
        }
        if frames == before && ends {
            return Ok(());
        }
        self.check_frame_may_change(coded)?;
        let begins_turn = frames.turn.filter(|_| frames.turn != before.turn);
        self.state.offsets.fanuc.before_turn = begins_turn.map(|turn| BeforeTurn {
            plane: turn.plane,
            machine: self.state.position,
            program: self.state.offsets.to_program(self.state.position),
        });
        self.state.offsets.fanuc.frames = frames;
        self.state.offsets.frame = self.state.offsets.tilted.with(&frames.frame());
        Ok(())
    }

    /// Refuses other coordinates while the tool is beside a contour.
    fn check_frame_may_change(&self, coded: Coded<FrameCode>) -> Outcome<()> {
        if !self.state.on_contour && !self.state.leaving_contour {
            return Ok(());
        }
        let message = "coordinates that change with cutter radius compensation on";
        Err(BlockDiagnostic::new(DiagnosticCode::CutterRadius, coded.span, message)
            .because("the tool stands beside the programmed point, at a place that depends on the next move")
            .help("write G40 and a move before it"))
    }

    /// X, Y and Z of the block in mm, or where the tool is in the coordinates that the other frames leave:
    /// that is the place which stays where it is. In the coordinates of the frame that is replaced the
    /// tool is elsewhere, and a scale given again and again would multiply what rounding has left.
    fn centre(&self, block: &Block, others: &FanucFrames) -> Outcome<[f64; 3]> {
        let words = self.axis_values(block)?;
        let offsets = &self.state.offsets;
        let frame = offsets.tilted.with(&others.frame());
        let here = offsets.to_program_by(&frame, self.state.position);
        Ok([0, 1, 2].map(|axis| words[axis].unwrap_or(here[axis])))
    }

    /// P is the factor of all axes, I, J and K those of X, Y and Z. Without a point they count
    /// thousandths.
    fn scale_words(&self, block: &Block, coded: Coded<FrameCode>) -> Outcome<Scale> {
        let word = |letter: u8| {
            let value = block.get(letter)?;
            Some(if block.has_no_point(letter) {
                value * STEP
            } else {
                value
            })
        };
        let each = [b'I', b'J', b'K'];
        let factors = match (word(b'P'), each.map(word)) {
            (None, [None, None, None]) => {
                return Err(missing(coded.span, "G51", "P", "the factor"));
            }
            (Some(factor), [None, None, None]) => [factor; 3],
            (None, factors) => factors.map(|factor| factor.unwrap_or(1.0)),
            (Some(_), _) => {
                let message = "both P and I, J, K in G51";
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::AmbiguousWord,
                    block.span(b'P'),
                    message,
                )
                .because("P is the factor of all axes, I, J and K are those of each")
                .help("write one or the other"));
            }
        };
        let wrong = factors
            .iter()
            .find(|factor| !(1.0 / MAX_SCALE..=MAX_SCALE).contains(&factor.abs()));
        if let Some(factor) = wrong {
            let message = format!("a scale of {factor}");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, coded.span, message)
                    .because(format!(
                        "factors are from {} to {MAX_SCALE}",
                        1.0 / MAX_SCALE
                    ))
                    .help("write the factor with its point: P2. doubles, and so does P2000"),
            );
        }
        let others = FanucFrames {
            scale: None,
            ..self.state.offsets.fanuc.frames
        };
        Ok(Scale {
            about: self.centre(block, &others)?,
            factors,
        })
    }

    fn mirror_words(
        &self,
        block: &Block,
        coded: Coded<FrameCode>,
        begins: bool,
        mirror: &mut [Option<f64>; 3],
    ) -> Outcome<()> {
        let words = self.axis_values(block)?;
        if words[3..].iter().any(Option::is_some) {
            let message = "a mirror image of an axis other than X, Y or Z";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
                    .because("rotary and parallel axes keep their coordinates")
                    .help("write X, Y or Z"),
            );
        }
        if words.iter().all(Option::is_none) {
            if begins {
                return Err(missing(
                    coded.span,
                    "G51.1",
                    "an axis",
                    "where it is mirrored",
                ));
            }
            *mirror = [None; 3];
        }
        for (slot, word) in mirror.iter_mut().zip(words) {
            if word.is_some() {
                *slot = word.filter(|_| begins);
            }
        }
        Ok(())
    }

    /// R in degrees, about the two axes of the plane; in G91 it is added to the angle in force, unless the control is set
    /// not to (parameter 5400#0, RIN).
    fn turn_words(&self, block: &Block, coded: Coded<FrameCode>) -> Outcome<Turn> {
        let plane = self.state.modal.plane;
        if plane.normal().index() >= 3 {
            let message = "G68 in a plane of U, V, W";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
                    .because("X, Y and Z are turned")
                    .help("write G17, G18 or G19"),
            );
        }
        let normal = plane.normal().index();
        if self.axis_values(block)?[normal].is_some() {
            let letter = [b'X', b'Y', b'Z'][normal];
            let message = format!(
                "{} in a G68 that turns in another plane",
                char::from(letter)
            );
            return Err(
                BlockDiagnostic::new(DiagnosticCode::UnusedWord, block.span(letter), message)
                    .because("the centre of the rotation has the two axes of the plane, and nothing moves in this block")
                    .help("leave it out, or write the move in a block of its own"),
            );
        }
        let degrees = block
            .get(b'R')
            .ok_or_else(|| missing(coded.span, "G68", "R", "the angle"))?;
        let before = self.state.offsets.fanuc.frames.turn;
        let adds = !self.options.fanuc.rotations_are_absolute
            && self.state.modal.distance == Distance::Incremental;
        let base = before.filter(|_| adds).map_or(0.0, |turn| turn.degrees);
        let others = FanucFrames {
            turn: None,
            ..self.state.offsets.fanuc.frames
        };
        let about = match before {
            Some(turn) if !block.has_axes() => turn.about,
            _ => self.centre(block, &others)?,
        };
        Ok(Turn {
            plane,
            about,
            degrees: base + degrees,
        })
    }
}

#[cold]
fn mirrors_inside(coded: Coded<FrameCode>) -> Box<BlockDiagnostic> {
    let message = "a mirror image that begins or ends with G51 or G68 in force";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
        .because("mirror image, scale and turn begin in this order, and end in the other")
        .help("write G69 and G50 before it")
}
