//! CYCLE800: a plane that is swivelled.
//!
//! `CYCLE800(FR, TC, ST, MODE, X0, Y0, Z0, A, B, C, X1, Y1, Z1, DIR, FR_I, DMODE)`: the zero goes to X0,
//! Y0, Z0, the axes turn by A, B and C one after the other, about those that MODE names, and in the new
//! axes the zero goes on by X1, Y1, Z1. Then the rotary axes turn until the tool stands along the
//! normal: DIR says by which of the two ways. With FR 1 the tool goes up along the machine's Z before
//! that, with FR 2 along X and Y behind it, with ones of ST that are 1 the plane counts in the one in force. Its tens to ten thousands are 0.

use std::io::BufRead;

use glidepath_geometry::AxisVector;
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::check_end;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::Pace;
use crate::execute::motion::tilted_plane::Branch;
use crate::execute::program::Program;
use crate::execute::state::frame::Frame;
use crate::syntax::block::Block;

/// Arguments there are.
const COUNT: usize = 16;
/// The argument that is a name.
const TC: usize = 1;
/// X of the zero before and behind the turns.
const X_BEFORE: usize = 4;
const X_BEHIND: usize = 10;
/// X, Y and Z: the rotary axes are where the plane has turned them.
const LINEAR: usize = 3;
/// Angles below this are none, degrees.
const NO_ANGLE: f64 = 1e-12;

#[cold]
fn shifted_diameter(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "CYCLE800 with X0 or X1 where X counts diameters";
    BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
        .because("whether X is a diameter among the arguments, too, depends on the control")
        .help("write DIAMOF before it, and radii")
}

impl<R: BufRead> Program<R> {
    /// A line with CYCLE800.
    pub(super) fn siemens_swivel(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let (numbers, is_off, span) = {
            let scope = self.scope();
            let mut input = self.evaluator(&scope, text, at);
            input.at += input.name_ahead().len();
            let (numbers, texts) = input.arguments_and_texts()?;
            check_end(&mut input)?;
            let name = texts.get(TC).cloned().flatten();
            // "0" takes the data set off.
            let is_off = numbers.iter().all(Option::is_none) && name.is_none()
                || name.as_deref() == Some(b"0");
            (numbers, is_off, SourceSpan::new(at, input.at))
        };
        check_frame(&self.interpreter, is_off, span)?;
        self.settle_corner_before_plane(span)?;
        if is_off {
            check_no_way_out(&numbers, span)?;
            let before = self.interpreter.place_names();
            self.interpreter.end_tilt();
            self.interpreter.rename_by_frame(&before, LINEAR);
            self.end_of_line();
            return Ok(());
        }
        let value = |index: usize| numbers.get(index).copied().flatten().unwrap_or(0.0);
        let shifts_x = [X_BEFORE, X_BEHIND]
            .iter()
            .any(|index| value(*index) != 0.0);
        if shifts_x && self.interpreter.counts_diameters() {
            return Err(shifted_diameter(span));
        }
        let own = frame(&value, self.interpreter.state.modal.units.mm(), span)?;
        let branch = branch(&value, span)?;
        check_rest(&numbers, &value, span)?;
        let number = self.line_of_program();
        let interpreter = &mut self.interpreter;
        let turns = (7..10).any(|index| value(index).abs() > NO_ANGLE);
        // Without angles nothing turns: the zero is another one.
        let is_shift = interpreter.options.five_axis.is_none() && !turns;
        let adds = (value(2) % 10.0 - 1.0).abs() < 1e-9;
        let frame = if adds {
            interpreter.state.offsets.tilted.with(&own)
        } else {
            own
        };
        interpreter.begin(number);
        interpreter.mapped_items = self.items.len();
        let names = interpreter.place_names();
        let from = interpreter.state.position;
        // A plane comes in the place of the one before.
        interpreter.end_tilt();
        let block = Block::of(self.block.dialect, &interpreter.options.m_codes);
        let items = &mut self.items;
        interpreter
            .lift_before_swivel(&block, (value(0), span), items)
            .and_then(|()| {
                if is_shift {
                    interpreter.state.offsets.tilted = frame;
                    interpreter.state.offsets.frame = frame;
                    return Ok(());
                }
                interpreter.begin_tilt(frame, span)?;
                interpreter.align_tool(&block, (branch, span), items)
            })
            .map_err(|mut fault| {
                fault.span = span;
                fault
            })?;
        // What went up has a coordinate of its own.
        interpreter.forget_untraversed(&block, &from);
        interpreter.rename_by_frame(&names, LINEAR);
        self.end_of_line();
        Ok(())
    }

    /// The move to a corner in front of the plane is made in the coordinates from before it.
    fn settle_corner_before_plane(&mut self, span: SourceSpan) -> Outcome<()> {
        let interpreter = &mut self.interpreter;
        if interpreter.state.open.corner.is_none() {
            return Ok(());
        }
        let block = Block::of(self.block.dialect, &interpreter.options.m_codes);
        interpreter.mapped_items = self.items.len();
        interpreter.settle_corner_before(&block, span, &mut self.items)?;
        interpreter.map_moves(&block, &mut self.items)
    }
}

