//! Programs with numbers: `O20` in front of one, `M98 P20` to call it.
//!
//! One is looked for in the text of its caller, from its O number to M99 or M30, then in the program
//! itself, then in a file: program 20 in `O0020`, `O20` or `20`, as it is or with `.nc` behind it, in
//! capitals or not ([`file_names`] has the order). Of a file the lines from its O number on are executed,
//! or all of them if it has none.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::fanuc::arguments::CallWords;
use crate::execute::dialect::tape::TapePlace;
use crate::execute::flow::load::unusable;
use crate::execute::program::Program;
use crate::setup::subroutine_file::{NoSubroutineFile, NotTaken};
use crate::syntax::dialect::fanuc::{Statement, statement};

/// The files that program may be in, in the order in which they are looked for.
fn file_names(program: u32) -> impl Iterator<Item = String> {
    let stems = [
        format!("O{program:04}"),
        format!("O{program:05}"),
        format!("O{program}"),
        format!("o{program:04}"),
        format!("o{program}"),
        format!("{program:04}"),
        format!("{program}"),
    ];
    let mut names = Vec::new();
    for ending in ["", ".nc", ".NC"] {
        for stem in &stems {
            let name = format!("{stem}{ending}");
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names.into_iter()
}

impl<R: BufRead> Program<R> {
    /// Where a program begins, and how often it runs: of a number with more than four digits the
    /// first ones count repetitions where there is no such program.
    pub(super) fn fanuc_program_and_turns(
        &mut self,
        program: u32,
        words: &CallWords,
        span: SourceSpan,
    ) -> Outcome<(TapePlace, u32)> {
        let found = self.fanuc_program(program, span);
        let (turns, number) = (program / 10_000, program % 10_000);
        let is_missing = found
            .as_ref()
            .is_err_and(|fault| fault.code == DiagnosticCode::UnknownSubroutine);
        // Programs of a Haas have five digits, and their calls are repeated by L.
        let is_haas = self.interpreter.options.fanuc.is_haas();
        let has_turns = turns != 0 && number != 0 && !is_haas;
        if !is_missing || !has_turns || words.says_turns || words.is_macro {
            return found.map(|place| (place, words.turns));
        }
        match self.fanuc_program(number, span) {
            Ok(place) => Ok((place, turns)),
            Err(_) => found.map(|place| (place, words.turns)),
        }
    }

    /// Where that program begins: its first line.
    fn fanuc_program(&mut self, program: u32, span: SourceSpan) -> Outcome<TapePlace> {
        let here = self.tape.place();
        if let Some(place) = self.tape.known_program(program) {
            return Ok(place);
        }
        let mut texts = vec![here.text, 0];
        texts.dedup();
        let mut found = None;
        for text in texts {
            self.tape.go_to(TapePlace { text, line: 0 });
            let wanted = |line: &[u8]| statement(line).0 == Statement::Label(program);
            let label = self.tape.search(0, &mut self.source, wanted, |_| false);
            self.tape.go_to(here);
            if let Some(label) = label? {
                let line = label + 1;
                self.check_number_once(program, TapePlace { text, line }, span)?;
                found = Some(TapePlace { text, line });
                break;
            }
        }
        let place = match found {
            Some(place) => place,
            None => self.fanuc_file(program, span)?,
        };
        self.tape.remember_program(program, place);
        Ok(place)
    }

    /// Refuses a program whose number stands in front of another one, too; `first` is behind the number.
    fn check_number_once(
        &mut self,
        program: u32,
        first: TapePlace,
        span: SourceSpan,
    ) -> Outcome<()> {
        let here = self.tape.place();
        self.tape.go_to(first);
        let wanted = |line: &[u8]| statement(line).0 == Statement::Label(program);
        let second = self
            .tape
            .search(first.line, &mut self.source, wanted, |_| false);
        let number = second.map(|second| Some(self.tape.get(second?)?.0));
        self.tape.go_to(here);
        let Some(number) = number? else {
            return Ok(());
        };
        let message = format!("there are two programs O{program}");
        Err(
            BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, span, message)
                .because(format!("the second one begins in line {number}"))
                .help("remove one of them, or give it another number"),
        )
    }

    /// The program of that number in a file of its own.
    fn fanuc_file(&mut self, program: u32, span: SourceSpan) -> Outcome<TapePlace> {
        let Some(subroutines) = &self.interpreter.options.subroutines else {
            return Err(unknown(program, span, &[]));
        };
        let file = subroutines
            .first_of(file_names(program))
            .map_err(|why| match why {
                NotTaken::None(NoSubroutineFile::Missing { looked_in }) => {
                    unknown(program, span, &looked_in)
                }
                why => unusable(&format!("program O{program}"), span, why),
            })?;
        let TapePlace { text, .. } = self.start_of_file(&file)?;
        let here = self.tape.place();
        self.tape.go_to(TapePlace { text, line: 0 });
        let mut others = false;
        let wanted = |line: &[u8]| match statement(line).0 {
            Statement::Label(number) => {
                others |= number != program;
                number == program
            }
            _ => false,
        };
        let label = self.tape.search(0, &mut self.source, wanted, |_| false);
        self.tape.go_to(here);
        match label? {
            Some(label) => Ok(TapePlace {
                text,
                line: label + 1,
            }),
            None if others => {
                let message = format!("{} has other programs than O{program}", file.name);
                Err(
                    BlockDiagnostic::new(DiagnosticCode::UnknownSubroutine, span, message)
                        .because("the O numbers in a file say which programs it has")
                        .help(format!(
                            "write O{program} at its beginning, or remove the O numbers"
                        )),
                )
            }
            None => Ok(TapePlace { text, line: 0 }),
        }
    }
}

fn unknown(program: u32, span: SourceSpan, looked_in: &[String]) -> Box<BlockDiagnostic> {
    let message = format!("there is no program O{program}");
    let fault = BlockDiagnostic::new(DiagnosticCode::UnknownSubroutine, span, message);
    let fault = if looked_in.is_empty() {
        fault.because(
            "it is not in the text of its caller, and there is no folder to look for it in",
        )
    } else {
        fault.because(format!(
            "it is not in the text of its caller, and there is no file O{program:04}, O{program} or \
             {program}, with or without .nc, in {}",
            looked_in.join(", ")
        ))
    };
    if program > 9999 {
        return fault.help(format!(
            "if its first digits are repetitions, write M98 P{} L{}; else add the program or its \
             folder",
            program % 10_000,
            program / 10_000
        ));
    }
    fault.help(
        "copy it behind the end of this program, or give the folder of its file: --subroutine-path, \
         or `subroutine_path` of [program]",
    )
}
