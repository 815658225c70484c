//! Reads the profile of a cycle, and makes its moves.

use std::io::BufRead;
use std::sync::Arc;

use glidepath_geometry::{AXES, Arc as ArcSegment, Axis, AxisVector, Plane, Segment};
use glidepath_program::Item;

use super::frame::{Frame, Point, ROUNDING_MM, pieces};
use super::offset::offset;
use super::passes::{MAX_STEPS, NoPasses, Roughing, Step, finish, lift, rough};
use super::profile::Profile;
use super::{OpenContour, label};
use crate::block::Block;
use crate::compensation::{Element, turn};
use crate::diagnostic::{Code as FaultCode, Fault, Outcome};
use crate::dialect::Dialect;
use crate::flow::Code;
use crate::flow_word::Label;
use crate::interpreter::Interpreter;
use crate::modes::{Contour, Motion};
use crate::moves::{MIN_MOVE, Pace, motion_span, settled};
use crate::place::Place;
use crate::program::Program;

/// Arcs whose ends are as near as this are straight, mm.
const SHORT_ARC_MM: f64 = 2e-6;

/// What the block of a cycle asks for.
pub(crate) struct Asked {
    contour: Contour,
    code: Arc<Code>,
}

impl<R: BufRead> Program<R> {
    /// The cycle that a block asks for, and the subroutine of its profile.
    pub(crate) fn asked_contour(&self, block: &Block) -> Outcome<Option<Asked>> {
        let Some(motion) = block.codes.motion else {
            return Ok(None);
        };
        let Some(Motion::Contour(contour)) = motion.code else {
            return Ok(None);
        };
        if block.dialect != Dialect::LinuxCnc {
            let message = "a lathe cycle in this dialect is not supported";
            return Err(Fault::new(FaultCode::NotSupported, motion.span, message)
                .because("its words mean something else than LinuxCNC's")
                .help("let the CAM system write the passes out"));
        }
        if self.contour.is_some() {
            let message = "a lathe cycle in the profile of another one";
            return Err(Fault::new(FaultCode::CannedCycle, motion.span, message)
                .because("a profile is drawn by G0, G1, G2 and G3 alone"));
        }
        let label = Label::Number(label(block)?);
        match self.flow.subroutines.get(&label) {
            Some(code) => Ok(Some(Asked {
                contour,
                code: Arc::clone(code),
            })),
            None => {
                let message = format!("there is no subroutine {label}");
                let span = block.span(b'Q');
                Err(Fault::new(FaultCode::UnknownSubroutine, span, message)
                    .because(
                        "the profile is a subroutine of the same file, defined before the cycle",
                    )
                    .help("define it before this line"))
            }
        }
    }

    /// Begins to read the profile.
    pub(crate) fn open_contour(&mut self, asked: &Asked) -> Outcome<()> {
        let block = self.block().clone();
        let words = self.interpreter.contour_words(&block, asked.contour)?;
        let contour = OpenContour {
            line: self.line_of_program(),
            source: self.here(),
            level: self.parameters.call_level(),
            words,
            profile: Profile::new(self.interpreter.lathe_point()),
            state: self.interpreter.state,
            block,
        };
        self.enter(&asked.code, &[], contour.block.span(b'Q'))?;
        self.contour = Some(Box::new(contour));
        Ok(())
    }

    /// Draws a block of the profile. Parameters that show the position show its end.
    pub(crate) fn draw_block(&mut self) -> Outcome<()> {
        let Some(mut contour) = self.contour.take() else {
            return Ok(());
        };
        contour.profile.add(self.block(), &self.interpreter)?;
        let target = self.interpreter.lathe_target(contour.profile.at);
        self.interpreter.state.position = target;
        self.contour = Some(contour);
        Ok(())
    }

    /// Makes the moves of the cycle, once its profile is complete.
    pub(crate) fn close_contour(&mut self) -> Outcome<()> {
        let level = self.parameters.call_level();
        let Some(contour) = self.contour.take_if(|contour| contour.level >= level) else {
            return Ok(());
        };
        self.place = Place::Past(contour.source.clone());
        self.interpreter.state = contour.state;
        self.interpreter.line = contour.line;
        let mut items = Vec::new();
        self.interpreter.make_contour(&contour, &mut items)?;
        self.give(items);
        Ok(())
    }
}

