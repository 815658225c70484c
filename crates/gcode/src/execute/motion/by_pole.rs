//! Moves to a direction of the tool on a machine with five axes: by the pole, which is the tool along the axis of C, and at
//! the ends of travel.
//!
//! ```text
//!        direction          Within `pole_deg` of the pole a direction is as good as any other there, so C
//!     ●───────╮             stays, and the tool passes straight. From there C turns first, while the tip
//!     │  pole ⊙ C turns     rests, and then the tool leans its new way. Where the tilt cannot lean to
//!     ●───────╯             the other side, it leans back, and C turns by half a round at the pole.
//! ```
//!
//! Where C has wound up to its end, a move at feed is refused: the way back is many degrees of C, in which the tool
//! may swing through the work. A rapid goes that way if the machine lets it.

use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{FiveAxis, Tilt};
use glidepath_program::{DirectionTolerance, Item};
use nalgebra::Vector3;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::Pace;
use crate::syntax::block::Block;
use crate::syntax::modes::FeedMode;
use crate::syntax::named_word::Named;

/// Angles nearer than this are the same, degrees.
const SAME_DEG: f64 = 1e-9;
/// Most rounds that C may be wound, either way.
const ROUNDS: i32 = 32;

/// Where the rotary axes stand: the tilt, and C, degrees.
type Angles = (f64, f64);

/// The way of a move to a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    /// All at once.
    Straight(Angles),
    /// C turns first, while the tip rests.
    TurnFirst(Angles),
    /// Up to a share of the way the tool leans to the pole, then C turns by half a round, while the tip rests.
    ByPole {
        share: f64,
        at: [Angles; 2],
        end: Angles,
    },
}

/// A machine that takes a direction, and how near to the pole any of them will do.
struct Directions<'a> {
    interpreter: &'a Interpreter,
    machine: FiveAxis,
    pole_deg: f64,
}

