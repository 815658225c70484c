//! NURBS through dense runs of short lines.
//!
//! ```text
//!  points ── corners ──► parts ── knots, least squares, removal ──► cubic splines ──► one NURBS
//!            (turns by           (module `knots`)                   (corners become knots of
//!             more than 18°)                                         multiplicity three)
//! ```
//!
//! For given knots and parameters of the points, the best control points are the solution of a
//! linear system; what remains to be found is how many knots and where. Three methods:
//!
//! | method | searches | result |
//! |---|---|---|
//! | [`Method::LeastSquares`] (default) | knots: greedily, then removing what is not needed | fewest points for the time |
//! | [`Method::Foraging`] | the control points, by bacterial foraging, over the knots of the first | as published; cannot beat least squares, only approach it |
//! | [`Method::Hybrid`] | the knots, by bacterial foraging, control points by least squares | at most as many points as the first, slowly |
//!
//! Measured on 3829 points of a curve of 383 mm with four sharp tips (a butterfly sampled every
//! 0.1 mm, to the micrometre), tolerance 10 µm, one core:
//!
//! | method | control points | error both ways | time |
//! |---|---|---|---|
//! | least squares | 149 | 9.7 and 9.9 µm | 0.2 s |
//! | hybrid | 144 | 9.6 and 9.9 µm | 1.1 s |
//! | foraging, 496 iterations | 149 | 92 and 93 µm | 2.2 s |
//!
//! The published search reduces the sum of squares of a part from 34 mm² to 0.4 mm², where least
//! squares has 0.01 mm². (`cargo run --release -p glidepath-fit --example fit_table all`)
//!
//! The error that counts is the distance both ways: of every point from the curve, and of the curve
//! from the polyline through the points. [`Deviation`] measures it independently of how a curve was
//! found.
//!
//! In the pipeline it serves `glidepath fit` alone: the command gathers the dense runs of a
//! program and writes the curves that [`fit`] finds as curve files or as a program again. Planning
//! does not pass through here.
//!
//! ```
//! use glidepath_fit::{Point, Settings, fit};
//!
//! // A quarter of a circle of 10 mm, a point every half degree.
//! let on_circle = |i: u32| {
//!     let angle = f64::from(i).to_radians() / 2.0;
//!     Point::new(10.0 * angle.cos(), 10.0 * angle.sin(), 0.0)
//! };
//! let points: Vec<Point> = (0..=180).map(on_circle).collect();
//! let fitted = fit(&points, &Settings::new(0.01), &mut |_share_done| {})?;
//! assert!(fitted.deviation.max_mm() <= 0.01);
//! assert!(fitted.curve.control_points().len() < 12);
//! # Ok::<(), glidepath_fit::FitError>(())
//! ```
//!
//! Everything is deterministic: the searches draw from a generator with a seed, in a fixed order.
//!
//! Sources: the foraging method is that of Gu, Zhou, Lin et al. on NURBS fitting by bacterial
//! foraging, completed after Passino, *Biomimicry of bacterial foraging*, 2002.

mod bacterial_foraging;
mod corner;
mod deviation;
mod knots;
mod least_squares;
mod part;
mod point;
mod spline;

pub use bacterial_foraging::Foraging;
pub use deviation::Deviation;
pub use point::Point;

use glidepath_geometry::{AxisVector, Nurbs, NurbsError};
use knots::Placed;
use part::{Candidate, Part};

/// The share of the tolerance the fit uses: it compares curve and polyline at some points, and
/// between them they may be a little further apart.
const RESERVE: f64 = 0.99;

/// The method by which a curve is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Greedy knots, least squares, removal.
    #[default]
    LeastSquares,
    /// Bacterial foraging on the control points, as published.
    Foraging,
    /// Bacterial foraging on the knots, least squares for the control points.
    Hybrid,
}

/// The settings of a fit: what it shall keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Largest distance between curve and points, both ways, mm, > 0.
    pub tolerance_mm: f64,
    /// Turns of the polyline above this are corners and stay exactly, rad.
    pub corner_rad: f64,
    /// How the curve is found.
    pub method: Method,
    /// Seed of the searches.
    pub seed: u64,
}

impl Settings {
    /// The default method, corners of more than 18°.
    #[must_use]
    pub const fn new(tolerance_mm: f64) -> Self {
        Self {
            tolerance_mm,
            corner_rad: 0.1 * core::f64::consts::PI,
            method: Method::LeastSquares,
            seed: 0,
        }
    }
}

/// The reason why there is no curve.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Fewer than two points that differ.
    #[error("{points} distinct points: a curve needs at least two")]
    TooFewPoints {
        /// How many there are.
        points: usize,
    },
    /// A coordinate that is infinite or no number.
    #[error("point {index} is not finite")]
    NotFinite {
        /// Its index.
        index: usize,
    },
    /// The curve would have more control points than the run has points.
    #[error("{control_points} control points for {points} points: the run is not dense")]
    NotDense {
        /// Control points of the curve.
        control_points: usize,
        /// Distinct points of the run.
        points: usize,
    },
    /// The points make no curve.
    #[error(transparent)]
    Curve(#[from] NurbsError),
}

/// A part of a fit, between two corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartReport {
    /// Points.
    pub points: usize,
    /// Control points.
    pub control_points: usize,
    /// Sum of the squared distances at the parameters of the points, mm².
    pub squares_mm2: f64,
    /// Largest of these distances, mm.
    pub max_mm: f64,
    /// What a search found along the way, if there was one.
    pub search: Option<Foraging>,
}

