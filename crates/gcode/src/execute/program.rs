//! A program as an iterator of items.

use std::io::BufRead;
use std::sync::Arc;

use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::auxiliary::input_wait::InputWait;
use crate::execute::awaited_codes::AwaitedCodes;
use crate::execute::dialect::macro_call::ModalMacro;
use crate::execute::dialect::siemens::steps::SiemensState;
use crate::execute::dialect::tape::Finishing;
use crate::execute::dialect::tape::Tape;
use crate::execute::flow::activation::Flow;
use crate::execute::interpreter::Interpreter;
use crate::execute::lathe_cycle::open::OpenLatheCycle;
use crate::execute::line_origin::{LineOrigin, SourceLine};
use crate::execute::parameters::Parameters;
use crate::execute::scope::ProgramScope;
use crate::setup::options::Options;
use crate::summary::remark::Remark;
use crate::summary::totals::Totals;
use crate::syntax::block::Block;
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::Dialect;
use crate::syntax::line_source::LineSource;
use crate::syntax::straight_line::StraightLine;

/// A program being read: an iterator of [`Item`]s in constant memory.
///
/// It ends at M2, M30, the second percent line, the end of the input, or after the first
/// diagnostic.
#[derive(Debug)]
pub struct Program<R> {
    pub(crate) source: LineSource<R>,
    pub(crate) interpreter: Interpreter,
    pub(crate) parameters: Parameters,
    pub(crate) flow: Flow,
    /// Lines of a program in a dialect whose flow is not that of O words.
    pub(crate) tape: Tape,
    /// The finishing of a FANUC lathe in progress (G70).
    pub(crate) finishing: Option<Finishing>,
    /// The macro that a FANUC program calls behind every move.
    pub(crate) modal_macro: Option<ModalMacro>,
    /// What a SINUMERIK program has besides.
    pub(crate) siemens: SiemensState,
    pub(crate) origin: LineOrigin,
    pub(crate) block: Block,
    /// M codes that are waited for later than where they stand.
    pub(crate) awaited: AwaitedCodes,
    /// The line read last, if it was tried as a straight move.
    pub(crate) straight: StraightLine,
    /// The line executed last was one.
    pub(crate) was_straight: bool,
    /// The lathe cycle whose profile is being read.
    pub(crate) lathe_cycle: Option<Box<OpenLatheCycle>>,
    /// Items of the last block; the first `given` of them have been given out.
    pub(crate) items: Vec<Item>,
    pub(crate) given: usize,
    pub(crate) totals: Totals,
    /// Kept lines executed since the last item.
    pub(crate) idle_lines: u32,
    /// Kept lines executed.
    pub(crate) kept_lines: u64,
    /// A percent line was read.
    pub(crate) percent: bool,
    /// A line with words was read.
    pub(crate) begun: bool,
    /// The block number of the line that is executed (FANUC).
    pub(crate) sequence: Option<u32>,
    pub(crate) ended: bool,
    /// The input ended, and not the program: it has no M2, M30 or percent line at its end.
    pub(crate) ran_out: bool,
    /// Its lines come one after the other, and it waits for them.
    pub(crate) is_typed: bool,
    /// What was said to people, if that is kept.
    pub(crate) keeps_remarks: bool,
    pub(crate) remarks: Vec<Remark>,
}

impl<R: BufRead> Program<R> {
    /// Starts to read a program. Nothing is read before the first item is asked for.
    pub fn new(reader: R, options: Options) -> Self {
        let block = Block::of(options.dialect, &options.m_codes)
            .with_point(options.fanuc.point)
            .of_lathe(options.is_fanuc_lathe(), options.fanuc_control());
        let mut parameters = match options.dialect {
            Dialect::Fanuc => Parameters::of_fanuc(),
            _ => Parameters::new(),
        };
        parameters.begin_with(&options.variables);
        let awaited = AwaitedCodes::new(&options.m_codes);
        let in_force = options.in_force.clone();
        let feed = options.fanuc.feed_at_start;
        let mut program = Self {
            source: LineSource::new(reader),
            interpreter: Interpreter::new(options),
            parameters,
            flow: Flow::default(),
            tape: Tape::default(),
            finishing: None,
            modal_macro: None,
            siemens: SiemensState::default(),
            origin: LineOrigin::Stream,
            block,
            awaited,
            straight: StraightLine::default(),
            was_straight: false,
            lathe_cycle: None,
            items: Vec::new(),
            given: 0,
            totals: Totals::default(),
            idle_lines: 0,
            kept_lines: 0,
            percent: false,
            begun: false,
            sequence: None,
            ended: false,
            ran_out: false,
            is_typed: false,
            keeps_remarks: false,
            remarks: Vec::new(),
        };
        program.power_on(feed);
        if let Some(in_force) = in_force {
            program.begin_with(&in_force);
        }
        program
    }

    /// The same program, of lines that come one after the other, as somebody sends them. Where the reader gives
    /// nothing, the program waits for more: it gives no item, and goes on when it is asked again. A line that is
    /// refused has no effect, and the next one may be read, unless what follows depends on it.
    #[must_use]
    pub fn typed(self) -> Self {
        Self {
            is_typed: true,
            ..self
        }
    }

