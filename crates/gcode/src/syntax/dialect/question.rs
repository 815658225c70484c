//! The question which dialect a program is in, where its lines mean one thing to one control and
//! another thing to the next.

use crate::diagnostic::Diagnostic;
use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

/// What is in doubt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Doubt {
    /// A program number alone.
    Number,
    /// G90, G92 or G94 with a place and F.
    Cycle,
    /// G98 or G99.
    FeedMode,
    /// Holes in G91, in a mill's program.
    HolesInG91,
    /// G10 L2, L20 or G92 in G91, in a mill's program.
    OffsetInG91,
    /// P of a dwell without a decimal point, in a mill's program.
    Dwell,
    /// A program that is executed as it comes.
    Stream,
}

/// The question which dialect a program is in: a line that the controls it may be for read
/// differently, where nothing in the program says which it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DialectQuestion {
    pub(super) doubt: Doubt,
    /// The line, from 1.
    pub(super) line: u32,
    pub(super) text: Box<[u8]>,
}

impl DialectQuestion {
    /// The diagnostic that asks it.
    pub(crate) fn diagnostic(&self) -> Diagnostic {
        let (message, reason) = match self.doubt {
            Doubt::Number => (
                "a lathe's program with a number, and nothing says whose it is",
                "X counts diameters on FANUC's lathes, and radii in LinuxCNC's language",
            ),
            Doubt::Cycle => (
                "this line is a cycle to one control and a mode with a move to another",
                "on FANUC's lathes G90, G92 and G94 with X, Z and F cut along the part and come back, and X counts diameters; in LinuxCNC's language they do not, and X counts radii",
            ),
            Doubt::FeedMode => (
                "this line says what F counts on one control, and where drilling ends on another",
                "on FANUC's lathes G98 and G99 are the feed per minute and per revolution, and X counts diameters; in LinuxCNC's language they are no feed, and X counts radii",
            ),
            Doubt::HolesInG91 => (
                "holes in G91, in a program with a number, and nothing says whose it is",
                "the levels of R and Z stay where they are on FANUC's and Haas' controls; in LinuxCNC's language each hole in G91 counts them anew from where the tool is",
            ),
            Doubt::OffsetInG91 => (
                "an offset in G91, in a program with a number, and nothing says whose it is",
                "G10 and G92 add their words in G91 on FANUC's and Haas' controls, and set them in LinuxCNC's language",
            ),
            Doubt::Dwell => (
                "a dwell without a decimal point, in a program with a number, and nothing says whose it is",
                "P without a point counts milliseconds on FANUC's and Haas' controls, and seconds in LinuxCNC's language",
            ),
            Doubt::Stream => (
                "a lathe's program that cannot be looked at before it is executed",
                "X counts diameters on FANUC's lathes, and radii in LinuxCNC's language, and G90, G92 and G98 mean other things there",
            ),
        };
        let start = self
            .text
            .iter()
            .take_while(|byte| byte.is_ascii_whitespace());
        let start = start.count();
        let end = self.text.trim_ascii_end().len();
        let span = SourceSpan::new(start, end.max(start));
        let fault = BlockDiagnostic::new(DiagnosticCode::UndecidedDialect, span, message)
            .because(reason)
            .help("say which it is: --dialect fanuc or --dialect linuxcnc (or another), or `dialect` of [program] in the configuration");
        fault.at(self.line, &self.text)
    }
}
