//! CYCLE95: stock is removed along Z down to a contour, outside or inside, then the contour is finished.
//!
//! ```text
//!      ● start                              passes along Z, of the same depth (MID at most), each back by
//!      │◄────────────────┐                  _VRT; the last one goes along the contour, which has FALZ and
//!   _VRT   ┌────────┐◄───┤ last point       FALX added, and FAL along all of it
//!          │ stock  │    │                  VARI 1, 3 rough outside, inside · 5, 7 finish · 9, 11 both
//! first point ──────┴────┘
//! ```
//!
//! The contour rises all along, seen from its first point: what it has of relief cuts is refused. It may be
//! programmed from either end; finishing alone goes as it is programmed, all else away from the low end.
//! A tool with a radius finishes with G41 or G42.

use std::io::BufRead;

use glidepath_geometry::{Axis, Plane};

use crate::diagnostic::block_diagnostic::Outcome;
use crate::diagnostic::span::SourceSpan;
use crate::execute::compensation::element::{Element, Point};
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::face_milling::parts;
use crate::execute::dialect::siemens::flow::check_end;
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::dialect::siemens::steps::CycleCall;
use crate::execute::interpreter::Interpreter;
use crate::execute::lathe_cycle::contour_passes::{ContourRoughing, rough_contour};
use crate::execute::lathe_cycle::passes::PassMove;
use crate::execute::program::Program;
use crate::syntax::word_check::missing;

/// How far the tool lifts off where _VRT does not say so, mm.
const LIFT_MM: f64 = 1.0;
/// Arguments of the cycle.
const MOST: usize = 12;
/// Most passes.
const MOST_PASSES: f64 = 1000.0;
/// Directions that lean back by no more are level.
const LEVEL: f64 = 1e-6;
/// Moves shorter than this are none, mm.
const NO_MOVE: f64 = 1e-9;

/// What the arguments say, mm.
struct Removal {
    /// 1 outside, -1 inside.
    out: f64,
    /// What is left along Z and X, and along the contour.
    left: Point,
    along: f64,
    /// How deep a pass is at most; `None` where nothing is roughed.
    step: Option<f64>,
    finishes: bool,
    lift: f64,
    /// For roughing and finishing; 0: the one in force.
    feeds: [f64; 2],
    /// Where the tool stands along Z.
    stands_z: f64,
    /// The tool has a radius, which finishing compensates.
    has_radius: bool,
    /// Of the units in force.
    mm: f64,
}

impl<R: BufRead> Program<R> {
    /// The cycle in a line of its own.
    pub(super) fn siemens_stock_removal(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let (call, span, contour) = {
            let scope = self.scope();
            let mut input = self.evaluator(&scope, text, at);
            input.at += input.name_ahead().len();
            let start = input.at;
            let (arguments, texts) = input.arguments_and_texts()?;
            let span = SourceSpan::new(at, input.at);
            check_end(&mut input)?;
            let name = texts.into_iter().next().flatten();
            let name = name.ok_or_else(|| {
                let meaning = "the contour: the name of its subprogram, or two labels, in quotes";
                missing(span, "CYCLE95", "NPP", meaning)
            })?;
            let call = CycleCall {
                name: "CYCLE95",
                arguments,
            };
            let place = SourceSpan::new(start + 1, start + 3 + name.len());
            (call, span, (name, place))
        };
        let arguments = Arguments { call: &call, span };
        self.check_cycle(arguments)?;
        let removal = self.interpreter.removal(arguments)?;
        let profile = self.siemens_contour(&contour.0, contour.1)?;
        let lines = removal.lines(arguments, profile.elements())?;
        self.siemens_give(lines)
    }
}

