//! The path front: items in, pieces of smooth path and rests out.
//!
//! Lines at a feedrate in continuous mode go through the compressor, which makes smooth curves of
//! dense ones and gives back the lines that stay. These, and every other segment, wait for the next
//! one, since the joint between the two tells where each ends. What comes out depends on the order of
//! the items alone.

use crate::PlanError;
use crate::joint::{Joint, chord_error_mm, join};
use crate::parts::DenseRun;
use crate::pending::{Pending, axes_speed};
use crate::piece::{Element, Piece, Rest, RestKind, Shape};
use crate::programmed_rate::ProgrammedRate;
use crate::speed_limit::{self, CurveRule, SpeedRule};
use crate::stops::Blocks;
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::Override;
use glidepath_program::{Event, Item, ItemKind, Limits, PathMode, Rate, Settings};

/// Moves shorter than this are carried into the next one: below the resolution of programs, where
/// directions are rounding noise.
pub(crate) const SHORTEST_MOVE_MM: f64 = 1e-6;

/// Turns items into pieces and rests.
#[derive(Debug)]
pub(crate) struct PathFront {
    pub(crate) settings: Settings,
    pub(crate) wanted: Override,
    /// The run of blocks under compression.
    pub(crate) run: Option<DenseRun>,
    /// The rate of its block that was last put out.
    pub(crate) run_rate: ProgrammedRate,
    /// No other axis than X, Y, Z has moved in such a run.
    pub(crate) is_linear: bool,
    /// The segment whose end is not decided.
    pub(crate) pending: Option<Pending>,
    /// Where the pieces made so far, and the pending segment, end.
    position: AxisVector,
    /// Where the program is; differs from `position` by moves too short to be made.
    program_position: AxisVector,
    /// The blocks since the last rest.
    pub(crate) blocks: Blocks,
    pub(crate) events: Vec<Event>,
    pub(crate) line: u32,
    last_rate: Rate,
}

impl PathFront {
    pub(crate) const fn new(settings: Settings, start: AxisVector) -> Self {
        Self {
            settings,
            wanted: Override::NONE,
            run: None,
            run_rate: ProgrammedRate {
                rate: Rate::Rapid,
                axes_v: f64::INFINITY,
            },
            is_linear: true,
            pending: None,
            position: start,
            program_position: start,
            blocks: Blocks::new(),
            events: Vec::new(),
            line: 0,
            last_rate: Rate::Rapid,
        }
    }

    /// Plans what follows with another override.
    pub(crate) fn set_override(&mut self, wanted: Override) {
        self.wanted = wanted;
        self.blocks.lose();
        let settings = self.settings;
        if let Some(held) = &mut self.pending {
            let chord_v = chord_speed(&held.segment, held.mode, &settings);
            held.rate_v = held.rate.under(wanted).min(chord_v);
        }
    }

    /// Takes an item and appends what it decides.
    pub(crate) fn push(&mut self, item: &Item, out: &mut Vec<Element>) -> Result<(), PlanError> {
        match item.kind {
            ItemKind::Move {
                segment,
                rate,
                mode,
            } => {
                self.push_move(item.line, segment, rate, mode, out)?;
            }
            ItemKind::Dwell(dwell_t) => {
                if !(dwell_t >= 0.0 && dwell_t.is_finite()) {
                    return Err(PlanError::Dwell {
                        line: item.line,
                        dwell_t,
                    });
                }
                self.rest(RestKind::Dwell(dwell_t), item.line, out);
            }
            ItemKind::Event(event) if event.is_at_rest() => {
                self.rest(RestKind::Event(event), item.line, out);
            }
            ItemKind::Event(event) => self.events.push(event),
        }
        self.line = item.line;
        Ok(())
    }

    /// No more items: the path ends at rest.
    pub(crate) fn finish(&mut self, out: &mut Vec<Element>) {
        self.rest(RestKind::End, self.line, out);
    }

