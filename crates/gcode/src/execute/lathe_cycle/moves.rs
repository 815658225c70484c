//! The moves of a lathe cycle, made once its profile is known.

use glidepath_geometry::{AXES, Arc as ArcSegment, Axis, AxisVector, Plane, Segment};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::compensation::element::{Element, Point, turn};
use crate::execute::interpreter::Interpreter;
use crate::execute::lathe_cycle::offset::offset;
use crate::execute::lathe_cycle::open::OpenLatheCycle;
use crate::execute::lathe_cycle::pass_axes::{PassAxes, ROUNDING_MM, pieces};
use crate::execute::lathe_cycle::passes::{
    MAX_PASS_MOVES, NoPasses, PassMove, Roughing, finish, lift, rough,
};
use crate::execute::lathe_cycle::profile::LatheProfile;
use crate::execute::motion::settled::{MIN_MOVE, settled};
use crate::execute::motion::speed::Pace;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::LatheCycle;

/// Arcs whose ends are as near as this are straight, mm.
const SHORT_ARC_MM: f64 = 2e-6;

impl Interpreter {
    /// Machine coordinates of Z and X; the other axes stay.
    pub(crate) fn lathe_target(&self, [z, x]: Point) -> AxisVector {
        let mut values = [None; AXES];
        values[Axis::Z.index()] = Some(z);
        values[Axis::X.index()] = Some(x);
        self.absolute_target(&values)
    }

