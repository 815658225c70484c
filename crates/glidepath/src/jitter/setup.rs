//! The set-up of a measurement.

use super::motion::LoadMotion;
use glidepath_realtime::{Mode, Request};

/// The set-up of a measurement: what to measure.
#[derive(Debug)]
pub struct Setup {
    /// Period, ns.
    pub period_ns: u64,
    /// How long.
    pub seconds: u32,
    /// What the thread asks for.
    pub request: Request,
    /// Whether it measures without what it is not granted.
    pub mode: Mode,
    /// The motion whose ticks are the work of each period; nothing without.
    pub motion: Option<LoadMotion>,
    /// Run cyclictest beside.
    pub against_cyclictest: bool,
}