impl Interpreter {
    /// FR: the way out before the rotary axes turn.
    fn lift_before_swivel(
        &mut self,
        block: &Block,
        (way, span): (f64, SourceSpan),
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if way == 0.0 {
            return Ok(());
        }
        let siemens = &self.options.siemens;
        let is = |known: f64| (way - known).abs() < 1e-9;
        // Where the tip is followed, places are not those of the axes.
        let has_axes = self.options.five_axis.is_none() || !self.state.tip.follows();
        let beside = match siemens.swivel_xy_mm {
            [Some(x), Some(y)] if is(2.0) && has_axes => Some([x, y]),
            _ => None,
        };
        let up = siemens.swivel_z_mm;
        let Some(up) = up.filter(|_| is(1.0) || is(2.0) && beside.is_some()) else {
            let message = format!("CYCLE800 with the retraction FR {way} is not supported");
            return Err(BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                .because("where the tool goes before it swivels is machine data; with FR 1 it is a place of Z, with FR 2 of X and Y, too")
                .help("set `swivel_z` of [program] for FR 1, for FR 2 also `swivel_x` and `swivel_y` (without TRAORI), or write the way out as a block before it (SUPA Z) and FR 0"));
        };
        let mut target = self.state.position;
        // Never down.
        target[2] = up.max(target[2]);
        self.straight(block, target, Pace::Rapid, out)?;
        if let Some([x, y]) = beside {
            (target[0], target[1]) = (x, y);
            self.straight(block, target, Pace::Rapid, out)?;
        }
        self.map_moves(block, out)
    }
}

/// Refuses a way out where the plane ends.
fn check_no_way_out(numbers: &[Option<f64>], span: SourceSpan) -> Outcome<()> {
    let way = numbers.first().copied().flatten().unwrap_or(0.0);
    if way == 0.0 {
        return Ok(());
    }
    let message = format!("CYCLE800 that ends the plane with the retraction FR {way}");
    Err(
        BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
            .because("whether the tool goes out of the way where nothing swivels is not known here")
            .help("write the way out as a block before it (SUPA Z), and FR 0 or CYCLE800()"),
    )
}

/// Refuses to put a plane in front of a frame of the program, or to take it from under one.
fn check_frame(interpreter: &Interpreter, is_off: bool, span: SourceSpan) -> Outcome<()> {
    let offsets = &interpreter.state.offsets;
    let has_frame = offsets.frame != offsets.tilted;
    if !has_frame || is_off && !offsets.tilted.is_in_force() {
        return Ok(());
    }
    let message = "CYCLE800 within a frame";
    Err(
        BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
            .because("TRANS, ROT and the like count in the plane, and would count in another one")
            .help("write TRANS alone before it, which ends them"),
    )
}

/// The zero before the turn, the turn, and the zero behind it; `mm` is the unit of lengths.
fn frame(value: &impl Fn(usize) -> f64, mm: f64, span: SourceSpan) -> Outcome<Frame> {
    let mode = value(3);
    let order: Option<[usize; 3]> = [
        (57.0, [0, 1, 2]),
        (54.0, [1, 0, 2]),
        (45.0, [0, 2, 1]),
        (30.0, [1, 2, 0]),
        (39.0, [2, 0, 1]),
        (27.0, [2, 1, 0]),
    ]
    .into_iter()
    .find(|(known, _): &(f64, _)| (known - mode).abs() < 1e-9)
    .map(|(_, order)| order);
    let Some(order) = order else {
        let message = format!("CYCLE800 with MODE {mode} is not supported");
        return Err(BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
            .because("the angles are about the axes one after the other; solid angles, projections and positions of the rotary axes are not made")
            .help("write MODE 57 (X, Y, Z), 54, 45, 30, 39 or 27"));
    };
    let place = |first: usize| {
        let mut place = AxisVector::zeros();
        for axis in 0..3 {
            place[axis] = value(first + axis) * mm;
        }
        Frame::shifted(place)
    };
    let mut turned = Frame::default();
    for (index, axis) in order.into_iter().enumerate() {
        let mut degrees = [0.0; 3];
        degrees[axis] = value(7 + index);
        turned = turned.with(&Frame::turned(degrees));
    }
    Ok(place(4).with(&turned).with(&place(10)))
}

/// DIR: which of the two ways.
fn branch(value: &impl Fn(usize) -> f64, span: SourceSpan) -> Outcome<Branch> {
    let direction = value(13);
    if (direction + 1.0).abs() < 1e-9 {
        Ok(Branch::LowTilt)
    } else if (direction - 1.0).abs() < 1e-9 {
        Ok(Branch::HighTilt)
    } else {
        let message = "CYCLE800 with a DIR other than -1 and 1 is not supported";
        Err(BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
            .because("with 0 the rotary axes would stay, and the tool would not stand along the plane's normal")
            .help("write -1 (the smaller angle of the tilting axis) or 1"))
    }
}

/// Refuses what the other arguments would do.
fn check_rest(
    numbers: &[Option<f64>],
    value: &impl Fn(usize) -> f64,
    span: SourceSpan,
) -> Outcome<()> {
    let refuse = |message: &str, reason: &str, help: &str| {
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                .because(reason)
                .help(help),
        )
    };
    let ones = value(2) % 10.0;
    if ![0.0, 1.0].contains(&ones) {
        return refuse(
            "CYCLE800 with other ones of ST than 0 and 1 is not supported",
            "0 is a new plane, 1 one that counts in the plane in force",
            "write the plane as a whole, with ST 0",
        );
    }
    // The hundred thousands say how the dialog shows DIR.
    let others = (value(2).abs() / 10.0).trunc() % 10_000.0;
    if others > 0.0 {
        return refuse(
            "CYCLE800 with tens to ten thousands of ST is not supported",
            "they have the tip stay where it is while the rotary axes turn, or align the tool",
            "write 0 there, and TRAORI where the tip is to stay",
        );
    }
    if numbers.len() > COUNT {
        return refuse(
            "CYCLE800 with more arguments than it has",
            "what the others mean depends on the version of the control",
            "leave them out",
        );
    }
    Ok(())
}
