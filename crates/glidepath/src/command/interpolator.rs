//! `glidepath interpolator`: the real-time process.

use super::session;
use crate::cli::InterpolatorArgs;
use crate::command::failure::Failure;
use crate::config::{HomingBy, MachineConfig};
use crate::exit::Exit;
use crate::interrupt::{Interrupt, end_with};
use crate::output;
use crate::report::{AwaitedEvent, Beside, status_object, status_text};
use crate::service_manager::ServiceManager;
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_interpolator::{
    Config, FeedbackSettings, Gantry, JogSettings, JointFeedback, RealTime, SoftLimits,
};
use glidepath_link::{Ipc, Transport};
use glidepath_program::TAP_OVERTRAVEL;
use glidepath_realtime::{Mode, Request};

/// Runs until asked to end; the motion then comes to rest on the path.
///
/// # Errors
/// The host is not real-time capable, or the link cannot be used.
pub(super) fn interpolator(
    args: &InterpolatorArgs,
    config: &MachineConfig,
) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    end_with(args.end_with).map_err(Failure::Signals)?;
    let instance = session::instance(&args.instance, config);
    let link = session::link(&instance, config);
    let transport = || Ok(Box::new(Ipc::connect(&link)?) as Box<dyn Transport>);
    // What a process that started this one has to know is in the status.
    let quiet = args.end_with.is_some();
    let mut log = |line: &str| {
        if !quiet {
            output::note(&format!("interpolator: {line}"));
        }
    };
    let config = &with_drives(config, args);
    let settings = settings(config, args.best_effort);
    let over = AtomicBool::new(false);
    let status = std::thread::scope(|scope| {
        // Also if this thread panics: the scope waits for the other.
        let _end = SetOnDrop(&over);
        if let Some(manager) = service_manager() {
            let (link, over) = (&link, &over);
            scope.spawn(move || {
                if let Err(error) = manager.watch(link, over) {
                    output::note(&format!("the service manager is not told: {error}"));
                }
            });
        }
        glidepath_interpolator::run(&settings, transport, interrupt.flag(), &mut log)
    })?;
    if args.basic.json {
        output::object(&status_object(&instance, &status, &AwaitedEvent::default()));
    } else {
        let beside = Beside {
            not_homed: config.axes_not_homed(&status),
            ..Beside::default()
        };
        output::result(&status_text(&instance, &status, &beside));
    }
    Ok(interrupt.exit())
}

/// Feedback older than this stops the motion on a host that promises nothing, s; and takes the power.
const DESK_STALE_T: f64 = 0.25;
const DESK_OFF_T: f64 = 0.5;
/// How far drives may be behind that were not served in time there, mm or degrees.
const DESK_ERROR: f64 = 10.0;

/// The machine, whose drives answer where that is asked for.
fn with_drives(config: &MachineConfig, args: &InterpolatorArgs) -> MachineConfig {
    let mut config = config.clone();
    if args.expect_drives {
        let feedback = &mut config.feedback;
        feedback.is_expected = true;
        if args.best_effort {
            feedback.stale_t = Some(feedback.stale_t.unwrap_or(0.0).max(DESK_STALE_T));
            feedback.off_t = feedback.off_t.max(DESK_OFF_T);
            feedback.min_following_error = feedback.min_following_error.max(DESK_ERROR);
            feedback.following_error = feedback.following_error.max(DESK_ERROR);
        }
    }
    config
}

fn service_manager() -> Option<ServiceManager> {
    ServiceManager::from_environment().unwrap_or_else(|error| {
        output::note(&format!("cannot reach the service manager: {error}"));
        None
    })
}

struct SetOnDrop<'a>(&'a AtomicBool);

impl Drop for SetOnDrop<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// How the drives' feedback is judged, if drives answer.
fn feedback(config: &MachineConfig) -> Option<FeedbackSettings> {
    let given = config.feedback;
    let by_drive = given.homing == HomingBy::Drive;
    let joint = |max_velocity, homing| JointFeedback {
        min_following_error: given.min_following_error,
        following_error: given.following_error,
        max_velocity,
        homes: by_drive,
        homing,
    };
    // Where joints are not axes they have limits of their own.
    let own = config.joint_limits.0.iter().take(config.joints());
    let own = own.map(|limit| limit.velocity);
    let velocity = |of: Axis| {
        let axis = config.axes.iter().find(|axis| axis.axis == of);
        axis.map_or(f64::MAX, |axis| axis.max_velocity)
    };
    let velocities: Vec<f64> = if config.joints() == 0 {
        config.axis_of_joints().into_iter().map(velocity).collect()
    } else {
        own.collect()
    };
    let by_controller = given.homing == HomingBy::Controller;
    let mut settings = FeedbackSettings::new(config.period_ns(), joint(f64::MAX, None));
    let homes = config
        .home_of_joints
        .map(|home| home.filter(|_| by_controller));
    let joints = settings.joints.iter_mut().zip(velocities).zip(homes);
    for ((slot, velocity), home) in joints {
        *slot = joint(velocity, home);
    }
    if let Some(stale_t) = given.stale_t {
        settings.stale_after = Duration::from_secs_f64(stale_t);
    }
    settings.probe = config.probe.map(|probe| probe.input);
    settings.adaptive = config.adaptive_feed;
    settings.off_after = Duration::from_secs_f64(given.off_t).max(settings.stale_after);
    given.is_expected.then_some(settings)
}

/// The second joints of axes, which follow the first ones.
fn gantries(config: &MachineConfig) -> [Option<Gantry>; 4] {
    let mut gantries = [None; 4];
    let names = config.axis_names();
    for (slot, (axis, difference)) in gantries.iter_mut().zip(&config.gantries) {
        let master = names.iter().position(|name| name == axis);
        *slot = master.map(|master| Gantry {
            master,
            difference: *difference,
        });
    }
    gantries
}

/// What the process is started with.
pub(super) fn settings(config: &MachineConfig, best_effort: bool) -> Config {
    let (lowest, highest) = config.travel();
    let request = Request {
        priority: Some(i32::from(config.interpolator.priority)),
        cpu: config.interpolator.cpu,
        lock_memory: true,
        prefault_stack: true,
        hold_cpu_awake: true,
    };
    let mode = if best_effort {
        Mode::BestEffort
    } else {
        Mode::Strict
    };
    Config {
        soft_limits: SoftLimits { lowest, highest },
        mechanism: config.mechanism,
        joint_limits: config.joint_limits,
        start_position: config.home(),
        feedback: feedback(config),
        gantries: gantries(config),
        compensation: config.compensation.joints(),
        superposition: config.superposition,
        m_code_waits: config.m_code_waits(),
        stops: config.stops,
        spindle_override: config.spindle_override,
        tap_overtravel: config
            .spindle
            .map_or(TAP_OVERTRAVEL, |spindle| spindle.overtravel),
        horizon_frames: session::pace(config).horizon_frames,
        jog: JogSettings {
            velocity: config.jog.velocity,
            unhomed_velocity: AxisVector::repeat(config.jog.unhomed_velocity),
            return_v: config.jog.return_velocity,
            time_out: Duration::from_millis(config.jog.dead_man_ms.into()),
            tool_axis: config.jog.tool_axis,
            ..JogSettings::new(&config.limits())
        },
        real_time: RealTime { mode, request },
        // On a desk the clock is what it is: missed ticks are counted and reported.
        missed_ticks_allowed: (!best_effort).then_some(config.interpolator.max_missed_ticks),
        hand_limits: config.limits(),
        ..Config::new(config.axis_limits(), config.period_ns())
    }
}
