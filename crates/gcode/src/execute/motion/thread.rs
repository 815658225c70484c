//! Threads: G33, and the passes of cycles.
//!
//! A pass goes from rest to rest. Before it stands the event that tells how far the path goes with
//! each revolution of the spindle, and at which angle the pass begins. Its moves are planned for a
//! spindle that turns a little faster than programmed; whoever executes them follows the spindle.

use glidepath_geometry::Segment;
use glidepath_program::{Event, Item, ItemKind, PHASE_STEPS, PathMode, Rate};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::{MIN_MOVE, settled};
use crate::execute::motion::thread_lead::thread_name;
use crate::execute::state::open_thread::Groove;
use crate::setup::threading::{SPEED_RESERVE, Threading};
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::word_check::{missing, unused};

impl Interpreter {
    /// G33: a pass to the point of the block.
    pub(crate) fn thread(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let span = block.motion_span();
        let is_fanuc = block.dialect == Dialect::Fanuc;
        let (letter, other) = match block.dialect {
            Dialect::Fanuc => (b'F', b'K'),
            Dialect::Siemens => (lead_letter(block), b'F'),
            Dialect::LinuxCnc | Dialect::Marlin => (b'K', b'F'),
        };
        let name = char::from(letter);
        let code = thread_name(block);
        let pitch_mm = if is_fanuc {
            self.fanuc_lead_mm(block, code)?
        } else if let Some(pitch) = block.get(letter) {
            pitch * self.state.modal.units.mm()
        } else {
            let meaning = "the way of a revolution along the thread";
            return Err(missing(span, code, &name.to_string(), meaning));
        };
        if block.dialect == Dialect::Siemens
            && let Some(second) = second_lead(block, letter)
        {
            return Err(unused(char::from(second), block.span(second)));
        }
        // F of a SINUMERIK is that of the moves that follow.
        if block.dialect != Dialect::Siemens && block.get(other).is_some() {
            let message = format!("{code} with {}", char::from(other));
            return Err(BlockDiagnostic::new(
                DiagnosticCode::InvalidValue,
                block.span(other),
                message,
            )
            .because("the spindle alone gives the speed of a thread")
            .help(format!(
                "the way of a revolution is {name}; remove the other word"
            )));
        }
        if pitch_mm <= 0.0 {
            let pitch = block.get(letter).unwrap_or_default();
            return Err(no_pitch(block, letter, pitch));
        }
        let target = self.target(block)?;
        if self.state.open.thread.is_none() && self.state.thread_end == Some(self.state.path_end) {
            let message = "a thread that goes on from another one";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("a pass ends at rest, and what follows would begin at any angle")
                    .help("write the thread in one block, or retract between two"),
            );
        }
        let phase = self.phase(block)?;
        let from = self.thread_from();
        let end = settled(from, target, [None, None]);
        let way = end - from;
        // The lead is that of the axis that goes further: to LinuxCNC it is along the thread.
        let of_axis = match letter {
            b'I' => Some(way[0]),
            b'J' => Some(way[1]),
            b'K' if block.dialect == Dialect::Siemens => Some(way[2]),
            _ => None,
        };
        if of_axis.is_some_and(|own| own.abs() < way.amax() - MIN_MOVE) {
            return Err(other_lead(block, letter));
        }
        let along = if (is_fanuc || of_axis.is_some()) && way.amax() > 0.0 {
            way.norm() / way.amax()
        } else {
            1.0
        };
        let groove = Groove {
            end,
            pitch_mm: pitch_mm * along,
            corner_mm: 0.0,
            line: self.line,
        };
        if self.thread_goes_on || self.state.open.thread.is_some() {
            return self.chain_thread(block, (groove, target), phase, out);
        }
        self.pass(block, &[groove], phase, out)?;
        self.state.position = target;
        Ok(())
    }

    /// The angle at which a pass begins, of the Q word: degrees, on a FANUC thousandths of them.
    pub(crate) fn phase(&self, block: &Block) -> Outcome<u32> {
        let Some(angle) = block.get(b'Q') else {
            return Ok(0);
        };
        let is_fanuc = block.dialect == Dialect::Fanuc;
        if is_fanuc && !block.has_no_point(b'Q') && angle > 0.0 && angle <= 360.0 {
            return Err(angle_with_point(block, angle));
        }
        let degrees = match block.dialect {
            Dialect::Fanuc => angle / 1000.0,
            _ => angle,
        };
        if !(0.0..=360.0).contains(&degrees) {
            let message = format!("a thread cannot begin at {degrees} degrees");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::InvalidValue,
                block.span(b'Q'),
                message,
            )
            .help("write an angle of the spindle from 0 to 360 degrees"));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "range checked"
        )]
        let steps = (degrees / 360.0 * f64::from(PHASE_STEPS)).round() as u32;
        Ok(steps % PHASE_STEPS)
    }

    /// A pass along grooves, one after the other, from where the tool is.
    pub(crate) fn pass(
        &mut self,
        block: &Block,
        grooves: &[Groove],
        phase: u32,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let span = block.motion_span();
        let threading = self.check_spindle(span)?;
        let first = out.len();
        let line = self.line;
        for (index, groove) in grooves.iter().enumerate() {
            self.line = groove.line;
            let segment = Segment::line(self.state.path_end, groove.end);
            if segment.length() <= MIN_MOVE {
                let message = "a thread without a length";
                return Err(
                    BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                        .help("write an end that is not where the tool is"),
                );
            }
            let ends = [index == 0, index + 1 == grooves.len()];
            let speed_v = self.check_groove(span, &threading, &segment, groove.pitch_mm, ends)?;
            self.check_limits(block, &groove.end, &groove.end, "the end")?;
            if out.len() == first {
                let pitch_mm = groove.pitch_mm;
                self.push(out, ItemKind::Event(Event::Synchronise { pitch_mm, phase }));
            }
            self.state.path_end = groove.end;
            let mode = if grooves.len() == 1 {
                PathMode::ExactStop
            } else {
                PathMode::Continuous {
                    // The same for all of them: else the motion would rest between them.
                    tolerance_mm: Some(groove.corner_mm),
                }
            };
            let rate = Rate::Synchronised(speed_v);
            self.push(
                out,
                ItemKind::Move {
                    segment,
                    rate,
                    mode,
                },
            );
        }
        if grooves.len() > 1 {
            self.push(out, ItemKind::Dwell(0.0));
        }
        self.line = line;
        self.state.position = self.state.path_end;
        self.state.thread_end = Some(self.state.path_end);
        self.state.leaving_contour = false;
        Ok(())
    }

    /// What threads need of the machine, whose spindle's angle is known.
    pub(crate) fn known_angle(&self, span: SourceSpan) -> Outcome<Threading> {
        self.options.threading.ok_or_else(|| {
            let message = "the angle of the spindle is not known";
            BlockDiagnostic::new(DiagnosticCode::NotConnected, span, message)
                .because("a thread follows it, and the machine's configuration names no encoder")
                .help(
                    "write `encoder = true` into the table [spindle] if the drives' feedback tells \
                     the angle, or where nothing is driven",
                )
        })
    }

    /// Refuses a thread where the spindle is not known, or does not turn steadily.
    pub(super) fn check_spindle(&self, span: SourceSpan) -> Outcome<Threading> {
        let threading = self.known_angle(span)?;
        let spindle = &self.state.spindle;
        let message = if spindle.turning.is_none() {
            "a thread with the spindle at rest"
        } else if spindle.speed <= 0.0 {
            "a thread with a spindle without a speed"
        } else if spindle.follows_tool() {
            "a thread with a spindle whose speed follows the tool (G96)"
        } else if self.state.open.compensation.is_some() {
            "a thread with cutter radius compensation"
        } else {
            return Ok(threading);
        };
        Err(BlockDiagnostic::new(DiagnosticCode::Spindle, span, message)
            .because("the passes of a thread are cut at one steady speed, along its own line")
            .help("write G97, G40, an S word and M3 or M4 before it"))
    }

    /// Refuses what the axes cannot do. Returns the speed that it is planned with, mm/s.
    pub(super) fn check_groove(
        &self,
        span: SourceSpan,
        threading: &Threading,
        segment: &Segment,
        pitch_mm: f64,
        [is_first, is_last]: [bool; 2],
    ) -> Outcome<f64> {
        let speed = self.state.spindle.speed;
        let speed_v = pitch_mm * SPEED_RESERVE * speed / 60.0;
        let direction = segment.jet(0.0).d1;
        let most_v = threading.most_v(&direction);
        if speed_v > most_v {
            let most = (speed * most_v / speed_v).floor();
            let message = format!(
                "a pitch of {pitch_mm:.3} mm at S{speed} takes {:.0} mm/min",
                speed_v * 60.0
            );
            return Err(BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                .because(format!(
                    "the axes go {:.0} mm/min there at most, with a reserve of 10 % for the spindle",
                    most_v * 60.0
                ))
                .help(format!("write S{most} or less")));
        }
        let run_in_mm = threading.run_in_mm(&direction, speed_v);
        let ends = f64::from(u8::from(is_first)) + f64::from(u8::from(is_last));
        let least_mm = ends * run_in_mm + threading.steady_mm(speed_v);
        let length_mm = segment.length();
        if length_mm < least_mm {
            let message = format!("a thread of {length_mm:.3} mm is too short at S{speed}");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                    .because(format!(
                        "the axes need {run_in_mm:.3} mm to come to its speed, and as much to stop"
                    ))
                    .help(format!(
                        "begin further away, at least {least_mm:.3} mm in all, or turn more slowly"
                    )),
            );
        }
        Ok(speed_v)
    }
}