impl Directions<'_> {
    fn is_in_travel(&self, axis: Axis, angle_deg: f64) -> bool {
        let travel = self.interpreter.options.machine.travel(axis);
        travel.is_none_or(|travel| {
            (travel.min - SAME_DEG..=travel.max + SAME_DEG).contains(&angle_deg)
        })
    }

    fn are_in_travel(&self, (tilt, rotary): Angles) -> bool {
        self.is_in_travel(self.machine.tilt_axis(), tilt) && self.is_in_travel(Axis::C, rotary)
    }

    fn direction(&self, (tilt, rotary): Angles) -> Vector3<f64> {
        self.machine.tool_axis(tilt, rotary)
    }

    /// How far the tool leans there, degrees.
    fn lean_deg(&self, at: Angles) -> f64 {
        let way = self.direction(at);
        way.x.hypot(way.y).atan2(way.z).to_degrees()
    }

    fn is_at_pole(&self, at: Angles) -> bool {
        self.lean_deg(at) <= self.pole_deg.max(SAME_DEG)
    }

    /// All ways inside the travel to give the tool a direction.
    fn reached(&self, direction: &Vector3<f64>, near_rotary: f64) -> impl Iterator<Item = Angles> {
        let branches = self.machine.branches_deg(direction, near_rotary);
        let all = branches.into_iter().flatten().flat_map(|(tilt, rotary)| {
            (-ROUNDS..=ROUNDS).map(move |round| (tilt, rotary + 360.0 * f64::from(round)))
        });
        all.filter(|angles| self.are_in_travel(*angles))
    }

    /// The way of a move at a pace from where the rotary axes stand to angles that the direction has nearest to them.
    fn way(&self, here: Angles, to: Angles, pace: Pace) -> Option<Way> {
        let direction = self.direction(to);
        let is_leaving = self.is_at_pole(here) && !self.is_at_pole(to);
        let least_turn = |a: &Angles, b: &Angles| {
            let turn = |angles: &Angles| (angles.1 - here.1).abs();
            turn(a).total_cmp(&turn(b))
        };
        if is_leaving && let Some(end) = self.reached(&direction, here.1).min_by(least_turn) {
            // Leaning and turning at once the tool would lean aside on the way, by so much at most.
            let aside_deg = 0.25 * self.lean_deg(to) * (end.1 - here.1).to_radians().abs();
            let is_cutting = pace == Pace::Feed;
            return Some(if aside_deg <= self.pole_deg.max(SAME_DEG) || !is_cutting {
                Way::Straight(end)
            } else {
                Way::TurnFirst(end)
            });
        }
        if self.are_in_travel(to) {
            return Some(Way::Straight(to));
        }
        self.by_pole(here, to).or_else(|| {
            let far = |angles: &Angles| {
                let [tilt, rotary] = [angles.0 - here.0, angles.1 - here.1];
                tilt.abs().max(rotary.abs())
            };
            let all = self.reached(&direction, here.1);
            let nearest = all.min_by(|a, b| far(a).total_cmp(&far(b)));
            let may_unwind = self.interpreter.options.unwinds_at_rapid && pace == Pace::Rapid;
            nearest.filter(|_| may_unwind).map(Way::Straight)
        })
    }

    /// The way through the pole of a tilt that cannot go on beyond it: with C half a round on, the same directions are on
    /// the side that it can lean to.
    fn by_pole(&self, here: Angles, to: Angles) -> Option<Way> {
        // A skewed tilt turns the tool's heading, too.
        let is_plain = matches!(self.machine.tilt, Tilt::A | Tilt::B);
        if !is_plain || here.0 * to.0 >= 0.0 {
            return None;
        }
        let share = here.0 / (here.0 - to.0);
        let at_c = here.1 + share * (to.1 - here.1);
        let flipped = |half: f64| Way::ByPole {
            share,
            at: [(0.0, at_c), (0.0, at_c + half)],
            end: (-to.0, to.1 + half),
        };
        let is_there = |way: &Way| match way {
            Way::ByPole { at, end, .. } => at
                .iter()
                .chain([end])
                .all(|angles| self.are_in_travel(*angles)),
            Way::Straight(_) | Way::TurnFirst(_) => false,
        };
        [180.0, -180.0].map(flipped).into_iter().find(is_there)
    }
}

impl Interpreter {
    /// How far from a programmed direction the tool may be along the axis of C instead, degrees.
    pub(super) fn pole_deg(&self) -> f64 {
        let options = &self.options;
        let tolerance_mm = self.path_mode().tolerance_mm(options.tolerance_mm);
        DirectionTolerance::POLE_R * options.direction.in_force_deg(tolerance_mm)
    }

    /// The angles for a direction within [`Self::pole_deg`] of the pole: C stays, and the tilt leans the tool as far as
    /// it goes that way.
    pub(super) fn angles_by_pole(
        &self,
        machine: FiveAxis,
        direction: &Vector3<f64>,
        here: Angles,
    ) -> Option<Angles> {
        let directions = Directions {
            interpreter: self,
            machine,
            pole_deg: self.pole_deg(),
        };
        let (tilt, rotary) = machine.branches_deg(direction, here.1)?[0];
        let leans = tilt * (rotary - here.1).to_radians().cos();
        let ends = self.options.machine.travel(machine.tilt_axis());
        let kept = ends.map_or(leans, |ends| leans.clamp(ends.min, ends.max));
        let way = direction.normalize();
        let off = directions.direction((kept, here.1)).cross(&way).norm();
        let is_near = off.asin().to_degrees() <= directions.pole_deg && way.z > 0.0;
        (directions.is_at_pole((tilt, rotary)) && is_near).then_some((kept, here.1))
    }

