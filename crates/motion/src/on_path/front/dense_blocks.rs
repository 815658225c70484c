//! The way of dense blocks through the compressor, to pieces of path.
//!
//! Lines wait for what follows them, like any segment: two in a row meet at a corner. Spans of a
//! spline continue what comes before them and are put out at once.

use super::assembly::Assembly;
use super::pending::Pending;
use crate::feed_axes::feed_axes;
use crate::on_path::junction::chord_error_mm;
use crate::on_path::pieces::{CurveRule, Element, Shape, SpeedRule};
use crate::on_path::spline_tube::{Change, Compressor, Cut, PartShape, SplinePart};
use crate::programmed_rate::{ProgrammedRate, axes_speed};
use crate::rest::{Rest, RestKind};
use core::ops::Range;
use glidepath_geometry::{AxisVector, Cubic, Segment};
use glidepath_program::{Event, PathMode, ProgramLine, Rate, Smoothing};

/// A run of blocks under compression.
#[derive(Debug, Clone)]
struct DenseRun {
    compressor: Compressor,
    manner: Manner,
    /// The rate of the last block taken.
    rate: Rate,
}

/// What all blocks of a run have in common.
#[derive(Debug, Clone, PartialEq)]
struct Manner {
    mode: PathMode,
    /// The axes that measure the feed.
    feed_axes: Range<usize>,
}

/// Dense blocks on their way through the compressor.
#[derive(Debug, Clone)]
pub(crate) struct DenseBlocks {
    /// The run of blocks under compression.
    run: Option<DenseRun>,
    /// The rate of its block that was last put out.
    run_rate: ProgrammedRate,
    /// No other axis than X, Y, Z has moved in such a run.
    is_linear: bool,
}

impl DenseBlocks {
    pub(crate) const fn new() -> Self {
        Self {
            run: None,
            run_rate: ProgrammedRate {
                rate: Rate::Rapid,
                axes_v: f64::INFINITY,
            },
            is_linear: true,
        }
    }

    /// Takes a block into the run at hand, or starts another; false if it is none for compression.
    pub(crate) fn compress(
        &mut self,
        assembly: &mut Assembly,
        (segment, line): (&Segment, ProgramLine),
        rate: Rate,
        mode: PathMode,
        out: &mut Vec<Element>,
    ) -> bool {
        let (Segment::Line(block), Some(_)) = (segment, rate.feed_v()) else {
            return false;
        };
        let is_continuous = matches!(mode, PathMode::Continuous { .. });
        if !is_continuous || assembly.settings.smoothing == Smoothing::ExactStop {
            return false;
        }
        let displacement = block.displacement();
        let manner = Manner {
            mode,
            feed_axes: feed_axes(&displacement),
        };
        let goes_on = self
            .run
            .as_ref()
            .is_some_and(|run| run.manner == manner && run.compressor.takes(&displacement));
        if !goes_on {
            self.end_run(assembly, out);
        }
        self.is_linear &= displacement.iter().skip(3).all(|x| *x == 0.0);
        let is_linear = self.is_linear;
        let mut is_new = false;
        // A run is large: it stays where it is.
        let run = self.run.get_or_insert_with(|| {
            is_new = true;
            let tolerance_mm = mode.tolerance_mm(assembly.settings.tolerance_mm);
            let (start, settings) = (block.start, &assembly.settings);
            DenseRun {
                compressor: Compressor::new(
                    start,
                    manner.feed_axes.clone(),
                    is_linear,
                    tolerance_mm,
                    settings,
                ),
                manner,
                rate,
            }
        });
        let is_change = is_new || run.rate != rate || !assembly.events.is_empty();
        let change = is_change.then(|| Change {
            rate: ProgrammedRate {
                rate,
                axes_v: f64::INFINITY,
            },
            events: core::mem::take(&mut assembly.events),
        });
        run.rate = rate;
        run.compressor.push(&block.end, line, change);
        run.put_parts(&mut self.run_rate, assembly, out);
        true
    }

    /// Ends the run at hand, if any: all of it is put out, but for the last line.
    pub(crate) fn end_run(&mut self, assembly: &mut Assembly, out: &mut Vec<Element>) {
        if let Some(mut run) = self.run.take() {
            run.compressor.finish();
            run.put_parts(&mut self.run_rate, assembly, out);
        }
    }
}

impl DenseRun {
    /// Puts out what is decided; `run_rate`: that of the block put out last.
    fn put_parts(
        &mut self,
        run_rate: &mut ProgrammedRate,
        assembly: &mut Assembly,
        out: &mut Vec<Element>,
    ) {
        let manner = &self.manner;
        for part in self.compressor.parts() {
            PartOutput { run_rate, manner }.put_part(part, assembly, out);
        }
    }
}

