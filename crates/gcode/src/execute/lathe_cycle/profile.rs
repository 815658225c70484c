//! The profile: what the blocks of the subroutine describe.
//!
//! | words | meaning |
//! |---|---|
//! | G0 G1 | a straight element; the first one leads to the first point of the profile |
//! | G2 G3, I K or R | an arc |
//! | X Z, with G91 incremental; with G90 U W: incremental X and Z | where the element ends |
//! | A, C; `,R`, `,C` of FANUC | a fillet, a chamfer at its end, in front of the next element |
//!
//! Feedrate, speed of the spindle, coolant and path mode have no effect there, as in LinuxCNC.
//! Codes that would give the words another meaning are refused, as skipping them would make another
//! profile.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::compensation::element::{Element, Point};
use crate::execute::interpreter::Interpreter;
use crate::execute::lathe_cycle::edge_break::{EdgeBreak, cut};
use crate::execute::motion::arc_ends::{Ends, center_from_radius, check_radii, sweep};
use crate::syntax::block::{Block, CornerKind};
use crate::syntax::codes::Coded;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{Distance, Motion};
use crate::syntax::word_check::unused;

/// Most elements of a profile.
const MAX_ELEMENTS: usize = 1000;
/// Elements shorter than this are none, mm.
const SHORT_MM: f64 = 1e-6;

/// The profile read so far, Z and X, program coordinates in mm.
#[derive(Debug, Clone)]
pub(crate) struct LatheProfile {
    pub(super) elements: Vec<Element>,
    /// Where the last block ended, first the start of the cycle.
    pub(crate) at: Point,
    /// True once the first point is known.
    begun: bool,
    pub(crate) motion: Option<Motion>,
    /// What is to be made of the next corner.
    corner: Option<EdgeBreak>,
    /// The way to the first point is one at feed.
    pub(super) begins_at_feed: bool,
    /// How far it was shifted.
    pub(super) shift: Point,
}

impl LatheProfile {
    pub(crate) const fn new(start: Point) -> Self {
        Self {
            elements: Vec::new(),
            at: start,
            begun: false,
            motion: None,
            corner: None,
            begins_at_feed: false,
            shift: [0.0; 2],
        }
    }

    /// Shifts all of it.
    pub(crate) fn shift_by(&mut self, by: Point) {
        self.shift = [self.shift[0] + by[0], self.shift[1] + by[1]];
        let shift = |point: &mut Point| {
            point[0] += by[0];
            point[1] += by[1];
        };
        for element in &mut self.elements {
            shift(&mut element.start);
            shift(&mut element.end);
            if let Some((center, _)) = &mut element.arc {
                shift(center);
            }
        }
    }

    pub(crate) fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// True if a fillet or chamfer has no element behind it.
    pub(crate) const fn is_open(&self) -> bool {
        self.corner.is_some()
    }

    /// Takes a block of the subroutine.
    pub(crate) fn add(&mut self, block: &Block, interpreter: &Interpreter) -> Outcome<()> {
        check_codes(block, interpreter)?;
        if let Some(coded) = block.codes.motion {
            self.motion = match coded.code {
                Some(
                    motion @ (Motion::Rapid
                    | Motion::Linear
                    | Motion::ArcClockwise
                    | Motion::ArcCounterclockwise),
                ) => Some(motion),
                _ => {
                    let message = "a motion code that draws no profile";
                    return Err(refused(coded.span, message).help("write G0, G1, G2 or G3"));
                }
            };
        }
        let words = Letters::of(b"XZUWACIKRFS");
        if let Some((letter, span)) = block.unused(words) {
            return Err(unused(letter, span));
        }
        if let Some(word) = block.polar.iter().flatten().next() {
            return Err(refused(word.span, "a polar word in a profile").help("write X and Z"));
        }
        if !block.has_any(Letters::of(b"XZUWACIKR")) {
            return Ok(());
        }
        let end = self.end(block, interpreter)?;
        self.element(block, interpreter, end)?;
        self.at = end;
        self.corner = self.corner_of(block, interpreter)?.or(self.corner);
        Ok(())
    }