    fn push_move(
        &mut self,
        line: u32,
        segment: Segment,
        rate: Rate,
        mode: PathMode,
        out: &mut Vec<Element>,
    ) -> Result<(), PlanError> {
        check(line, &segment, rate, mode, &self.program_position)?;
        self.program_position = segment.end();
        self.last_rate = rate;
        let segment = starting_at(segment, self.position);
        let length_s = segment.length();
        let is_arc = matches!(segment, Segment::Arc(_));
        if (segment.end() - segment.start()).amax() < SHORTEST_MOVE_MM
            && (!is_arc || length_s < SHORTEST_MOVE_MM)
        {
            return Ok(());
        }
        self.position = segment.end();
        let axes_v = axes_speed(&segment, &self.settings);
        let programmed = ProgrammedRate { rate, axes_v };
        if self.blocks.keeps() {
            let rule = self.rule(&segment, programmed, mode);
            let shape = Shape::Segment(segment);
            let mut piece = self.piece(shape, (0.0, length_s), rule, line);
            piece.events.clone_from(&self.events);
            self.blocks.push(piece);
        }
        if self.compress((&segment, line), rate, mode, out) {
            return Ok(());
        }
        self.end_run(out);
        let rate = programmed;
        let mut next = Pending {
            segment,
            length_s,
            rate,
            rate_v: rate
                .under(self.wanted)
                .min(chord_speed(&segment, mode, &self.settings)),
            line,
            lines: Vec::new(),
            mode,
            trimmed_s: 0.0,
            events: core::mem::take(&mut self.events),
            error_mm: segment.error_mm(),
            continues: [false; 2],
        };
        if let Some(before) = self.pending.take() {
            self.join(before, &mut next, out);
        }
        self.pending = Some(next);
        Ok(())
    }

    /// Decides the joint between two segments and puts out all of the first.
    pub(crate) fn join(&mut self, before: Pending, next: &mut Pending, out: &mut Vec<Element>) {
        let joint = join(before.ending(), next.starting(), &self.settings);
        let (line, rates) = (before.last_line(), [before.rate, next.rate]);
        match joint {
            Joint::Straight => self.put_segment(before, 0.0, out),
            Joint::Stop { exact } => {
                self.put_segment(before, 0.0, out);
                let kind = if exact {
                    RestKind::ExactStop
                } else {
                    RestKind::Corner
                };
                let stops = self.blocks.take(&next.segment.start());
                self.put_stops(stops, out);
                out.push(Element::Rest(Rest { kind, line }));
            }
            Joint::Blend {
                transition,
                trim_s,
                curve,
            } => {
                self.put_segment(before, trim_s, out);
                let length_s = transition.length();
                let shape = Shape::Transition(Box::new(transition));
                let rule = SpeedRule::Curve {
                    curve: Box::new(curve),
                    rates,
                };
                let mut piece = self.piece(shape, (0.0, length_s), rule, line);
                piece.events = core::mem::take(&mut next.events);
                out.push(Element::Piece(piece));
                next.trimmed_s = trim_s;
            }
        }
    }

    /// Puts out the segment that waits: it is left without a joint.
    pub(crate) fn put_pending(&mut self, out: &mut Vec<Element>) {
        if let Some(pending) = self.pending.take() {
            self.put_segment(pending, 0.0, out);
        }
    }

    /// Puts out what is left of a segment after both its joints.
    fn put_segment(&self, pending: Pending, trim_end_s: f64, out: &mut Vec<Element>) {
        let length_s = pending.length_s - pending.trimmed_s - trim_end_s;
        // Half is the most a joint takes, so nothing left means rounding of two halves.
        if length_s <= 1e-12 * pending.length_s {
            return;
        }
        let rule = self.rule(&pending.segment, pending.rate, pending.mode);
        let shape = Shape::Segment(pending.segment);
        let mut piece = self.piece(shape, (pending.trimmed_s, length_s), rule, pending.line);
        (piece.events, piece.lines) = (pending.events, pending.lines);
        out.push(Element::Piece(piece));
    }

    /// What limits the speed on a segment.
    fn rule(&self, segment: &Segment, rate: ProgrammedRate, mode: PathMode) -> SpeedRule {
        match segment {
            Segment::Line(_) => SpeedRule::Straight {
                d1: segment.jet(0.0).d1,
                rate,
            },
            Segment::Arc(arc) => SpeedRule::Arc {
                arc: *arc,
                rate,
                chord_v: chord_speed(segment, mode, &self.settings),
            },
            Segment::Curve(curve) => SpeedRule::Curve {
                curve: Box::new(CurveRule {
                    bounds: curve.bounds(),
                    gentle: true,
                    stretch_r: 1.0,
                    chord_v: chord_speed(segment, mode, &self.settings),
                }),
                rates: [rate; 2],
            },
        }
    }

    /// Tells of the other way to drive up to the rest that comes next.
    fn put_stops(&self, stops: Option<Vec<Piece>>, out: &mut Vec<Element>) {
        if let Some(pieces) = stops {
            let exact = self.stop_cut_mm() > 0.05 * self.settings.tolerance_mm;
            out.push(Element::Stops { pieces, exact });
        }
    }

    /// How much the chord of one period can cut off at a stop between two setpoints, at most, mm.
    pub(crate) fn stop_cut_mm(&self) -> f64 {
        let jerk_j = self.settings.limits.jerk;
        let limited = jerk_j.iter().filter(|j| **j < Limits::UNLIMITED);
        let greatest_j = limited.fold(0.0_f64, |a, b| a.max(*b));
        greatest_j * self.settings.period_t.powi(3) / 48.0
    }

