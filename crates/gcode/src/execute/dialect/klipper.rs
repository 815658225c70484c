//! Klipper's commands that give places other names, or keep and bring back what is in force.
//!
//! | | |
//! |---|---|
//! | `SET_GCODE_OFFSET X= Y= Z=`, `Z_ADJUST=` …, `MOVE=1 MOVE_SPEED=` | coordinates count from that much farther on; with MOVE the tool goes there, at so many mm/s |
//! | `SAVE_GCODE_STATE NAME=` | keeps G90 and G91, M82 and M83, offsets, F and the place |
//! | `RESTORE_GCODE_STATE NAME= MOVE=1 MOVE_SPEED=` | brings them back, and with MOVE the tool, in X, Y and Z |

use std::io::BufRead;

use glidepath_geometry::AxisVector;
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::Pace;
use crate::execute::program::Program;
use crate::execute::state::modal::Feed;
use crate::execute::state::printer::KeptState;
use crate::syntax::block::Block;
use crate::syntax::dialect::klipper::{KlipperWord, words};
use crate::syntax::word_check::missing;

/// Most states that are kept.
const MAX_STATES: usize = 100;

impl<R: BufRead> Program<R> {
    /// A command that is made; `span` is where its name stands.
    pub(super) fn klipper_state(&mut self, name: &[u8], span: SourceSpan) -> Outcome<()> {
        let line = self.source.number();
        let words = words(self.source.text(), span.start + span.length)?;
        let block = Block::of(self.block.dialect, &self.interpreter.options.m_codes);
        let interpreter = &mut self.interpreter;
        interpreter.begin(line);
        let out = &mut self.items;
        let done = match name {
            b"SET_GCODE_OFFSET" => interpreter.set_gcode_offset(&block, &words, out),
            b"SAVE_GCODE_STATE" => interpreter.keep_state(&words, span),
            _ => interpreter.bring_back_state(&block, &words, span, out),
        };
        done.map_err(|mut fault| {
            if fault.span == SourceSpan::default() {
                fault.span = span;
            }
            fault
        })?;
        self.end_of_line();
        Ok(())
    }
}

/// Whether a command moves, and how fast, mm/s.
#[derive(Debug, Clone, Copy, Default)]
struct MoveWords {
    moves: bool,
    speed_v: Option<f64>,
}

impl MoveWords {
    /// Takes a word; false if it is none of these.
    fn take(&mut self, word: &KlipperWord) -> Outcome<bool> {
        match word.key.as_slice() {
            b"MOVE" => self.moves = word.number()? != 0.0,
            b"MOVE_SPEED" => {
                let speed_v = word.number()?;
                if speed_v <= 0.0 {
                    let message = "MOVE_SPEED is not above zero";
                    return Err(
                        BlockDiagnostic::new(DiagnosticCode::BadFeed, word.span, message)
                            .because("a move at that speed would never end")
                            .help("write mm per second, above zero"),
                    );
                }
                self.speed_v = Some(speed_v);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

impl Interpreter {
    fn set_gcode_offset(
        &mut self,
        block: &Block,
        words: &[KlipperWord],
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let mut move_words = MoveWords::default();
        let mut by = AxisVector::zeros();
        for word in words {
            let key = word.key.as_slice();
            let (axis, adjusts) = match key.strip_suffix(b"_ADJUST") {
                Some(axis) => (axis, true),
                None => (key, false),
            };
            let axis = [&b"X"[..], b"Y", b"Z"]
                .iter()
                .position(|name| *name == axis);
            match axis {
                Some(axis) => {
                    let value = word.number()?;
                    let before = self.state.gcode_offset[axis];
                    by[axis] = if adjusts { value } else { value - before };
                    self.state.gcode_offset[axis] = before + by[axis];
                }
                None if move_words.take(word)? => {}
                None => return Err(unknown_word(word)),
            }
        }
        self.state.offsets.shift += by;
        self.state.offsets.saved_shift = self.state.offsets.shift;
        if !move_words.moves {
            return Ok(());
        }
        self.go_at(block, self.state.position + by, move_words.speed_v, out)
    }

    fn keep_state(&mut self, words: &[KlipperWord], span: SourceSpan) -> Outcome<()> {
        let name = state_name(words, span)?;
        let kept = KeptState {
            modal: self.state.modal,
            extruder: self.state.extruder,
            shift: self.state.offsets.shift,
            gcode_offset: self.state.gcode_offset,
            place: self.state.position,
        };
        let states = &mut self.state.kept_by_printer.states;
        if states.len() >= MAX_STATES && !states.contains_key(&name) {
            let message = format!("more than {MAX_STATES} states are kept");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                    .because("the memory of a program is bounded")
                    .help("use a name again"),
            );
        }
        states.insert(name, kept);
        Ok(())
    }

    fn bring_back_state(
        &mut self,
        block: &Block,
        words: &[KlipperWord],
        span: SourceSpan,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let name = state_name(words, span)?;
        let mut move_words = MoveWords::default();
        for word in words {
            if word.key != b"NAME" && !move_words.take(word)? {
                return Err(unknown_word(word));
            }
        }
        let Some(kept) = self.state.kept_by_printer.states.get(&name).copied() else {
            let shown = String::from_utf8_lossy(&name).into_owned();
            let message = format!("no state `{shown}` was kept");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                    .because("it brings back what SAVE_GCODE_STATE of the same name has kept")
                    .help("write SAVE_GCODE_STATE before it"),
            );
        };
        self.state.modal = kept.modal;
        self.state.extruder = kept.extruder;
        self.state.gcode_offset = kept.gcode_offset;
        let mut shift = kept.shift;
        // What was extruded meanwhile stays so: its coordinate is the one from before.
        if let Some(axis) = self.options.extruder {
            let i = axis.index();
            shift[i] += self.state.position[i] - kept.place[i];
        }
        self.state.offsets.shift = shift;
        self.state.offsets.saved_shift = shift;
        if !move_words.moves {
            return Ok(());
        }
        let mut target = self.state.position;
        for axis in 0..3 {
            target[axis] = kept.place[axis];
        }
        self.go_at(block, target, move_words.speed_v, out)
    }

    /// A straight move at a speed, or at the feed in force.
    fn go_at(
        &mut self,
        block: &Block,
        target: AxisVector,
        speed_v: Option<f64>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let before = self.state.modal.feed;
        if let Some(speed_v) = speed_v {
            self.state.modal.feed = Some(Feed {
                linear_v: speed_v,
                rotary_v: speed_v,
            });
        }
        self.straight(block, target, Pace::Feed, out)?;
        self.state.modal.feed = before;
        Ok(())
    }
}

/// NAME; "default" where it is left out.
fn state_name(words: &[KlipperWord], span: SourceSpan) -> Outcome<Vec<u8>> {
    let named = words.iter().find(|word| word.key == b"NAME");
    match named.map(|word| word.value.clone()) {
        Some(name) if name.is_empty() => Err(missing(span, "the command", "NAME", "what is kept")),
        Some(name) => Ok(name),
        None => Ok(b"default".to_vec()),
    }
}

#[cold]
fn unknown_word(word: &KlipperWord) -> Box<BlockDiagnostic> {
    let shown = String::from_utf8_lossy(&word.key).into_owned();
    let message = format!("{shown} is no word of this command here");
    BlockDiagnostic::new(DiagnosticCode::UnusedWord, word.span, message)
        .because("X, Y and Z are offset, MOVE and MOVE_SPEED move, NAME names a state")
        .help("remove it")
}
