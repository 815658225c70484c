//! Canned cycles: G73, G74, G81 to G86, G89.
//!
//! A block of a cycle makes one hole, or L of them, along the axis normal to the plane (Z in G17).
//! The first block of a cycle gives R, the depth, and what the cycle needs besides; the blocks
//! after it keep what they do not give, until another motion mode is written.
//!
//! ```text
//!        rapid across                 initial level  (G98 retracts to here)
//!   ●┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┐
//!                         ┆ rapid
//!                         ▼           R plane        (G99 retracts to here)
//!                         │ feed
//!                         ▼           bottom: dwell, spindle, retraction
//! ```
//!
//! With G90 R and depth are coordinates; with G91 R counts from the initial level, the depth from
//! R, and the in-plane words from hole to hole. The initial level is where the axis stood before
//! the first of a series of cycles. The way to the next hole begins with a rise where one is
//! needed.
//!
//! | cycle | down | at the bottom | out |
//! |---|---|---|---|
//! | G73 | Q at a time, 0.254 mm back after each | – | rapid |
//! | G74, G84 | feed, overrides off | spindle reversed, dwell P | feed, then reversed again |
//! | the same, rigidly | behind the spindle | – | behind the spindle to R, rapid from there |
//! | G81 | feed | – | rapid |
//! | G82 | feed | dwell P | rapid |
//! | G83 | Q at a time, out to R after each | – | rapid |
//! | G85 | feed | – | feed to R, rapid from there |
//! | G86 | feed | dwell P, spindle stop | rapid, spindle on |
//! | G89 | feed | dwell P | feed |

use glidepath_geometry::{AXES, Axis, AxisVector, Plane};
use glidepath_program::{Event, Item, ItemKind, PathMode};

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::auxiliary::order::fanuc_dwell;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::Pace;
use crate::execute::state::sticky_words::{CycleSeries, StickyWords};
use crate::execute::tapping_cycle::tap_turns;
use crate::setup::fanuc::PointInput;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{CannedCycle, Distance, FeedMode, Retract, Units};
use crate::syntax::word_check::{missing, negative, whole};

/// How far the tool backs off from a depth it has reached, mm.
const BACK_OFF_MM: f64 = 0.254;
/// Depths as near to the bottom as this are the bottom, mm.
const BOTTOM_MM: f64 = 1e-6;
/// Most pecks of one block.
const MAX_PECKS: f64 = 10_000.0;
/// Depths without a point above this are in doubt on a FANUC mill.
const MOST_PECK: f64 = 99.0;
/// Most holes of one block.
const MAX_HOLES: u32 = 10_000;

/// One hole: levels in program coordinates along the normal axis, mm.
#[derive(Debug, Clone, Copy)]
struct Hole {
    sticky: StickyWords,
    r: f64,
    bottom: f64,
    clear: f64,
}

impl Interpreter {
    pub(crate) fn cycle(
        &mut self,
        block: &Block,
        cycle: CannedCycle,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if block.is_lathe {
            // On the face: along Z, whatever plane arcs have.
            let plane = core::mem::replace(&mut self.state.modal.plane, Plane::Xy);
            let made = self.cycle_along_normal(block, cycle, out);
            self.state.modal.plane = plane;
            return made;
        }
        self.cycle_along_normal(block, cycle, out)
    }