    /// A piece of a shape: where in the shape it starts, and how long it is.
    pub(crate) fn piece(
        &self,
        shape: Shape,
        (from_s, length_s): (f64, f64),
        rule: SpeedRule,
        line: u32,
    ) -> Piece {
        Piece {
            shape,
            from_s,
            length_s,
            limit: rule.limit(self.wanted, &self.settings.limits),
            rapid: rule.is_rapid(),
            rule,
            planned: self.wanted,
            line,
            lines: Vec::new(),
            events: Vec::new(),
        }
    }

    /// Ends the path at rest.
    fn rest(&mut self, kind: RestKind, line: u32, out: &mut Vec<Element>) {
        self.end_run(out);
        self.put_pending(out);
        let stops = self.blocks.take_all(&self.position);
        self.put_stops(stops, out);
        self.put_remainder(out);
        for event in core::mem::take(&mut self.events) {
            out.push(Element::Rest(Rest {
                kind: RestKind::Event(event),
                line,
            }));
        }
        out.push(Element::Rest(Rest { kind, line }));
        self.blocks.restart();
    }

    /// Makes up for moves that were too short to be made by themselves.
    fn put_remainder(&mut self, out: &mut Vec<Element>) {
        let segment = Segment::line(self.position, self.program_position);
        let length_s = segment.length();
        if length_s <= 0.0 {
            return;
        }
        out.push(Element::Rest(Rest {
            kind: RestKind::Corner,
            line: self.line,
        }));
        self.position = self.program_position;
        let d1 = segment.jet(0.0).d1;
        let axes_v = speed_limit::straight(&d1, f64::INFINITY, &self.settings.limits).top_v;
        let rate = ProgrammedRate {
            rate: self.last_rate,
            axes_v,
        };
        let rule = SpeedRule::Straight { d1, rate };
        let shape = Shape::Segment(segment);
        out.push(Element::Piece(self.piece(
            shape,
            (0.0, length_s),
            rule,
            self.line,
        )));
    }
}

/// The speed at which the chords of one period reach the tolerance of an arc or another curve.
fn chord_speed(segment: &Segment, mode: PathMode, settings: &Settings) -> f64 {
    let arc = match segment {
        Segment::Line(_) => return f64::INFINITY,
        Segment::Arc(arc) => arc,
        Segment::Curve(curve) => {
            let left_mm = mode.tolerance_mm(settings) - curve.error_mm;
            let at_unit_mm = chord_error_mm(&curve.bounds(), 1.0, settings.period_t);
            return (left_mm.max(0.0) / at_unit_mm).sqrt();
        }
    };
    let radius_mm = arc.start_radius().max(arc.end_radius());
    let omega = arc.sweep_rad / arc.length();
    let curvature_k = radius_mm * omega * omega;
    (8.0 * mode.tolerance_mm(settings) / curvature_k).sqrt() / settings.period_t
}

/// The same segment from a start that differs by less than [`SHORTEST_MOVE_MM`].
pub(crate) fn starting_at(mut segment: Segment, start: AxisVector) -> Segment {
    match &mut segment {
        Segment::Line(line) => line.start = start,
        Segment::Arc(arc) => arc.start = start,
        Segment::Curve(curve) => curve.start = start,
    }
    segment
}

/// Refuses a move that cannot be planned.
pub(crate) fn check(
    line: u32,
    segment: &Segment,
    rate: Rate,
    mode: PathMode,
    program_position: &AxisVector,
) -> Result<(), PlanError> {
    let finite = segment
        .start()
        .iter()
        .chain(segment.end().iter())
        .all(|x| x.is_finite())
        && segment.length().is_finite();
    if !finite {
        return Err(PlanError::NotFinite { line });
    }
    let gap_mm = (segment.start() - program_position).amax();
    if gap_mm > SHORTEST_MOVE_MM {
        return Err(PlanError::Gap { line, gap_mm });
    }
    // Not a number is no rate either.
    let wrong = [rate.feed_v(), Some(rate.most_v().min(f64::MAX))];
    if let Some(feed_v) = wrong
        .into_iter()
        .flatten()
        .find(|v| !(*v > 0.0 && v.is_finite()))
    {
        return Err(PlanError::Feed { line, feed_v });
    }
    if let PathMode::Continuous {
        tolerance_mm: Some(tolerance_mm),
    } = mode
        && !(tolerance_mm > 0.0 && tolerance_mm.is_finite())
    {
        return Err(PlanError::Tolerance { line, tolerance_mm });
    }
    Ok(())
}
