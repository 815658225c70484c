//! Programs with names: `O<PART>` or `<PART>` in front of one, `M98 <PART>` to call it.
//!
//! It is looked for in the text of its caller, then in the program itself, then in a file of that name,
//! as it is or with `.nc` behind it.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::tape::TapePlace;
use crate::execute::flow::load::unusable;
use crate::execute::program::Program;
use crate::setup::subroutine_file::{NoSubroutineFile, NotTaken};
use crate::syntax::dialect::fanuc::program_name;

impl<R: BufRead> Program<R> {
    /// Where the program of that name, in capitals, begins.
    pub(super) fn fanuc_program_named(
        &mut self,
        name: &[u8],
        span: SourceSpan,
    ) -> Outcome<TapePlace> {
        if let Some(place) = self.tape.known_name(name) {
            return Ok(place);
        }
        let here = self.tape.place();
        let mut texts = vec![here.text, 0];
        texts.dedup();
        for text in texts {
            self.tape.go_to(TapePlace { text, line: 0 });
            let wanted =
                |line: &[u8]| program_name(line).is_some_and(|it| it.eq_ignore_ascii_case(name));
            let found = self.tape.search(0, &mut self.source, wanted, |_| false);
            self.tape.go_to(here);
            if let Some(label) = found? {
                let line = label + 1;
                let place = TapePlace { text, line };
                self.tape.remember_name(name.to_vec(), place);
                return Ok(place);
            }
        }
        let place = self.fanuc_named_file(name, span)?;
        self.tape.remember_name(name.to_vec(), place);
        Ok(place)
    }

    fn fanuc_named_file(&mut self, name: &[u8], span: SourceSpan) -> Outcome<TapePlace> {
        let shown = String::from_utf8_lossy(name).into_owned();
        let mut found = None;
        if let Some(subroutines) = &self.interpreter.options.subroutines {
            let lower = shown.to_ascii_lowercase();
            let stems = [&shown, &lower];
            for name in stems
                .iter()
                .flat_map(|stem| [(*stem).clone(), format!("{stem}.nc"), format!("{stem}.NC")])
            {
                match subroutines.get(&name) {
                    Err(NotTaken::None(NoSubroutineFile::Missing { .. })) => {}
                    Err(why) => return Err(unusable(&format!("program <{shown}>"), span, why)),
                    Ok(file) => {
                        found = Some(file);
                        break;
                    }
                }
            }
        }
        let Some(file) = found else {
            return Err(unknown(&shown, span));
        };
        self.start_of_file(&file)
    }
}

fn unknown(name: &str, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("there is no program <{name}>");
    BlockDiagnostic::new(DiagnosticCode::UnknownSubroutine, span, message)
        .because("it is not in the text of its caller, and no file of that name was found")
        .help("copy it behind the end of this program, or give the folder of its file: --subroutine-path, or `subroutine_path` of [program]")
}