    fn cycle_along_normal(
        &mut self,
        block: &Block,
        cycle: CannedCycle,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let normal = self.state.modal.plane.normal();
        let sticky = self.keep(block, cycle)?;
        self.check_cycle(block, &sticky)?;
        let repeats = whole(block, b'K', MAX_HOLES)?.or(whole(block, b'L', MAX_HOLES)?);
        let holes = match repeats {
            // FANUC keeps the words for the blocks that follow.
            Some(0) if block.dialect == Dialect::Fanuc => 0,
            Some(0) => {
                let message = "a cycle without holes";
                return Err(
                    Fault::new(DiagnosticCode::CannedCycle, block.span(b'L'), message)
                        .because("L0 asks for no repetition at all")
                        .help("write L1 or more, or leave L out"),
                );
            }
            holes => holes.unwrap_or(1),
        };
        let incremental = self.state.modal.distance == Distance::Incremental;
        let program = self.offsets.to_program(self.state.position);
        let start = program[normal.index()];
        let initial = self.state.cycles.initial.unwrap_or(start);
        let (r, bottom) = if incremental {
            (initial + sticky.r, initial + sticky.r + sticky.depth)
        } else if block.is_lathe {
            // R is the way from the initial level.
            (initial + sticky.r, sticky.depth)
        } else {
            (sticky.r, sticky.depth)
        };
        if r < bottom {
            let message = "the R plane is below the bottom of the hole";
            return Err(
                Fault::new(DiagnosticCode::CannedCycle, block.span(b'R'), message)
                    .because(format!(
                        "the cycle goes from R down to {}; with G91 the depth counts from R",
                        normal.letter()
                    ))
                    .help("check both words, and G90 or G91"),
            );
        }
        self.state.cycles = CycleSeries {
            initial: Some(initial),
            last: Some(sticky),
        };
        if holes == 0 {
            return Ok(());
        }
        let clear = match self.state.modal.retract {
            Retract::RPlane if !block.is_lathe => r,
            _ => initial.max(r),
        };
        let hole = Hole {
            sticky,
            r,
            bottom,
            clear,
        };
        let mode = core::mem::replace(&mut self.state.modal.path_mode, PathMode::ExactPath);
        if !sticky.is_rigid {
            self.spindle_from_taps(out);
        }
        let made = self.holes(block, hole, holes, out);
        self.state.modal.path_mode = mode;
        made
    }

    /// Refuses cycles that cannot be made.
    fn check_cycle(&self, block: &Block, sticky: &StickyWords) -> Outcome<()> {
        let (span, cycle) = (block.motion_span(), sticky.cycle);
        let refuse = |span: SourceSpan, message: String, reason: &str, help: &str| {
            Err(Fault::new(DiagnosticCode::CannedCycle, span, message)
                .because(reason)
                .help(help))
        };
        if self.state.modal.feed_mode == FeedMode::InverseTime {
            return refuse(
                span,
                "a canned cycle with inverse-time feed (G93)".to_owned(),
                "the time of the block would be shared by several moves",
                "write G94",
            );
        }
        let plane = self.state.modal.plane;
        let (first, second) = plane.axes();
        let of_cycle = [first, second, plane.normal()];
        if let Some((axis, _)) = block.axes().find(|(axis, _)| !of_cycle.contains(axis)) {
            return refuse(
                block.axis_span(axis),
                format!("{axis} in a canned cycle"),
                "a cycle moves the three axes of its plane only",
                "move the other axes in a block of their own",
            );
        }
        let wrong = match (tap_turns(cycle), self.state.spindle.turning) {
            (Some(wanted), Some(turning)) => turning != wanted,
            // Behind M29, and as an axis, the cycle itself lets it turn.
            (Some(_), None) => !sticky.starts_spindle && !self.taps_by_axis(sticky),
            (None, turning) => cycle == CannedCycle::BoreStop && turning.is_none(),
        };
        if wrong {
            let message = "the spindle does not turn as the cycle needs it";
            let help = match cycle {
                CannedCycle::TapLeft => "write M4 before G74",
                CannedCycle::TapRight => "write M3 before G84",
                _ => "write M3 or M4 before the cycle",
            };
            return Err(Fault::new(DiagnosticCode::Spindle, span, message)
                .because("the cycle stops or reverses the spindle at the bottom")
                .help(help));
        }
        Ok(())
    }

