//! Inputs and outputs: M62 to M68, and the M codes of the machine.
//!
//! | code | what it does |
//! |---|---|
//! | M62 P, M63 P | digital output P on, off, in order with the motion |
//! | M64 P, M65 P | the same; there is no queue here to overtake |
//! | M66 P or E, L, Q | waits for an input; what it reads is `#5399` |
//! | M67 E Q, M68 E Q | analog output E to the value Q |
//!
//! They are refused unless the program is read with [`Connections::Simulated`] or
//! [`Connections::Real`]. M codes that the machine's builder declared are events at rest, with their
//! P and Q words in front of them.

use glidepath_program::{CodeWord, Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::auxiliary::input_wait::{Input, InputWait, WaitFor};
use crate::execute::interpreter::Interpreter;
use crate::setup::options::Connections;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::word_check::{missing, whole};

/// Largest number of an input or output.
const MAX_PORT: u32 = 63;

impl Interpreter {
    /// M19 and M62 to M68.
    pub(crate) fn input_output(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        self.orient(block, out)?;
        self.machine_codes(block, out);
        let Some(Coded { code, span }) = block.codes.input_output else {
            return Ok(());
        };
        let what = if code == 66 { "input" } else { "output" };
        self.require_connection(span, what)?;
        let name = format!("M{code}");
        let event = match code {
            62..=65 => {
                let number = whole(block, b'P', MAX_PORT)?
                    .ok_or_else(|| missing(span, &name, "P", "the output's number"))?;
                let on = matches!(code, 62 | 64);
                Event::DigitalOutput { number, on }
            }
            67 | 68 => {
                let number = whole(block, b'E', MAX_PORT)?
                    .ok_or_else(|| missing(span, &name, "E", "the output's number"))?;
                let value = block
                    .get(b'Q')
                    .ok_or_else(|| missing(span, &name, "Q", "the output's value"))?;
                Event::AnalogOutput { number, value }
            }
            _ => {
                let wait = self.read_wait(block, span)?;
                self.state.input = 0.0;
                self.state.input_wait =
                    (self.options.connections == Connections::Real).then_some(wait);
                Event::MCode(code)
            }
        };
        self.push(out, ItemKind::Event(event));
        Ok(())
    }

    /// M codes of the machine, the first with the words of the block; those of gears come in front of S.
    fn machine_codes(&mut self, block: &Block, out: &mut Vec<Item>) {
        let Some(Coded { code, .. }) = block.codes.user else {
            return;
        };
        let more = block.codes.more_of_user.map(u32::from);
        let mut has_words = false;
        for code in core::iter::once(code).chain(more) {
            if code == 0 || self.is_gear_word(code) {
                continue;
            }
            for (letter, word) in [(b'P', CodeWord::P), (b'Q', CodeWord::Q)] {
                if let Some(value) = block.get(letter).filter(|_| !has_words) {
                    self.push(out, ItemKind::Event(Event::CodeWord { word, value }));
                }
            }
            has_words = true;
            self.push(out, ItemKind::Event(Event::MCode(code)));
        }
    }

    /// The words of M66.
    fn read_wait(&self, block: &Block, span: SourceSpan) -> Outcome<InputWait> {
        let digital = whole(block, b'P', MAX_PORT)?;
        let analog = whole(block, b'E', MAX_PORT)?;
        if digital.is_some() == analog.is_some() {
            return Err(missing(
                span,
                "M66",
                "one of P and E",
                "the digital or the analog input",
            ));
        }
        let mode = whole(block, b'L', 4)?.unwrap_or(0);
        if mode != 0 && analog.is_some() {
            let message = "M66 waits for no edge or level of an analog input";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::InvalidValue,
                block.span(b'L'),
                message,
            )
            .help("write L0, which reads it at once"));
        }
        if mode != 0 && block.get(b'Q').is_none_or(|limit| limit <= 0.0) {
            return Err(missing(
                span,
                "M66",
                "Q",
                "how long to wait at most, seconds above zero",
            ));
        }
        Ok(InputWait {
            input: match (digital, analog) {
                (Some(number), _) => Input::Digital(number),
                (None, number) => Input::Analog(number.unwrap_or(0)),
            },
            until: match mode {
                1 => WaitFor::Rise,
                2 => WaitFor::Fall,
                3 => WaitFor::High,
                4 => WaitFor::Low,
                _ => WaitFor::Nothing,
            },
            limit_s: block.get(b'Q').unwrap_or(0.0),
        })
    }

    /// Refuses what the machine does not have connected.
    pub(crate) fn require_connection(&self, span: SourceSpan, what: &str) -> Outcome<()> {
        if self.options.connections != Connections::None {
            return Ok(());
        }
        let message = format!("no {what} is connected");
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotConnected, span, message)
                .because("the motion alone is made here; going on without it could break something")
                .help("remove the block, or read the program with simulated inputs and outputs"),
        )
    }
}