impl Interpreter {
    fn removal(&self, arguments: Arguments<'_>) -> Outcome<Removal> {
        let modal = &self.state.modal;
        if modal.plane != Plane::Zx || self.state.diameter_by_distance {
            return Err(arguments
                .refused(
                    "a plane other than G18, or DIAM90",
                    "the contour is one of a lathe, in Z and X",
                )
                .help("write G18, and DIAMON or DIAMOF before it"));
        }
        if arguments
            .call
            .arguments
            .iter()
            .skip(MOST)
            .flatten()
            .any(|more| *more != 0.0)
        {
            return Err(arguments
                .refused(
                    format!("more than {MOST} arguments"),
                    "what the others mean depends on the version of the control",
                )
                .help("leave them out"));
        }
        let mm = modal.units.mm();
        let variant = arguments.choice(8, "VARI", &[1, 3, 5, 7, 9, 11])?;
        for (index, name) in [(9, "DT"), (10, "DAM")] {
            if arguments.or_zero(index) != 0.0 {
                return Err(arguments
                    .refused(
                        format!("{name} interrupts the passes"),
                        "a pass goes from its beginning to its end here",
                    )
                    .help("leave DT and DAM out"));
            }
        }
        let roughs = !matches!(variant, 5 | 7);
        let step = if roughs {
            Some(arguments.positive(1, "MID", "how deep a pass is at most")? * mm)
        } else {
            None
        };
        let left = |index, name| {
            let value = arguments.not_negative(index, name, "what roughing leaves");
            value.map(|value| value * mm)
        };
        let lift = arguments.not_negative(11, "_VRT", "how far the tool lifts off")? * mm;
        self.check_edge(arguments)?;
        let tool = self.edge_in_force();
        Ok(Removal {
            out: if matches!(variant, 3 | 7 | 11) {
                -1.0
            } else {
                1.0
            },
            left: [left(2, "FALZ")?, left(3, "FALX")?],
            along: left(4, "FAL")?,
            step,
            finishes: variant >= 5,
            lift: if lift > 0.0 { lift } else { LIFT_MM },
            feeds: [
                arguments.not_negative(5, "FF1", "the feed of roughing")?,
                arguments.not_negative(7, "FF3", "the feed of finishing")?,
            ],
            stands_z: self.state.offsets.to_program(self.state.position)[Axis::Z.index()],
            has_radius: tool.is_some_and(|tool| tool.diameter_mm > 0.0),
            mm,
        })
    }
}

/// The same contour from its other end.
fn reversed(contour: &[Element]) -> Vec<Element> {
    let back = |element: &Element| Element {
        start: element.end,
        end: element.start,
        arc: element.arc.map(|(center, sweep)| (center, -sweep)),
    };
    contour.iter().rev().map(back).collect()
}

/// First and last point.
fn ends(contour: &[Element]) -> [Point; 2] {
    let first = contour.first().map(|element| element.start);
    let last = contour.last().map(|element| element.end);
    [first, last].map(Option::unwrap_or_default)
}

/// Which way along Z a contour leads.
fn way(contour: &[Element]) -> f64 {
    let [first, last] = ends(contour);
    if last[0] >= first[0] { 1.0 } else { -1.0 }
}

impl Removal {
    fn lines(&self, arguments: Arguments<'_>, drawn: &[Element]) -> Outcome<Lines> {
        let [first, last] = ends(drawn);
        let rises = self.out * (last[1] - first[1]) >= 0.0;
        let rising = if rises {
            drawn.to_vec()
        } else {
            reversed(drawn)
        };
        self.check_contour(arguments, &rising)?;
        let mut lines = Lines::new([Axis::Z, Axis::X, Axis::Y]);
        if let Some(step) = self.step {
            self.rough(&mut lines, arguments, &rising, step)?;
        }
        if self.finishes {
            let is_back = self.step.is_none() && !rises;
            let contour = if is_back { drawn } else { &rising };
            self.finish(&mut lines, contour, is_back);
        }
        Ok(lines)
    }

    /// The X at which the tool is free of the stock: off the last point of a rising contour.
    fn free(&self, rising: &[Element]) -> f64 {
        ends(rising)[1][1] + self.out * (self.left[1] + self.along + self.lift)
    }

    /// Refuses relief cuts, and a way through the axis of the spindle.
    fn check_contour(&self, arguments: Arguments<'_>, rising: &[Element]) -> Outcome<()> {
        let way = way(rising);
        let leans_back = |[z, x]: Point| z * way < -LEVEL || x * self.out < -LEVEL;
        let is_relief = |element: &&Element| {
            let turns = element
                .arc
                .is_some_and(|(_, sweep)| sweep.abs() > core::f64::consts::PI);
            turns || leans_back(element.start_tangent()) || leans_back(element.end_tangent())
        };
        if let Some(element) = rising.iter().find(is_relief) {
            let [z, x] = element.start.map(|mm| mm / self.mm);
            let message = format!("a relief cut of the contour at Z{z:.4} X{x:.4} (X: radius)");
            return Err(arguments
                .refused(
                    message,
                    "whether the tool is slender enough to go in there is not known",
                )
                .help("draw a contour that rises all along, from its low end to its high one"));
        }
        let [first, last] = ends(rising);
        if (first[0] - last[0]).abs() < NO_MOVE {
            return Err(arguments
                .refused("a contour without a length along Z", "passes go along Z")
                .help("check the contour"));
        }
        // It would come to the beginning of the passes at rapid through the part: outside and inside are taken for each other, mostly.
        if (self.stands_z - last[0]) * way > -LEVEL {
            let [stands, begin] = [self.stands_z, first[0]].map(|mm| mm / self.mm);
            return Err(arguments
                .refused(
                    format!("the passes begin at Z{begin:.4}, and the tool stands at Z{stands:.4}, beyond the other end of the contour"),
                    "VARI 1, 5 and 9 are for an outside, from its thin end on, and 3, 7 and 11 for an inside, from its wide end on",
                )
                .help("write the VARI that fits the contour, or move the tool to the end where the passes begin first"));
        }
        if self.out < 0.0 && self.free(rising) < 0.0 {
            return Err(arguments
                .refused(
                    "the tool would go through the axis of the spindle",
                    "there is no room off the narrowest place of the contour",
                )
                .help("check the contour, FALX, FAL and _VRT"));
        }
        Ok(())
    }

