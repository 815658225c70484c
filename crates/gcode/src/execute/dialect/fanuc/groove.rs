//! G74 and G75 of a lathe: along Z or X by depths, with a short way back after each, in one place or
//! in several side by side.
//!
//! ```text
//!  start ●──┄┄┄┄─●┄┄┄┄┄─●      G75 R back                    of its own, and once
//!        │ P     │      │      G75 X Z P Q R F               P a depth, Q from place to place,
//!        ▼       ▼      ▼                                    R aside at the bottom, before the way out
//!          Q        Q    end   G75 X Z I K F                 Haas: I for P, K for Q
//! ```
//!
//! G74 is the same with X and Z exchanged: Q and K are the depth along Z, P and I the way along X. P
//! and Q without a point count least increments; P and I are radii. The last place is the end of the
//! block, however near to the one before. The tool goes back to where it was.

use glidepath_geometry::AxisVector;
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Pace;
use crate::syntax::block::Block;
use crate::syntax::modes::Units;
use crate::syntax::word_check::{missing, negative};

/// Most steps along an axis.
const MOST: f64 = 10_000.0;
/// Most depths of a block, in all its places.
const MOST_DEPTHS: usize = 20_000;

/// A way that is made in steps.
#[derive(Debug, Clone, Copy)]
struct Stepped {
    axis: usize,
    from: f64,
    to: f64,
    /// How far at a time; all at once where it is as long as the way.
    step_mm: f64,
}

impl Stepped {
    /// How far the first step goes.
    fn first_step_mm(self) -> f64 {
        self.step_mm.min((self.to - self.from).abs())
    }

    /// The places on the way, the end the last of them.
    fn places(self) -> Vec<f64> {
        let (length, way) = ((self.to - self.from).abs(), (self.to - self.from).signum());
        let mut places = Vec::new();
        let mut gone = self.step_mm;
        while gone < length - MIN_MOVE {
            places.push(self.from + way * gone);
            gone += self.step_mm;
        }
        places.push(self.to);
        places
    }
}

impl Interpreter {
    /// G74, or G75 across.
    pub(crate) fn groove(
        &mut self,
        block: &Block,
        across: bool,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let mm = self.state.modal.units.mm();
        let back = block.get(b'R').map(|back| back * mm);
        if back.is_some_and(|back| back < 0.0) {
            return Err(negative(
                block,
                b'R',
                "the way back, or aside at the bottom",
            ));
        }
        if !block.has_axes() {
            self.state.fanuc.retract_mm = back.unwrap_or(self.state.fanuc.retract_mm);
            return Ok(());
        }
        let start = self.state.offsets.to_program(self.state.position);
        let values = self.ends_of_cycle(block)?;
        let (axis, other) = if across { (0, 2) } else { (2, 0) };
        let word = if across { "X" } else { "Z" };
        let span = block.motion_span();
        let end = values[axis].ok_or_else(|| missing(span, "the cycle", word, "the bottom"))?;
        let deep = self.stepped(block, axis, start[axis], end)?;
        let side = self.stepped(
            block,
            other,
            start[other],
            values[other].unwrap_or(start[other]),
        )?;
        let is_single = (side.to - side.from).abs() <= MIN_MOVE;
        let places = if is_single { vec![] } else { side.places() };
        if (places.len() + 1).saturating_mul(deep.places().len()) > MOST_DEPTHS {
            return Err(too_many(block));
        }
        let aside_mm = back.unwrap_or(0.0);
        // The second place is the nearest to where the tool has cut before.
        let free_mm = if is_single { 0.0 } else { side.first_step_mm() };
        if aside_mm > free_mm + MIN_MOVE {
            return Err(too_far_aside(block, aside_mm, free_mm));
        }
        self.plunge(block, start, deep, None, out)?;
        let aside = aside_mm * (side.from - side.to).signum();
        for place in places {
            let mut at = start;
            at[other] = place;
            self.groove_move(block, at, Pace::Rapid, out)?;
            let aside = Some(aside).filter(|aside| *aside != 0.0);
            self.plunge(block, at, deep, aside.map(|aside| (other, aside)), out)?;
        }
        self.groove_move(block, start, Pace::Rapid, out)
    }

