//! The path front: items in, pieces of smooth path and rests out.
//!
//! Lines at a feedrate in continuous mode go through the compressor, which makes smooth curves of
//! dense ones and gives back the lines that stay. These, and every other segment, wait for the next
//! one, since the junction between the two tells where each ends. What comes out depends on the
//! order of the items alone.

use super::assembly::{Assembly, chord_speed};
use super::dense_blocks::DenseBlocks;
use super::pending::Pending;
use crate::PlanError;
use crate::intake::{Intake, check_dwell};
use crate::joints::JointRows;
use crate::on_path::pieces::{Element, Shape, SpeedRule};
use crate::programmed_rate::{ProgrammedRate, axes_speed, axes_speed_along};
use crate::rest::{Rest, RestKind};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Item, ItemKind, Override, PathMode, ProgramLine, Rate, Settings};

/// Turns items into pieces and rests.
#[derive(Debug, Clone)]
pub(crate) struct PathFront {
    intake: Intake,
    /// Dense blocks go through the compressor on their way to the assembly.
    dense: DenseBlocks,
    assembly: Assembly,
    last_rate: Rate,
}

impl PathFront {
    pub(crate) const fn new(settings: Settings, start: AxisVector) -> Self {
        Self {
            intake: Intake::new(start),
            dense: DenseBlocks::new(),
            assembly: Assembly::new(settings),
            last_rate: Rate::Rapid,
        }
    }

    /// The same, before its first item, for joints that are not the axes.
    pub(crate) fn with_joints(mut self, joints: Option<JointRows>) -> Self {
        self.assembly.joints = joints;
        self
    }

    /// Plans what follows with another override.
    pub(crate) fn set_override(&mut self, wanted: Override) {
        self.assembly.set_override(wanted);
    }

    /// Takes an item and appends what it decides.
    pub(crate) fn push(&mut self, item: &Item, out: &mut Vec<Element>) -> Result<(), PlanError> {
        match item.kind {
            ItemKind::Move {
                ref segment,
                rate,
                mode,
            } => {
                self.push_move(item.program_line(), segment, rate, mode, out)?;
            }
            ItemKind::Dwell(dwell_t) => {
                check_dwell(item.line, dwell_t)?;
                self.rest(RestKind::Dwell(dwell_t), item.program_line(), out);
            }
            ItemKind::Event(event) if event.is_at_rest() => {
                self.rest(RestKind::Event(event), item.program_line(), out);
            }
            ItemKind::Event(event) => self.assembly.events.push(event),
        }
        self.assembly.line = item.program_line();
        Ok(())
    }

    /// No more items: the path ends at rest.
    pub(crate) fn finish(&mut self, out: &mut Vec<Element>) {
        self.rest(RestKind::End, self.assembly.line, out);
    }

    fn push_move(
        &mut self,
        line: ProgramLine,
        segment: &Segment,
        rate: Rate,
        mode: PathMode,
        out: &mut Vec<Element>,
    ) -> Result<(), PlanError> {
        self.intake.check_move(line.number, segment, rate, mode)?;
        self.last_rate = rate;
        let mut segment = *segment;
        if !self.intake.takes(&mut segment) {
            return Ok(());
        }
        let length_s = segment.length();
        let assembly = &mut self.assembly;
        let programmed = |settings: &Settings| ProgrammedRate {
            rate,
            axes_v: axes_speed(&segment, &settings.limits),
        };
        if rate.is_synchronised() {
            // A pass is not interrupted, however much faster that were.
            assembly.blocks.lose();
        }
        if assembly.blocks.keeps() {
            let rule = assembly.rule(&segment, programmed(&assembly.settings), mode);
            let shape = Shape::Segment(segment);
            let mut piece = assembly.piece(shape, (0.0, length_s), rule, line);
            piece.events.clone_from(&assembly.events);
            assembly.blocks.push(piece);
        }
        if self
            .dense
            .compress(assembly, (&segment, line), rate, mode, out)
        {
            return Ok(());
        }
        self.dense.end_run(assembly, out);
        let rate = programmed(&assembly.settings);
        let settings = &assembly.settings;
        let tolerance_mm = mode.tolerance_mm(settings.tolerance_mm);
        let mm_per_deg = settings.direction.mm_per_deg(tolerance_mm);
        let chord_v = chord_speed(&segment, tolerance_mm, mm_per_deg, settings);
        let mut next = Pending {
            segment,
            length_s,
            rate,
            rate_v: rate.under(assembly.wanted).min(chord_v),
            line,
            lines: Vec::new(),
            mode,
            trimmed_s: 0.0,
            events: core::mem::take(&mut assembly.events),
            error_mm: segment.error_mm(),
            continues: [false; 2],
        };
        if let Some(before) = assembly.pending.take() {
            assembly.join(before, &mut next, out);
        }
        assembly.pending = Some(next);
        Ok(())
    }

    /// Ends the path at rest.
    fn rest(&mut self, kind: RestKind, line: ProgramLine, out: &mut Vec<Element>) {
        let assembly = &mut self.assembly;
        self.dense.end_run(assembly, out);
        assembly.put_pending(out);
        let stops = assembly.blocks.take_all(self.intake.position());
        assembly.put_stops(stops, out);
        self.put_remainder(out);
        let assembly = &mut self.assembly;
        for event in core::mem::take(&mut assembly.events) {
            out.push(Element::Rest(Rest {
                kind: RestKind::Event(event),
                line,
            }));
        }
        out.push(Element::Rest(Rest { kind, line }));
        assembly.blocks.restart();
    }

    /// Makes up for moves that were too short to be made by themselves.
    fn put_remainder(&mut self, out: &mut Vec<Element>) {
        let segment = self.intake.remainder();
        let length_s = segment.length();
        if length_s <= 0.0 {
            return;
        }
        let line = self.assembly.line;
        out.push(Element::Rest(Rest {
            kind: RestKind::Corner,
            line,
        }));
        self.intake.make_up();
        let d1 = segment.jet(0.0).d1;
        let rate = ProgrammedRate {
            rate: self.last_rate,
            axes_v: axes_speed_along(&d1, &self.assembly.settings.limits),
        };
        let rule = SpeedRule::Straight { d1, rate };
        let shape = Shape::Segment(segment);
        let piece = self.assembly.piece(shape, (0.0, length_s), rule, line);
        out.push(Element::Piece(piece));
    }
}
