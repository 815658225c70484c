//! The lines of a program that may jump: kept as they are read, up to a bound; and those of the
//! files of its subprograms.

use std::collections::BTreeMap;
use std::io::BufRead;
use std::sync::Arc;

use glidepath_geometry::AxisVector;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::line_source::LineSource;

/// Most text kept while there are no jumps, bytes; with jumps it may be twice as much.
const MAX_BYTES: usize = 32 * 1024 * 1024;
/// Bytes a kept line costs besides its text.
const LINE_OVERHEAD: usize = 40;

/// Most jumps whose ends are remembered.
const MAX_JUMPS: usize = 100_000;

/// A line of the program: its number and text.
pub(crate) type TapeLine = (u32, Box<[u8]>);

/// Where a line is: which text, and which line of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct TapePlace {
    /// 0: the program itself; others: files of subprograms.
    pub(crate) text: usize,
    pub(crate) line: usize,
}

/// A subprogram in progress.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SubprogramCall {
    /// First line of the subprogram.
    pub(crate) first: TapePlace,
    /// Where the caller goes on.
    pub(crate) back: TapePlace,
    /// The line of the program that calls it.
    pub(crate) called_from: u32,
    /// How many more times it runs.
    pub(crate) again: u32,
    /// The number of the program that calls it, of FANUC.
    pub(crate) caller: u32,
    /// True for G65: the subprogram has parameters of its own.
    pub(crate) own_parameters: bool,
    /// True for the macro of G66, whose locals its next call has again.
    pub(crate) keeps_locals: bool,
}

/// The blocks of a profile that are executed for G70, and where the tool goes behind them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Finishing {
    /// The line behind the last one.
    pub(crate) end: TapePlace,
    /// Where the program goes on.
    pub(crate) back: TapePlace,
    /// Where the tool was, machine coordinates.
    pub(crate) start: AxisVector,
}

/// A part of the program that is executed again (SINUMERIK's REPEAT).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Repetition {
    pub(crate) start: usize,
    /// The line behind its last one.
    pub(crate) end: usize,
    /// Where the program goes on.
    pub(crate) back: usize,
    /// How many more times it runs.
    pub(crate) again: u32,
    /// How deep in calls it is.
    pub(crate) depth: usize,
}

/// The program, or the file of a subprogram.
#[derive(Debug, Default)]
struct TapeText {
    /// `None`: the program itself.
    file: Option<Arc<str>>,
    lines: Vec<TapeLine>,
}

/// A loop of FANUC that was begun.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct OpenLoop {
    /// How deep in calls it is.
    depth: usize,
    number: u32,
    /// The line with its DO.
    start: TapePlace,
}

/// Lines read so far, and which comes next.
#[derive(Debug)]
pub(crate) struct Tape {
    /// The program itself, then the files in the order of their calls.
    texts: Vec<TapeText>,
    bytes: usize,
    /// The text that is executed.
    text: usize,
    /// The line of it that comes next.
    pub(crate) next: usize,
    pub(crate) calls: Vec<SubprogramCall>,
    pub(crate) repetitions: Vec<Repetition>,
    loops: Vec<OpenLoop>,
    /// The first line of the program that was never executed.
    unseen: usize,
    /// The line executed last had been executed before, or is of a file.
    is_again: bool,
    /// Where jumps have led: a search through a long program for every turn of a loop would take
    /// as long as all its lines do.
    jumps: BTreeMap<(TapePlace, u32), usize>,
    /// Where programs begin, by the text that calls them and their number.
    programs: BTreeMap<(usize, u32), TapePlace>,
    /// The same of programs with names.
    named: BTreeMap<Vec<u8>, TapePlace>,
    /// The first and the last line of profiles that a cycle has cut, by the text, P and Q.
    profiles: BTreeMap<(usize, [u32; 2]), [usize; 2]>,
}

