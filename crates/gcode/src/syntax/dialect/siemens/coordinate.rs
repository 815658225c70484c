//! Coordinates with their own way of counting: `X=AC(5)`, `X=IC(5)`, `C=DC(5)`, `C=ACP(5)`, `C=ACN(5)`;
//! of X as a diameter or as a radius: `X=DAC(5)`, `X=DIC(5)`, `X=RAC(5)`, `X=RIC(5)`.

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::system_index::Index;
use crate::syntax::dialect::siemens::writer::Writer;
use crate::syntax::letters::AXIS_LETTERS;
use crate::syntax::named_word::Named;
use crate::syntax::word_check::missing;

/// Parts of a turn below this are rounding.
const NO_TURN: f64 = 1e-12;

/// The parameter that shows the program coordinate of X; those of the other axes follow.
const COORDINATES: u32 = 5420;

/// How a coordinate is gone to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// AC.
    Absolute,
    /// IC.
    Increment,
    /// DC: a place of a turn, the short way.
    Shortest,
    /// ACP: with rising angles.
    Upwards,
    /// ACN: with falling ones.
    Downwards,
}

impl Way {
    const fn is_of_a_turn(self) -> bool {
        matches!(self, Self::Shortest | Self::Upwards | Self::Downwards)
    }

    /// Where the axis goes from a place, degrees for the ways of a turn.
    fn place(self, value: f64, here: f64) -> f64 {
        // Less than rounding leads to where the axis is, and not once round.
        let turns = (here - value) / 360.0;
        let whole = match self {
            Self::Shortest => turns.round(),
            Self::Upwards => (turns - NO_TURN).ceil(),
            Self::Downwards => (turns + NO_TURN).floor(),
            Self::Absolute | Self::Increment => 0.0,
        };
        value + 360.0 * whole
    }
}

/// Which words of X are diameters.
#[derive(PartialEq, Eq)]
enum Diameters {
    /// DIAMON.
    All,
    /// DIAMOF.
    None,
    /// DIAM90.
    ByDistance,
}

/// How values of X are converted.
struct UnitOfX {
    of_value: f64,
    of_place: f64,
}

#[cold]
fn no_turn(letter: char, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("DC, ACP or ACN of {letter}, which does not turn");
    BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
        .because("they say which way round a rotary axis goes to its place")
        .help("write the value alone")
}

#[cold]
fn no_diameter(letter: char, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("a diameter or radius of {letter}");
    BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
        .because("DAC, DIC, RAC and RIC say whether X is a diameter or a radius")
        .help("write AC or IC")
}

#[cold]
pub(crate) fn unclear_increment(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "an increment behind a frame that turned, mirrored or scaled the coordinate";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("whether it counts from the old coordinate or from where the axis stands is not known: they are two places")
        .help("write the first coordinate behind the frame in G90, or set increment_after_frame = \"alone\" in [program]")
}