impl Interpreter {
    /// Machine coordinates of Z and X; the other axes stay.
    fn lathe_target(&self, [z, x]: Point) -> AxisVector {
        let mut values = [None; AXES];
        values[Axis::Z.index()] = Some(z);
        values[Axis::X.index()] = Some(x);
        self.absolute_target(&values)
    }

    fn make_contour(&mut self, contour: &OpenContour, out: &mut Vec<Item>) -> Outcome<()> {
        let (block, words, profile) = (&contour.block, &contour.words, &contour.profile);
        if profile.elements.is_empty() || profile.is_open() {
            let (message, help) = if profile.is_open() {
                (
                    "a fillet or chamfer at the end of the profile",
                    "remove A or C there",
                )
            } else {
                (
                    "the profile is empty",
                    "draw at least one element behind its first point",
                )
            };
            return Err(
                Fault::new(FaultCode::CannedCycle, block.span(b'Q'), message)
                    .because("the cycle follows the elements of its profile")
                    .help(help),
            );
        }
        let start = self.lathe_point();
        let (facing, pockets) = match words.contour {
            Contour::Finish => return self.finish_contour(contour, start, out),
            Contour::Turn(pockets) => (false, pockets),
            Contour::Face(pockets) => (true, pockets),
        };
        let frame = frame_of(block, facing, &profile.elements, start)?;
        let pieces = pieces(&frame, &profile.elements)
            .map_err(|index| turns_back(block, facing, profile.elements.get(index)))?;
        if let (Some(first), Some(last)) = (pieces.first(), pieces.last())
            && last.end[1] < first.start[1] - ROUNDING_MM
        {
            return Err(no_passes(block, NoPasses::WrongSide));
        }
        let at_distance =
            offset(&pieces, words.distance_mm).ok_or_else(|| nothing_left(block, b'D'))?;
        let roughing = Roughing {
            pockets,
            increment_mm: words.increment_mm,
            retract_mm: words.retract_mm,
        };
        let steps = rough(&at_distance, frame.inside(start), roughing)
            .map_err(|why| no_passes(block, why))?;
        steps
            .iter()
            .try_for_each(|step| self.step(block, &frame, *step, out))
    }

    /// G70.
    fn finish_contour(
        &mut self,
        contour: &OpenContour,
        start: Point,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let (block, words, profile) = (&contour.block, &contour.words, &contour.profile);
        let mut turned = None;
        let mut found = None;
        for facing in [false, true] {
            let frame = frame_of(block, facing, &profile.elements, start)?;
            match pieces(&frame, &profile.elements) {
                Ok(pieces) => {
                    found = Some((frame, pieces));
                    break;
                }
                Err(index) => turned = turned.or(profile.elements.get(index)),
            }
        }
        let Some((frame, pieces)) = found else {
            return Err(turns_back(block, false, turned));
        };
        let target = self.state.position;
        let from = out.len();
        for pass in (0..words.finishing).rev() {
            let share = f64::from(pass) / f64::from(words.finishing);
            let distance_mm = share * (words.distance_mm - words.end_mm) + words.end_mm;
            let along = offset(&pieces, distance_mm).ok_or_else(|| nothing_left(block, b'D'))?;
            if out.len() - from + along.len() > MAX_STEPS {
                return Err(no_passes(block, NoPasses::TooMany));
            }
            self.without_compensation(block, target, out)?;
            for step in finish(&along, frame.inside(start)) {
                self.step(block, &frame, step, out)?;
            }
            if pass > 0 {
                let compensation = self.compensation.clone();
                self.end_compensation(out)?;
                for step in lift(&along, frame.inside(start)) {
                    self.step(block, &frame, step, out)?;
                }
                self.compensation = compensation.map(|on| on.again(self.state.path_end));
            }
        }
        Ok(())
    }

