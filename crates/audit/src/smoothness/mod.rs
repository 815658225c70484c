//! The smoothness figures of a motion: what a plot shows at a glance, and limits do not.
//!
//! A motion may keep every limit and tremble all the way: an axis that wanders by micrometres with
//! its jerk at the limit is inside all of them. These figures tell such a motion from a good one:
//!
//! * rms and peak jerk of every axis;
//! * rms acceleration above 30 Hz: what the structure of a machine rings to, beside the
//!   acceleration that the path needs, which is slower;
//! * reversals of every axis: each is a passage through the backlash and the stiction of its drive;
//! * mean and rms deviation from the programmed path: how much of the tolerance is in use.
//!
//! All are told twice: for the whole motion, and for those periods in which the programmed feed
//! binds, where nothing but the curvature of the path asks for acceleration.
//!
//! Positions are differentiated by backward differences, as a drive does it. Work is linear, memory
//! constant.

mod high_pass;

use glidepath_geometry::{AXES, AxisVector};
use high_pass::HighPass;

/// Corner of the high pass, Hz.
pub const RINGING_HZ: f64 = 30.0;
/// An axis that moves by less in a period does not turn, mm or degrees: rounding.
const STILL_MM: f64 = 1e-9;

/// The smoothness of a motion, measured as it goes by.
#[derive(Debug)]
pub struct Smoothness {
    period_t: f64,
    /// The last position, and the differences up to it: of first and second order.
    last: Option<[AxisVector; 3]>,
    high_pass: HighPass,
    /// The sign of the last difference of each axis that was not still, 0 before it.
    direction: [i8; AXES],
    whole: Sums,
    at_feed: Sums,
}

/// The figures of some periods of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Figures {
    /// Number of periods.
    pub periods: u64,
    /// Rms jerk of every axis, mm/s³ or °/s³.
    pub rms_jerk_j: [f64; AXES],
    /// Largest jerk of every axis, mm/s³ or °/s³.
    pub peak_jerk_j: [f64; AXES],
    /// Rms acceleration above [`RINGING_HZ`] of every axis, mm/s² or °/s².
    pub ringing_a: [f64; AXES],
    /// How often every axis turned round. One that stood in between did so too.
    pub reversals: [u64; AXES],
    /// Mean distance of the positions from the programmed path, mm.
    pub mean_deviation_mm: f64,
    /// Rms distance of the positions from the programmed path, mm.
    pub rms_deviation_mm: f64,
}

/// The smoothness of a whole motion, and of a part of it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SmoothnessReport {
    /// Of all periods.
    pub whole: Figures,
    /// Of the periods in which the programmed feed binds.
    pub at_feed: Figures,
}

/// Sums over periods.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    periods: u64,
    jerk_2: [f64; AXES],
    peak_jerk: [f64; AXES],
    ringing_2: [f64; AXES],
    reversals: [u64; AXES],
    deviation_mm: f64,
    deviation_2: f64,
}

/// What one period adds to the sums.
#[derive(Debug)]
struct Period {
    jerk: AxisVector,
    ringing: AxisVector,
    turns: [bool; AXES],
    deviation_mm: f64,
}

impl Smoothness {
    /// Figures with nothing seen yet. The period, in s, is > 0.
    #[must_use]
    pub fn new(period_t: f64) -> Self {
        Self {
            period_t,
            last: None,
            high_pass: HighPass::new(RINGING_HZ, period_t),
            direction: [0; AXES],
            whole: Sums::default(),
            at_feed: Sums::default(),
        }
    }

    /// The next position, whether the feed binds in the period that it ends, and its distance from
    /// the programmed path. Before the first one the machine is at rest there.
    pub fn next(&mut self, position: &AxisVector, is_at_feed: bool, deviation_mm: f64) {
        if let Some(period) = self.advance(position, deviation_mm) {
            self.whole.add(&period);
            if is_at_feed {
                self.at_feed.add(&period);
            }
        }
    }

    /// A position that the motion goes through and that is not counted.
    pub fn pass(&mut self, position: &AxisVector) {
        let _uncounted = self.advance(position, 0.0);
    }

    fn advance(&mut self, position: &AxisVector, deviation_mm: f64) -> Option<Period> {
        let Some([last, first, second]) = self.last else {
            self.last = Some([*position, AxisVector::zeros(), AxisVector::zeros()]);
            return None;
        };
        let now_first = position - last;
        let now_second = now_first - first;
        let period = Period {
            jerk: (now_second - second) / self.period_t.powi(3),
            ringing: self.high_pass.next(&(now_second / self.period_t.powi(2))),
            turns: self.turns(&now_first),
            deviation_mm,
        };
        self.last = Some([*position, now_first, now_second]);
        Some(period)
    }

    /// The axes that move the other way than they last did.
    fn turns(&mut self, difference: &AxisVector) -> [bool; AXES] {
        let mut turns = [false; AXES];
        for (axis, turn) in turns.iter_mut().enumerate() {
            let way = difference[axis];
            if way.abs() > STILL_MM {
                let direction = if way > 0.0 { 1 } else { -1 };
                *turn = self.direction[axis] == -direction;
                self.direction[axis] = direction;
            }
        }
        turns
    }

    /// The figures so far.
    #[must_use]
    pub fn report(&self) -> SmoothnessReport {
        SmoothnessReport {
            whole: self.whole.figures(),
            at_feed: self.at_feed.figures(),
        }
    }
}

impl Sums {
    fn add(&mut self, period: &Period) {
        self.periods += 1;
        for axis in 0..AXES {
            let (jerk, ringing) = (period.jerk[axis], period.ringing[axis]);
            self.jerk_2[axis] += jerk * jerk;
            self.peak_jerk[axis] = self.peak_jerk[axis].max(jerk.abs());
            self.ringing_2[axis] += ringing * ringing;
            self.reversals[axis] += u64::from(period.turns[axis]);
        }
        self.deviation_mm += period.deviation_mm;
        self.deviation_2 += period.deviation_mm * period.deviation_mm;
    }

    fn figures(&self) -> Figures {
        #[allow(
            clippy::cast_precision_loss,
            reason = "a mean; 2⁵³ periods are a million years"
        )]
        let periods = self.periods.max(1) as f64;
        let rms = |sum: f64| (sum / periods).sqrt();
        Figures {
            periods: self.periods,
            rms_jerk_j: self.jerk_2.map(rms),
            peak_jerk_j: self.peak_jerk,
            ringing_a: self.ringing_2.map(rms),
            reversals: self.reversals,
            mean_deviation_mm: self.deviation_mm / periods,
            rms_deviation_mm: rms(self.deviation_2),
        }
    }
}

#[cfg(test)]
mod tests;