impl Default for Tape {
    fn default() -> Self {
        Self {
            texts: vec![TapeText::default()],
            bytes: 0,
            text: 0,
            next: 0,
            calls: Vec::new(),
            repetitions: Vec::new(),
            loops: Vec::new(),
            unseen: 0,
            is_again: false,
            jumps: BTreeMap::new(),
            programs: BTreeMap::new(),
            named: BTreeMap::new(),
            profiles: BTreeMap::new(),
        }
    }
}

impl Tape {
    fn lines(&self) -> &[TapeLine] {
        self.texts.get(self.text).map_or(&[], |text| &text.lines)
    }

    /// A line of the text that is executed.
    pub(crate) fn get(&self, index: usize) -> Option<&TapeLine> {
        self.lines().get(index)
    }

    /// The file that is executed; `None`: the program itself.
    pub(crate) fn file(&self) -> Option<&Arc<str>> {
        self.texts.get(self.text)?.file.as_ref()
    }

    /// The line that comes next.
    pub(crate) const fn place(&self) -> TapePlace {
        TapePlace {
            text: self.text,
            line: self.next,
        }
    }

    /// Goes to a line.
    pub(crate) const fn go_to(&mut self, place: TapePlace) {
        self.text = place.text;
        self.next = place.line;
    }

    /// The text of a file that was taken up.
    pub(crate) fn text_of(&self, file: &str) -> Option<usize> {
        let of_file = |text: &TapeText| text.file.as_deref() == Some(file);
        self.texts.iter().position(of_file)
    }

    /// Takes up the lines of a file: which text it is.
    pub(crate) fn take_up(&mut self, file: Arc<str>, lines: Vec<TapeLine>) -> usize {
        let file = Some(file);
        self.texts.push(TapeText { file, lines });
        self.texts.len() - 1
    }

    /// True if the line may have been executed before: a loop is made of such lines.
    pub(crate) const fn is_again(&self) -> bool {
        self.is_again
    }

    /// Where a program begins that the text being executed has called before.
    pub(crate) fn known_program(&self, number: u32) -> Option<TapePlace> {
        self.programs.get(&(self.text, number)).copied()
    }

    pub(crate) fn remember_program(&mut self, number: u32, place: TapePlace) {
        self.programs.insert((self.text, number), place);
    }

    /// Where a program of that name begins that was called before.
    pub(crate) fn known_name(&self, name: &[u8]) -> Option<TapePlace> {
        self.named.get(name).copied()
    }

    pub(crate) fn remember_name(&mut self, name: Vec<u8>, place: TapePlace) {
        self.named.insert(name, place);
    }

    /// The lines of the profile of these numbers that was cut last.
    pub(crate) fn known_profile(&self, numbers: [u32; 2]) -> Option<[usize; 2]> {
        self.profiles.get(&(self.text, numbers)).copied()
    }

    pub(crate) fn remember_profile(&mut self, numbers: [u32; 2], lines: [usize; 2]) {
        if self.profiles.len() >= MAX_JUMPS {
            self.profiles.clear();
        }
        self.profiles.insert((self.text, numbers), lines);
    }

    /// Makes sure that the line is kept, reading on if need be; false behind the end.
    pub(crate) fn reach<R: BufRead>(
        &mut self,
        index: usize,
        source: &mut LineSource<R>,
    ) -> Outcome<bool> {
        let Some(program) = self.texts.first_mut().filter(|_| self.text == 0) else {
            return Ok(index < self.lines().len());
        };
        while program.lines.len() <= index {
            if !source.advance()? {
                return Ok(false);
            }
            self.bytes += source.text().len() + LINE_OVERHEAD;
            if self.bytes > 2 * MAX_BYTES {
                return Err(too_long());
            }
            program.lines.push((source.number(), source.text().into()));
        }
        Ok(true)
    }