impl Writer<'_> {
    /// What the line says of diameters, or what is in force.
    fn diameters(&self) -> Diameters {
        let scope = self.names.scope;
        if self.has_name(b"DIAMON") {
            Diameters::All
        } else if self.has_name(b"DIAMOF") {
            Diameters::None
        } else if self.has_name(b"DIAM90") || scope.system_value(b"DIAM90", &[]) == Some(1.0) {
            Diameters::ByDistance
        } else if scope.named("_lathe_diameter_mode") == Some(1.0) {
            Diameters::All
        } else {
            Diameters::None
        }
    }

    /// What a value of X and the place of the tool, which is a radius, are multiplied by to count as
    /// the words of the line do.
    fn unit_of_x(&self, name: &[u8], way: Way, incremental: bool) -> UnitOfX {
        let (by_distance, counts_diameters) = match self.diameters() {
            // DIAM90: diameters where coordinates are absolute.
            Diameters::ByDistance => (true, !incremental),
            Diameters::All => (false, true),
            Diameters::None => (false, false),
        };
        let is_diameter = match name {
            b"DAC" | b"DIC" => true,
            b"RAC" | b"RIC" => false,
            _ if by_distance => way == Way::Absolute,
            _ => counts_diameters,
        };
        let of = |diameters: bool| if diameters { 1.0 } else { 2.0 };
        UnitOfX {
            of_value: of(is_diameter) / of(counts_diameters),
            of_place: 2.0 / of(counts_diameters),
        }
    }

    /// `I1=5`, `I1=AC(5)`, `I1=IC(5)`: a place on an arc; `length` is that of the name. A place of X is a
    /// diameter where coordinates are.
    pub(super) fn via(&mut self, start: usize, length: usize, axis: usize) -> Outcome<()> {
        let letter = Named::Via(axis).letter();
        self.input.at = start + length;
        self.input.eat(b'=');
        self.input.next_visible();
        let way = self.input.name_ahead();
        let increment = match way.as_slice() {
            b"AC" => false,
            b"IC" => true,
            _ => return self.value_of(start, length, &[b',', letter], 0.0),
        };
        let word = SourceSpan::new(self.input.at, self.input.at + way.len());
        self.input.at += way.len();
        let arguments = self.input.arguments()?;
        let [Some(value)] = arguments.as_slice() else {
            return Err(missing(word, "AC or IC", "( )", "one value in parentheses"));
        };
        let here = u32::try_from(axis).ok();
        let here = here.and_then(|axis| self.names.scope.numbered(COORDINATES + axis));
        let here = here.unwrap_or(0.0);
        let incremental = self.is_incremental();
        // A place is at a diameter, and an increment a length; the block has what counts in its own mode.
        let diameters = if axis == 0 && self.diameters() != Diameters::None {
            2.0
        } else {
            1.0
        };
        let value = match (increment, incremental) {
            (true, false) => (value + here) * diameters,
            (false, true) => value / diameters - here,
            _ => *value,
        };
        self.put(start, &[b',', letter, b'['], value);
        Ok(())
    }

    /// Whether words of the line are increments, unless they say otherwise.
    fn is_incremental(&self) -> bool {
        match (self.has_code(90), self.has_code(91)) {
            (true, _) => false,
            (_, true) => true,
            _ => self.names.scope.named("_incremental") == Some(1.0),
        }
    }

    /// The coordinate that increments of an axis count from, in the units in force.
    fn increments_from(&self, axis: usize, span: SourceSpan) -> Outcome<f64> {
        let named = Axis::ALL.get(axis).map(|axis| Index::Axis(*axis));
        let index: Vec<Index> = named.into_iter().collect();
        let from = self.names.scope.system_value(b"COUNTED", &index);
        from.ok_or_else(|| unclear_increment(span))
    }

    /// `X=expression`, `X=AC(expression)`, `X=IC(expression)`; `C=DC(…)`, `C=ACP(…)`, `C=ACN(…)`.
    ///
    /// What these say holds for that word alone, whatever G90 and G91 say for the others: the
    /// value is changed by where the axis stands, so that it means the same in the mode in force.
    pub(super) fn coordinate(&mut self, start: usize, letter: u8) -> Outcome<()> {
        self.input.at = start + 1;
        self.input.eat(b'=');
        self.input.next_visible();
        let name = self.input.name_ahead();
        let way = match name.as_slice() {
            b"AC" | b"DAC" | b"RAC" => Way::Absolute,
            b"IC" | b"DIC" | b"RIC" => Way::Increment,
            b"DC" => Way::Shortest,
            b"ACP" => Way::Upwards,
            b"ACN" => Way::Downwards,
            _ => return self.value_of(start, 1, &[letter], 0.0),
        };
        let word = SourceSpan::new(self.input.at, self.input.at + self.input.name_ahead().len());
        self.input.at += word.length;
        let centre = matches!(letter, b'I' | b'J' | b'K');
        let of_axis = if centre {
            b'X' + (letter - b'I')
        } else {
            letter
        };
        let axis = AXIS_LETTERS.iter().position(|axis| *axis == of_axis);
        let Some(axis) = axis else {
            let message = "AC( ), IC( ) or the like of what is no coordinate";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, word, message)
                    .because("they say from where a coordinate counts")
                    .help("write the value alone"),
            );
        };
        let arguments = self.input.arguments()?;
        let [Some(value)] = arguments.as_slice() else {
            return Err(missing(word, "AC or IC", "( )", "one value in parentheses"));
        };
        if way.is_of_a_turn() && !(3..6).contains(&axis) {
            return Err(no_turn(char::from(letter), word));
        }
        let scope = self.names.scope;
        let here = u32::try_from(axis)
            .ok()
            .and_then(|axis| scope.numbered(COORDINATES + axis));
        let incremental = self.is_incremental();
        let mut value = *value;
        let mut here = here.unwrap_or(0.0);
        let mut unit_of_place = 1.0;
        if axis == 0 && !centre {
            let unit = self.unit_of_x(&name, way, incremental);
            value *= unit.of_value;
            here *= unit.of_place;
            unit_of_place = unit.of_place;
        } else if axis == 0 && way == Way::Absolute && self.diameters() != Diameters::None {
            // The centre is at a diameter, as the end is; its distance from the start is a length.
            value *= 0.5;
        } else if matches!(name.as_slice(), [b'D' | b'R', _, b'C']) {
            return Err(no_diameter(char::from(letter), word));
        }
        let counts_from_here = centre || incremental;
        let needs_origin = !centre && (incremental != (way == Way::Increment));
        let from = if needs_origin {
            self.increments_from(axis, word)? * unit_of_place
        } else {
            here
        };
        let value = match way {
            Way::Increment if counts_from_here => value,
            Way::Increment => value + from,
            _ if counts_from_here => way.place(value, here) - from,
            _ => way.place(value, here),
        };
        self.put(start, &[letter, b'['], value);
        Ok(())
    }
}