    /// Where the element of a block ends.
    fn end(&self, block: &Block, interpreter: &Interpreter) -> Outcome<Point> {
        let modal = &interpreter.state.modal;
        let scale = modal.units.mm();
        let incremental = modal.distance == Distance::Incremental;
        let radius = if modal.diameter { 0.5 } else { 1.0 };
        let mut end = self.at;
        let axes = [(b'Z', b'W', 1.0), (b'X', b'U', radius)];
        for (place, (absolute, relative, share)) in end.iter_mut().zip(axes) {
            let to = block.get(absolute).map(|to| to * scale * share);
            let by = block.get(relative).map(|by| by * scale * share);
            match (to, by) {
                (Some(to), None) if incremental => *place += to,
                (Some(to), None) => *place = to,
                (None, Some(by)) if !incremental => *place += by,
                (None, None) => {}
                _ => {
                    let [absolute, other] = [absolute, relative].map(char::from);
                    let message = format!("{other} beside {absolute}, or with G91");
                    return Err(refused(block.span(relative), &message)
                        .help(format!("write {absolute} alone")));
                }
            }
        }
        Ok(end)
    }

    fn element(&mut self, block: &Block, interpreter: &Interpreter, end: Point) -> Outcome<()> {
        let span = block.motion_span();
        let Some(motion) = self.motion else {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::NoMotionMode,
                span,
                "axis words without a motion mode",
            )
            .because("a profile does not know the mode from before it")
            .help("write G0 or G1 in front of the first ones"));
        };
        if !self.begun {
            self.begun = true;
            self.begins_at_feed = motion == Motion::Linear;
            let has_more = block.corner.is_some() || block.has_any(Letters::of(b"ACIKR"));
            if motion.is_arc() || has_more {
                let message = "a profile that does not begin with a point";
                return Err(refused(span, message)
                    .help("write G0 or G1 with X and Z, and nothing else, first"));
            }
            return Ok(());
        }
        let mut next = Element {
            start: self.at,
            end,
            arc: None,
        };
        if motion.is_arc() {
            let left = motion == Motion::ArcCounterclockwise;
            next.arc = Some(arc(block, interpreter, [self.at, end], left)?);
        } else if block.has_any(Letters::of(b"IKR")) {
            let letter = *b"IKR"
                .iter()
                .find(|l| block.get(**l).is_some())
                .unwrap_or(&b'I');
            return Err(unused(char::from(letter), block.span(letter)));
        } else if (end[0] - self.at[0]).hypot(end[1] - self.at[1]) < SHORT_MM {
            return Ok(());
        }
        self.push(next, span)
    }

    fn push(&mut self, mut next: Element, span: SourceSpan) -> Outcome<()> {
        if self.elements.len() >= MAX_ELEMENTS {
            let message = format!("a profile of more than {MAX_ELEMENTS} elements");
            return Err(refused(span, &message).help("leave out what cannot be seen"));
        }
        if let (Some(corner), Some(last)) = (self.corner.take(), self.elements.last_mut()) {
            let Some(between) = cut(last, &mut next, corner) else {
                let message = "the fillet or chamfer in front of it does not fit";
                return Err(
                    BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                        .because("it begins and ends on the elements on both sides of the corner")
                        .help("make it smaller, or the elements longer"),
                );
            };
            self.elements.extend(between);
        }
        self.elements.push(next);
        Ok(())
    }

    /// What is to be made of the corner at the end of a block.
    fn corner_of(&self, block: &Block, interpreter: &Interpreter) -> Outcome<Option<EdgeBreak>> {
        let scale = interpreter.state.modal.units.mm();
        if let Some(word) = block.corner {
            let size = word.value.abs() * scale;
            let is_arc = word.kind == CornerKind::Round;
            let corner = if is_arc {
                EdgeBreak::Fillet(size)
            } else {
                EdgeBreak::Leg(size)
            };
            return Ok(Some(corner).filter(|_| size > 0.0));
        }
        let (letter, size) = match (block.get(b'A'), block.get(b'C')) {
            (None, None) => return Ok(None),
            (Some(_), Some(_)) => {
                return Err(
                    refused(block.span(b'C'), "a fillet and a chamfer at one corner")
                        .help("remove A or C"),
                );
            }
            (Some(radius), None) => (b'A', radius * scale),
            (None, Some(size)) => (b'C', size * scale),
        };
        if size <= 0.0 {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::InvalidValue,
                block.span(letter),
                "the size of the corner is not above zero",
            )
            .help("write a size above zero, or leave the word out"));
        }
        Ok(Some(if letter == b'A' {
            EdgeBreak::Fillet(size)
        } else {
            EdgeBreak::Chamfer(size)
        }))
    }
}

