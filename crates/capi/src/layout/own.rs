//! The structures that are no records: what the servo is told, and what it tells.
#![allow(
    unsafe_code,
    reason = "the derives of `Pod` and `Zeroable` expand to `unsafe impl`; both check the fields"
)]

use super::structure::{Each, Field, InC, Structure, in_c, structure};
use glidepath_geometry::AXES;

/// Why a servo stopped the joints by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum Stopped {
    Not = 0,
    Silence = 1,
    Asked = 2,
    Jump = 3,
}

/// What of a jump is too much.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum TooMuch {
    None = 0,
    Velocity = 1,
    Acceleration = 2,
}

/// See [`JOINT`].
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GpJoint {
    pub(crate) position: f64,
    pub(crate) velocity: f64,
    pub(crate) acceleration: f64,
}

/// See [`STOP_LIMITS`].
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct GpStopLimits {
    pub(crate) acceleration: f64,
    pub(crate) jerk: f64,
}

/// See [`JUMP_LIMITS`].
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct GpJumpLimits {
    pub(crate) velocity: f64,
    pub(crate) acceleration: f64,
}

/// See [`SERVO_SETTINGS`].
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct GpServoSettings {
    pub(crate) patience_ns: u64,
    pub(crate) stop: [GpStopLimits; AXES],
    pub(crate) jump: [GpJumpLimits; AXES],
}

/// See [`JUMP`].
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GpJump {
    pub(crate) joint: u32,
    pub(crate) of: u32,
    pub(crate) from_position: f64,
    pub(crate) to_position: f64,
    pub(crate) span_t: f64,
    pub(crate) asked: f64,
    pub(crate) limit: f64,
}

/// See [`SERVO_STATE`].
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GpServoState {
    pub(crate) armed: u32,
    pub(crate) stopped: u32,
    pub(crate) port_failed: u32,
    pub(crate) reserved: u32,
    pub(crate) jump: GpJump,
    pub(crate) received: u64,
    pub(crate) lost: u64,
    pub(crate) gaps: u64,
    pub(crate) duplicates: u64,
    pub(crate) late: u64,
    pub(crate) refused: u64,
    pub(crate) missed_ticks: u64,
    pub(crate) restarts: u64,
    pub(crate) references: u64,
    pub(crate) stops: u64,
    pub(crate) jumps: u64,
}

in_c! {
    GpStopLimits: "gp_stop_limits",
    GpJumpLimits: "gp_jump_limits",
    GpJump: "gp_jump",
}

structure! {
    /// What a joint is to do.
    JOINT: "gp_joint" = GpJoint, "", 24 {
        /// mm or degrees
        position: f64,
        /// mm/s or degrees/s
        velocity: f64,
        /// mm/s^2 or degrees/s^2
        acceleration: f64,
    }
}

structure! {
    /// What a joint's own stop may use, both > 0.
    STOP_LIMITS: "gp_stop_limits" = GpStopLimits, "", 16 {
        /// mm/s^2 or degrees/s^2
        acceleration: f64,
        /// mm/s^3 or degrees/s^3
        jerk: f64,
    }
}

structure! {
    /// Beyond this a setpoint is a jump and is not played; both > 0, INFINITY for no guard. Set them
    /// above the joint's limits: 1.2 times the velocity and twice the acceleration are good.
    JUMP_LIMITS: "gp_jump_limits" = GpJumpLimits, "", 16 {
        /// mm/s or degrees/s
        velocity: f64,
        /// mm/s^2 or degrees/s^2
        acceleration: f64,
    }
}

structure! {
    /// How a servo behaves when setpoints stay away, or jump.
    SERVO_SETTINGS: "gp_servo_settings" = GpServoSettings, "", 296 {
        /// how long after the time of the last setpoint the joints go on at constant acceleration, ns
        patience_ns: u64,
        /// what each joint's own stop may use
        stop: Each<GpStopLimits>,
        /// what each joint is never asked for
        jump: Each<GpJumpLimits>,
    }
}

structure! {
    /// A setpoint that was not played, because the way to it is beyond the limits.
    JUMP: "gp_jump" = GpJump, "", 48 {
        /// the joint, from 0
        joint: u32,
        /// what is too much: GP_JUMP_NONE before the first jump
        of: u32,
        /// where the joint would have come from, mm or degrees
        from_position: f64,
        /// where it was to go, mm or degrees
        to_position: f64,
        /// in what time, s
        span_t: f64,
        /// how much it would have been, in units per s or s^2
        asked: f64,
        /// how much is allowed
        limit: f64,
    }
}

structure! {
    /// What a servo does, and what arrived so far.
    SERVO_STATE: "gp_servo_state" = GpServoState, "", 152 {
        /// 1 if setpoints are played, or will be from the first that the servo can begin at
        armed: u32,
        /// why the servo stopped the joints by itself, GP_STOPPED_NOT if it did not
        stopped: u32,
        /// 1 if no setpoint comes any more, because the transport failed: gp_servo_close says why
        port_failed: u32,
        /// zero
        reserved: u32,
        /// means something if stopped is GP_STOPPED_JUMP
        jump: GpJump,
        /// setpoints that arrived and were new
        received: u64,
        /// setpoints that were published but did not arrive
        lost: u64,
        /// gaps in the numbers, of any length
        gaps: u64,
        /// setpoints that arrived again, or after a later one
        duplicates: u64,
        /// setpoints that arrived after their time
        late: u64,
        /// records that failed their check
        refused: u64,
        /// ticks that the interpolator missed
        missed_ticks: u64,
        /// times the interpolator was started anew
        restarts: u64,
        /// times the position was taken anew from the drives
        references: u64,
        /// own stops
        stops: u64,
        /// setpoints that were not played because they jumped
        jumps: u64,
    }
}
