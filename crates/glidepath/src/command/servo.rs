//! `glidepath servo`: a mock servo. It takes setpoints, plays them on a machine that is not there, and
//! sends its feedback.

use super::session;
use crate::cli::ServoArgs;
use crate::command::failure::Failure;
use crate::config::{HomingBy, MachineConfig};
use crate::exit::Exit;
use crate::interrupt::{Interrupt, end_with};
use crate::output;
use crate::recording::Recording;
use crate::report::grouped;
use crate::sample::Sample;
use glidepath_geometry::AXES;
use glidepath_interpolator::JointHoming;
use glidepath_kinematics::Kinematics as _;
use glidepath_link::servo::{JumpLimits, OwnStop, Servo, ServoCounts, ServoSettings, StopLimits};
use glidepath_link::{Recorder, Setpoint, Transport as _};
use glidepath_plant::{HomeSettings, JointSettings, Plant, SwitchSettings};
use glidepath_realtime::{Clock as _, Monotonic};
use serde_json::json;
use std::io::BufWriter;
use std::time::{Duration, Instant};

/// Between two looks for setpoints: a fraction of a period, and a small one of the queue.
const POLL: Duration = Duration::from_millis(1);

/// How long it waits for the first setpoint before it says so.
const NOTICE_AFTER: Duration = Duration::from_secs(1);

/// Periods without a setpoint after which the servo stops its joints by itself.
const PATIENCE_PERIODS: u64 = 3;

/// Receives until asked to end.
///
/// # Errors
/// The link cannot be used, or a file cannot be written.
pub(super) fn servo(args: &ServoArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    end_with(args.end_with).map_err(Failure::Signals)?;
    if args.relay {
        return relay(args, config, &interrupt);
    }
    let guard = session::guard(None, &args.basic, config, args.overwrite);
    let mut recording = Recording::create(config, args.setpoints.as_deref(), None, &guard)?;
    let period_t = config.period_t();
    let counts = play(args, config, &interrupt, |setpoint| {
        recording.push(&Sample::received(setpoint, period_t))?;
        Ok(true)
    })?;
    recording.finish("", "")?;
    if args.basic.json {
        output::object(&json!({
            "received": counts.received,
            "lost_setpoints": counts.lost,
            "late_setpoints": counts.late,
            "duplicates": counts.duplicates,
            "refused": counts.refused,
            "restarts": counts.restarts,
            "own_stops": counts.stops,
            "setpoints": args.setpoints,
        }));
    } else {
        output::result(&format!(
            "servo: {} setpoints, {} lost, {} late, {} restarts of the interpolator, {} own stops\n",
            grouped(counts.received),
            grouped(counts.lost),
            grouped(counts.late),
            counts.restarts,
            counts.stops
        ));
    }
    Ok(interrupt.exit())
}

/// Passes every setpoint on, as a recording, until the reader goes away.
fn relay(args: &ServoArgs, config: &MachineConfig, interrupt: &Interrupt) -> Result<Exit, Failure> {
    let mut recorder = Recorder::new(BufWriter::new(std::io::stdout().lock()))?;
    play(args, config, interrupt, |setpoint| {
        Ok(recorder
            .write(setpoint)
            .and_then(|()| recorder.flush())
            .is_ok())
    })?;
    Ok(interrupt.exit())
}

/// Plays setpoints and hands over every one, until `take` gives false or the process is asked to
/// end.
fn play(
    args: &ServoArgs,
    config: &MachineConfig,
    interrupt: &Interrupt,
    mut take: impl FnMut(&Setpoint) -> Result<bool, Failure>,
) -> Result<ServoCounts, Failure> {
    let transport = session::join(&args.instance, config)?;
    let mut servo = Servo::new(transport.setpoint_source()?, settings(config));
    let mut feedback = transport.feedback_sink()?;
    let mut plant = plant(config, &args.stands);
    if let Some((joint, position)) = args.probe {
        plant = plant.with_probe(joint, position);
    }
    let waits_from = Instant::now();
    let mut is_told = args.relay;
    let mut jumps_told = 0;
    while !interrupt.is_set() {
        if !is_told && servo.counts().received == 0 && waits_from.elapsed() > NOTICE_AFTER {
            is_told = true;
            let instance = session::instance(&args.instance, config);
            output::note(&format!(
                "servo: waiting for setpoints of the instance \"{instance}\", which `glidepath \
                 interpolator` gives"
            ));
        }
        while let Some(setpoint) = servo.receive(Monotonic.now_ns())? {
            if !take(&setpoint)? {
                return Ok(*servo.counts());
            }
        }
        // A real servo stack hands this to its drives, and asks them where they are.
        let now_ns = Monotonic.now_ns();
        let demand = servo.demand(now_ns);
        if let Some(OwnStop::Jump(jump)) = servo.stopped()
            && servo.counts().jumps > jumps_told
        {
            jumps_told = servo.counts().jumps;
            output::note(&format!("servo: stopped, {jump}"));
        }
        plant.step(now_ns, servo.last(), demand.as_ref());
        if let Some(measured) = plant.feedback() {
            feedback.publish(&measured)?;
        }
        std::thread::sleep(POLL);
    }
    Ok(*servo.counts())
}

