//! The words of canned cycles, and those of them that are kept from block to block.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::auxiliary::order::fanuc_dwell;
use crate::execute::block_words::has_number_of_system;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::sticky_words::StickyWords;
use crate::execute::tapping_cycle::tap_turns;
use crate::setup::fanuc::PointInput;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{CannedCycle, Units};
use crate::syntax::word_check::{missing, negative, unused};

/// Depths without a point above this are in doubt on a FANUC mill.
const MOST_PECK: f64 = 99.0;

impl Interpreter {
    /// The words of the block, with those kept from the block before where they are missing.
    pub(super) fn keep(&mut self, block: &Block, cycle: CannedCycle) -> Outcome<StickyWords> {
        let span = block.motion_span();
        let name = name(cycle, block.is_lathe);
        let scale = self.state.modal.units.mm();
        // R, Z and P of FANUC stay until G80, whichever cycle is next.
        let before = self.state.cycles.last;
        let last = before.filter(|last| last.cycle == cycle);
        let stays = before.filter(|_| block.dialect == Dialect::Fanuc).or(last);
        let normal = self.state.modal.plane.normal();
        let letter = u8::try_from(normal.letter()).unwrap_or(b'Z');
        let get = |letter: u8, scale: f64, sticky: Option<f64>, meaning: &str| {
            let word = block.get(letter).map(|value| value * scale);
            let text = char::from(letter).to_string();
            word.or(sticky)
                .ok_or_else(|| missing(span, name, &text, meaning))
        };
        let last_r = stays.map(|l| l.r).or(block.is_lathe.then_some(0.0));
        let r = get(b'R', scale, last_r, "the plane above the hole")?;
        let peck_scale = scale * self.peck_unit(block)?;
        let depth = get(
            letter,
            scale,
            stays.map(|l| l.depth),
            "the bottom of the hole",
        )?;
        let mut sticky = StickyWords {
            cycle,
            r,
            says_r: block.get(b'R').is_some() || stays.is_some_and(|l| l.says_r),
            depth,
            levels_mm: None,
            dwell_s: 0.0,
            peck: 0.0,
            less: 0.0,
            least: 0.0,
            out_after: 0.0,
            shift_mm: [0.0; 2],
            is_rigid: false,
            starts_spindle: false,
        };
        let last_dwell = stays.map(|l| l.dwell_s);
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
                let pecks =
                    |l: &StickyWords| matches!(l.cycle, CannedCycle::ChipBreak | CannedCycle::Peck);
                self.peck_words(block, peck_scale, stays.filter(pecks), &mut sticky)?;
            }
            CannedCycle::FineBore | CannedCycle::BackBore => {
                sticky.shift_mm = self.bore_shift(block, cycle, last)?;
            }
            CannedCycle::Drill | CannedCycle::Bore => {}
        }
        check_haas_words(block, cycle)?;
        sticky.out_after = self.haas_way_out(block, cycle, last)?;
        if block.dialect == Dialect::Fanuc {
            // In every cycle.
            let word = fanuc_dwell(block).filter(|_| !has_number_of_system(block));
            sticky.dwell_s = word.or(last_dwell).unwrap_or(0.0);
        }
        if sticky.dwell_s < 0.0 {
            return Err(negative(block, b'P', "the dwell"));
        }
        self.settle_rigidity(block, last.as_ref(), &mut sticky)?;
        Ok(sticky)
    }

    /// The depths of G73 and G83: Q, or I, J and K of Haas.
    fn peck_words(
        &self,
        block: &Block,
        scale: f64,
        last: Option<StickyWords>,
        sticky: &mut StickyWords,
    ) -> Outcome<()> {
        if block.get(b'I').is_some() {
            return self.haas_pecks(block, sticky);
        }
        let is_fanuc = block.dialect == Dialect::Fanuc;
        let written = block.get(b'Q').map(|peck| peck * scale);
        // It is a depth there, whatever its sign.
        let written = written.map(|peck| if is_fanuc { peck.abs() } else { peck });
        if let Some(last) = last.filter(|last| written.is_none() && last.least > 0.0) {
            (sticky.peck, sticky.less, sticky.least) = (last.peck, last.less, last.least);
            return Ok(());
        }
        let name = name(sticky.cycle, block.is_lathe);
        // Without Q that of a lathe drills at once.
        let at_once = block.is_lathe.then_some(0.0);
        sticky.peck = written
            .or(last.map(|last| last.peck))
            .or(at_once)
            .ok_or_else(|| missing(block.motion_span(), name, "Q", "how deep to go at a time"))?;
        if sticky.peck > 0.0 || block.is_lathe && written.is_none() {
            return Ok(());
        }
        let message = format!("{name} goes no deeper");
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, block.span(b'Q'), message)
                .because("Q is how deep it goes at a time, and must be above zero")
                .help("write a Q above zero"),
        )
    }

    /// I, J and K of Haas' G73 and G83: the first depth, by how much each is less, the least.
    fn haas_pecks(&self, block: &Block, sticky: &mut StickyWords) -> Outcome<()> {
        let mm = self.state.modal.units.mm();
        let value = |letter: u8| block.get(letter).map(|value| value * mm);
        if block.get(b'Q').is_some() {
            return Err(unused('Q', block.span(b'Q')));
        }
        sticky.peck = value(b'I').unwrap_or(0.0);
        sticky.less = value(b'J').unwrap_or(0.0);
        sticky.least = value(b'K').unwrap_or(sticky.peck);
        let is_possible = sticky.least > 0.0 && sticky.peck >= sticky.least && sticky.less >= 0.0;
        if is_possible {
            return Ok(());
        }
        let message = "depths that are not possible";
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, block.span(b'I'), message)
                .because(
                    "I is the first depth, J by how much each one is less, K the least of them",
                )
                .help("write I and K above zero, K no more than I, and J of zero or more"),
        )
    }

    /// K of a Haas without I, which does not count holes: how deep G73 goes before it comes out to R.
    fn haas_way_out(
        &self,
        block: &Block,
        cycle: CannedCycle,
        last: Option<StickyWords>,
    ) -> Outcome<f64> {
        if !self.counts_holes_by_l(block) || block.get(b'I').is_some() {
            return Ok(0.0);
        }
        let Some(deep) = block.get(b'K') else {
            return Ok(last.map_or(0.0, |last| last.out_after));
        };
        if cycle == CannedCycle::ChipBreak && deep > 0.0 {
            return Ok(deep * self.state.modal.units.mm());
        }
        let message = format!("K{deep} in {} of a Haas", name(cycle, block.is_lathe));
        Err(
            BlockDiagnostic::new(DiagnosticCode::UnusedWord, block.span(b'K'), message)
                .because("K is the least depth there beside I, and in G73 how deep it goes before it comes out to R; L counts holes")
                .help("write L if holes are to be repeated"),
        )
    }

    /// A Haas repeats holes by L alone.
    pub(super) fn counts_holes_by_l(&self, block: &Block) -> bool {
        block.dialect == Dialect::Fanuc && self.options.fanuc.is_haas()
    }

    /// The R plane of a lathe of system A: R is the way from the initial level, to FANUC. To Haas it is the
    /// place; a way that would lead away from the hole is one, too.
    pub(super) fn r_of_lathe(&self, initial: f64, sticky: &StickyWords) -> f64 {
        let is_haas = self.options.fanuc.is_haas();
        if sticky.says_r && (is_haas || sticky.r > 0.0) {
            sticky.r
        } else {
            initial + sticky.r
        }
    }

    /// What Q counts: lengths, and on a FANUC without a point least increments where all coordinates
    /// do, and on lathes.
    pub(super) fn peck_unit(&self, block: &Block) -> Outcome<f64> {
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
                    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, block.span(b'Q'), message)
                        .because(
                            "it is millimetres on one control, and least increments on another",
                        )
                        .help("write the point, or set `point` of [program] in the configuration"),
                )
            }
            PointInput::Calculator | PointInput::Unsaid => Ok(1.0),
        }
    }
}

