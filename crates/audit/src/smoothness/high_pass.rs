//! A high-pass filter: what of a signal is faster than a frequency.
//!
//! A Butterworth high pass of fourth order: two sections of second order in a row, by the bilinear
//! transform, with the corner where it is wanted (prewarped). Nothing of a constant passes, −24 dB
//! an octave below the corner, everything above it.

use core::f64::consts::PI;
use glidepath_geometry::AxisVector;

/// The filter, for all axes at once.
#[derive(Debug)]
pub(super) struct HighPass {
    sections: [Section; 2],
}

/// A section of second order, in transposed direct form II.
#[derive(Debug)]
struct Section {
    /// Coefficients of the input: b, −2 b, b.
    b: f64,
    /// Coefficients of the output before, and of the one before that.
    a: [f64; 2],
    state: [AxisVector; 2],
}

impl HighPass {
    /// A filter for samples at a period, its corner at a frequency. Where the period is too long
    /// for the corner (at half the sampling rate or above), nothing passes.
    pub(super) fn new(corner_hz: f64, period_t: f64) -> Self {
        // Quality of the two pairs of poles of the fourth order.
        let quality = |angle_rad: f64| 0.5 / angle_rad.cos();
        let section = |q| Section::new(corner_hz * period_t, q);
        Self {
            sections: [section(quality(PI / 8.0)), section(quality(3.0 * PI / 8.0))],
        }
    }

    pub(super) fn next(&mut self, input: &AxisVector) -> AxisVector {
        let [first, second] = &mut self.sections;
        second.next(&first.next(input))
    }
}

impl Section {
    /// `corner_r`: the corner as a share of the sampling rate.
    fn new(corner_r: f64, quality: f64) -> Self {
        let zero = AxisVector::zeros();
        if corner_r >= 0.5 {
            return Self {
                b: 0.0,
                a: [0.0; 2],
                state: [zero; 2],
            };
        }
        let k = (PI * corner_r).tan();
        let norm = 1.0 / (1.0 + k / quality + k * k);
        Self {
            b: norm,
            a: [
                2.0 * (k * k - 1.0) * norm,
                (1.0 - k / quality + k * k) * norm,
            ],
            state: [zero; 2],
        }
    }

    fn next(&mut self, input: &AxisVector) -> AxisVector {
        let output = input * self.b + self.state[0];
        self.state[0] = input * (-2.0 * self.b) - output * self.a[0] + self.state[1];
        self.state[1] = input * self.b - output * self.a[1];
        output
    }
}