    /// Whether nothing more is read: behind M2, M30, the percent line, or a diagnostic behind which nothing can
    /// be understood.
    #[must_use]
    pub const fn has_ended(&self) -> bool {
        self.ended
    }

    /// Whether all that the line read last comes to was given out.
    #[must_use]
    pub const fn is_line_given(&self) -> bool {
        self.given >= self.items.len()
    }

    /// Whether the block read last assigns parameters.
    #[must_use]
    pub const fn assigns(&self) -> bool {
        !self.block.assignments.is_empty()
    }

    /// Likewise, and nothing depends on the next line: no move is held back beside the tool, no structure is open.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        let interpreter = &self.interpreter;
        let is_open = !interpreter.state.open.is_nothing()
            || interpreter.state.fanuc.open_plane.is_some()
            || self.lathe_cycle.is_some()
            || self.flow.recorder.is_some()
            || !self.flow.activations.is_empty()
            || !self.tape.calls.is_empty()
            || !self.siemens.steps.is_empty();
        !is_open && self.is_line_given()
    }

    /// What an M66 among the items of the last block waits for; once, and only of a machine whose
    /// inputs are [real](crate::Connections::Real). Nothing more is to be read before
    /// [`Program::answer_input`].
    pub const fn take_input_wait(&mut self) -> Option<InputWait> {
        self.interpreter.state.input_wait.take()
    }

    /// What an input was found to be: `#5399` from now on.
    pub const fn answer_input(&mut self, value: f64) {
        self.interpreter.state.input = value;
    }

    /// The same program to be judged alone: its items and totals leave out most moves.
    pub(crate) fn only_judged(mut self) -> Self {
        // CT of SINUMERIK goes on in the direction of the move before it.
        self.interpreter.only_judges = self.block.dialect != Dialect::Siemens;
        self
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

    /// Source line of the item given out last, 0 before the first.
    #[must_use]
    pub fn line_of_last(&self) -> u32 {
        let given = self
            .given
            .checked_sub(1)
            .and_then(|last| self.items.get(last));
        given.map_or(0, |item| item.line)
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

    /// The line being executed.
    pub(crate) fn here(&self) -> SourceLine {
        match &self.origin {
            LineOrigin::Stream => SourceLine::new(self.source.number(), self.source.text()),
            LineOrigin::Past(line) | LineOrigin::Tape(line) => line.clone(),
            LineOrigin::Kept(part, index) => match part.lines.get(*index) {
                Some(line) => SourceLine {
                    file: part.file.clone(),
                    ..SourceLine::new(line.number, &line.text)
                },
                None => SourceLine::default(),
            },
        }
    }

    /// The line of the program that a move now comes from: in the file of a subroutine, the line
    /// that calls it.
    pub(crate) fn line_of_program(&self) -> u32 {
        match &self.origin {
            LineOrigin::Stream => self.source.number(),
            LineOrigin::Tape(line) if line.file.is_some() => {
                self.tape.calls.last().map_or(0, |call| call.called_from)
            }
            LineOrigin::Past(line) | LineOrigin::Tape(line) => line.number,
            LineOrigin::Kept(part, index) if part.file.is_none() => {
                part.lines.get(*index).map_or(0, |line| line.number)
            }
            LineOrigin::Kept(..) => self
                .flow
                .activations
                .last()
                .map_or(0, |activation| activation.called_from),
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

    pub(crate) fn set_tape_origin(&mut self, number: u32, text: &[u8]) {
        let file = self.tape.file().map(Arc::clone);
        let line = SourceLine::new(number, text);
        self.origin = LineOrigin::Tape(SourceLine { file, ..line });
    }

    /// The end of the input, or of the tape: false, or a diagnostic if a part is not complete.
    pub(crate) fn end_of_input(&mut self) -> Outcome<bool> {
        self.ended = true;
        self.ran_out = !is_percent(self.source.text());
        match self.flow.recorder.take() {
            None => {
                self.interpreter.end_open(&self.block, &mut self.items)?;
                self.count();
                Ok(false)
            }
            Some(recorder) => {
                let fault = recorder.unfinished();
                let (number, text, _) = recorder.first;
                self.origin = LineOrigin::Past(SourceLine::new(number, &text));
                Err(fault)
            }
        }
    }

    /// Adds the items of a line to the totals.
    pub(crate) fn count(&mut self) {
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

    pub(crate) const fn scope(&self) -> ProgramScope<'_> {
        ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        }
    }
}

pub(crate) fn is_percent(text: &[u8]) -> bool {
    Cursor::new(text).next_visible() == Some(b'%')
}

fn endless(lines: u32) -> Box<BlockDiagnostic> {
    let message = format!("{lines} lines of a loop without a move");
    BlockDiagnostic::new(DiagnosticCode::EndlessLoop, SourceSpan::default(), message)
        .because("a loop that moves nothing for so long would hold up the machine for ever")
        .help("check the condition that should end it")
}