    /// A way along an axis with its steps: P or I along X, Q or K along Z.
    fn stepped(&self, block: &Block, axis: usize, from: f64, to: f64) -> Outcome<Stepped> {
        let (letter, haas) = if axis == 0 {
            (b'P', b'I')
        } else {
            (b'Q', b'K')
        };
        let mm = self.state.modal.units.mm();
        let unit = match (block.has_no_point(letter), self.state.modal.units) {
            (false, _) => 1.0,
            (true, Units::Millimetre) => 1e-3,
            (true, Units::Inch) => 1e-4,
        };
        let (letter, written) = match (block.get(letter), block.get(haas)) {
            (Some(step), None) => (letter, Some(step * unit * mm)),
            (None, Some(step)) => (haas, Some(step * mm)),
            (None, None) => (letter, None),
            (Some(_), Some(_)) => return Err(both(block, letter, haas)),
        };
        let length = (to - from).abs();
        // Posts write Q0 for a single groove.
        let written = written.filter(|step| *step != 0.0 || length > MIN_MOVE);
        let step_mm = written.unwrap_or(length.max(MIN_MOVE));
        if step_mm <= 0.0 || length / step_mm > MOST {
            let name = char::from(letter);
            let message = format!("{name} of {step_mm} mm");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::InvalidValue,
                block.span(letter),
                message,
            )
            .because(format!("{name} is how far the cycle goes at a time"))
            .help("write a larger one: P and Q without a point count thousandths"));
        }
        Ok(Stepped {
            axis,
            from,
            to,
            step_mm,
        })
    }

    fn groove_move(
        &mut self,
        block: &Block,
        place: AxisVector,
        pace: Pace,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let target = self.state.offsets.to_machine(place);
        self.straight(block, target, pace, out)
    }

    /// One place: down by depths, aside at the bottom, and out.
    fn plunge(
        &mut self,
        block: &Block,
        from: AxisVector,
        deep: Stepped,
        aside: Option<(usize, f64)>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let way = (deep.to - deep.from).signum();
        let mut at = from;
        for level in deep.places() {
            at[deep.axis] = level;
            self.groove_move(block, at, Pace::Feed, out)?;
            if (level - deep.to).abs() > MIN_MOVE {
                let gone = (level - deep.from).abs() - self.state.fanuc.retract_mm;
                at[deep.axis] = deep.from + way * gone.max(0.0);
                self.groove_move(block, at, Pace::Rapid, out)?;
            }
        }
        if let Some((axis, by)) = aside {
            at[axis] += by;
            self.groove_move(block, at, Pace::Rapid, out)?;
        }
        at[deep.axis] = deep.from;
        self.groove_move(block, at, Pace::Rapid, out)
    }
}

#[cold]
fn too_far_aside(block: &Block, aside_mm: f64, free_mm: f64) -> Box<BlockDiagnostic> {
    let message = format!("R of {aside_mm} mm, where {free_mm:.3} mm beside the bottom are free");
    let fault = BlockDiagnostic::new(DiagnosticCode::InvalidValue, block.span(b'R'), message)
        .because("at the bottom the tool goes aside by R, to where it has cut before");
    if free_mm > 0.0 {
        return fault.help("write a smaller R in the block with X and Z");
    }
    fault.help("remove it: a single groove or hole has no room aside; how far back between depths is said by R in a block before")
}

#[cold]
fn too_many(block: &Block) -> Box<BlockDiagnostic> {
    let message = "too many depths in one block";
    BlockDiagnostic::new(DiagnosticCode::InvalidValue, block.motion_span(), message)
        .because(format!("a cycle has {MOST_DEPTHS} of them at most"))
        .help("write larger steps: P and Q without a point count thousandths")
}

#[cold]
fn both(block: &Block, letter: u8, haas: u8) -> Box<BlockDiagnostic> {
    let [letter, other] = [letter, haas].map(char::from);
    let message = format!("{other} beside {letter}");
    BlockDiagnostic::new(DiagnosticCode::UnusedWord, block.span(haas), message)
        .because("both say how far the cycle goes at a time: one is FANUC's, the other Haas'")
        .help("write one of them")
}
