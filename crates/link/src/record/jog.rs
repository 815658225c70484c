//! The jog record, from an operator's panel to the interpolator: how the axes are to be moved by
//! hand.

use super::check::{Fields, RecordError};
use super::code::coded;
use super::{ALL_JOINTS, Record};
use glidepath_geometry::AXES;
use iceoryx2::prelude::ZeroCopySend;

coded! {
    /// The way in which a [`JogDemand`] moves the machine.
    pub enum JogMode {
        /// Not at all: whoever jogs lets go.
        None = 0,
        /// As long as demands keep coming, at the velocities in `value`, mm/s or °/s. Without a
        /// newer demand the motion stops by itself.
        Continuous = 1,
        /// Once for every `number`, by the distances in `value`, mm or degrees.
        Incremental = 2,
        /// As a wheel turns: `value` are the counts of the wheel since it was switched on, and a
        /// count is `scale`.
        Wheel = 3,
        /// As fast as a wheel turns: likewise, but the motion stops when the wheel does.
        WheelVelocity = 4,
    }
}

/// A demand of a client that jogs: how the axes, or the joints, are to be moved by hand. The latest
/// counts; the first client owns the axes until they are at rest.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.JogDemand.v2")]
pub struct JogDemand {
    /// Who asks: any number that no other client has.
    pub client: u64,
    /// Counts what the client asks for. The same again says that the client lives, and nothing new.
    pub number: u64,
    /// When it was sent, ns of `CLOCK_MONOTONIC` of this host. A bridge from another host stamps
    /// anew what came fresh from there, and nothing else.
    pub sent_ns: u64,
    /// When `number` was asked for, on the same clock; 0 if nobody knows. What was asked for before the machine
    /// was stopped moves nothing.
    pub asked_ns: u64,
    /// Code of a [`JogMode`].
    pub mode: u32,
    /// The axes, or joints, that are meant, one bit each, X or J0 lowest.
    pub mask: u32,
    /// 1 if `mask` and `value` are about joints, 0 if about axes.
    pub by_joint: u32,
    /// Must be zero.
    pub reserved: u32,
    /// How fast at most, mm/s or °/s, in the modes that give no velocity; 0 for as fast as jogging
    /// may be.
    pub velocity_v: f64,
    /// What a count of a wheel is, mm or degrees.
    pub scale: f64,
    /// See [`JogMode`].
    pub value: [f64; AXES],
}

impl JogDemand {
    /// The way in which it moves the machine.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn mode(&self) -> Result<JogMode, RecordError> {
        Fields(Self::NAME).code("mode", self.mode)
    }
}

impl Record for JogDemand {
    const NAME: &'static str = "glidepath.JogDemand.v2";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        self.mode()?;
        fields.flags("mask", self.mask, ALL_JOINTS)?;
        fields.flags("by_joint", self.by_joint, 1)?;
        fields.zero("reserved", self.reserved)?;
        fields.range("velocity_v", self.velocity_v, 0.0, f64::MAX)?;
        fields.finite("scale", self.scale)?;
        fields.all_finite("value", &self.value)
    }
}
