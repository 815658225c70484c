//! The orientation of the spindle: M19, and SPOS of SINUMERIK.
//!
//! | word | what it does |
//! |---|---|
//! | M19 | stops the spindle at angle 0, or at its own where it turns to none that it is given |
//! | M19 R, SPOS | stops it at this angle, degrees |
//! | M19 P | the way there: 0 the shorter one, 1 clockwise, 2 counterclockwise |
//! | M19 Q | how long it may take, s |
//!
//! An angle is refused where the spindle does not turn to one: the tool would stand otherwise than the
//! program says, and be drawn through the wall of a bore.

use glidepath_program::{CodeWord, Event, Item, ItemKind, OrientWay};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::named_word::{Named, NamedValue};
use crate::syntax::word_check::whole;

const ORIENTED: u32 = 19;
const TURN: f64 = 360.0;

/// What the spindle is to do at M19.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Orientation {
    /// Degrees from 0 to 360.
    deg: f64,
    way: OrientWay,
    /// How long it may take, s.
    within_s: Option<f64>,
}

impl Orientation {
    /// That of M19 without a word.
    pub(crate) const OWN: Self = Self {
        deg: 0.0,
        way: OrientWay::Shortest,
        within_s: None,
    };
}

impl Interpreter {
    /// M19 and SPOS.
    pub(super) fn orient(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        if let Some(coded) = block.codes.orient {
            self.require_connection(coded.span, "spindle that stops in a known position")?;
            let orientation = self.orientation(block, coded.span)?;
            self.state.spindle.turning = None;
            self.tell_orientation(orientation, out);
        }
        if let Some(word) = block.named.find(Named::SpindleAngle) {
            let orientation = self.stop_at_angle(word)?;
            self.turn_spindle(None);
            self.tell_orientation(orientation, out);
        }
        Ok(())
    }

    /// The words of M19.
    fn orientation(&self, block: &Block, span: SourceSpan) -> Outcome<Orientation> {
        for (letter, what) in [(b'R', "to an angle"), (b'P', "one way or the other")] {
            if block.get(letter).is_some() && !self.options.orients {
                let name = char::from(letter);
                return Err(not_oriented(
                    block.span(letter),
                    &format!("M19 {name} of a spindle that is not turned {what}"),
                ));
            }
        }
        let deg = block.get(b'R').unwrap_or(0.0);
        if !(0.0..=TURN).contains(&deg) {
            let message = format!("the angle of M19 is {deg}");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::InvalidValue,
                block.span(b'R'),
                message,
            )
            .because("R is an angle in a turn of the spindle")
            .help("write an R from 0 to 360"));
        }
        let way = match whole(block, b'P', 2)? {
            Some(1) => OrientWay::Clockwise,
            Some(2) => OrientWay::Counterclockwise,
            _ => OrientWay::Shortest,
        };
        let within_s = block.get(b'Q');
        if let Some(within_s) = within_s {
            self.check_time_out(block, span, within_s)?;
        }
        Ok(Orientation { deg, way, within_s })
    }

    /// Q of M19: a time, at a machine that waits for the spindle.
    fn check_time_out(&self, block: &Block, span: SourceSpan, within_s: f64) -> Outcome<()> {
        if within_s <= 0.0 {
            let message = format!("the time of M19 is {within_s} s");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::InvalidValue,
                block.span(b'Q'),
                message,
            )
            .because("Q is how long the spindle may take to stand at its angle")
            .help("write seconds above zero, or leave Q out"));
        }
        if self.options.m_codes.contains(ORIENTED) {
            return Ok(());
        }
        Err(BlockDiagnostic::new(
            DiagnosticCode::NotConnected,
            span,
            "Q of M19 on a machine that does not wait for its spindle",
        )
        .because("nobody says when the spindle stands at its angle, so no time ends")
        .help("add a table [m_codes.M19] that says what tells it, or leave Q out"))
    }

    /// SPOS.
    fn stop_at_angle(&self, word: NamedValue) -> Outcome<Orientation> {
        if !self.options.orients {
            return Err(not_oriented(
                word.span,
                "SPOS of a spindle that is not turned to an angle",
            ));
        }
        self.require_connection(word.span, "spindle that stops in a known position")?;
        Ok(Orientation {
            deg: word.value.rem_euclid(TURN),
            ..Orientation::OWN
        })
    }

    /// Tells the spindle to stand at an angle.
    pub(crate) fn tell_orientation(&mut self, orientation: Orientation, out: &mut Vec<Item>) {
        let Orientation { deg, way, within_s } = orientation;
        if self.options.orients {
            self.push(out, ItemKind::Event(Event::SpindleAngle { deg, way }));
        }
        if let Some(value) = within_s {
            let word = CodeWord::Q;
            self.push(out, ItemKind::Event(Event::CodeWord { word, value }));
        }
        self.push(out, ItemKind::Event(Event::MCode(ORIENTED)));
    }
}

fn not_oriented(span: SourceSpan, message: &str) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(DiagnosticCode::NotConnected, span, message)
        .because("it would stand at another angle than the program says")
        .help(
            "set `orientation = true` in [spindle] if it can be turned to an angle; M19 alone stops it where \
             it stops by itself, and M5 anywhere",
        )
}
