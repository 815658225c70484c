//! What a machine is made of: its drives, its bus, and what its interpolator knows of them.

use core::time::Duration;
use glidepath_emulator::{DriveSettings as Emulated, HomeSwitch};
use glidepath_ethercat::{
    BusSettings, DigitalInput, DriveSettings, HomingSettings, Mapping, TerminalSettings,
};
use glidepath_geometry::{AXES, Axis};
use glidepath_interpolator::{
    Config, FeedbackSettings, JointFeedback, JointHoming, MCodeWait, MCodeWaits, ProbeInput,
};
use glidepath_kinematics::{AxisList, Mechanism, Trivial};
use glidepath_link::servo::{JumpLimits, ServoSettings, StopLimits};
use glidepath_program::Limits;

pub(crate) const PERIOD_NS: u64 = 4_000_000;
pub(crate) const START_NS: u64 = 9_000_000_000_000;
/// A 23 bit encoder on a spindle of 5 mm.
pub(crate) const COUNTS: f64 = 8_388_608.0 / 5.0;

pub(crate) fn limits() -> Limits {
    Limits::uniform(200.0, 2000.0, 40_000.0)
}

/// The drive of a joint.
pub(crate) fn drive(joint: usize) -> DriveSettings {
    DriveSettings {
        joint,
        position: joint,
        axis: 0,
        map_step: 0x10,
        vendor: 0xe1e,
        product: 0x402,
        alias: 0,
        process_at: None,
        mapping: Mapping::Written,
        counts_per_unit: COUNTS,
        is_modulo: false,
        is_inverted: joint == 1,
        home_offset: 0.0,
        homing: None,
        following_error: 2.0,
        following_ms: 10,
        enable_window: 0.05,
        quick_stop_a: 4000.0,
        torque_limits: [None; 2],
        feed_forward: None,
        probe: None,
        index: None,
        has_inputs: false,
        max_v: 200.0,
    }
}

/// The same with a switch 5 mm below where it stands.
pub(crate) fn homing_drive(joint: usize) -> DriveSettings {
    DriveSettings {
        homing: Some(HomingSettings {
            method: 17,
            fast_v: 20.0,
            slow_v: 2.0,
            acceleration_a: 500.0,
            sequence: u32::from(joint != 2),
        }),
        ..drive(joint)
    }
}

pub(crate) fn servo() -> ServoSettings {
    ServoSettings {
        patience_ns: 3 * PERIOD_NS,
        stop: [StopLimits {
            acceleration: 2000.0,
            jerk: 40_000.0,
        }; AXES],
        jump: [JumpLimits::above(200.0, 2000.0); AXES],
    }
}

/// What a case is made of.
#[derive(Debug, Clone)]
pub(crate) struct Setup {
    /// From the grid of the bus to that of the interpolator, ns.
    pub(crate) phase_ns: u64,
    pub(crate) bus: BusSettings,
    pub(crate) drives: Vec<DriveSettings>,
    pub(crate) emulated: Vec<Emulated>,
    pub(crate) drive_inputs: Vec<(usize, DigitalInput)>,
    pub(crate) terminals: Vec<TerminalSettings>,
    /// The following error that is no fault at rest, mm.
    pub(crate) resting_error: f64,
    /// The first joints, so many, are brought home by the controller.
    pub(crate) homing: Option<JointHoming>,
    pub(crate) homed: usize,
    pub(crate) probe: Option<ProbeInput>,
    /// M codes that are waited for.
    pub(crate) waits: Vec<MCodeWait>,
    /// The least and the highest spindle override.
    pub(crate) spindle_override: [f64; 2],
}

impl Setup {
    /// Three axes with absolute encoders.
    pub(crate) fn absolute(period_ns: u64) -> Self {
        Self {
            phase_ns: 1_300_000,
            bus: BusSettings {
                period_ns,
                shift_ns: period_ns / 2,
                delay_ns: period_ns / 2 + 2_000_000,
                watchdog_ns: (4 * period_ns).max(10_000_000),
                ..BusSettings::default()
            },
            drives: (0..3).map(drive).collect(),
            emulated: vec![Emulated::default(); 3],
            drive_inputs: Vec::new(),
            terminals: Vec::new(),
            resting_error: 0.2,
            homing: None,
            homed: 1,
            probe: None,
            waits: Vec::new(),
            spindle_override: [0.5, 1.2],
        }
    }

    /// Three axes that have to find their home.
    pub(crate) fn homing(period_ns: u64) -> Self {
        let home = |joint: i32| Emulated {
            start_counts: vec![1000 * (joint + 1)],
            home: Some(HomeSwitch {
                at_counts: -5 * COUNTS as i64,
            }),
            ..Emulated::default()
        };
        Self {
            drives: (0..3).map(homing_drive).collect(),
            emulated: (0..3).map(home).collect(),
            ..Self::absolute(period_ns)
        }
    }
}

pub(super) fn config(setup: &Setup) -> Config {
    let (homes, bus) = (
        setup.drives.iter().any(|drive| drive.homing.is_some()),
        &setup.bus,
    );
    let joint = JointFeedback {
        min_following_error: setup.resting_error,
        following_error: 2.0,
        max_velocity: 200.0,
        homes,
        homing: None,
    };
    let mut feedback = FeedbackSettings::new(PERIOD_NS, joint);
    for joint in &mut feedback.joints[..setup.homed] {
        joint.homing = setup.homing;
    }
    Config {
        feedback: Some(FeedbackSettings {
            probe: setup.probe,
            // As the manual has it: frames that are lost are not yet feedback that is.
            stale_after: Duration::from_nanos(
                3 * PERIOD_NS + u64::from(bus.lost_frames) * bus.period_ns + bus.delay_ns,
            ),
            ..feedback
        }),
        m_code_waits: MCodeWaits::new(&setup.waits).unwrap(),
        spindle_override: setup.spindle_override,
        mechanism: Mechanism::Trivial(Trivial::new(AxisList::new(&[Axis::X, Axis::Y, Axis::Z]))),
        ..Config::new(limits(), PERIOD_NS)
    }
}
