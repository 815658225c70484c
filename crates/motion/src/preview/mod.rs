//! The preview of a NURBS: where on it the programmed feedrate is too fast, and which speed is not.
//!
//! A tick at speed v goes along a chord of length vT while the curve bulges beyond it by the chord
//! error. With c = vT/2 and the radius of curvature ρ that error is c²/(ρ + √(ρ² − c²)), and it
//! exceeds δ exactly where ρ < F²T²/(8δ) + δ/2. Such a stretch is a *speed-sensitive region*; what
//! the planner needs of it are its ends and its curvature maxima, each with the speed it allows:
//!
//! ```text
//!   κ │        ╭╮                     minimum of ρ, and of the allowed speed
//!     │       ╱  ╲        ╭─╮
//! 1/ρc│┈┈┈┈┈┈╱┈┈┈┈╲┈┈┈┈┈┈╱┈┈┈╲┈┈┈
//!     │─────╯      ╰────╯     ╰──
//!     └──────┴────┴──────┴───┴─── u
//!            region      region
//! ```
//!
//! A limit of the normal acceleration (v²/ρ) and of its jerk (v³/ρ²) makes thresholds of the same
//! kind, so one preview serves all three.
//!
//! | method | how | misses |
//! |---|---|---|
//! | [`Traditional`] | evaluates at every tick of a motion whose speed follows the curvature | regions shorter than a tick |
//! | [`AdvanceRetreat`] | doubles its step while all is well, retreats to the start of a region, scans it | regions shorter than its longest step; all but one minimum of a region |
//! | [`Certified`] | bounds the curvature of whole knot spans, isolates its extremes by polynomials | none |
//!
//! All three evaluate the curve through one [`Probe`], which counts.
//!
//! Measured on reference curves (feedrate 6000 mm/min, chord error 1 µm):
//!
#![doc = include_str!("table.md")]
//!
//! (`cargo run --release -p glidepath-motion --example preview_table`)
//!
//! Sources: *A fast read-ahead processing method for NURBS curve interpolation based on advance and
//! retreat* (Chinese patent), for the second method, with the repairs its text needs; the certified
//! method was derived for Glidepath.

mod certified;
mod probe;
mod published;

pub use certified::Certified;
pub use probe::{Probe, Reading};
pub use published::{AdvanceRetreat, Traditional};

use glidepath_geometry::NurbsPath;

/// The demand on the motion along a curve: what it shall keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// Programmed feedrate, mm/s, > 0.
    pub feed_v: f64,
    /// Period of a tick, s, > 0.
    pub period_t: f64,
    /// Chord error of one tick, mm, > 0.
    pub chord_mm: f64,
    /// Limit of the normal acceleration, mm/s²; infinite for none.
    pub normal_a: f64,
    /// Limit of the normal jerk, mm/s³; infinite for none.
    pub normal_j: f64,
}

impl Demand {
    /// Chord error alone.
    #[must_use]
    pub const fn chord(feed_v: f64, period_t: f64, chord_mm: f64) -> Self {
        Self {
            feed_v,
            period_t,
            chord_mm,
            normal_a: f64::INFINITY,
            normal_j: f64::INFINITY,
        }
    }

    /// The radius of curvature below which the feedrate is too fast, mm.
    #[must_use]
    pub fn critical_radius_mm(&self) -> f64 {
        let (f, t, d) = (self.feed_v, self.period_t, self.chord_mm);
        let chord = f * f * t * t / (8.0 * d) + 0.5 * d;
        chord
            .max(f * f / self.normal_a)
            .max((f * f * f / self.normal_j).sqrt())
    }

    /// Chord error of one tick at speed `v` on a circle of a radius, mm; on a circle the tick does
    /// not fit into, its radius.
    #[must_use]
    pub fn chord_error_mm(&self, v: f64, radius_mm: f64) -> f64 {
        let half = 0.5 * v * self.period_t;
        if half >= radius_mm {
            return radius_mm;
        }
        if radius_mm.is_infinite() {
            return 0.0;
        }
        // ρ − √(ρ² − c²) without its cancellation.
        half * half / (radius_mm + ((radius_mm - half) * (radius_mm + half)).sqrt())
    }

    /// Speed a radius of curvature allows, at most the feedrate, mm/s.
    #[must_use]
    pub fn cap_v(&self, radius_mm: f64) -> f64 {
        let (r, t, d) = (radius_mm, self.period_t, self.chord_mm);
        if r.is_infinite() {
            return self.feed_v;
        }
        let chord = if r >= d {
            2.0 / t * (d * (2.0 * r - d)).sqrt()
        } else {
            2.0 * r / t
        };
        let normal = (self.normal_a * r).sqrt();
        let jerk = (self.normal_j * r * r).cbrt();
        // No limit times no radius is no number: the other operand counts.
        self.feed_v.min(chord).min(normal).min(jerk)
    }
}

/// A minimum of the radius of curvature inside a region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Minimum {
    /// Curve parameter.
    pub u: f64,
    /// Radius of curvature, mm; 0 at a corner and where the curve stands still (a cusp).
    pub radius_mm: f64,
    /// Speed it allows, mm/s.
    pub cap_v: f64,
}

/// A speed-sensitive region.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// Parameter of its start.
    pub from_u: f64,
    /// Parameter of its end; a corner is a region of one point.
    pub to_u: f64,
    /// Minima of the radius inside it, ascending in `u`, at least one.
    pub minima: Vec<Minimum>,
}

/// The result of a preview.
#[derive(Debug, Clone, PartialEq)]
pub struct Preview {
    /// Points at which the curvature was evaluated.
    pub points_evaluated: u64,
    /// The regions, ascending and disjoint.
    pub regions: Vec<Region>,
}

impl Preview {
    /// The number of regions of `truth` that have no point in common with any of these.
    #[must_use]
    pub fn missed(&self, truth: &Self) -> usize {
        let found = |region: &Region| {
            self.regions
                .iter()
                .any(|own| own.from_u <= region.to_u && own.to_u >= region.from_u)
        };
        truth.regions.iter().filter(|region| !found(region)).count()
    }
}

/// A way to find the regions.
pub trait Method {
    /// Its name on the command line.
    fn name(&self) -> &'static str;

    /// The regions of the probe's curve.
    fn regions(&self, probe: &mut Probe<'_>, demand: &Demand) -> Vec<Region>;
}

/// Reads a curve ahead by one of the methods.
#[must_use]
pub fn preview(path: &NurbsPath, demand: &Demand, method: &dyn Method) -> Preview {
    let mut probe = Probe::new(path);
    let regions = method.regions(&mut probe, demand);
    Preview {
        points_evaluated: probe.points(),
        regions,
    }
}
