//! A program as an iterator of items.

use std::io::BufRead;
use std::mem;

use glidepath_geometry::AxisVector;
use glidepath_program::Item;

use crate::block::{Block, LineKind};
use crate::contour::OpenContour;
use crate::cursor::Cursor;
use crate::diagnostic::{Code as FaultCode, Diagnostic, Fault, Outcome, Span};
use crate::dialect::{Dialect, Tape};
use crate::flow::Flow;
use crate::interpreter::{Flow as BlockFlow, Interpreter};
use crate::modal::Modal;
use crate::options::Options;
use crate::parameters::{Parameters, ProgramScope};
use crate::place::{Place, SourceLine};
use crate::plain_move::StraightLine;
use crate::source::LineSource;
use crate::totals::Totals;

/// A program being read: an iterator of [`Item`]s in constant memory.
///
/// It ends at M2, M30, the second percent line, the end of the input, or after the first finding.
#[derive(Debug)]
pub struct Program<R> {
    pub(crate) source: LineSource<R>,
    pub(crate) interpreter: Interpreter,
    pub(crate) parameters: Parameters,
    pub(crate) flow: Flow,
    /// Lines of a program in a dialect whose flow is not that of O words.
    pub(crate) tape: Tape,
    pub(crate) place: Place,
    pub(crate) block: Block,
    /// The line read last, if it was tried as a straight move.
    pub(crate) straight: StraightLine,
    /// The line executed last was one.
    pub(crate) was_straight: bool,
    /// The lathe cycle whose profile is being read.
    pub(crate) contour: Option<Box<OpenContour>>,
    /// Items of the last block; the first `given` of them have been given out.
    pub(crate) items: Vec<Item>,
    given: usize,
    totals: Totals,
    /// Kept lines executed since the last item.
    idle_lines: u32,
    /// Kept lines executed.
    kept_lines: u64,
    /// A percent line was read.
    percent: bool,
    /// A line with words was read.
    pub(crate) begun: bool,
    pub(crate) ended: bool,
}

impl<R: BufRead> Program<R> {
    /// Starts to read a program. Nothing is read before the first item is asked for.
    pub fn new(reader: R, options: Options) -> Self {
        let block = Block::of(options.dialect);
        Self {
            source: LineSource::new(reader),
            interpreter: Interpreter::new(options),
            parameters: Parameters::new(),
            flow: Flow::default(),
            tape: Tape::default(),
            place: Place::Stream,
            block,
            straight: StraightLine::default(),
            was_straight: false,
            contour: None,
            items: Vec::new(),
            given: 0,
            totals: Totals::default(),
            idle_lines: 0,
            kept_lines: 0,
            percent: false,
            begun: false,
            ended: false,
        }
    }

    /// The same program to be judged alone: its items and totals leave out most moves.
    pub(crate) const fn only_judged(mut self) -> Self {
        self.interpreter.only_judges = true;
        self
    }

    /// Modal state after the last block read.
    #[must_use]
    pub const fn modal(&self) -> &Modal {
        &self.interpreter.state.modal
    }

    /// Machine position after the last block read.
    #[must_use]
    pub const fn position(&self) -> &AxisVector {
        &self.interpreter.state.position
    }

    /// Items of the line read last.
    pub(crate) fn items(&self) -> &[Item] {
        &self.items
    }

    /// Gives out the items of a lathe cycle.
    pub(crate) fn give(&mut self, items: Vec<Item>) {
        self.items = items;
        self.idle_lines = 0;
        self.count();
    }

    /// The block read last.
    pub(crate) const fn block(&self) -> &Block {
        &self.block
    }

    /// Counts and sums over the blocks read so far.
    #[must_use]
    pub const fn totals(&self) -> &Totals {
        &self.totals
    }

    /// Lines of subroutines and structures executed so far, each as often as it was.
    pub(crate) const fn kept_lines(&self) -> u64 {
        self.kept_lines
    }

    /// Reads the next line and executes it; its items replace those of the line before.
    ///
    /// `None` after the end. A line with a finding has no effect on the state, and the next line
    /// can be read, unless what follows depends on it: a finding that is fatal, or in an O word,
    /// a subroutine or a loop ends the program.
    pub(crate) fn next_line(&mut self) -> Option<Result<(), Diagnostic>> {
        self.items.clear();
        self.given = 0;
        if self.ended {
            return None;
        }
        let goes_on = mem::take(&mut self.was_straight);
        let result = self.read_line(goes_on);
        self.totals.lines = self.source.number();
        match result {
            Ok(true) => Some(Ok(())),
            Ok(false) => {
                self.ended = true;
                // What cutter radius compensation still held back is given out now.
                (!self.items.is_empty()).then_some(Ok(()))
            }
            Err(fault) => {
                let kept = matches!(self.place, Place::Kept(..) | Place::Past(..));
                self.ended |= kept || fault.code.is_fatal();
                Some(Err(self.here().finding(*fault)))
            }
        }
    }

    /// The line being executed.
    pub(crate) fn here(&self) -> SourceLine {
        match &self.place {
            Place::Stream => SourceLine::new(self.source.number(), self.source.text()),
            Place::Past(line) | Place::Tape(line) => line.clone(),
            Place::Kept(code, index) => match code.lines.get(*index) {
                Some(line) => SourceLine {
                    file: code.file.clone(),
                    ..SourceLine::new(line.number, &line.text)
                },
                None => SourceLine::default(),
            },
        }
    }

