//! The lines of a program that may jump: kept as they are read, up to a bound.

use std::io::BufRead;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::syntax::line_source::LineSource;

/// Most text kept while there are no jumps, bytes; with jumps it may be twice as much.
const MAX_BYTES: usize = 32 * 1024 * 1024;
/// Bytes a kept line costs besides its text.
const LINE_OVERHEAD: usize = 40;

/// A line of the program: its number and text.
pub(crate) type TapeLine = (u32, Box<[u8]>);

/// A subprogram in progress.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SubprogramCall {
    /// First line of the subprogram.
    pub(crate) first: usize,
    /// Where the caller goes on.
    pub(crate) back: usize,
    /// How many more times it runs.
    pub(crate) again: u32,
    /// True for G65: the subprogram has parameters of its own.
    pub(crate) own_parameters: bool,
}

/// Lines read so far, and which comes next.
#[derive(Debug, Default)]
pub(crate) struct Tape {
    lines: Vec<TapeLine>,
    bytes: usize,
    pub(crate) next: usize,
    pub(crate) calls: Vec<SubprogramCall>,
}

impl Tape {
    /// A kept line.
    pub(crate) fn get(&self, index: usize) -> Option<&TapeLine> {
        self.lines.get(index)
    }

    /// Makes sure that the line is kept, reading on if need be; false behind the end.
    pub(crate) fn reach<R: BufRead>(
        &mut self,
        index: usize,
        source: &mut LineSource<R>,
    ) -> Outcome<bool> {
        while self.lines.len() <= index {
            if !source.advance()? {
                return Ok(false);
            }
            self.bytes += source.text().len() + LINE_OVERHEAD;
            if self.bytes > 2 * MAX_BYTES {
                return Err(too_long());
            }
            self.lines.push((source.number(), source.text().into()));
        }
        Ok(true)
    }

    /// Goes to the next line, reading it if need be; false behind the end.
    ///
    /// The beginning of a program that is longer than what is kept is forgotten: it can still go
    /// on, but not back there.
    pub(crate) fn advance<R: BufRead>(&mut self, source: &mut LineSource<R>) -> Outcome<bool> {
        if self.bytes > MAX_BYTES && self.next >= self.lines.len() && self.calls.is_empty() {
            self.lines.clear();
            self.bytes = 0;
            self.next = 0;
        }
        let any = self.reach(self.next, source)?;
        self.next += usize::from(any);
        Ok(any)
    }

    /// The first line from `from` on that is wanted, before the end and before `stop` says so.
    pub(crate) fn search<R: BufRead>(
        &mut self,
        from: usize,
        source: &mut LineSource<R>,
        wanted: impl Fn(&[u8]) -> bool,
        stop: impl Fn(&[u8]) -> bool,
    ) -> Outcome<Option<usize>> {
        let mut index = from;
        while self.reach(index, source)? {
            let text = self.lines.get(index).map_or(&[][..], |(_, text)| text);
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
        wanted: impl Fn(&[u8]) -> bool,
        stop: impl Fn(&[u8]) -> bool,
    ) -> Option<usize> {
        let kept = self.lines.get(..before.min(self.lines.len()))?;
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

fn too_long() -> Box<Fault> {
    let message = format!("a program with jumps longer than {MAX_BYTES} bytes");
    Fault::new(DiagnosticCode::FlowTooLong, SourceSpan::default(), message)
        .because("what may be jumped to is kept in memory, up to that bound")
        .help("split the program, or write its jumps out")
}