    /// Goes to the next line, reading it if need be; false behind the end.
    ///
    /// The beginning of a program that is longer than what is kept is forgotten: it can still go
    /// on, but not back there.
    pub(crate) fn advance<R: BufRead>(&mut self, source: &mut LineSource<R>) -> Outcome<bool> {
        if let Some(program) = self.texts.first_mut()
            && self.bytes > MAX_BYTES
            && self.text == 0
            && self.next >= program.lines.len()
            && self.calls.is_empty()
            && self.repetitions.is_empty()
        {
            program.lines.clear();
            self.jumps.clear();
            self.programs.clear();
            self.named.clear();
            self.profiles.clear();
            self.bytes = 0;
            self.next = 0;
            self.unseen = 0;
        }
        let any = self.reach(self.next, source)?;
        self.next += usize::from(any);
        self.is_again = self.text != 0 || self.next <= self.unseen;
        if self.text == 0 {
            self.unseen = self.unseen.max(self.next);
        }
        Ok(any)
    }

    /// A loop of that number is over, and so are those of calls that are.
    pub(crate) fn leave_loop(&mut self, number: u32) {
        let depth = self.calls.len();
        self.loops
            .retain(|it| it.depth < depth || it.depth == depth && it.number != number);
    }

    /// A loop begins, in that line.
    pub(crate) fn open_loop(&mut self, number: u32, line: usize) {
        let start = TapePlace {
            text: self.text,
            line,
        };
        let depth = self.calls.len();
        self.loops.push(OpenLoop {
            depth,
            number,
            start,
        });
    }

    /// True inside of the loop that begins in that line.
    pub(crate) fn is_in_loop(&self, number: u32, line: usize) -> bool {
        let start = TapePlace {
            text: self.text,
            line,
        };
        let depth = self.calls.len();
        self.loops.contains(&OpenLoop {
            depth,
            number,
            start,
        })
    }

    /// Where the jump in a line led before; `number` tells the jumps of a line apart.
    pub(crate) fn known_jump(&self, index: usize, number: u32) -> Option<usize> {
        let from = TapePlace {
            text: self.text,
            line: index,
        };
        self.jumps.get(&(from, number)).copied()
    }

    /// Jumps, and remembers where to.
    pub(crate) fn jump(&mut self, index: usize, number: u32, to: usize) {
        self.remember_jump(index, number, to);
        self.next = to;
    }

    /// Remembers where what a line names is.
    pub(crate) fn remember_jump(&mut self, index: usize, number: u32, to: usize) {
        if self.jumps.len() >= MAX_JUMPS {
            self.jumps.clear();
        }
        let from = TapePlace {
            text: self.text,
            line: index,
        };
        self.jumps.insert((from, number), to);
    }

    /// The first line from `from` on that is wanted, before the end and before `stop` says so.
    pub(crate) fn search<R: BufRead>(
        &mut self,
        from: usize,
        source: &mut LineSource<R>,
        mut wanted: impl FnMut(&[u8]) -> bool,
        stop: impl Fn(&[u8]) -> bool,
    ) -> Outcome<Option<usize>> {
        let mut index = from;
        while self.reach(index, source)? {
            let text = self.get(index).map_or(&[][..], |(_, text)| text);
            if wanted(text) {
                return Ok(Some(index));
            }
            if stop(text) {
                return Ok(None);
            }
            index += 1;
        }
        Ok(None)
    }

    /// The last line before `before` that is wanted, not looking beyond one where `stop` says so.
    pub(crate) fn search_back(
        &self,
        before: usize,
        mut wanted: impl FnMut(&[u8]) -> bool,
        stop: impl Fn(&[u8]) -> bool,
    ) -> Option<usize> {
        let lines = self.lines();
        let kept = lines.get(..before.min(lines.len()))?;
        for (index, (_, text)) in kept.iter().enumerate().rev() {
            if wanted(text) {
                return Some(index);
            }
            if stop(text) {
                return None;
            }
        }
        None
    }
}

fn too_long() -> Box<BlockDiagnostic> {
    let message = format!("a program with jumps longer than {MAX_BYTES} bytes");
    BlockDiagnostic::new(DiagnosticCode::FlowTooLong, SourceSpan::default(), message)
        .because("what may be jumped to is kept in memory, up to that bound")
        .help("split the program, or write its jumps out")
}