/// How far away the home switch of a joint is that has one, mm or degrees.
const TO_HOME: f64 = 5.0;
/// How fast it looks for it, mm/s or °/s.
const HOMING_V: f64 = 10.0;
/// How long the cam of its switch is, mm or degrees.
const CAM: f64 = 50.0;
/// How long the contact bounces, ns.
const BOUNCE_NS: u64 = 3_000_000;
/// How far its index pulses are from each other, mm or degrees.
const PITCH: f64 = 4.0;

/// The machine that is moved: it stands at the places given, else where programs begin. Drives that
/// look for their home have not yet found it, and count from anywhere.
fn plant(config: &MachineConfig, stands: &[f64]) -> Plant {
    let begins = config.mechanism.inverse(&config.home());
    let mut begins = begins.map_or([0.0; AXES], <[f64; AXES]>::from);
    if config.joints() == 0 {
        let home = config.home();
        for (begins, axis) in begins.iter_mut().zip(config.axis_of_joints()) {
            *begins = home[axis.index()];
        }
    }
    let joints: Vec<JointSettings> = (0..config.drives().min(AXES))
        .map(|joint| {
            let start = stands.get(joint).copied().unwrap_or(begins[joint]);
            let at = JointSettings {
                start,
                count: start,
                ..JointSettings::default()
            };
            match config.feedback.homing {
                HomingBy::Nobody => at,
                HomingBy::Drive => JointSettings {
                    count: 0.0,
                    home: Some(HomeSettings {
                        switch: start - TO_HOME,
                        velocity: HOMING_V,
                        position: start - TO_HOME,
                    }),
                    ..at
                },
                HomingBy::Controller => with_switch(at, config.home_of_joints[joint].as_ref()),
            }
        })
        .collect();
    Plant::new(Monotonic.now_ns() ^ u64::from(std::process::id()), &joints)
}

/// A joint with the switch and the index pulses that the controller looks for. Its drive counts from
/// where it was switched on.
fn with_switch(joint: JointSettings, homing: Option<&JointHoming>) -> JointSettings {
    let Some(homing) = homing else { return joint };
    let edge = joint.start + TO_HOME.copysign(homing.search_v);
    let end = edge + CAM.copysign(homing.search_v);
    JointSettings {
        count: if homing.absolute.is_some() {
            joint.start - homing.offset
        } else {
            0.0
        },
        switch: (homing.search_v != 0.0).then_some(SwitchSettings {
            cam: (edge.min(end), edge.max(end)),
            bounce_ns: BOUNCE_NS,
        }),
        index: homing.index_input.map(|_| (PITCH, joint.start)),
        ..joint
    }
}

fn settings(config: &MachineConfig) -> ServoSettings {
    let mut settings = ServoSettings {
        patience_ns: PATIENCE_PERIODS * config.period_ns(),
        ..ServoSettings::default()
    };
    // Where joints are not axes they have limits of their own.
    let limits = config.joint_limits.0.iter().take(config.joints());
    let joints = limits.map(|joint| (joint.velocity, joint.acceleration, joint.jerk));
    let of_joints = if config.joints() == 0 {
        config.axis_of_joints()
    } else {
        Vec::new()
    };
    let axes = of_joints
        .into_iter()
        .filter_map(|of| config.axes.iter().find(|axis| axis.axis == of))
        .map(|axis| (axis.max_velocity, axis.max_acceleration, axis.max_jerk));
    let drives = settings.stop.iter_mut().zip(&mut settings.jump);
    for ((stop, jump), (velocity, acceleration, jerk)) in drives.zip(joints.chain(axes)) {
        *stop = StopLimits { acceleration, jerk };
        *jump = JumpLimits::above(velocity, acceleration);
    }
    settings
}
