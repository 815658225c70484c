//! Intake: the checks of every item, whoever plans it, and how far the program has come.
//!
//! Moves below the resolution of programs are not made by themselves: the segment that follows
//! starts where the last one that was made ended, and what is left over in the end is the
//! remainder.

use crate::PlanError;
use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{PathMode, Rate};

/// Moves shorter than this are carried into the next one: below the resolution of programs, where
/// directions are rounding noise.
pub(crate) const SHORTEST_MOVE_MM: f64 = 1e-6;

/// How far the program has come, and how far what was made of it.
#[derive(Debug, Clone)]
pub(crate) struct Intake {
    /// Where the segments taken so far end.
    position: AxisVector,
    /// Where the program is; differs from `position` by moves too short to be made.
    program_position: AxisVector,
}

impl Intake {
    pub(crate) const fn new(start: AxisVector) -> Self {
        Self {
            position: start,
            program_position: start,
        }
    }

    /// Where the segments taken so far end.
    pub(crate) const fn position(&self) -> &AxisVector {
        &self.position
    }

    /// Where the program is.
    pub(crate) const fn program_position(&self) -> &AxisVector {
        &self.program_position
    }

    /// Refuses a move that cannot be planned. Changes nothing.
    pub(crate) fn check_move(
        &self,
        line: u32,
        segment: &Segment,
        rate: Rate,
        mode: PathMode,
    ) -> Result<(), PlanError> {
        let (start, end) = (segment.start(), segment.end());
        // Zero times what is not finite is not a number.
        let nothing = |point: &AxisVector| point.as_slice().iter().map(|x| 0.0 * x).sum::<f64>();
        let is_finite = nothing(&start) + nothing(&end) == 0.0;
        if !(is_finite && segment.length().is_finite()) {
            return Err(PlanError::NotFinite { line });
        }
        if !is_near(&start, &self.program_position) {
            let gap_mm = (start - self.program_position).amax();
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

    /// Takes a move that was checked: its segment from where the last one ended; `None` if it is
    /// too short to be made.
    #[inline]
    pub(crate) fn take(&mut self, mut segment: Segment) -> Option<Segment> {
        self.takes(&mut segment).then_some(segment)
    }

    /// As [`Intake::take`], where the segment is: it is large, and a program has millions. False if
    /// it is too short to be made.
    #[inline]
    pub(crate) fn takes(&mut self, segment: &mut Segment) -> bool {
        let end = segment.end();
        self.program_position = end;
        start_at(segment, self.position);
        let is_arc = matches!(segment, Segment::Arc(_));
        let is_made =
            !is_near(&end, &self.position) || (is_arc && segment.length() >= SHORTEST_MOVE_MM);
        if is_made {
            self.position = end;
        }
        is_made
    }

    /// The way from where the segments end to where the program is: what moves too short to be made
    /// by themselves have left over. It may have no length.
    pub(crate) fn remainder(&self) -> Segment {
        Segment::line(self.position, self.program_position)
    }

    /// The remainder has been made.
    pub(crate) const fn make_up(&mut self) {
        self.position = self.program_position;
    }
}

/// Refuses a dwell that is not a time.
pub(crate) fn check_dwell(line: u32, dwell_t: f64) -> Result<(), PlanError> {
    if dwell_t >= 0.0 && dwell_t.is_finite() {
        Ok(())
    } else {
        Err(PlanError::Dwell { line, dwell_t })
    }
}

/// True if no coordinate differs by more than [`SHORTEST_MOVE_MM`].
fn is_near(a: &AxisVector, b: &AxisVector) -> bool {
    let pairs = a.as_slice().iter().zip(b.as_slice());
    pairs.fold(true, |all, (a, b)| {
        all & ((a - b).abs() <= SHORTEST_MOVE_MM)
    })
}

/// Gives a segment a start that differs by less than [`SHORTEST_MOVE_MM`].
const fn start_at(segment: &mut Segment, start: AxisVector) {
    match segment {
        Segment::Line(line) => line.start = start,
        Segment::Arc(arc) => arc.start = start,
        Segment::Curve(curve) => curve.start = start,
    }
}
