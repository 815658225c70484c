//! Measured points, and how far a mechanism is off at them.

use crate::JointVector;
use glidepath_geometry::AxisVector;

/// Coordinates that can be measured: X Y Z A B C.
const MEASURED: usize = 6;

/// A point: the joints, and where the tool was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredPoint {
    /// Where the joints said they were, mm or degrees.
    pub joints: JointVector,
    /// X Y Z of the tip, mm, and A B C, degrees; `None` for what was not measured.
    pub measured: [Option<f64>; MEASURED],
    /// Where the tool is about, for mechanisms whose joints fit several places.
    pub near: AxisVector,
}

/// How accurately was measured: standard deviations, > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuringAccuracy {
    /// Of a coordinate, mm.
    pub position_mm: f64,
    /// Of an angle, degrees.
    pub angle_deg: f64,
}

/// How far a kind of numbers is off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResidualSize {
    /// Root of the mean square over the points.
    pub rms: f64,
    /// The most.
    pub worst: f64,
    /// At which point that was, from 0.
    pub worst_point: usize,
}

/// The residuals: how far measured points are from where the dimensions put them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointResiduals {
    /// Of the tip, as a distance in what was measured of it, mm; `None` where no coordinate was.
    pub position_mm: Option<ResidualSize>,
    /// Of the angles, degrees, the largest of a point; `None` where none was measured.
    pub angle_deg: Option<ResidualSize>,
}

/// All residuals of a set of points.
pub(super) struct Evaluated {
    /// Every measured number's, divided by its accuracy.
    pub(super) weighted: Vec<f64>,
    pub(super) summary: PointResiduals,
}

/// Gathers residuals point by point.
#[derive(Default)]
pub(super) struct Gathering {
    weighted: Vec<f64>,
    position_mm: Vec<(usize, f64)>,
    angle_deg: Vec<(usize, f64)>,
}

impl Gathering {
    /// Takes the tool as the dimensions put it.
    pub(super) fn take(
        &mut self,
        number: usize,
        point: &MeasuredPoint,
        at: &AxisVector,
        accuracy: &MeasuringAccuracy,
    ) {
        let (mut square, mut most_deg) = (None, None);
        for (axis, measured) in point.measured.iter().enumerate() {
            let Some(measured) = measured else { continue };
            let off = at[axis] - measured;
            if axis < 3 {
                self.weighted.push(off / accuracy.position_mm);
                square = Some(square.unwrap_or(0.0) + off * off);
            } else {
                // An axis may have made turns that nobody measures.
                let off = off - 360.0 * (off / 360.0).round();
                self.weighted.push(off / accuracy.angle_deg);
                most_deg = Some(f64::max(most_deg.unwrap_or(0.0), off.abs()));
            }
        }
        if let Some(square) = square {
            self.position_mm.push((number, f64::sqrt(square)));
        }
        if let Some(most_deg) = most_deg {
            self.angle_deg.push((number, most_deg));
        }
    }

    pub(super) fn finish(self) -> Evaluated {
        Evaluated {
            weighted: self.weighted,
            summary: PointResiduals {
                position_mm: miss(&self.position_mm),
                angle_deg: miss(&self.angle_deg),
            },
        }
    }
}

fn miss(points: &[(usize, f64)]) -> Option<ResidualSize> {
    let worst = points.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let squares: f64 = points.iter().map(|(_, off)| off * off).sum();
    #[allow(clippy::cast_precision_loss, reason = "a count of points")]
    let count = points.len() as f64;
    Some(ResidualSize {
        rms: (squares / count).sqrt(),
        worst: worst.1,
        worst_point: worst.0,
    })
}