    /// Makes a straight move; one to a direction of the tool by the pole, or back from the end of C, in several parts.
    pub(crate) fn straight_to_direction(
        &mut self,
        block: &Block,
        target: AxisVector,
        pace: Pace,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let has_direction = (0..3).any(|axis| block.named.find(Named::Vector(axis)).is_some());
        let Some(machine) = self.options.five_axis.filter(|_| has_direction) else {
            return self.straight(block, target, pace, out);
        };
        let [tilt, rotary] = [machine.tilt_axis().index(), Axis::C.index()];
        let angles = |place: &AxisVector| (place[tilt], place[rotary]);
        let turned = |mut place: AxisVector, to: Angles| {
            (place[tilt], place[rotary]) = to;
            place
        };
        let start = self.state.position;
        let (here, to) = (angles(&start), angles(&target));
        let directions = Directions {
            interpreter: self,
            machine,
            pole_deg: self.pole_deg(),
        };
        let Some(way) = directions.way(here, to, pace) else {
            return Err(wound(&directions, block, to));
        };
        // In one part where the parts of a block are not told apart: in G93, and beside a contour up to the move that
        // leads away, where the tip is not where the program has it.
        let is_whole = self.state.open.compensation.is_some()
            || self.state.leaving_contour
            || self.state.modal.feed_mode == FeedMode::InverseTime;
        match way {
            Way::ByPole { .. } if is_whole => Err(wound(&directions, block, to)),
            Way::Straight(end) | Way::TurnFirst(end) if is_whole => {
                self.straight(block, turned(target, end), pace, out)
            }
            Way::Straight(end) => self.straight(block, turned(target, end), pace, out),
            Way::TurnFirst(end) => {
                let turn = turned(start, (here.0, end.1));
                self.straight(block, turn, Pace::Rapid, out)?;
                self.straight(block, turned(target, end), pace, out)?;
                self.pole_turns.add(self.line, (end.1 - here.1).abs());
                Ok(())
            }
            Way::ByPole { share, at, end } => {
                let middle = start + (target - start) * share;
                self.straight(block, turned(middle, at[0]), pace, out)?;
                self.straight(block, turned(middle, at[1]), Pace::Rapid, out)?;
                self.straight(block, turned(target, end), pace, out)?;
                if pace == Pace::Feed {
                    self.pole_turns.add(self.line, (at[1].1 - at[0].1).abs());
                }
                Ok(())
            }
        }
    }
}

/// Refuses a direction that an axis would have to go beyond its travel for.
#[cold]
fn wound(directions: &Directions<'_>, block: &Block, to: Angles) -> Box<BlockDiagnostic> {
    let tilt_axis = directions.machine.tilt_axis();
    let (axis, angle) = if directions.is_in_travel(Axis::C, to.1) {
        (tilt_axis, to.0)
    } else {
        (Axis::C, to.1)
    };
    let travel = directions.interpreter.options.machine.travel(axis);
    let (min, max) = travel.map_or((0.0, 0.0), |travel| (travel.min, travel.max));
    let (side, end) = if angle > max {
        ("above", max)
    } else {
        ("below", min)
    };
    let message = format!(
        "{axis} would go to {angle:.3}°, which is {side} {end}°, for the direction of the tool"
    );
    let found = (0..3).find_map(|axis| block.named.find(Named::Vector(axis)));
    let span = found.map_or_else(|| block.motion_span(), |word| word.span);
    let direction = directions.direction(to);
    let others = directions.reached(&direction, to.1);
    let nearest = others.min_by(|a, b| (a.1 - to.1).abs().total_cmp(&(b.1 - to.1).abs()));
    let refusal = BlockDiagnostic::new(DiagnosticCode::SoftLimit, span, message);
    match nearest {
        Some((tilt, rotary)) => refusal
            .because(format!(
                "the way that goes on from where the axes stand ends there; the same direction is at \
                 {tilt_axis} {tilt:.3}° and C {rotary:.3}°, and on the way there the tool swings"
            ))
            .help(format!(
                "write G0 {tilt_axis}{tilt:.3} C{rotary:.3} before it where the tool is clear of the work, or let rapid \
                 moves to a direction go there: unwind = \"rapids\" in [program] of the configuration"
            )),
        None => refusal
            .because("no way to turn the rotary axes inside their travel gives the tool that direction")
            .help("set the work up in another way"),
    }
}