/// A pitch that leads nowhere, or back.
fn no_pitch(block: &Block, letter: u8, pitch: f64) -> Box<BlockDiagnostic> {
    let name = char::from(letter);
    let message = format!("the pitch {name}{pitch} is not above zero");
    BlockDiagnostic::new(DiagnosticCode::InvalidValue, block.span(letter), message)
        .help("write the way of a revolution; the axis words give its direction")
}

/// Q90. of a FANUC, which takes no point there: 0.09 degrees are hardly meant.
#[cold]
fn angle_with_point(block: &Block, angle: f64) -> Box<BlockDiagnostic> {
    let message = format!("the angle Q{angle} of a thread has a decimal point");
    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, block.span(b'Q'), message)
        .because("Q counts thousandths of a degree there, without a point")
        .help(format!("write Q{:.0} for {angle} degrees", 1000.0 * angle))
}

/// The letters that a SINUMERIK's thread has its lead in.
const LEADS: [u8; 3] = *b"KIJ";

/// The lead of a SINUMERIK's thread: I, J or K, by the axis that goes further.
fn lead_letter(block: &Block) -> u8 {
    let found = LEADS.into_iter().find(|it| block.get(*it).is_some());
    found.unwrap_or(b'K')
}

/// A lead beside the one that counts.
fn second_lead(block: &Block, counts: u8) -> Option<u8> {
    let is_second = |it: &u8| *it != counts && block.get(*it).is_some();
    LEADS.into_iter().find(is_second)
}

#[cold]
fn other_lead(block: &Block, letter: u8) -> Box<BlockDiagnostic> {
    let name = char::from(letter);
    let message = format!("{name} is not the lead of the axis that goes further");
    BlockDiagnostic::new(DiagnosticCode::InvalidValue, block.span(letter), message)
        .because("I is the lead along X, J along Y, K along Z: that of the longer way counts")
        .help("write the lead of the axis that goes further")
}

#[cfg(test)]
mod tests;
