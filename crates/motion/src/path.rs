//! The path front: items in, pieces of smooth path and rests out.
//!
//! A segment is held back until the next item tells how it is left; so at most one segment is
//! pending, and what comes out depends on the order of the items alone.

use crate::joint::{Joint, Leg, join};
use crate::speed_limit::{self, SpeedLimit};
use crate::{Event, Item, ItemKind, PathMode, PlanError, Rate, Settings};
use glidepath_geometry::{AxisVector, Jet, Segment, Transition};

/// Moves shorter than this are carried into the next one: below the resolution of programs, where
/// directions are rounding noise.
const SHORTEST_MOVE_MM: f64 = 1e-6;

/// A smooth piece of path with one speed limit.
#[derive(Debug, Clone)]
pub(crate) struct Piece {
    shape: Shape,
    /// Where in the shape the piece begins.
    from_s: f64,
    pub length_s: f64,
    pub limit: SpeedLimit,
    pub line: u32,
    pub rapid: bool,
    /// Events that happen when the piece is entered, without stopping.
    pub events: Vec<Event>,
}

#[derive(Debug, Clone)]
enum Shape {
    Segment(Segment),
    Transition(Box<Transition>),
}

impl Piece {
    /// True for a line.
    pub(crate) fn is_straight(&self) -> bool {
        matches!(self.shape, Shape::Segment(Segment::Line(_)))
    }

    /// Position and derivatives `s` after the start of the piece.
    pub(crate) fn jet(&self, s: f64) -> Jet {
        match &self.shape {
            Shape::Segment(segment) => segment.jet(self.from_s + s),
            Shape::Transition(transition) => transition.jet(self.from_s + s),
        }
    }
}

/// What follows a piece of path where the machine comes to rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum RestKind {
    /// The motion goes on in the same period.
    Corner,
    /// One setpoint is exactly there.
    ExactStop,
    /// For a time, s.
    Dwell(f64),
    /// For an event.
    Event(Event),
    /// End of the program.
    End,
}

/// A rest and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rest {
    pub kind: RestKind,
    pub line: u32,
}

/// What the path front makes.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "nearly every element is a piece")]
pub(crate) enum Element {
    Piece(Piece),
    Rest(Rest),
}

/// A segment whose end is not decided yet.
#[derive(Debug)]
struct Pending {
    segment: Segment,
    length_s: f64,
    rate_v: f64,
    rapid: bool,
    line: u32,
    mode: PathMode,
    /// Length at the start that the joint before has replaced.
    trimmed_s: f64,
    events: Vec<Event>,
}

impl Pending {
    fn leg(&self) -> Leg<'_> {
        Leg {
            segment: &self.segment,
            mode: self.mode,
            length_s: self.length_s,
            rate_v: self.rate_v,
        }
    }
}

/// Turns items into pieces and rests.
#[derive(Debug)]
pub(crate) struct PathFront {
    settings: Settings,
    pending: Option<Pending>,
    /// Where the pieces made so far, and the pending segment, end.
    position: AxisVector,
    /// Where the program is; differs from `position` by moves too short to be made.
    program_position: AxisVector,
    events: Vec<Event>,
    line: u32,
}

