//! The guard, the last check of a frame before it is given out: it must continue the motion, inside
//! the travel.
//!
//! A plan that keeps the limits always passes. What is caught is a plan with a hole in it: a piece
//! of path left out, a state that is not a number, a position that the interpolator refuses because
//! the axis cannot go there. Such a frame must never be published, whatever the cause; no motion at
//! all is better.

use crate::PlanError;
use glidepath_geometry::{AXES, Axis, AxisVector, LINEAR_XYZ};
use glidepath_program::{Frame, Limits, Settings, Travel};

/// Follows the frames.
#[derive(Debug, Clone)]
pub(crate) struct Guard {
    /// Largest first, second and third difference of each axis, mm or degrees.
    most: [AxisVector; 3],
    travel: Travel,
    /// Position, and its first and second differences, at the last frame.
    last: Option<[AxisVector; 3]>,
    /// Another axis than X, Y, Z has moved.
    others_move: bool,
}

/// How far above a limit a difference has to be to count as a hole in the plan. Rounding is far
/// below it, a hole mostly far above.
const ALLOWANCE_R: f64 = 1.01;
/// What rounding of large positions makes of a difference, mm.
const ROUNDING_MM: f64 = 1e-8;

impl Guard {
    pub(crate) fn new(settings: &Settings) -> Self {
        let Limits {
            velocity,
            acceleration,
            jerk,
            ..
        } = settings.limits;
        let t = settings.period_t;
        let most = [velocity * t, acceleration * (t * t), jerk * t.powi(3)]
            .map(|most| most.map(|x| x.mul_add(ALLOWANCE_R, ROUNDING_MM)));
        Self {
            most,
            travel: settings.limits.travel,
            last: None,
            others_move: false,
        }
    }

    /// The same guard, for a machine at rest at a position: the first frame has to follow from that.
    pub(crate) fn resting_at(self, position: AxisVector) -> Self {
        let zero = AxisVector::zeros();
        Self {
            last: Some([position, zero, zero]),
            ..self
        }
    }

    /// Refuses a frame that does not follow the one before.
    #[inline]
    pub(crate) fn check(&mut self, frame: &Frame) -> Result<(), PlanError> {
        let is_first = self.last.is_none();
        let zero = AxisVector::zeros();
        let [position, first, second] = self.last.get_or_insert([frame.position, zero, zero]);
        // Axes that do not move are not looked at: but for the sign of a zero, nothing of them
        // changes.
        let mut differing = 0;
        for i in LINEAR_XYZ.end..AXES {
            differing |= frame.position[i].to_bits() ^ position[i].to_bits();
            differing |= (frame.velocity[i].to_bits() | frame.acceleration[i].to_bits()) << 1;
        }
        self.others_move |= differing != 0;
        let axes = if self.others_move || is_first {
            AXES
        } else {
            LINEAR_XYZ.end
        };
        let [most_first, most_second, most_third] = &self.most;
        // All together, without a branch for each. Not a number is not within a limit.
        let (mut follows, mut is_inside) = (true, true);
        let Travel { lowest, highest } = &self.travel;
        for i in 0..axes {
            is_inside &= (frame.position[i] >= lowest[i] - Travel::ROUNDING)
                & (frame.position[i] <= highest[i] + Travel::ROUNDING);
            let new_first = frame.position[i] - position[i];
            let new_second = new_first - first[i];
            let new_third = new_second - second[i];
            follows &= (new_first.abs() <= most_first[i])
                & (new_second.abs() <= most_second[i])
                & (new_third.abs() <= most_third[i])
                & (frame.velocity[i].abs() <= f64::MAX)
                & (frame.acceleration[i].abs() <= f64::MAX);
            (first[i], second[i]) = (new_first, new_second);
        }
        *position = frame.position;
        if !follows {
            return Err(PlanError::NoMotion { line: frame.line });
        }
        if is_inside {
            Ok(())
        } else {
            Err(self.beyond(frame))
        }
    }

