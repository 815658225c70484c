//! The servo: interpolation, counting, gaps, the stop of its own, the guard, and the ring.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a test that cannot go on fails; what is exact is compared exactly"
)]

mod counting;
mod curves;
mod own_stop;
mod playing;
mod references;
mod ring;

use bytemuck::Zeroable;
use glidepath_link::servo::{JointState, Servo, ServoSettings};
use glidepath_link::{InProcess, MachineState, Publisher, Setpoint, Transport};

const PERIOD_NS: u64 = 4_000_000;
const BOOT: u64 = 77;
/// Far from zero, as a monotonic clock is.
const START_NS: u64 = 9_000_000_000_000;

fn state(position: f64, velocity: f64, acceleration: f64) -> JointState {
    JointState {
        position,
        velocity,
        acceleration,
    }
}

/// A joint that goes to and fro: 50 mm amplitude at 1 Hz, 314 mm/s, 1974 mm/s², 12 403 mm/s³.
fn truth(time_t: f64) -> JointState {
    let omega = core::f64::consts::TAU;
    let (sin, cos) = (omega * time_t).sin_cos();
    state(50.0 * sin, 50.0 * omega * cos, -50.0 * omega * omega * sin)
}

fn setpoint(number: u64) -> Setpoint {
    let mut setpoint = Setpoint {
        boot_id: BOOT,
        number,
        tick: number,
        state: MachineState::Running.code(),
        enable: 1,
        scheduled_ns: START_NS + number * PERIOD_NS,
        apply_ns: START_NS + (number + 1) * PERIOD_NS,
        ..Setpoint::zeroed()
    };
    let at = truth((number + 1) as f64 * PERIOD_NS as f64 * 1e-9);
    setpoint.joint_position[0] = at.position;
    setpoint.joint_velocity[0] = at.velocity;
    setpoint.joint_acceleration[0] = at.acceleration;
    setpoint
}

struct Bench {
    sink: Box<dyn Publisher<Setpoint>>,
    servo: Servo,
    now_ns: u64,
}

impl Bench {
    fn new() -> Self {
        Self::with(ServoSettings::default())
    }

    fn with(settings: ServoSettings) -> Self {
        let link = InProcess::default();
        let servo = Servo::new(link.setpoint_source().unwrap(), settings);
        Self {
            sink: link.setpoint_sink().unwrap(),
            servo,
            now_ns: START_NS,
        }
    }

    fn publish(&mut self, setpoint: &Setpoint) {
        self.sink.publish(setpoint).unwrap();
    }

    /// Goes on in small steps; publishes each setpoint of the list when it is scheduled, and takes
    /// what arrives. Returns the first joint at each step.
    fn run_to(&mut self, end_ns: u64, numbers: &[u64]) -> Vec<(u64, JointState)> {
        const STEP_NS: u64 = 100_000;
        let mut joints = Vec::new();
        while self.now_ns < end_ns {
            if self.now_ns.is_multiple_of(PERIOD_NS) {
                let number = (self.now_ns - START_NS) / PERIOD_NS;
                if numbers.contains(&number) {
                    self.publish(&setpoint(number));
                }
            }
            while self.servo.receive(self.now_ns).unwrap().is_some() {}
            if let Some(demand) = self.servo.demand(self.now_ns) {
                joints.push((self.now_ns, demand[0]));
            }
            self.now_ns += STEP_NS;
        }
        joints
    }
}

fn ns_of(ticks: u64) -> u64 {
    START_NS + ticks * PERIOD_NS
}

/// Velocity and acceleration are those of the positions: no jump anywhere.
fn assert_continuous(joints: &[(u64, JointState)], limit_a: f64) {
    for pair in joints.windows(2) {
        let [(t0, a), (t1, b)] = pair else {
            unreachable!()
        };
        let dt = (t1 - t0) as f64 * 1e-9;
        let dv = b.velocity - a.velocity;
        assert!(
            dv.abs() <= limit_a * dt,
            "at {t1}: velocity {} to {}",
            a.velocity,
            b.velocity
        );
        let dp = b.position - a.position - 0.5 * dt * (a.velocity + b.velocity);
        assert!(
            dp.abs() <= limit_a * dt * dt,
            "at {t1}: position {} to {}",
            a.position,
            b.position
        );
    }
}