/// Refuses I and J in cycles that do not have them.
fn check_haas_words(block: &Block, cycle: CannedCycle) -> Outcome<()> {
    let shifts = cycle.goes_aside();
    let takes_i = shifts || matches!(cycle, CannedCycle::ChipBreak | CannedCycle::Peck);
    let takes_j = shifts || takes_i && block.get(b'I').is_some() || tap_turns(cycle).is_some();
    for (letter, is_taken) in [(b'I', takes_i), (b'J', takes_j)] {
        if block.get(letter).is_some() && !is_taken {
            return Err(unused(char::from(letter), block.span(letter)));
        }
    }
    Ok(())
}

pub(crate) const fn name(cycle: CannedCycle, is_lathe: bool) -> &'static str {
    match cycle {
        CannedCycle::ChipBreak => "G73",
        CannedCycle::TapLeft if is_lathe => "G184",
        CannedCycle::TapLeft => "G74",
        CannedCycle::FineBore => "G76",
        CannedCycle::Drill => "G81",
        CannedCycle::DrillDwell => "G82",
        CannedCycle::Peck => "G83",
        CannedCycle::TapRight => "G84",
        CannedCycle::Bore => "G85",
        CannedCycle::BoreStop => "G86",
        CannedCycle::BackBore => "G87",
        CannedCycle::BoreDwell => "G89",
    }
}