    #[cold]
    fn beyond(&self, frame: &Frame) -> PlanError {
        let Travel { lowest, highest } = &self.travel;
        let line = frame.line;
        let found = Axis::ALL.into_iter().find_map(|axis| {
            let i = axis.index();
            let position = frame.position[i];
            let end = position.max(lowest[i]).min(highest[i]);
            ((position - end).abs() > Travel::ROUNDING).then_some(PlanError::BeyondTravel {
                line,
                axis,
                position,
                end,
            })
        });
        found.unwrap_or(PlanError::NoMotion { line })
    }
}

/// Frames one after the other, each looked at before it is given out.
#[derive(Debug, Clone)]
pub(crate) struct GuardedFrames {
    guard: Guard,
    /// The frame made last.
    frame: Frame,
    /// Why there are no more.
    failed: Option<PlanError>,
}

impl GuardedFrames {
    /// At rest at `start`.
    pub(crate) fn new(settings: &Settings, start: AxisVector) -> Self {
        Self {
            guard: Guard::new(settings),
            frame: Frame::blank(start),
            failed: None,
        }
    }

    /// Has the next frame made in the place of the last one; false if there is none. After an error
    /// there is none any more.
    #[inline]
    pub(crate) fn make(
        &mut self,
        next: impl FnOnce(&mut Frame) -> Result<bool, PlanError>,
    ) -> Result<bool, PlanError> {
        self.check()?;
        let made = next(&mut self.frame).and_then(|is_made| {
            if is_made {
                self.guard.check(&self.frame)?;
            }
            Ok(is_made)
        });
        self.failed = made.err();
        made
    }

    /// No frame follows any more.
    pub(crate) const fn fail(&mut self, error: PlanError) {
        self.failed = Some(error);
    }

    /// Why there are no more frames, if there are none.
    pub(crate) fn check(&self) -> Result<(), PlanError> {
        self.failed.map_or(Ok(()), Err)
    }

    pub(crate) const fn frame(&self) -> &Frame {
        &self.frame
    }

    pub(crate) const fn frame_mut(&mut self) -> &mut Frame {
        &mut self.frame
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_program::{Effort, Smoothing};

    fn guard() -> Guard {
        Guard::new(&Settings {
            limits: Limits::uniform(200.0, 2000.0, 40_000.0),
            tolerance_mm: 0.02,
            direction: glidepath_program::DirectionTolerance::default(),
            smoothing: Smoothing::Sextic,
            corners: glidepath_program::Corners::default(),
            period_t: 0.004,
            effort: Effort::Fast,
        })
    }

    fn frame(x: f64) -> Frame {
        let mut position = AxisVector::zeros();
        position[0] = x;
        Frame {
            line: 9,
            ..Frame::blank(position)
        }
    }

    #[test]
    fn a_jump_is_refused_and_steady_motion_is_not() {
        // A step of the jerk allowed, after a rest anywhere.
        let most = 40_000.0 * 0.004_f64.powi(3);
        let mut sound = guard();
        for x in [500.0, 500.0, 500.0 + most, 500.0 + 4.0 * most] {
            assert_eq!(sound.check(&frame(x)), Ok(()), "{x}");
        }
        for x in [500.0 + 1.1 * most, 499.0, f64::NAN] {
            let mut guard = guard();
            assert_eq!(guard.check(&frame(500.0)), Ok(()), "first");
            let refused = Err(PlanError::NoMotion { line: 9 });
            assert_eq!(guard.check(&frame(x)), refused, "{x}");
        }
    }

    #[test]
    fn a_position_beyond_an_end_of_travel_is_refused() {
        let mut at_end = guard();
        at_end.travel.highest[0] = 500.0;
        at_end.travel.lowest[1] = 0.0;
        assert_eq!(at_end.check(&frame(500.0)), Ok(()), "first");
        assert_eq!(at_end.check(&frame(500.0 + 9e-10)), Ok(()), "rounding");
        let position = 500.0 + 1e-6;
        let refused = PlanError::BeyondTravel {
            line: 9,
            axis: Axis::X,
            position,
            end: 500.0,
        };
        assert_eq!(at_end.check(&frame(position)), Err(refused));
    }
}