    pub(crate) fn make_lathe_cycle(
        &mut self,
        cycle: &OpenLatheCycle,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let (block, words, profile) = (&cycle.block, &cycle.words, &cycle.profile);
        check_elements(block, profile)?;
        let start = self.lathe_point();
        let (facing, pockets) = match words.cycle {
            LatheCycle::Finish => return self.finish_profile(cycle, start, out),
            LatheCycle::Turn(pockets) => (false, pockets),
            LatheCycle::Repeat => return self.repeat_profile(cycle, out),
            LatheCycle::Face(pockets) => (true, pockets),
        };
        let axes = axes_of(block, facing, &profile.elements, start)?;
        let pieces = pieces(&axes, &profile.elements)
            .map_err(|index| turns_back(block, facing, profile.elements.get(index..)))?;
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
            first_level: words.first_level,
            infeed: cycle.infeed(),
        };
        let moves = rough(&at_distance, axes.inside(start), roughing)
            .map_err(|why| no_passes(block, why))?;
        moves
            .iter()
            .try_for_each(|pass_move| self.pass_move(block, &axes, *pass_move, out))
    }

    /// G70.
    fn finish_profile(
        &mut self,
        cycle: &OpenLatheCycle,
        start: Point,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let (block, words, profile) = (&cycle.block, &cycle.words, &cycle.profile);
        let mut turned = None;
        let mut found = None;
        for facing in [false, true] {
            let axes = axes_of(block, facing, &profile.elements, start)?;
            match pieces(&axes, &profile.elements) {
                Ok(pieces) => {
                    found = Some((axes, pieces));
                    break;
                }
                Err(index) => turned = turned.or(profile.elements.get(index..)),
            }
        }
        let Some((axes, pieces)) = found else {
            return Err(turns_back(block, false, turned));
        };
        let target = self.state.position;
        let from = out.len();
        for pass in (0..words.finishing).rev() {
            let share = f64::from(pass) / f64::from(words.finishing);
            let distance_mm = share * (words.distance_mm - words.end_mm) + words.end_mm;
            let along = offset(&pieces, distance_mm).ok_or_else(|| nothing_left(block, b'D'))?;
            if out.len() - from + along.len() > MAX_PASS_MOVES {
                return Err(no_passes(block, NoPasses::TooMany));
            }
            self.rapid_without_compensation(block, target, out)?;
            for pass_move in finish(&along, axes.inside(start), cycle.infeed()) {
                self.pass_move(block, &axes, pass_move, out)?;
            }
            if pass > 0 {
                let compensation = self.state.open.compensation.clone();
                self.end_compensation(out)?;
                for pass_move in lift(&along, axes.inside(start)) {
                    self.pass_move(block, &axes, pass_move, out)?;
                }
                self.state.open.compensation = compensation.map(|on| on.again(self.state.path_end));
            }
        }
        Ok(())
    }

    /// One move of a cycle.
    fn pass_move(
        &mut self,
        block: &Block,
        axes: &PassAxes,
        pass_move: PassMove,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let (end, pace, turn) = match pass_move {
            PassMove::Rapid(end) => (end, Pace::Rapid, None),
            PassMove::Feed(end) => (end, Pace::Feed, None),
            PassMove::Arc(end, center, left) => (end, Pace::Feed, Some((center, left))),
        };
        let target = self.lathe_target(axes.outside(end));
        let way = target - self.state.position;
        match turn {
            Some((center, left)) if way.amax() > SHORT_ARC_MM => {
                let center = self.lathe_target(axes.outside(center));
                self.lathe_arc(block, target, center, left != axes.mirrors(), out)
            }
            _ if way.amax() <= MIN_MOVE => Ok(()),
            _ => self.straight(block, target, pace, out),
        }
    }

    /// An arc of at most half a turn about a centre, to a machine position.
    pub(super) fn lathe_arc(
        &mut self,
        block: &Block,
        target: AxisVector,
        center: AxisVector,
        left: bool,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let compensated = self.state.open.compensation.is_some();
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

/// Refuses a profile without elements, or with a corner at its end.
fn check_elements(block: &Block, profile: &LatheProfile) -> Outcome<()> {
    let (message, help) = if profile.is_open() {
        (
            "a fillet or chamfer at the end of the profile",
            "remove its word there, or draw one element more",
        )
    } else if profile.elements.is_empty() {
        (
            "the profile is empty",
            "draw at least one element behind its first point",
        )
    } else {
        return Ok(());
    };
    Err(
        BlockDiagnostic::new(DiagnosticCode::CannedCycle, block.span(b'Q'), message)
            .because("the cycle follows the elements of its profile")
            .help(help),
    )
}

fn axes_of(block: &Block, facing: bool, profile: &[Element], start: Point) -> Outcome<PassAxes> {
    // A profile has an element: it was seen to.
    PassAxes::new(facing, profile, start).ok_or_else(|| nothing_left(block, b'Q'))
}

/// From the first of these elements on the profile turns back.
fn turns_back(block: &Block, facing: bool, from: Option<&[Element]>) -> Box<BlockDiagnostic> {
    let from = from.unwrap_or_default();
    let [z, x] = from.first().map_or([0.0; 2], |element| element.start);
    let (axis, other) = if facing { ("X", "G71") } else { ("Z", "G72") };
    let message =
        format!("the profile turns back along {axis} behind X{x:.4} Z{z:.4} mm (X: radius)");
    BlockDiagnostic::new(DiagnosticCode::CannedCycle, block.span(b'Q'), message)
        .because(if block.dialect == Dialect::Fanuc {
            "along it a profile must not change its direction, in pockets (type II) either: the controls refuse that, \
             too (FANUC's alarm 064)"
        } else {
            "it must lead one way along it, with arcs of at most half a turn"
        })
        .help(if from.len() == 1 {
            "end the profile in front of its last element, and write that way back behind the cycle"
                .to_owned()
        } else {
            format!("draw it otherwise, in several parts, or use {other}")
        })
}

fn nothing_left(block: &Block, letter: u8) -> Box<BlockDiagnostic> {
    let message = "nothing is left of the profile at that distance";
    BlockDiagnostic::new(DiagnosticCode::CannedCycle, block.span(letter), message)
        .because("the distance is greater than what the profile has room for")
        .help("write a smaller distance")
}

fn no_passes(block: &Block, why: NoPasses) -> Box<BlockDiagnostic> {
    let span = block.motion_span();
    match why {
        NoPasses::WrongSide => {
            let message = "the cycle starts on the side of the workpiece";
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                .because(
                    "the tool comes from the side to which the profile leads, beyond its first point \
                     and the distance D",
                )
                .help("write X and Z outside the stock, or draw the profile from its other end")
        }
        NoPasses::TooMany => {
            let message = "too many passes";
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                .because("one cycle makes at most 10000 passes and 50000 moves")
                .help("write a larger I or a smaller P, or make two cycles of it")
        }
    }
}
