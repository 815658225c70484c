//! Where the profile of a lathe cycle stands: the blocks from N P to N Q.
//!
//! G71, G72 and G73 take the first ones behind them, or else in front of them. G70 takes those that such
//! a cycle has cut, as the control does, so that each tool may have the same numbers.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::program::Program;
use crate::syntax::block::Block;
use crate::syntax::dialect::fanuc::{is_label, is_numbered};
use crate::syntax::modes::LatheCycle;

impl<R: BufRead> Program<R> {
    /// The first and the last line of the profile.
    pub(super) fn profile_lines(
        &mut self,
        block: &Block,
        cycle: LatheCycle,
        numbers: [u32; 2],
    ) -> Outcome<[usize; 2]> {
        let is_finish = cycle == LatheCycle::Finish;
        if is_finish && let Some(lines) = self.tape.known_profile(numbers) {
            return Ok(lines);
        }
        let [first, last] = numbers;
        let index = self.tape.next.saturating_sub(1);
        let begins = |line: &[u8]| is_numbered(line, first);
        let ahead = self
            .tape
            .search(index + 1, &mut self.source, begins, is_label)?;
        let behind = self.tape.search_back(index, begins, is_label);
        if is_finish && ahead.is_some() && behind.is_some() {
            let message = format!("there are two blocks N{first}, in front of G70 and behind it");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::AmbiguousWord,
                block.span(b'P'),
                message,
            )
            .because("no cycle in front of it has cut one of the two profiles")
            .help("give one of them another number"));
        }
        let begin = ahead.or(behind);
        let end = match begin {
            Some(begin) => {
                let ends = |line: &[u8]| is_numbered(line, last);
                self.tape.search(begin, &mut self.source, ends, is_label)?
            }
            None => None,
        };
        match (begin, end) {
            (Some(begin), Some(end)) if begin < end => {
                if !is_finish {
                    self.tape.remember_profile(numbers, [begin, end]);
                }
                Ok([begin, end])
            }
            _ => {
                let message = format!("there are no blocks N{first} to N{last} in the program");
                Err(
                    BlockDiagnostic::new(DiagnosticCode::FlowStructure, block.span(b'P'), message)
                        .because("they are the profile of the cycle")
                        .help("write N and the numbers of P and Q in front of its first and last block"),
                )
            }
        }
    }
}