    /// The words of the block, with those kept from the block before where they are missing.
    fn keep(&mut self, block: &Block, cycle: CannedCycle) -> Outcome<StickyWords> {
        let span = block.motion_span();
        let name = name(cycle);
        let scale = self.state.modal.units.mm();
        let last = self.state.cycles.last.filter(|last| last.cycle == cycle);
        let normal = self.state.modal.plane.normal();
        let letter = u8::try_from(normal.letter()).unwrap_or(b'Z');
        let get = |letter: u8, scale: f64, sticky: Option<f64>, meaning: &str| {
            let word = block.get(letter).map(|value| value * scale);
            let text = char::from(letter).to_string();
            word.or(sticky)
                .ok_or_else(|| missing(span, name, &text, meaning))
        };
        let last_r = last.map(|l| l.r).or(block.is_lathe.then_some(0.0));
        let r = get(b'R', scale, last_r, "the plane above the hole")?;
        let peck_scale = scale * self.peck_unit(block)?;
        let depth = get(
            letter,
            scale,
            last.map(|l| l.depth),
            "the bottom of the hole",
        )?;
        let mut sticky = StickyWords {
            cycle,
            r,
            depth,
            dwell_s: 0.0,
            peck: 0.0,
            is_rigid: false,
            starts_spindle: false,
        };
        let last_dwell = last.map(|l| l.dwell_s);
        match cycle {
            CannedCycle::DrillDwell | CannedCycle::BoreStop | CannedCycle::BoreDwell => {
                sticky.dwell_s = if block.dialect == Dialect::Fanuc {
                    0.0
                } else {
                    get(b'P', 1.0, last_dwell, "seconds at the bottom")?
                };
            }
            CannedCycle::TapLeft | CannedCycle::TapRight => {
                sticky.dwell_s = block.get(b'P').or(last_dwell).unwrap_or(0.0);
                let word = block.get(b'Q').map(|peck| peck * peck_scale);
                sticky.peck = word.or(last.map(|l| l.peck)).unwrap_or(0.0);
            }
            CannedCycle::ChipBreak | CannedCycle::Peck => {
                sticky.peck = get(
                    b'Q',
                    peck_scale,
                    last.map(|l| l.peck),
                    "how deep to go at a time",
                )?;
                if sticky.peck <= 0.0 {
                    let message = format!("{name} goes no deeper");
                    return Err(
                        Fault::new(DiagnosticCode::CannedCycle, block.span(b'Q'), message)
                            .because("Q is how deep it goes at a time, and must be above zero")
                            .help("write a Q above zero"),
                    );
                }
            }
            CannedCycle::Drill | CannedCycle::Bore => {}
        }
        if block.dialect == Dialect::Fanuc {
            // In every cycle.
            let word = fanuc_dwell(block);
            sticky.dwell_s = word.or(last_dwell).unwrap_or(0.0);
        }
        if sticky.dwell_s < 0.0 {
            return Err(negative(block, b'P', "the dwell"));
        }
        self.settle_rigidity(block, last.as_ref(), &mut sticky)?;
        Ok(sticky)
    }

    /// What Q counts: lengths, and on a FANUC without a point least increments where all coordinates
    /// do, and on lathes.
    fn peck_unit(&self, block: &Block) -> Outcome<f64> {
        let is_fanuc = block.dialect == Dialect::Fanuc && block.has_no_point(b'Q');
        let Some(peck) = block.get(b'Q').filter(|_| is_fanuc) else {
            return Ok(1.0);
        };
        let increment = match self.state.modal.units {
            Units::Inch => 1e-4,
            Units::Millimetre => 1e-3,
        };
        match block.point {
            _ if block.is_lathe => Ok(increment),
            PointInput::Increment => Ok(increment),
            PointInput::Unsaid if peck > MOST_PECK => {
                let message = format!("Q{peck} has no decimal point");
                Err(
                    Fault::new(DiagnosticCode::AmbiguousWord, block.span(b'Q'), message)
                        .because(
                            "it is millimetres on one control, and least increments on another",
                        )
                        .help("write the point, or set `point` of [program] in the configuration"),
                )
            }
            PointInput::Calculator | PointInput::Unsaid => Ok(1.0),
        }
    }

    fn holes(&mut self, block: &Block, hole: Hole, holes: u32, out: &mut Vec<Item>) -> Outcome<()> {
        if hole.sticky.peck > 0.0 {
            let pecks = (hole.r - hole.bottom) / hole.sticky.peck * f64::from(holes);
            if pecks > MAX_PECKS {
                let message = format!("the block asks for {pecks:.0} pecks");
                return Err(
                    Fault::new(DiagnosticCode::CannedCycle, block.span(b'Q'), message)
                        .because(format!("one block makes at most {MAX_PECKS}"))
                        .help("write a larger Q"),
                );
            }
        }
        let plane = self.state.modal.plane;
        let normal = plane.normal();
        let (first, second) = plane.axes();
        let values = self.axis_values(block)?;
        let incremental = self.state.modal.distance == Distance::Incremental;
        let program = self.offsets.to_program(self.state.position);
        let mut level = program[normal.index()];
        // Up first: a rapid across below the level the cycle asks for could hit something.
        let safe = level.max(if self.state.modal.retract == Retract::Initial {
            hole.clear
        } else {
            hole.r
        });
        if safe > level {
            level = safe;
            self.along(block, normal, level, Pace::Rapid, out)?;
        }
        let mut place = [None; AXES];
        for axis in [first, second] {
            let i = axis.index();
            place[i] = values[i].map(|value| if incremental { program[i] } else { value });
        }
        for _ in 0..holes {
            if incremental {
                for axis in [first.index(), second.index()] {
                    place[axis] = place[axis].zip(values[axis]).map(|(at, by)| at + by);
                }
            }
            let target = self.absolute_target(&place);
            self.straight(block, target, Pace::Rapid, out)?;
            if level > hole.r {
                self.along(block, normal, hole.r, Pace::Rapid, out)?;
            }
            self.hole(block, hole, out)?;
            level = hole.clear;
        }
        Ok(())
    }

