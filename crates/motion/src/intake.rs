//! Intake: what every item is checked for, whoever plans it, and how far the program has come.
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
        let finite = segment
            .start()
            .iter()
            .chain(segment.end().iter())
            .all(|x| x.is_finite())
            && segment.length().is_finite();
        if !finite {
            return Err(PlanError::NotFinite { line });
        }
        let gap_mm = (segment.start() - self.program_position).amax();
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

    /// Takes a move that was checked: its segment from where the last one ended; `None` if it is
    /// too short to be made.
    #[inline]
    pub(crate) fn take(&mut self, segment: Segment) -> Option<Segment> {
        self.program_position = segment.end();
        let segment = starting_at(segment, self.position);
        let is_arc = matches!(segment, Segment::Arc(_));
        if (segment.end() - segment.start()).amax() < SHORTEST_MOVE_MM
            && (!is_arc || segment.length() < SHORTEST_MOVE_MM)
        {
            return None;
        }
        self.position = segment.end();
        Some(segment)
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

/// The same segment from a start that differs by less than [`SHORTEST_MOVE_MM`].
fn starting_at(mut segment: Segment, start: AxisVector) -> Segment {
    match &mut segment {
        Segment::Line(line) => line.start = start,
        Segment::Arc(arc) => arc.start = start,
        Segment::Curve(curve) => curve.start = start,
    }
    segment
}