    /// The line of the program that a move now comes from: in the file of a subroutine, the line that
    /// calls it.
    pub(crate) fn line_of_program(&self) -> u32 {
        match &self.place {
            Place::Stream => self.source.number(),
            Place::Past(line) | Place::Tape(line) => line.number,
            Place::Kept(code, index) if code.file.is_none() => {
                code.lines.get(*index).map_or(0, |line| line.number)
            }
            Place::Kept(..) => self.flow.frames.last().map_or(0, |frame| frame.called_from),
        }
    }

    fn read_line(&mut self, goes_on: bool) -> Outcome<bool> {
        match self.interpreter.options.dialect {
            Dialect::LinuxCnc => self.read_linuxcnc(goes_on),
            Dialect::Fanuc => self.read_fanuc(),
            Dialect::Marlin | Dialect::Siemens => self.read_without_flow(),
        }
    }

    /// Counts a line that may be executed again and again.
    pub(crate) fn count_idle(&mut self) -> Outcome<()> {
        self.kept_lines += 1;
        self.idle_lines += 1;
        let most = self.interpreter.options.loops.idle_lines;
        if self.idle_lines > most {
            return Err(endless(most));
        }
        Ok(())
    }

    /// Nothing more is read.
    pub(crate) const fn end(&mut self) {
        self.ended = true;
    }

    pub(crate) fn set_tape_place(&mut self, number: u32, text: &[u8]) {
        self.place = Place::Tape(SourceLine::new(number, text));
    }

    /// Executes a text as a block.
    pub(crate) fn execute_text(&mut self, number: u32, text: &[u8]) -> Outcome<bool> {
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let parsed = self.block.parse(text, &scope);
        self.execute_parsed(number, parsed)
    }

    /// The end of the input, or of the tape: false, or a finding if a part is not complete.
    pub(crate) fn end_of_input(&mut self) -> Outcome<bool> {
        self.ended = true;
        match self.flow.recorder.take() {
            None => {
                self.interpreter.check_spline_complete()?;
                self.interpreter.end_compensation(&mut self.items)?;
                self.count();
                Ok(false)
            }
            Some(recorder) => {
                let fault = recorder.unfinished();
                let (number, text, _) = recorder.first;
                self.place = Place::Past(SourceLine::new(number, &text));
                Err(fault)
            }
        }
    }

    /// Adds the items of a line to the totals.
    fn count(&mut self) {
        for item in &self.items {
            self.totals.add(item);
        }
    }

    /// Counts what a line came to.
    #[inline]
    pub(crate) fn end_of_line(&mut self) {
        if !self.items.is_empty() || self.interpreter.has_judged {
            self.idle_lines = 0;
        }
        self.count();
        self.totals.zero_length_feeds += self.interpreter.zero_length.feeds;
        self.totals.zero_length_rapids += self.interpreter.zero_length.rapids;
    }

    pub(crate) fn is_deleted(&self) -> bool {
        self.interpreter.options.block_delete
            && Cursor::new(self.source.text()).next_visible() == Some(b'/')
    }

    /// Executes the block, once it has been read.
    pub(crate) fn execute_parsed(&mut self, number: u32, parsed: Outcome<()>) -> Outcome<bool> {
        self.begun |= self.block.any || parsed.is_err();
        parsed?;
        match self.block.kind {
            LineKind::Block if self.block.any => {}
            LineKind::Block => return Ok(true),
            LineKind::Percent if self.percent || self.begun => return self.end_of_input(),
            LineKind::Percent => {
                self.percent = true;
                return Ok(true);
            }
        }
        for assignment in &self.block.assignments {
            self.parameters
                .check_assignable(&assignment.parameter, assignment.span)?;
        }
        let asked = self.asked_contour(&self.block)?;
        let flow = if self.contour.is_some() {
            self.draw_block()?;
            BlockFlow::Continue
        } else {
            self.interpreter
                .execute(&self.block, number, &mut self.items)?
        };
        for assignment in &self.block.assignments {
            self.parameters
                .assign(&assignment.parameter, assignment.value);
        }
        if let Some(asked) = asked {
            self.open_contour(&asked)?;
        }
        self.end_of_line();
        // The items of the last block are still to be given out.
        self.ended = flow == BlockFlow::End;
        Ok(true)
    }
}

pub(crate) fn is_percent(text: &[u8]) -> bool {
    Cursor::new(text).next_visible() == Some(b'%')
}

fn endless(lines: u32) -> Box<Fault> {
    let message = format!("{lines} lines of a loop without a move");
    Fault::new(FaultCode::EndlessLoop, Span::default(), message)
        .because("a loop that moves nothing for so long would hold up the machine for ever")
        .help("check the condition that should end it")
}

impl<R: BufRead> Iterator for Program<R> {
    type Item = Result<Item, Diagnostic>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(item) = self.items.get(self.given) {
                self.given += 1;
                return Some(Ok(*item));
            }
            if let Err(diagnostic) = self.next_line()? {
                self.ended = true;
                return Some(Err(diagnostic));
            }
        }
    }
}