    fn rough(
        &self,
        lines: &mut Lines,
        arguments: Arguments<'_>,
        rising: &[Element],
        step: f64,
    ) -> Outcome<()> {
        let way = way(rising);
        let shift = [-way * self.left[0], self.out * self.left[1]];
        let by = |point: Point| [point[0] + shift[0], point[1] + shift[1]];
        let shifted = rising.iter().map(|element| Element {
            start: by(element.start),
            end: by(element.end),
            arc: element.arc.map(|(center, sweep)| (by(center), sweep)),
        });
        // The passes begin in front of the contour.
        let begin = by(ends(rising)[0]);
        let lead = [begin[0] - way * self.lift, begin[1]];
        let front = Element {
            start: lead,
            end: begin,
            arc: None,
        };
        let contour: Vec<Element> = core::iter::once(front).chain(shifted).collect();
        let free = self.free(rising);
        let top = free - self.out * self.lift;
        let depth = (top - begin[1]).abs() - self.along;
        let count = parts(depth, step);
        if count > MOST_PASSES {
            return Err(arguments
                .refused(
                    format!("{count} passes"),
                    "the length of a cycle is bounded",
                )
                .help("write a greater MID"));
        }
        let words = ContourRoughing {
            increment_mm: if depth > NO_MOVE { depth / count } else { step },
            retract_mm: self.lift,
            distance_mm: self.along,
        };
        let start = [lead[0], top];
        let moves = rough_contour(&contour, start, words).ok_or_else(|| {
            arguments
                .refused(
                    "nothing is left of the contour beside FAL",
                    "its arcs or its corners are smaller",
                )
                .help("write a smaller FAL")
        })?;
        lines.feed(self.feeds[0]);
        self.go(lines, "G0", [lead[0], free]);
        self.go(lines, "G0", start);
        let mut at = start;
        for pass_move in moves {
            let (PassMove::Rapid(end) | PassMove::Feed(end) | PassMove::Arc(end, ..)) = pass_move;
            if (end[0] - at[0]).hypot(end[1] - at[1]) > NO_MOVE {
                match pass_move {
                    PassMove::Rapid(_) => self.go(lines, "G0", end),
                    PassMove::Feed(_) => self.go(lines, "G1", end),
                    PassMove::Arc(_, center, left) => self.arc(lines, [at, end], center, left),
                }
            }
            at = end;
        }
        self.go(lines, "G0", [at[0], free]);
        self.go(lines, "G0", [lead[0], free]);
        Ok(())
    }

    /// Along the contour; `falls` where its first point is the high one.
    fn finish(&self, lines: &mut Lines, contour: &[Element], falls: bool) {
        let way = way(contour);
        let [first, last] = ends(contour);
        let highest = if falls { first[1] } else { last[1] };
        let free = highest + self.out * (self.left[1] + self.along + self.lift);
        let (before, behind) = if falls {
            ([first[0], free], [last[0] + way * self.lift, last[1]])
        } else {
            ([first[0] - way * self.lift, first[1]], [last[0], free])
        };
        let side = match (self.has_radius, self.out * way < 0.0) {
            (false, _) => "",
            // Outside of a contour that leads towards the chuck the tool is on its right.
            (true, true) => " G42",
            (true, false) => " G41",
        };
        lines.feed(self.feeds[1]);
        self.go(lines, "G0", [before[0], free]);
        if !falls {
            self.go(lines, "G0", before);
        }
        self.go(lines, &format!("G1{side}"), first);
        for element in contour {
            match element.arc {
                None => self.go(lines, "G1", element.end),
                Some((center, sweep)) => {
                    self.arc(lines, [element.start, element.end], center, sweep > 0.0);
                }
            }
        }
        let off = if side.is_empty() { "" } else { " G40" };
        self.go(lines, &format!("G1{off}"), behind);
        self.go(lines, "G0", [behind[0], free]);
        if !falls {
            self.go(lines, "G0", [before[0], free]);
        }
    }

    /// A straight move to Z and X.
    fn go(&self, lines: &mut Lines, code: &str, to: Point) {
        let [z, x] = to.map(|mm| mm / self.mm);
        lines.go(code, [Some(z), Some(x), None]);
    }

    fn arc(&self, lines: &mut Lines, [start, end]: [Point; 2], center: Point, left: bool) {
        let code = if left { "G3" } else { "G2" };
        let [z, x] = end.map(|mm| mm / self.mm);
        let offset = [0, 1].map(|axis| (center[axis] - start[axis]) / self.mm);
        lines.arc(code, [z, x], None, offset, 1);
    }
}
