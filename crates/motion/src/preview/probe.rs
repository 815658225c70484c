//! The probe: a curve that counts how often a method evaluates it.

use glidepath_geometry::{AxisVector, NurbsJet, NurbsPath, Span, SpanCurvature};

/// A curve that counts how often it is evaluated.
#[derive(Debug)]
pub struct Probe<'a> {
    path: &'a NurbsPath,
    points: u64,
}

/// The curve at a point, in the axes that measure the feed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Radius of curvature, mm; infinite where straight, 0 where the curve stands still.
    pub radius_mm: f64,
    /// ds/du, mm.
    pub speed: f64,
    /// Sign of dκ/du: -1, 0 or 1.
    pub tightening: f64,
}

impl<'a> Probe<'a> {
    /// Nothing evaluated yet.
    #[must_use]
    pub const fn new(path: &'a NurbsPath) -> Self {
        Self { path, points: 0 }
    }

    /// The curve and its length.
    #[must_use]
    pub const fn path(&self) -> &'a NurbsPath {
        self.path
    }

    /// Points evaluated so far.
    #[must_use]
    pub const fn points(&self) -> u64 {
        self.points
    }

    /// Evaluates the curve at `u`.
    pub fn at(&mut self, u: f64) -> Reading {
        let curve = self.path.curve();
        read(&self.jet(u), curve.feed_axes().start)
    }

    /// Evaluates the position and derivatives at `u`.
    pub fn jet(&mut self, u: f64) -> NurbsJet {
        self.points += 1;
        self.path.curve().jet(u)
    }

    /// Evaluates the tangent at the end of a span, the limit from its own side.
    pub fn end_tangent(&mut self, span: &Span) -> AxisVector {
        self.points += 1;
        span.jet(span.to_u()).d1
    }

    /// Evaluates the signed curvature of a span at `u`, 1/mm.
    pub fn curvature(&mut self, span: &SpanCurvature, u: f64) -> f64 {
        self.points += 1;
        span.at(u)
    }
}

fn read(jet: &NurbsJet, first: usize) -> Reading {
    let part = |v: &AxisVector| v.fixed_rows::<3>(first).into_owned();
    let (d1, d2, d3) = (part(&jet.d1), part(&jet.d2), part(&jet.d3));
    let turning = d1.cross(&d2);
    let speed = d1.norm();
    let radius_mm = if speed > 0.0 {
        speed.powi(3) / turning.norm()
    } else {
        0.0
    };
    // κ² = |b|²/|d1|⁶ with b = d1 × d2 and b' = d1 × d3.
    let change = 2.0 * turning.dot(&d1.cross(&d3)) * speed * speed
        - 6.0 * turning.norm_squared() * d1.dot(&d2);
    let tightening = if change == 0.0 { 0.0 } else { change.signum() };
    Reading {
        radius_mm,
        speed,
        tightening,
    }
}