    /// One move of a cycle.
    fn step(
        &mut self,
        block: &Block,
        frame: &Frame,
        step: Step,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let (end, pace, turn) = match step {
            Step::Rapid(end) => (end, Pace::Rapid, None),
            Step::Feed(end) => (end, Pace::Feed, None),
            Step::Arc(end, center, left) => (end, Pace::Feed, Some((center, left))),
        };
        let target = self.lathe_target(frame.outside(end));
        let way = target - self.state.position;
        match turn {
            Some((center, left)) if way.amax() > SHORT_ARC_MM => {
                let center = self.lathe_target(frame.outside(center));
                self.lathe_arc(block, target, center, left != frame.mirrors(), out)
            }
            _ if way.amax() <= MIN_MOVE => Ok(()),
            _ => self.straight(block, target, pace, out),
        }
    }

    /// An arc of at most half a turn about a centre, to a machine position.
    fn lathe_arc(
        &mut self,
        block: &Block,
        target: AxisVector,
        center: AxisVector,
        left: bool,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let compensated = self.compensation.is_some();
        let start = if compensated {
            self.state.position
        } else {
            self.state.path_end
        };
        let place = |point: &AxisVector| [point[Axis::Z.index()], point[Axis::X.index()]];
        let center = place(&center);
        let end = settled(start, target, [Some(Axis::Z), Some(Axis::X)]);
        let by = |point: &AxisVector| {
            let [z, x] = place(point);
            [z - center[0], x - center[1]]
        };
        let (a, b) = (by(&start), by(&end));
        let sweep_rad = turn(a, b).abs().copysign(if left { 1.0 } else { -1.0 });
        let arc = ArcSegment {
            start,
            end,
            plane: Plane::Zx,
            center,
            sweep_rad,
        };
        let segment = Segment::Arc(arc);
        let speed = self.speed(block, &segment, Pace::Feed)?;
        self.state.position = target;
        if compensated {
            return self.contour_move(block, segment, speed, out);
        }
        let (low, high) = arc.bounding_box();
        self.check_limits(block, &low, &high, "a point")?;
        self.push_move(segment, speed, out);
        Ok(())
    }
}

fn frame_of(block: &Block, facing: bool, profile: &[Element], start: Point) -> Outcome<Frame> {
    // A profile has an element: it was seen to.
    Frame::new(facing, profile, start).ok_or_else(|| nothing_left(block, b'Q'))
}

fn turns_back(block: &Block, facing: bool, element: Option<&Element>) -> Box<Fault> {
    let [z, x] = element.map_or([0.0; 2], |element| element.start);
    let (axis, other) = if facing { ("X", "G71") } else { ("Z", "G72") };
    let message =
        format!("the profile turns back along {axis} behind X{x:.4} Z{z:.4} mm (X: radius)");
    Fault::new(FaultCode::CannedCycle, block.span(b'Q'), message)
        .because("it must lead one way along it, with arcs of at most half a turn")
        .help(format!(
            "draw it otherwise, in several parts, or use {other}"
        ))
}

fn nothing_left(block: &Block, letter: u8) -> Box<Fault> {
    let message = "nothing is left of the profile at that distance";
    Fault::new(FaultCode::CannedCycle, block.span(letter), message)
        .because("the distance is greater than what the profile has room for")
        .help("write a smaller distance")
}

fn no_passes(block: &Block, why: NoPasses) -> Box<Fault> {
    let span = motion_span(block);
    match why {
        NoPasses::WrongSide => {
            let message = "the cycle starts on the side of the workpiece";
            Fault::new(FaultCode::CannedCycle, span, message)
                .because(
                    "the tool comes from the side to which the profile leads, beyond its first point \
                     and the distance D",
                )
                .help("write X and Z outside the stock, or draw the profile from its other end")
        }
        NoPasses::TooMany => {
            let message = "too many passes";
            Fault::new(FaultCode::CannedCycle, span, message)
                .because("one cycle makes at most 10000 passes and 50000 moves")
                .help("write a larger I or a smaller P, or make two cycles of it")
        }
    }
}
