//! The simulated machine of a desk, on which setpoints are played.

use super::notices::Notices;
use super::part::part;
use super::settings::{best_effort_patience_ns, settings};
use super::silence::Silence;
use crate::cli::ServoArgs;
use crate::command::failure::Failure;
use crate::command::session;
use crate::config::{HomingBy, MachineConfig};
use crate::interrupt::Interrupt;
use glidepath_geometry::AXES;
use glidepath_interpolator::JointHoming;
use glidepath_kinematics::Kinematics as _;
use glidepath_link::servo::{Servo, ServoCounts};
use glidepath_link::{Setpoint, Transport as _};
use glidepath_plant::{HomeSettings, JointSettings, Plant, SwitchSettings};
use glidepath_realtime::{Clock as _, Monotonic};
use std::time::Duration;

/// Between two looks for setpoints: a fraction of a period, and a small one of the queue.
const POLL: Duration = Duration::from_millis(1);

/// What whoever has setpoints played is told.
pub(super) enum Told<'a> {
    /// The next setpoint.
    Setpoint(&'a Setpoint),
    /// The servo has stopped the joints by itself, for the first time, for this reason.
    Stopped(&'a str),
}

/// Plays setpoints and tells of every one, until `take` gives false or the process is asked to end.
pub(super) fn play(
    args: &ServoArgs,
    config: &MachineConfig,
    interrupt: &Interrupt,
    mut take: impl FnMut(Told<'_>) -> Result<bool, Failure>,
) -> Result<ServoCounts, Failure> {
    let transport = session::join(&args.instance, config)?;
    let _drives = part(&transport, args, config)?;
    let mut settings = settings(config);
    if args.best_effort {
        settings.patience_ns = best_effort_patience_ns(config);
    }
    let mut servo = Servo::new(transport.setpoint_source()?, settings);
    // What only passes setpoints on leaves the drives to somebody else.
    let mut feedback = (!args.listens)
        .then(|| transport.feedback_sink())
        .transpose()?;
    let mut told = transport.auxiliary_source()?;
    let mut plant = plant(config, &args.stands);
    if let Some((joint, position)) = args.probe {
        plant = plant.with_probe(joint, position);
    }
    let mut notices = Notices::new(args.relay);
    let mut silence = Silence::new(&settings);
    'playing: while !interrupt.is_set() {
        // The time from before it looks for setpoints: where a busy host lets it wait in between, what came meanwhile
        // is no silence.
        let now_ns = Monotonic.now_ns();
        while let Some(setpoint) = servo.receive(now_ns)? {
            plant.hear(&setpoint);
            if !take(Told::Setpoint(&setpoint))? {
                break 'playing;
            }
        }
        while let Some(record) = told.take()? {
            plant.override_spindle(record.spindle_override);
        }
        // A real servo stack hands this to its drives, and asks them where they are.
        let demand = servo.demand(now_ns);
        if let Some(why) = notices.look(&servo, &args.instance, config)
            && !take(Told::Stopped(why))?
        {
            break;
        }
        plant.step(now_ns, servo.last(), demand.as_ref());
        silence.look(&servo);
        if let (Some(mut measured), Some(feedback)) = (plant.feedback(), &mut feedback) {
            silence.tell(&servo, &mut measured);
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

/// Where the joints are where programs begin.
pub(in crate::command) fn begins(config: &MachineConfig) -> [f64; AXES] {
    let begins = config.mechanism.inverse(&config.home());
    let mut begins = begins.map_or([0.0; AXES], <[f64; AXES]>::from);
    if config.joints() == 0 {
        let home = config.home();
        for (begins, axis) in begins.iter_mut().zip(config.axis_of_joints()) {
            *begins = home[axis.index()];
        }
    }
    begins
}

/// The machine that is moved: it stands at the places given, else where programs begin. Drives that
/// look for their home have not yet found it, and count from anywhere.
fn plant(config: &MachineConfig, stands: &[f64]) -> Plant {
    let begins = begins(config);
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
        // None where it stands.
        index: homing.index.map(|_| (PITCH, joint.start + 0.5 * PITCH)),
        ..joint
    }
}
