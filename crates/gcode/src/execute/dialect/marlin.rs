//! Lines of printers, and the functions of their machines: heaters, fans, messages.

use std::io::BufRead;

use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::line_origin::LineOrigin;
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::setup::firmware::Firmware;
use crate::setup::options::Connections;
use crate::syntax::block::Block;
use crate::syntax::dialect::marlin::{NamedCommand, named_command, shows_text, verified};

/// Commands of Klipper that give places other names, or keep and bring back what is in force.
const STATES: [&[u8]; 3] = [
    b"SET_GCODE_OFFSET",
    b"SAVE_GCODE_STATE",
    b"RESTORE_GCODE_STATE",
];

/// True for an M code behind which a printer goes on only when something is as hot as it should be.
const fn waits(number: u32) -> bool {
    matches!(number, 109 | 190 | 191)
}

impl<R: BufRead> Program<R> {
    /// Reads and executes the next line; false at the end.
    pub(crate) fn read_marlin(&mut self) -> Outcome<bool> {
        self.origin = LineOrigin::Stream;
        if !self.source.advance()? {
            return self.end_of_input();
        }
        if self.is_deleted() {
            return Ok(true);
        }
        if let Some(command) = named_command(self.source.text()) {
            let done = self.whole_statement(|program| program.klipper_command(command));
            return done.map(|()| true);
        }
        let number = self.source.number();
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let text = verified(self.source.text())?;
        let parsed = self.block.parse(text, &scope);
        self.execute_parsed(number, parsed)
    }
}

impl<R: BufRead> Program<R> {
    /// Whoever has commands with names is Klipper.
    pub(crate) fn take_for_klipper(&mut self) {
        let firmware = &mut self.interpreter.state.firmware;
        *firmware = firmware.or(Some(Firmware::Klipper));
    }

    /// A command of Klipper with a name: read over where it moves nothing.
    fn klipper_command(&mut self, command: NamedCommand) -> Outcome<()> {
        self.begun = true;
        self.take_for_klipper();
        if command.is_silent {
            return Ok(());
        }
        let name = self.source.text().get(command.span.start..);
        let name = name.and_then(|name| name.get(..command.span.length));
        let name = name.unwrap_or_default().to_ascii_uppercase();
        if STATES.contains(&name.as_slice()) {
            return self.klipper_state(&name, command.span);
        }
        let name = String::from_utf8_lossy(&name).into_owned();
        let message = format!("{name} (a command or macro of Klipper) is not supported");
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, command.span, message)
                .because("what it does stands in the printer's configuration, and it may move the machine")
                .help("write the moves that it makes, or remove it"),
        )
    }
}

impl Interpreter {
    /// Refuses T of a printer's program that names another tool than the first.
    pub(crate) fn check_one_extruder(&self, block: &Block) -> Outcome<()> {
        let Some(tool) = block.get(b'T').filter(|tool| *tool != 0.0) else {
            return Ok(());
        };
        let message = format!("T{tool} (another extruder than T0) is not supported");
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, block.span(b'T'), message)
                .because("each tool of a printer has an extruder and a place of its own, and the machine has one extruder: E words behind it would move that of T0")
                .help("let the slicer write the program for one extruder"),
        )
    }

    /// A block with a function of the machine: nothing else of it is executed.
    pub(crate) fn machine_function(
        &mut self,
        block: &Block,
        number: u32,
        span: SourceSpan,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let other = block.codes.motion.map(|c| c.span);
        let other = other.or_else(|| block.codes.non_modal.map(|c| c.span));
        if let Some(span) = other {
            let message = format!("a G code beside M{number}");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, span, message)
                    .because("M codes of printers take the words of their block")
                    .help("write two blocks"),
            );
        }
        if number == 400 || shows_text(number) {
            // M400 waits for the end of the motion, and a message is shown at rest.
            self.push(out, ItemKind::Event(Event::MCode(number)));
            return Ok(());
        }
        check_factors(block, number)?;
        let simulated = self.options.connections == Connections::Simulated;
        if waits(number) && !simulated && !self.options.m_codes.contains(number) {
            let message =
                format!("M{number} waits for a temperature, and nothing says when it is reached");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotConnected, span, message)
                    .because("going on with a cold nozzle or bed could break the extruder")
                    .help(format!(
                        "say what it waits for: a table [m_codes.M{number}] in the configuration"
                    )),
            );
        }
        if self.options.extruder.is_none() {
            self.require_connection(span, "heater, fan or printer setting")?;
        }
        self.push(out, ItemKind::Event(Event::MCode(number)));
        Ok(())
    }
}

/// Refuses a code that would make other moves of the program's, if its words say so.
fn check_factors(block: &Block, number: u32) -> Outcome<()> {
    let (letter, none, what) = match number {
        200 => (b'D', 0.0, "E words that are volumes"),
        220 => (b'S', 100.0, "a factor of all feedrates"),
        221 => (b'S', 100.0, "a factor of all E words"),
        _ => return Ok(()),
    };
    let Some(value) = block
        .get(letter)
        .filter(|value| (value - none).abs() > 1e-9)
    else {
        return Ok(());
    };
    let name = char::from(letter);
    let message = format!("M{number} {name}{value} ({what}) is not supported");
    Err(
        BlockDiagnostic::new(DiagnosticCode::NotSupported, block.span(letter), message)
            .because("going on without it would make other moves than the program's")
            .help(format!(
                "write {name}{none}, or let the slicer compute it in"
            )),
    )
}
