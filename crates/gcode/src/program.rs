//! A program as an iterator of items.

use std::io::BufRead;
use std::sync::Arc;

use glidepath_geometry::AxisVector;
use glidepath_motion::Item;

use crate::block::{Block, LineKind};
use crate::contour::OpenContour;
use crate::cursor::Cursor;
use crate::diagnostic::{Code as FaultCode, Diagnostic, Fault, Outcome, Span};
use crate::dialect::{Dialect, Tape};
use crate::flow::Flow;
use crate::flow_word::head;
use crate::interpreter::{Flow as BlockFlow, Interpreter};
use crate::modal::Modal;
use crate::options::Options;
use crate::parameters::{Parameters, ProgramScope};
use crate::place::{Place, SourceLine};
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
    /// The lathe cycle whose profile is being read.
    pub(crate) contour: Option<Box<OpenContour>>,
    /// Items of the last block; the first `given` of them have been given out.
    items: Vec<Item>,
    given: usize,
    totals: Totals,
    /// Kept lines executed since the last item.
    idle_lines: u32,
    /// Kept lines executed.
    kept_lines: u64,
    /// A percent line was read.
    percent: bool,
    /// A line with words was read.
    begun: bool,
    ended: bool,
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
        let result = self.read_line();
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

    fn read_line(&mut self) -> Outcome<bool> {
        match self.interpreter.options.dialect {
            Dialect::LinuxCnc => self.read_linuxcnc(),
            Dialect::Fanuc => self.read_fanuc(),
            Dialect::Marlin | Dialect::Siemens => self.read_without_flow(),
        }
    }

    fn read_linuxcnc(&mut self) -> Outcome<bool> {
        if let Some((code, index)) = self.flow.next_line() {
            self.place = Place::Kept(Arc::clone(&code), index);
            self.count_idle()?;
            let has_head = code
                .lines
                .get(index)
                .is_some_and(|line| line.head.is_some());
            if has_head {
                self.execute_flow(&code, index)?;
                return self.close_contour().map(|()| true);
            }
            return self.execute_block();
        }
        if !matches!(self.place, Place::Stream) {
            self.place = Place::Stream;
        }
        // A plain line has no slash and no O word, and its end is found on the way.
        if self.flow.recorder.is_none()
            && let Some(length) = self.block.parse_plain(self.source.ahead())
            && self.source.pass(length)
        {
            return self.execute_parsed(self.source.number(), Ok(()));
        }
        if !self.source.advance()? {
            return self.end_of_input();
        }
        if self.is_deleted() {
            return Ok(true);
        }
        let head = head(self.source.text()).inspect_err(|_| self.ended = true)?;
        if self.flow.recorder.is_none() && head.is_none() {
            return self.execute_block();
        }
        if self.flow.recorder.is_some() && is_percent(self.source.text()) {
            return self.end_of_input();
        }
        self.begun |= head.as_ref().is_some_and(|head| head.keyword.is_some());
        let (number, text) = (self.source.number(), self.source.text().to_vec());
        // What follows depends on every O word, so a finding in one ends the program.
        self.read_flow(number, &text, head)
            .inspect_err(|_| self.ended = true)?;
        Ok(true)
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

    pub(crate) fn is_deleted(&self) -> bool {
        self.interpreter.options.block_delete
            && Cursor::new(self.source.text()).next_visible() == Some(b'/')
    }

    /// Executes the line at the present place as a block.
    fn execute_block(&mut self) -> Outcome<bool> {
        let number = self.line_of_program();
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let text = match &self.place {
            Place::Kept(code, index) => match code.lines.get(*index) {
                Some(line) => &*line.text,
                None => return Ok(true),
            },
            _ => self.source.text(),
        };
        let parsed = self.block.parse(text, &scope);
        self.execute_parsed(number, parsed)
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
        if !self.items.is_empty() || self.interpreter.has_judged {
            self.idle_lines = 0;
        }
        self.count();
        self.totals.zero_length_feeds += self.interpreter.zero_length.feeds;
        self.totals.zero_length_rapids += self.interpreter.zero_length.rapids;
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