impl PathFront {
    pub(crate) const fn new(settings: Settings, start: AxisVector) -> Self {
        Self {
            settings,
            pending: None,
            position: start,
            program_position: start,
            events: Vec::new(),
            line: 0,
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
            ItemKind::Event(event @ (Event::SpindleSpeed(_) | Event::SelectTool(_))) => {
                self.events.push(event);
            }
            ItemKind::Event(event) => self.rest(RestKind::Event(event), item.line, out),
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
        let segment = starting_at(segment, self.position);
        let length_s = segment.length();
        let is_arc = matches!(segment, Segment::Arc(_));
        if (segment.end() - segment.start()).amax() < SHORTEST_MOVE_MM
            && (!is_arc || length_s < SHORTEST_MOVE_MM)
        {
            return Ok(());
        }
        let rate_v = match rate {
            Rate::Rapid => f64::INFINITY,
            Rate::Feed(feed_v) => feed_v,
        };
        let mut next = Pending {
            segment,
            length_s,
            rate_v: self.rate_within_chord_error(&segment, rate_v, mode),
            rapid: rate == Rate::Rapid,
            line,
            mode,
            trimmed_s: 0.0,
            events: core::mem::take(&mut self.events),
        };
        if let Some(before) = self.pending.take() {
            self.join(before, &mut next, out);
        }
        self.position = segment.end();
        self.pending = Some(next);
        Ok(())
    }

    /// Decides the joint between two segments and puts out all of the first.
    fn join(&self, before: Pending, next: &mut Pending, out: &mut Vec<Element>) {
        let joint = join(before.leg(), next.leg(), &self.settings);
        let (line, rapid) = (before.line, before.rapid && next.rapid);
        match joint {
            Joint::Straight => self.put_segment(before, 0.0, out),
            Joint::Stop { exact } => {
                self.put_segment(before, 0.0, out);
                let kind = if exact {
                    RestKind::ExactStop
                } else {
                    RestKind::Corner
                };
                out.push(Element::Rest(Rest { kind, line }));
            }
            Joint::Blend {
                transition,
                trim_s,
                limit,
            } => {
                self.put_segment(before, trim_s, out);
                out.push(Element::Piece(Piece {
                    length_s: transition.length(),
                    shape: Shape::Transition(Box::new(transition)),
                    from_s: 0.0,
                    limit,
                    line,
                    rapid,
                    events: core::mem::take(&mut next.events),
                }));
                next.trimmed_s = trim_s;
            }
        }
    }

    /// Puts out what is left of a segment after both its joints.
    fn put_segment(&self, pending: Pending, trim_end_s: f64, out: &mut Vec<Element>) {
        let length_s = pending.length_s - pending.trimmed_s - trim_end_s;
        // Half is the most a joint takes, so nothing left means rounding of two halves.
        if length_s <= 1e-12 * pending.length_s {
            return;
        }
        let limits = &self.settings.limits;
        let limit = match &pending.segment {
            Segment::Line(_) => {
                let d1 = pending.segment.jet(0.0).d1;
                speed_limit::straight(&d1, pending.rate_v, limits)
            }
            Segment::Arc(arc) => speed_limit::arc(arc, pending.rate_v, limits),
        };
        out.push(Element::Piece(Piece {
            shape: Shape::Segment(pending.segment),
            from_s: pending.trimmed_s,
            length_s,
            limit,
            line: pending.line,
            rapid: pending.rapid,
            events: pending.events,
        }));
    }

    /// The rate at which the chords of one period stay within tolerance of an arc.
    fn rate_within_chord_error(&self, segment: &Segment, rate_v: f64, mode: PathMode) -> f64 {
        let Segment::Arc(arc) = segment else {
            return rate_v;
        };
        let radius_mm = arc.start_radius().max(arc.end_radius());
        let omega = arc.sweep_rad / arc.length();
        let curvature_k = radius_mm * omega * omega;
        let tolerance_mm = mode.tolerance_mm(&self.settings);
        rate_v.min((8.0 * tolerance_mm / curvature_k).sqrt() / self.settings.period_t)
    }

    /// Ends the path at rest.
    fn rest(&mut self, kind: RestKind, line: u32, out: &mut Vec<Element>) {
        if let Some(pending) = self.pending.take() {
            let (rate_v, pending_line, rapid) = (pending.rate_v, pending.line, pending.rapid);
            self.put_segment(pending, 0.0, out);
            self.put_remainder(rate_v, pending_line, rapid, out);
        }
        for event in core::mem::take(&mut self.events) {
            out.push(Element::Rest(Rest {
                kind: RestKind::Event(event),
                line,
            }));
        }
        out.push(Element::Rest(Rest { kind, line }));
    }

    /// Makes up for moves that were too short to be made by themselves.
    fn put_remainder(&mut self, rate_v: f64, line: u32, rapid: bool, out: &mut Vec<Element>) {
        let segment = Segment::line(self.position, self.program_position);
        let length_s = segment.length();
        if length_s <= 0.0 {
            return;
        }
        out.push(Element::Rest(Rest {
            kind: RestKind::Corner,
            line,
        }));
        self.position = self.program_position;
        let limit = speed_limit::straight(&segment.jet(0.0).d1, rate_v, &self.settings.limits);
        out.push(Element::Piece(Piece {
            shape: Shape::Segment(segment),
            from_s: 0.0,
            length_s,
            limit,
            line,
            rapid,
            events: Vec::new(),
        }));
    }
}

/// The same segment from a start that differs by less than [`SHORTEST_MOVE_MM`].
fn starting_at(mut segment: Segment, start: AxisVector) -> Segment {
    match &mut segment {
        Segment::Line(line) => line.start = start,
        Segment::Arc(arc) => arc.start = start,
    }
    segment
}

fn check(
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
    if let Rate::Feed(feed_v) = rate
        && !(feed_v > 0.0 && feed_v.is_finite())
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
