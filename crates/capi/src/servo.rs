//! The servo of the library: its settings judged, its state as a structure.

use crate::failure::Failure;
use crate::layout::{
    GpJoint, GpJump, GpJumpLimits, GpServoSettings, GpServoState, GpStopLimits, Stopped, TooMuch,
};
use core::num::FpCategory;
use glidepath_geometry::AXES;
use glidepath_link::servo::{
    Jump, JumpLimits, JumpOf, OwnStop, RingFiller, RingSource, Servo, ServoSettings, StopLimits,
    ring,
};
use glidepath_link::{Ipc, LinkConfig, LinkError, Setpoint, Transport as _};

/// A servo whose setpoints another thread takes from the transport.
#[derive(Debug)]
pub(crate) struct RingServo {
    servo: Servo<RingSource>,
    filler: RingFiller,
}

impl RingServo {
    pub(crate) fn open(config: &LinkConfig, settings: &GpServoSettings) -> Result<Self, Failure> {
        let settings = judged(settings)?;
        let config = config.clone();
        let (source, filler) = ring(move || Ipc::connect(&config)?.setpoint_source())?;
        Ok(Self {
            servo: Servo::new(source, settings),
            filler,
        })
    }

    pub(crate) fn receive(&mut self, now_ns: u64) -> Result<Option<Setpoint>, LinkError> {
        self.servo.receive(now_ns)
    }

    pub(crate) fn demand(&mut self, now_ns: u64) -> Option<[GpJoint; AXES]> {
        let demand = self.servo.demand(now_ns)?;
        Some(demand.map(|joint| GpJoint {
            position: joint.position,
            velocity: joint.velocity,
            acceleration: joint.acceleration,
        }))
    }

    pub(crate) fn stop(&mut self, now_ns: u64) {
        self.servo.stop(now_ns);
    }

    pub(crate) fn rearm(&mut self) {
        self.servo.rearm();
    }

    pub(crate) fn rearm_at(
        &mut self,
        actual: &[f64; AXES],
        window: &[f64; AXES],
    ) -> Result<(), Failure> {
        if !actual.iter().all(|place| place.is_finite()) {
            return Err(Failure::Argument("actual: every position has to be finite"));
        }
        if !window.iter().all(|width| *width >= 0.0) {
            return Err(Failure::Argument(
                "window: every width has to be 0 or more, INFINITY for a joint that there is not",
            ));
        }
        self.servo.rearm_at(actual, window);
        Ok(())
    }

    pub(crate) fn state(&self) -> GpServoState {
        let counts = self.servo.counts();
        let (stopped, jump) = match self.servo.stopped() {
            None => (Stopped::Not, None),
            Some(OwnStop::Silence) => (Stopped::Silence, None),
            Some(OwnStop::Asked) => (Stopped::Asked, None),
            Some(OwnStop::Jump(jump)) => (Stopped::Jump, Some(jump)),
        };
        GpServoState {
            armed: u32::from(self.servo.is_armed()),
            stopped: stopped as u32,
            port_failed: u32::from(self.filler.has_failed()),
            reserved: 0,
            jump: told(jump),
            received: counts.received,
            lost: counts.lost,
            gaps: counts.gaps,
            duplicates: counts.duplicates,
            late: counts.late,
            refused: counts.refused,
            missed_ticks: counts.missed_ticks,
            restarts: counts.restarts,
            references: counts.references,
            stops: counts.stops,
            jumps: counts.jumps,
        }
    }

    /// Ends the thread that fills the ring.
    pub(crate) fn close(self) -> Result<(), LinkError> {
        self.filler.finish()
    }
}

fn told(jump: Option<&Jump>) -> GpJump {
    let Some(jump) = jump else {
        return GpJump {
            joint: 0,
            of: TooMuch::None as u32,
            from_position: 0.0,
            to_position: 0.0,
            span_t: 0.0,
            asked: 0.0,
            limit: 0.0,
        };
    };
    GpJump {
        joint: u32::try_from(jump.joint).unwrap_or(u32::MAX),
        of: match jump.of {
            JumpOf::Velocity => TooMuch::Velocity as u32,
            JumpOf::Acceleration => TooMuch::Acceleration as u32,
        },
        from_position: jump.from,
        to_position: jump.to,
        span_t: jump.span_t,
        asked: jump.asked,
        limit: jump.limit,
    }
}

/// The settings of the servo library, as a start for the caller's own.
pub(crate) fn default_settings() -> GpServoSettings {
    let ServoSettings {
        patience_ns,
        stop,
        jump,
    } = ServoSettings::default();
    GpServoSettings {
        patience_ns,
        stop: stop.map(|limits| GpStopLimits {
            acceleration: limits.acceleration,
            jerk: limits.jerk,
        }),
        jump: jump.map(|limits| GpJumpLimits {
            velocity: limits.velocity,
            acceleration: limits.acceleration,
        }),
    }
}

fn judged(settings: &GpServoSettings) -> Result<ServoSettings, Failure> {
    let finite = |value: f64| value > 0.0 && value.classify() == FpCategory::Normal;
    let stops = settings.stop.iter();
    if !stops
        .into_iter()
        .all(|stop| finite(stop.acceleration) && finite(stop.jerk))
    {
        return Err(Failure::Argument(
            "settings.stop: acceleration and jerk of every joint have to be above 0 and finite; \
             begin with gp_servo_settings_default",
        ));
    }
    let mut jumps = settings.jump.iter();
    if !jumps.all(|jump| jump.velocity > 0.0 && jump.acceleration > 0.0) {
        return Err(Failure::Argument(
            "settings.jump: velocity and acceleration of every joint have to be above 0, INFINITY \
             for no guard; begin with gp_servo_settings_default",
        ));
    }
    Ok(ServoSettings {
        patience_ns: settings.patience_ns,
        stop: settings.stop.map(|limits| StopLimits {
            acceleration: limits.acceleration,
            jerk: limits.jerk,
        }),
        jump: settings.jump.map(|limits| JumpLimits {
            velocity: limits.velocity,
            acceleration: limits.acceleration,
        }),
    })
}