/// Centre and sweep of an arc.
fn arc(
    block: &Block,
    interpreter: &Interpreter,
    [start, end]: [Point; 2],
    left: bool,
) -> Outcome<(Point, f64)> {
    let modal = &interpreter.state.modal;
    let scale = modal.units.mm();
    let ends = Ends { start, end };
    let words = [block.get(b'K'), block.get(b'I')];
    let center = match block.get(b'R') {
        Some(_) if words != [None, None] => {
            let message = "an arc with both a radius and a centre";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::ArcOverdetermined,
                block.span(b'R'),
                message,
            )
            .because("one of them determines the arc; the other could contradict it")
            .help("remove R, or I and K"));
        }
        Some(radius) => center_from_radius(block, ends, radius * scale, left)?,
        None if words == [None, None] => {
            let message = "an arc without centre or radius";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::ArcWithoutCenter,
                block.motion_span(),
                message,
            )
            .because("the end point alone leaves every radius possible")
            .help("add K and I, or R"));
        }
        None => {
            let [z, x] = words.map(|word| word.unwrap_or(0.0) * scale);
            match modal.arc_distance {
                Distance::Incremental => [start[0] + z, start[1] + x],
                Distance::Absolute => [z, x],
            }
        }
    };
    check_radii(block, ends, center)?;
    Ok((center, sweep(ends, center, left, 1.0)))
}

fn refused(span: SourceSpan, message: &str) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
        .because("a profile is drawn by G0, G1, G2 and G3 alone")
}

/// Where a code stands that is another than the one in force.
fn other_than<T: PartialEq>(coded: Option<Coded<T>>, now: T) -> Option<SourceSpan> {
    coded.filter(|coded| coded.code != now).map(|c| c.span)
}

/// Refuses codes that would give words another meaning, or end the program.
fn check_codes(block: &Block, interpreter: &Interpreter) -> Outcome<()> {
    let (codes, modal) = (&block.codes, &interpreter.state.modal);
    let changed = [
        other_than(codes.plane, modal.plane),
        other_than(codes.units, modal.units),
        other_than(codes.distance, modal.distance),
        other_than(codes.arc_distance, modal.arc_distance),
        other_than(codes.diameter, modal.diameter),
        codes.non_modal.map(|c| c.span),
        codes.cutter_radius.map(|c| c.span),
        codes.tool_length.map(|c| c.span),
        codes.system.map(|c| c.span),
        codes.tool_change.map(|c| c.span),
        codes.stop.map(|c| c.span),
        codes.orient.map(|c| c.span),
        codes.input_output.map(|c| c.span),
        codes.saved_state.map(|c| c.span),
    ];
    match changed.into_iter().flatten().min_by_key(|span| span.start) {
        None => Ok(()),
        Some(span) => Err(refused(span, "a code that a profile cannot have")
            .help("write it before the cycle, or behind it")),
    }
}
