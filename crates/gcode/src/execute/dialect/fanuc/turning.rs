//! G90, G92 and G94 of a lathe: one pass and the way back to where it began.
//!
//! ```text
//!  G90  ●◄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┐   start       G94  ●◄──────── out, at rapid
//!       ┆ X                  ┆ Z, at rapid       ┆ Z         ▲
//!       ▼                    ┆                   ▼           │ Z, at feed
//!       ────────────────────►│ X, at feed        ───────────►
//!        to X Z, at feed                          to X Z, at feed
//! ```
//!
//! R is where the pass begins less where it ends: a radius in G90 and G92, along Z in G94. I of G90 and G92
//! and K of G94 are the same. Blocks
//! with X, Z, U, W or R repeat the cycle from the same place, until another code of motion.

use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::Pace;
use crate::execute::state::fanuc_modal::TurningWords;
use crate::execute::state::open_thread::Groove;
use crate::syntax::block::Block;
use crate::syntax::modes::Turning;
use crate::syntax::word_check::{missing, none_wrong};

/// How far a thread runs out of its groove, in leads (parameter 5130).
const RUNOUT_LEADS: f64 = 1.0;

impl Interpreter {
    pub(crate) fn turning(
        &mut self,
        block: &Block,
        cycle: Turning,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let start = self.state.offsets.to_program(self.state.position);
        let words = self.turning_words(block, cycle)?;
        self.state.fanuc.turning = Some(words);
        let at = |x: f64, z: f64| {
            let mut point = start;
            (point[Axis::X.index()], point[Axis::Z.index()]) = (x, z);
            point
        };
        let [from_x, from_z] = [start[0], start[2]];
        let TurningWords { x, z, taper, .. } = words;
        let ways = match cycle {
            Turning::Thread => return self.turned_thread(block, start, words, out),
            Turning::Turn => [
                (at(x + taper, from_z), Pace::Rapid),
                (at(x, z), Pace::Feed),
                (at(from_x, z), Pace::Feed),
                (start, Pace::Rapid),
            ],
            Turning::Face => [
                (at(from_x, z + taper), Pace::Rapid),
                (at(x, z), Pace::Feed),
                (at(x, from_z), Pace::Feed),
                (start, Pace::Rapid),
            ],
        };
        for (point, pace) in ways {
            let target = self.state.offsets.to_machine(point);
            self.straight(block, target, pace, out)?;
        }
        Ok(())
    }

    /// The words of the block, and those kept from the block before.
    fn turning_words(&self, block: &Block, cycle: Turning) -> Outcome<TurningWords> {
        let last = self.state.fanuc.turning.filter(|last| last.cycle == cycle);
        let values = self.ends_of_cycle(block)?;
        let need = |value: Option<f64>, word: &str| {
            value.ok_or_else(|| {
                missing(
                    block.motion_span(),
                    "the cycle",
                    word,
                    "where the pass ends",
                )
            })
        };
        let own = if cycle == Turning::Face { b'K' } else { b'I' };
        if block.get(own).is_some() && block.get(b'R').is_some() {
            let message = format!("{} beside R", char::from(own));
            let code = DiagnosticCode::AmbiguousWord;
            return Err(BlockDiagnostic::new(code, block.span(own), message)
                .because("both are the taper of the pass")
                .help("write one of them"));
        }
        let taper = block.get(b'R').or_else(|| block.get(own));
        let taper = taper.map(|taper| taper * self.state.modal.units.mm());
        Ok(TurningWords {
            cycle,
            x: need(values[0].or(last.map(|last| last.x)), "X")?,
            z: need(values[2].or(last.map(|last| last.z)), "Z")?,
            taper: taper.or(last.map(|last| last.taper)).unwrap_or(0.0),
        })
    }

    /// G92: the groove, with a way out at 45 degrees at its end, unless M24 is in force.
    fn turned_thread(
        &mut self,
        block: &Block,
        start: AxisVector,
        words: TurningWords,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let TurningWords { x, z, taper, .. } = words;
        let lead_mm = self.fanuc_lead_mm(block, "G92")?;
        let [from_x, from_z] = [start[0], start[2]];
        let (way_z, side) = (z - from_z, 1.0_f64.copysign(from_x - x));
        let rises_mm = side * (from_x - x);
        let leads = if self.state.fanuc.ends_thread_straight {
            0.0
        } else {
            RUNOUT_LEADS
        };
        let out_mm = (leads * lead_mm).min(rises_mm);
        none_wrong(
            block,
            "G92",
            [
                (b'F', lead_mm <= 0.0, "a lead above zero"),
                (b'Z', way_z.abs() <= out_mm, "an end that is further away"),
                (
                    b'R',
                    taper.abs() > way_z.abs(),
                    "a taper of 45 degrees at most",
                ),
                (
                    b'X',
                    rises_mm <= 0.0,
                    "an X below or above where the tool stands",
                ),
            ],
        )?;
        let at = |x: f64, z: f64| {
            let mut point = start;
            (point[0], point[2]) = (x, z);
            point
        };
        let exit_z = z - out_mm * way_z.signum();
        let exit_x = x + taper / way_z.abs() * out_mm;
        let begin = at(x + taper, from_z);
        self.rapid_to(block, begin, out)?;
        let mut from = begin;
        let points = [at(exit_x, exit_z), at(exit_x + side * out_mm, z)];
        // M24: to the end along the thread, and out at rapid.
        let points = if out_mm > 0.0 {
            &points[..]
        } else {
            &points[..1]
        };
        let grooves: Vec<Groove> = points
            .iter()
            .map(|point| {
                let way = point - from;
                from = *point;
                Groove {
                    end: self.state.offsets.to_machine(*point),
                    pitch_mm: lead_mm * way[0].hypot(way[2]) / way[0].abs().max(way[2].abs()),
                    corner_mm: 0.25 * out_mm,
                    line: self.line,
                }
            })
            .collect();
        let phase = self.phase(block)?;
        self.pass(block, &grooves, phase, out)?;
        self.rapid_to(block, at(from_x, z), out)?;
        self.rapid_to(block, start, out)
    }
}