/// A curve through a run of points.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The curve, parametrised by chord length in mm.
    pub curve: Nurbs,
    /// Its parts.
    pub parts: Vec<PartReport>,
    /// How far curve and polyline are apart.
    pub deviation: Deviation,
}

impl Fit {
    /// Corners that were kept.
    #[must_use]
    pub fn corners(&self) -> usize {
        self.parts.len() - 1
    }
}

/// Fits a NURBS to a run of points. `progress` is told how much of the work is done, from 0 to 1.
///
/// The result is the best that was found: whether it keeps the tolerance is in its
/// [`Fit::deviation`]. Where the chords themselves bulge further from every smooth curve than the
/// tolerance, none does.
///
/// # Errors
/// The points are too few, not finite, or not dense.
pub fn fit(
    points: &[Point],
    settings: &Settings,
    progress: &mut dyn FnMut(f64),
) -> Result<Fit, FitError> {
    let finite = |point: &Point| point.iter().all(|x| x.is_finite());
    if let Some(index) = points.iter().position(|point| !finite(point)) {
        return Err(FitError::NotFinite { index });
    }
    let points = corner::distinct(points);
    if points.len() < 2 {
        return Err(FitError::TooFewPoints {
            points: points.len(),
        });
    }
    let mut joined = Joined::default();
    let mut parts = Vec::new();
    let mut done = 0.0;
    for (index, placed) in placed(&points, settings).into_iter().enumerate() {
        let part = &placed.part;
        let share = part.points.len() as f64 / points.len() as f64;
        let seed = settings.seed.wrapping_add(index as u64);
        let mut progress = |of_part: f64| progress((done + share * of_part).min(1.0));
        let (candidate, search, judged) = match settings.method {
            Method::LeastSquares => (placed.candidate, None, part),
            Method::Foraging => {
                // What the search made small, so that its figures can be compared.
                let part = placed.determined();
                let (candidate, search) = bacterial_foraging::on_control_points(
                    part,
                    &placed.candidate,
                    seed,
                    &mut progress,
                );
                (candidate, search, part)
            }
            Method::Hybrid => {
                let (candidate, search) = bacterial_foraging::on_knots(
                    &placed.fitted,
                    placed.candidate,
                    seed,
                    &mut progress,
                );
                (candidate, search, part)
            }
        };
        done += share;
        let residual = judged.residual(&candidate.spline);
        parts.push(report(part, residual, &candidate, search));
        joined.append(&candidate.spline);
    }
    let control_points = joined.control.len();
    if control_points > points.len() && points.len() > 3 {
        return Err(FitError::NotDense {
            control_points,
            points: points.len(),
        });
    }
    let curve = joined.curve()?;
    let deviation = Deviation::measure(&curve, &points);
    progress(1.0);
    Ok(Fit {
        curve,
        parts,
        deviation,
    })
}

/// The parts between corners with their least-squares fits. Neighbouring corners are taken for one
/// sampled tip; where that does not keep the tolerance, they become corners, the sharpest first.
fn placed(points: &[Point], settings: &Settings) -> Vec<Placed> {
    let tips = corner::split_at_tips(points, settings.corner_rad);
    let mut placed = Vec::new();
    for ends in tips.windows(2) {
        place(&points[ends[0]..=ends[1]], settings, &mut placed);
    }
    placed
}

fn place(points: &[Point], settings: &Settings, placed: &mut Vec<Placed>) {
    let part = Part::new(points, RESERVE * settings.tolerance_mm);
    match knots::place_within(part) {
        Ok(part) => placed.push(part),
        Err(part) => match corner::sharpest(points, settings.corner_rad) {
            Some(corner) => {
                place(&points[..=corner], settings, placed);
                place(&points[corner..], settings, placed);
            }
            None => placed.push(knots::place_bulging(part)),
        },
    }
}

fn report(
    part: &Part,
    (squares_mm2, max_mm): (f64, f64),
    candidate: &Candidate,
    search: Option<Foraging>,
) -> PartReport {
    PartReport {
        points: part.points.len(),
        control_points: candidate.spline.control.len(),
        squares_mm2,
        max_mm,
        search,
    }
}

/// Splines one after the other as one curve: where two meet, a knot three times.
#[derive(Debug, Default)]
struct Joined {
    control: Vec<AxisVector>,
    knots: Vec<f64>,
    end: f64,
}

impl Joined {
    fn append(&mut self, spline: &spline::Spline) {
        let over_axes = |point: &Point| {
            let mut over_axes = AxisVector::zeros();
            for axis in 0..3 {
                over_axes[axis] = point[axis];
            }
            over_axes
        };
        // The first control point is the last of the part before.
        let skip = usize::from(!self.control.is_empty());
        self.control
            .extend(spline.control.iter().skip(skip).map(over_axes));
        let start = if skip == 0 { vec![0.0; 4] } else { Vec::new() };
        self.knots.extend(start);
        let inside = spline::inside(&spline.knots);
        self.knots.extend(inside.iter().map(|knot| self.end + knot));
        self.end += spline.knots[spline.knots.len() - 1];
        self.knots.extend([self.end; 3]);
    }

    fn curve(mut self) -> Result<Nurbs, NurbsError> {
        self.knots.push(self.end);
        let weights = vec![1.0; self.control.len()];
        Nurbs::new(3, &self.control, &weights, &self.knots)
    }
}
