//! Canned cycles: G73, G74, G76 of FANUC, G81 to G86, G89.
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
//! needed; a FANUC goes across where it stands, and back to the initial level below R, too.
//!
//! | cycle | down | at the bottom | out |
//! |---|---|---|---|
//! | G73 | Q at a time, 0.254 mm back after each | – (of a Haas dwell P) | rapid |
//! | G76 of FANUC | feed | dwell P, spindle stops at its angle (M19), aside | rapid, back, spindle on |
//! | G87 of FANUC | beside the wall, rapid | back, spindle on, feed up to Z, dwell P | as G76, to the initial level |
//! | G74, G84 | feed, overrides off | spindle reversed, dwell P | feed, then reversed again; of FANUC: feed to R, rapid from there |
//! | the same, rigidly | behind the spindle | – | behind the spindle to R, rapid from there |
//! | G81 | feed | – | rapid |
//! | G82 | feed | dwell P | rapid |
//! | G83 | Q at a time, out to R after each | – (of a Haas and a lathe of FANUC dwell P) | rapid |
//! | G85 | feed | – (of a lathe of FANUC dwell P) | feed to R (of a lathe of FANUC twice that), rapid from there |
//! | G86 | feed | dwell P, spindle stop | rapid, spindle on |
//! | G89 | feed | dwell P | feed; of FANUC: feed to R, rapid from there |

use glidepath_geometry::{AXES, Axis, AxisVector, Plane};
use glidepath_program::{Event, Item, ItemKind, PathMode};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::Pace;
use crate::execute::state::sticky_words::{CycleSeries, StickyWords};
use crate::execute::tapping_cycle::tap_turns;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{CannedCycle, Distance, Retract};
use crate::syntax::word_check::{whole, whole_count};

/// How far the tool backs off from a depth it has reached, mm.
const BACK_OFF_MM: f64 = 0.254;
/// Depths as near to the bottom as this are the bottom, mm.
const BOTTOM_MM: f64 = 1e-6;
/// Places as near to each other as this are one, mm.
const HERE_MM: f64 = 1e-6;
/// Most pecks of one block.
const MAX_PECKS: f64 = 10_000.0;
/// Most holes of one block.
pub(super) const MAX_HOLES: u32 = 10_000;

/// One hole: levels in program coordinates along the normal axis, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hole {
    pub(super) sticky: StickyWords,
    pub(super) r: f64,
    pub(super) bottom: f64,
    pub(super) clear: f64,
}

