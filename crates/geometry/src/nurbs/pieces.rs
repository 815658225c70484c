//! A NURBS as segments: pieces by path position that a planner can follow one by one.
//!
//! Each knot span is halved, by path position, until the polynomial of degree five through place,
//! direction and curvature of both ends ([`Quintic`]) is close to the curve, in place and in
//! speed. Its error has the shape x³(1−x)³: largest in the middle, and in its derivative at 0.28
//! and 0.72; it is measured there and at places between. Neighbours share the ends, so the pieces
//! of a span, and of spans that join smoothly, follow each other with continuous curvature.
//!
//! Where the curve comes to a stand (a cusp), and where other axes than X, Y, Z move along, there
//! are straight lines instead.

use super::{NurbsPath, Span};
use crate::{AxisVector, Jet, Line, Quintic, Segment, feed_length};

/// Halvings of a knot span, at most.
const MAX_HALVINGS: u32 = 24;
/// How far the speed of a piece may be from one, relative.
const SPEED_R: f64 = 3e-5;
/// Where a piece is compared with the curve.
const PLACES: [f64; 7] = [0.12, 0.276_4, 0.4, 0.5, 0.6, 0.723_6, 0.88];
/// What is measured counts as so much larger, for the places between.
const MARGIN_R: f64 = 1.1;

/// A place on a span.
#[derive(Clone, Copy)]
struct SpanPosition {
    s: f64,
    u: f64,
    jet: Jet,
}

/// A span that is being cut.
struct Cutting<'a> {
    path: &'a NurbsPath,
    span: &'a Span,
    tolerance_mm: f64,
    out: &'a mut Vec<Segment>,
    /// Where the last segment ended.
    at: AxisVector,
}

impl NurbsPath {
    /// Appends the segments of a knot span, by its index: from `at`, where those of the span
    /// before end, none farther from the curve than the tolerance, > 0.
    pub fn cut_span(
        &self,
        index: usize,
        at: AxisVector,
        tolerance_mm: f64,
        out: &mut Vec<Segment>,
    ) {
        let spans = self.curve().spans();
        let Some(span) = spans.get(index) else {
            return;
        };
        let place = |s: f64, u: f64| SpanPosition {
            s,
            u,
            jet: span.jet(u).by_path_position(self.curve().feed_axes()),
        };
        let from = place(self.s_at(span.from_u()), span.from_u());
        let to = place(self.s_at(span.to_u()), span.to_u());
        let mut cutting = Cutting {
            path: self,
            span,
            tolerance_mm,
            at,
            out,
        };
        if self.is_in_space() {
            cutting.curve(&from, &to, MAX_HALVINGS);
        } else {
            // Two at least, so that no bend hides between the places that are compared.
            let middle = cutting.between(&from, &to);
            cutting.chord(&from, &middle, MAX_HALVINGS);
            cutting.chord(&middle, &to, MAX_HALVINGS);
        }
    }

    /// All segments of the curve.
    #[must_use]
    pub fn segments(&self, tolerance_mm: f64) -> Vec<Segment> {
        let mut out = Vec::new();
        for index in 0..self.curve().spans().len() {
            let start = || self.jet(0.0).position;
            let at = out.last().map_or_else(start, Segment::end);
            self.cut_span(index, at, tolerance_mm, &mut out);
        }
        out
    }
}

impl Cutting<'_> {
    fn at_s(&self, s: f64) -> SpanPosition {
        let u = self
            .path
            .u_at(s)
            .clamp(self.span.from_u(), self.span.to_u());
        let jet = self
            .span
            .jet(u)
            .by_path_position(self.path.curve().feed_axes());
        SpanPosition { s, u, jet }
    }

    fn between(&self, from: &SpanPosition, to: &SpanPosition) -> SpanPosition {
        self.at_s(0.5 * (from.s + to.s))
    }

    fn curve(&mut self, from: &SpanPosition, to: &SpanPosition, halvings: u32) {
        let middle = self.between(from, to);
        let is_divisible = halvings > 0 && from.u < middle.u && middle.u < to.u;
        match self.quintic(from, to) {
            Some(piece) => self.push(Segment::Curve(piece)),
            None if is_divisible => {
                self.curve(from, &middle, halvings - 1);
                self.curve(&middle, to, halvings - 1);
            }
            None => self.push(Segment::line(self.at, to.jet.position)),
        }
    }

    /// The piece between two places, if it is close enough to the curve.
    fn quintic(&self, from: &SpanPosition, to: &SpanPosition) -> Option<Quintic> {
        let length = to.s - from.s;
        let ends = [from, to];
        let vector = |v: &AxisVector| v.fixed_rows::<3>(0).into_owned();
        let mut piece = Quintic {
            start: self.at,
            end: to.jet.position,
            tangents: ends.map(|place| vector(&place.jet.d1)),
            bends: ends.map(|place| vector(&place.jet.d2)),
            length,
            error_mm: 0.0,
        };
        for x in PLACES {
            let (here, curve) = (piece.jet(x * length), self.at_s(from.s + x * length).jet);
            let error_mm = MARGIN_R * (here.position - curve.position).norm();
            piece.error_mm = piece.error_mm.max(error_mm);
            let fits = error_mm <= self.tolerance_mm
                && MARGIN_R * (vector(&here.d1).norm() - 1.0).abs() <= SPEED_R;
            // Also refuses what is not a number.
            if !fits {
                return None;
            }
        }
        (length > 0.0).then_some(piece)
    }

    fn chord(&mut self, from: &SpanPosition, to: &SpanPosition, halvings: u32) {
        let middle = self.between(from, to);
        let chord = Line {
            start: from.jet.position,
            end: to.jet.position,
        };
        let beside = [0.25, 0.75].map(|x| self.at_s(from.s + x * (to.s - from.s)));
        let near = beside
            .iter()
            .chain([&middle])
            .all(|place| distance(&place.jet.position, &chord) <= self.tolerance_mm);
        if near || halvings == 0 {
            self.push(Segment::line(self.at, to.jet.position));
            return;
        }
        self.chord(from, &middle, halvings - 1);
        self.chord(&middle, to, halvings - 1);
    }

    fn push(&mut self, segment: Segment) {
        self.at = segment.end();
        self.out.push(segment);
    }
}

/// Distance of a point from a chord, in the feed length of what is left when the part along the
/// chord is taken away.
fn distance(point: &AxisVector, chord: &Line) -> f64 {
    let (way, offset) = (chord.displacement(), point - chord.start);
    let square = way.norm_squared();
    let share = if square > 0.0 {
        (offset.dot(&way) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let beside = offset - way * share;
    // Rotary axes count too, where linear ones move: the larger of the two.
    feed_length(&beside).max(beside.amax())
}