    /// Moves the normal axis alone, to a program coordinate.
    pub(super) fn along(
        &mut self,
        block: &Block,
        normal: Axis,
        level: f64,
        pace: Pace,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let target = self.level(normal, level);
        self.straight(block, target, pace, out)
    }

    /// Where the tool is with the normal axis at a program coordinate, in machine coordinates.
    pub(super) fn level(&self, normal: Axis, level: f64) -> AxisVector {
        let mut values = [None; AXES];
        values[normal.index()] = Some(level);
        self.absolute_target(&values)
    }

    /// From the R plane to the bottom and out again.
    fn hole(&mut self, block: &Block, hole: Hole, out: &mut Vec<Item>) -> Outcome<()> {
        let normal = self.state.modal.plane.normal();
        let StickyWords {
            cycle,
            dwell_s,
            peck,
            ..
        } = hole.sticky;
        let code = |number: u32| ItemKind::Event(Event::MCode(number));
        if let Some(turning) = tap_turns(cycle) {
            let levels = [hole.bottom, hole.clear];
            return if hole.sticky.is_rigid {
                self.tap_rigidly(block, turning, levels, [dwell_s, peck], out)
            } else {
                self.tap_with_holder(block, turning, levels, dwell_s, out)
            };
        }
        if peck > 0.0 {
            self.pecks(block, hole, peck, out)?;
        }
        self.along(block, normal, hole.bottom, Pace::Feed, out)?;
        match cycle {
            CannedCycle::DrillDwell | CannedCycle::BoreDwell => {
                self.push(out, ItemKind::Dwell(dwell_s));
            }
            CannedCycle::BoreStop => {
                self.push(out, ItemKind::Dwell(dwell_s));
                self.push(out, code(5));
            }
            _ => {}
        }
        let pace = match cycle {
            CannedCycle::Bore => {
                self.along(block, normal, hole.r, Pace::Feed, out)?;
                Pace::Rapid
            }
            CannedCycle::BoreDwell => Pace::Feed,
            _ => Pace::Rapid,
        };
        self.along(block, normal, hole.clear, pace, out)?;
        if let (CannedCycle::BoreStop, Some(turning)) = (cycle, self.state.spindle.turning) {
            self.push(out, code(turning.code()));
        }
        Ok(())
    }

    /// All depths of G73 and G83 but the last.
    fn pecks(&mut self, block: &Block, hole: Hole, peck: f64, out: &mut Vec<Item>) -> Outcome<()> {
        let normal = self.state.modal.plane.normal();
        let mut depth = hole.r - peck;
        // A last peck of less is rounding.
        while depth > hole.bottom + BOTTOM_MM {
            self.along(block, normal, depth, Pace::Feed, out)?;
            if hole.sticky.cycle == CannedCycle::Peck {
                self.along(block, normal, hole.r, Pace::Rapid, out)?;
            }
            // Never above the R plane, which a small Q would lead to.
            let back = (depth + BACK_OFF_MM).min(hole.r);
            self.along(block, normal, back, Pace::Rapid, out)?;
            depth -= peck;
        }
        Ok(())
    }
}

const fn name(cycle: CannedCycle) -> &'static str {
    match cycle {
        CannedCycle::ChipBreak => "G73",
        CannedCycle::TapLeft => "G74",
        CannedCycle::Drill => "G81",
        CannedCycle::DrillDwell => "G82",
        CannedCycle::Peck => "G83",
        CannedCycle::TapRight => "G84",
        CannedCycle::Bore => "G85",
        CannedCycle::BoreStop => "G86",
        CannedCycle::BoreDwell => "G89",
    }
}