/// Depths of G73 and G83 in the units of the program's coordinates, which a FANUC's G51 does not scale.
#[derive(Debug, Clone, Copy)]
struct Pecks {
    first: f64,
    less: f64,
    least: f64,
    out_after: f64,
    back: f64,
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
        let mut sticky = self.keep(block, cycle)?;
        self.check_cycle(block, &sticky)?;
        // Beside I of depths, K is the least depth of Haas.
        let is_depth = block.get(b'I').is_some() && !cycle.goes_aside();
        let repeats = if is_depth || self.counts_holes_by_l(block) {
            whole(block, b'L', MAX_HOLES)?
        } else {
            whole_count(block, b'K', MAX_HOLES)?.or(whole(block, b'L', MAX_HOLES)?)
        };
        let holes = match repeats {
            // FANUC keeps the words for the blocks that follow.
            Some(0) if block.dialect == Dialect::Fanuc => 0,
            Some(0) => {
                let message = "a cycle without holes";
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::CannedCycle,
                    block.span(b'L'),
                    message,
                )
                .because("L0 asks for no repetition at all")
                .help("write L1 or more, or leave L out"));
            }
            holes => holes.unwrap_or(1),
        };
        let incremental = self.state.modal.distance == Distance::Incremental;
        let initial = self.state.cycles.initial;
        let initial = initial.unwrap_or_else(|| self.level_before());
        let [r, bottom] = if block.has_increments() && !incremental {
            [self.r_of_lathe(initial, &sticky), sticky.depth]
        } else {
            self.levels(block, &sticky, initial)
        };
        sticky.levels_mm = Some([r, bottom]);
        if cycle == CannedCycle::BackBore {
            self.check_back_bore(block, [r, bottom])?;
        } else {
            self.check_levels(block, [r, bottom])?;
        }
        self.state.cycles = CycleSeries {
            initial: Some(initial),
            last: Some(sticky),
        };
        if holes == 0 {
            self.check_stored_place(block)?;
            return Ok(());
        }
        let clear = self.way_out(block, cycle, [initial, r, bottom])?;
        let hole = Hole {
            sticky,
            r,
            bottom,
            clear,
        };
        let mut places = self.places(block, holes)?;
        self.repeat_polar(block, &mut places);
        self.make_holes(block, hole, &places, out)
    }

    /// Makes the holes at those places of the program, with exact corners.
    pub(super) fn make_holes(
        &mut self,
        block: &Block,
        hole: Hole,
        places: &[[Option<f64>; AXES]],
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let mode = core::mem::replace(&mut self.state.modal.path_mode, PathMode::ExactPath);
        if !hole.sticky.is_rigid {
            self.spindle_from_taps(out);
        }
        let made = self.holes(block, hole, places, out);
        self.state.modal.path_mode = mode;
        made
    }

    fn holes(
        &mut self,
        block: &Block,
        hole: Hole,
        places: &[[Option<f64>; AXES]],
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if hole.sticky.peck > 0.0 {
            let pecks = self.pecks_of(&hole.sticky);
            let least = if pecks.least > 0.0 {
                pecks.least
            } else {
                pecks.first
            };
            let holes = u32::try_from(places.len()).unwrap_or(u32::MAX);
            let pecks = (hole.r - hole.bottom) / least * f64::from(holes);
            if pecks > MAX_PECKS {
                let message = format!("the block asks for {pecks:.0} pecks");
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::CannedCycle,
                    block.span(b'Q'),
                    message,
                )
                .because(format!("one block makes at most {MAX_PECKS}"))
                .help("write a larger Q"));
            }
        }
        let normal = self.state.modal.plane.normal();
        let program = self.state.offsets.to_program(self.state.position);
        let mut level = program[normal.index()];
        // Up first: a rapid across below the level the cycle asks for could hit something. A FANUC goes across at
        // the level where it stands.
        let is_fanuc = block.dialect == Dialect::Fanuc;
        let goes_across = is_fanuc && hole.sticky.cycle != CannedCycle::BackBore;
        let safe = level.max(if self.state.modal.retract == Retract::Initial {
            hole.clear
        } else {
            hole.r
        });
        if safe > level && !goes_across {
            level = safe;
            self.along(block, normal, level, Pace::Rapid, out)?;
        }
        for place in places {
            let mut place = *place;
            let is_absolute = self.state.modal.distance == Distance::Absolute;
            if is_absolute {
                self.add_coordinate_before_turn(block, &mut place)?;
            }
            let mut target = self.absolute_target(&place);
            if is_absolute {
                target = self.rolled_over(block, target);
            }
            let way = target - self.state.position;
            let (first, second) = self.state.modal.plane.axes();
            let is_aside = [first, second]
                .iter()
                .any(|axis| way[axis.index()].abs() > HERE_MM);
            self.doubts.crosses_below_r |= goes_across && is_aside && level < hole.r - HERE_MM;
            self.straight(block, target, Pace::Rapid, out)?;
            if hole.sticky.cycle == CannedCycle::BackBore {
                let levels = [hole.r, hole.bottom, hole.clear];
                self.bore_back(block, &hole.sticky, levels, out)?;
                level = hole.clear;
                continue;
            }
            if level > hole.r || level < hole.r && goes_across {
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
            if hole.sticky.is_rigid {
                let levels = [hole.bottom, hole.clear];
                return self.tap_rigidly(block, turning, levels, [dwell_s, peck], out);
            }
            // Of a FANUC the thread ends at R.
            if block.dialect == Dialect::Fanuc {
                self.tap_with_holder(block, turning, [hole.bottom, hole.r], dwell_s, out)?;
                return self.along(block, normal, hole.clear, Pace::Rapid, out);
            }
            let levels = [hole.bottom, hole.clear];
            return self.tap_with_holder(block, turning, levels, dwell_s, out);
        }
        if peck > 0.0 {
            self.pecks(block, hole, out)?;
        }
        self.along(block, normal, hole.bottom, Pace::Feed, out)?;
        if cycle == CannedCycle::FineBore {
            return self.leave_bore(block, &hole.sticky, hole.clear, out);
        }
        match cycle {
            CannedCycle::DrillDwell | CannedCycle::BoreDwell => {
                self.push(out, ItemKind::Dwell(dwell_s));
            }
            CannedCycle::BoreStop => {
                self.push(out, ItemKind::Dwell(dwell_s));
                self.push(out, code(5));
            }
            _ if hole.sticky.dwell_s > 0.0 && self.dwells_beside(block, cycle) => {
                self.push(out, ItemKind::Dwell(hole.sticky.dwell_s));
            }
            _ => {}
        }
        let pace = match cycle {
            CannedCycle::Bore => {
                let feed = self.state.modal.feed;
                // A lathe of FANUC comes out at twice the feed.
                let is_haas = self.options.fanuc.is_haas();
                if block.is_lathe && !is_haas {
                    self.state.modal.feed = feed.map(|feed| feed.times(2.0));
                }
                let made = self.along(block, normal, hole.r, Pace::Feed, out);
                self.state.modal.feed = feed;
                made?;
                Pace::Rapid
            }
            // FANUC's goes on at rapid above R.
            CannedCycle::BoreDwell if block.dialect == Dialect::Fanuc => {
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

    /// True where P, which other cycles need, may be a dwell at the bottom: G73 and G83 of a Haas, G83 and G85
    /// of FANUC's lathes.
    const fn dwells_beside(&self, block: &Block, cycle: CannedCycle) -> bool {
        let is_haas = self.options.fanuc.is_haas();
        let is_fanuc = matches!(block.dialect, Dialect::Fanuc);
        is_fanuc
            && match cycle {
                CannedCycle::ChipBreak | CannedCycle::Peck => is_haas || block.is_lathe,
                CannedCycle::Bore => !is_haas && block.is_lathe,
                _ => false,
            }
    }

    /// The depths of a cycle as coordinates count.
    fn pecks_of(&self, sticky: &StickyWords) -> Pecks {
        let normal = self.state.modal.plane.normal();
        let scale = match self.state.offsets.fanuc.frames.scale {
            Some(_) => self.state.offsets.frame.scale_along(normal),
            None => 1.0,
        };
        Pecks {
            first: sticky.peck / scale,
            less: sticky.less / scale,
            least: sticky.least / scale,
            out_after: sticky.out_after / scale,
            back: BACK_OFF_MM / scale,
        }
    }

    /// All depths of G73 and G83 but the last.
    fn pecks(&mut self, block: &Block, hole: Hole, out: &mut Vec<Item>) -> Outcome<()> {
        let normal = self.state.modal.plane.normal();
        let pecks = self.pecks_of(&hole.sticky);
        let mut stroke = pecks.first;
        let mut depth = hole.r - stroke;
        let mut out_at = hole.r;
        // A last peck of less is rounding.
        while depth > hole.bottom + BOTTOM_MM {
            self.along(block, normal, depth, Pace::Feed, out)?;
            let is_deep = pecks.out_after > 0.0 && out_at - depth >= pecks.out_after - BOTTOM_MM;
            if is_deep {
                out_at = depth;
            }
            if hole.sticky.cycle == CannedCycle::Peck || is_deep {
                self.along(block, normal, hole.r, Pace::Rapid, out)?;
            }
            // Never above the R plane, which a small Q would lead to.
            let back = (depth + pecks.back).min(hole.r);
            self.along(block, normal, back, Pace::Rapid, out)?;
            stroke = (stroke - pecks.less).max(pecks.least);
            depth -= stroke;
        }
        Ok(())
    }
}