/// Puts out parts of a run.
struct PartOutput<'a> {
    /// The rate of the block that was last put out.
    run_rate: &'a mut ProgrammedRate,
    manner: &'a Manner,
}

impl PartOutput<'_> {
    fn put_part(&mut self, part: SplinePart, assembly: &mut Assembly, out: &mut Vec<Element>) {
        let SplinePart { shape, cuts } = part;
        let mode = self.manner.mode;
        match shape {
            PartShape::Line {
                start,
                end,
                error_mm,
                continues,
            } => {
                let segment = Segment::line(start, end);
                let mut next = self.pending_line(segment, cuts, mode, assembly);
                (next.error_mm, next.continues) = (error_mm, continues);
                if let Some(before) = assembly.pending.take() {
                    assembly.join(before, &mut next, out);
                }
                assembly.pending = Some(next);
            }
            PartShape::Span { control, error_mm } => {
                assembly.put_pending(out);
                self.put_span((control, error_mm), cuts, assembly, out);
            }
            PartShape::Stop => {
                assembly.put_pending(out);
                // The chord of one period must not cut off more than the fit left over.
                let tolerance_mm = mode.tolerance_mm(assembly.settings.tolerance_mm);
                let is_exact = assembly.stop_cut_mm(tolerance_mm) > 0.05 * tolerance_mm;
                let kind = if is_exact {
                    RestKind::ExactStop
                } else {
                    RestKind::Corner
                };
                let line = assembly.line;
                out.push(Element::InnerRest(Rest { kind, line }));
            }
        }
    }

    /// Takes in what a cut changes; what happens there.
    fn enter(&mut self, cut: &mut Cut) -> Vec<Event> {
        let Some(Change { rate, events }) = cut.change.take() else {
            return Vec::new();
        };
        *self.run_rate = rate;
        events
    }

    fn pending_line(
        &mut self,
        segment: Segment,
        mut cuts: Vec<Cut>,
        mode: PathMode,
        assembly: &Assembly,
    ) -> Pending {
        let length_s = segment.length();
        let mut events = Vec::new();
        for cut in &mut cuts {
            events.extend(self.enter(cut));
        }
        let line = cuts.first().map_or(assembly.line, |cut| cut.line);
        let lines = cuts.iter().skip(1);
        let rate = ProgrammedRate {
            axes_v: axes_speed(&segment, &assembly.settings.limits),
            ..*self.run_rate
        };
        Pending {
            segment,
            length_s,
            rate,
            rate_v: rate.under(assembly.wanted),
            line,
            lines: lines.map(|cut| (cut.from_u * length_s, cut.line)).collect(),
            mode,
            trimmed_s: 0.0,
            events,
            error_mm: 0.0,
            continues: [false; 2],
        }
    }

    /// Puts out a span, cut where the rate changes or something happens.
    fn put_span(
        &mut self,
        (control, error_mm): ([AxisVector; 4], f64),
        cuts: Vec<Cut>,
        assembly: &Assembly,
        out: &mut Vec<Element>,
    ) {
        let manner = self.manner;
        let Some(span) = Cubic::new(control, manner.feed_axes.clone()) else {
            return;
        };
        let bounds = span.bounds();
        let settings = &assembly.settings;
        let tolerance_mm = manner.mode.tolerance_mm(settings.tolerance_mm);
        let mm_per_deg = settings.direction.mm_per_deg(tolerance_mm);
        let left_mm = (tolerance_mm - error_mm).max(0.0);
        let at_unit_mm = chord_error_mm(&bounds, 1.0, settings.period_t, mm_per_deg);
        let curve = CurveRule {
            bounds,
            gentle: true,
            stretch_r: 1.0,
            chord_v: (left_mm / at_unit_mm).sqrt(),
            mm_per_deg,
        };
        let end_s = span.length();
        let mut cuts = cuts.into_iter().peekable();
        while let Some(mut cut) = cuts.next() {
            let events = self.enter(&mut cut);
            let from_s = span.position_at(cut.from_u);
            let mut lines = Vec::new();
            while let Some(next) = cuts.next_if(|next| next.change.is_none()) {
                lines.push((span.position_at(next.from_u), next.line));
            }
            let to_s = cuts
                .peek()
                .map_or(end_s, |next| span.position_at(next.from_u));
            let rule = SpeedRule::Curve {
                curve: Box::new(curve),
                rates: [*self.run_rate; 2],
            };
            let shape = Shape::Spline(Box::new(span.clone()));
            let mut piece = assembly.piece(shape, (from_s, to_s - from_s), rule, cut.line);
            (piece.events, piece.lines) = (events, lines);
            out.push(Element::Piece(piece));
        }
    }
}
