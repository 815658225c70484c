//! The overshoot of axes: how far they go beyond what the program asks of them, and come back.
//!
//! Around a place of the program, an axis is asked to be between the least and the largest coordinate
//! of the moves that the motion may be on. What is beyond may be the rounding of a corner that is
//! still ahead: then the program follows, and it was none. If the axis comes back instead, it has
//! overshot.

use super::met::Met;
use crate::follow::Follow;
use glidepath_geometry::{AXES, AxisVector};

/// Less is rounding, mm or degrees.
const LEAST_MM: f64 = 1e-6;

/// An axis that is beyond.
#[derive(Debug, Clone, Copy)]
struct Beyond {
    /// What it was asked for when it went beyond.
    asked: f64,
    most: Met,
}

/// One side of an axis.
#[derive(Debug, Clone, Copy, Default)]
struct Side {
    beyond: Option<Beyond>,
    worst: Met,
    /// The last coordinate, if there was one.
    last: Option<f64>,
}

/// All axes, below and above.
#[derive(Debug, Default)]
pub(super) struct Overshoots {
    sides: [[Side; AXES]; 2],
}

impl Side {
    /// The next coordinate and the largest that is asked for, both with the sign of the side.
    fn next(&mut self, at: f64, asked: f64, line: u32) {
        // What has not come yet to where it is asked for is not beyond it: a rounded corner.
        let goes_out = self.last.replace(at).is_none_or(|last| at > last);
        match &mut self.beyond {
            None if goes_out && at - asked > LEAST_MM => {
                let mut most = Met::default();
                most.see(at - asked, line);
                self.beyond = Some(Beyond { asked, most });
            }
            None => {}
            Some(beyond) => {
                // The moves behind it may be out of sight by now.
                beyond.most.see(at - asked.max(beyond.asked), line);
                if asked > beyond.asked + LEAST_MM {
                    // The program went on to where the motion was already.
                    self.beyond = None;
                } else if at - beyond.asked <= LEAST_MM {
                    let most = beyond.most;
                    self.worst.see(most.distance_mm, most.line);
                    self.beyond = None;
                }
            }
        }
    }
}

impl Overshoots {
    pub(super) fn next(&mut self, position: &AxisVector, line: u32, follow: &Follow) {
        let Some((low, high)) = follow.extent() else {
            return;
        };
        let [below, above] = &mut self.sides;
        for axis in 0..AXES {
            below[axis].next(-position[axis], -low[axis], line);
            above[axis].next(position[axis], high[axis], line);
        }
    }

    /// The worst below and above.
    pub(super) fn report(&self) -> [[Met; AXES]; 2] {
        self.sides.map(|axes| {
            axes.map(|side| {
                let mut worst = side.worst;
                if let Some(beyond) = side.beyond {
                    worst.see(beyond.most.distance_mm, beyond.most.line);
                }
                worst
            })
        })
    }
}
