//! The emulated drives of a machine: those that its file of drives describes, or those of a desk.

use crate::config::{HomingBy, MachineConfig};
use crate::drives;
use glidepath_emulator::{DriveSettings as Emulated, HomeSwitch, OffsetAccess, ZeroImpulse};
use glidepath_ethercat::{DriveSettings, HomingSettings, Mapping, TerminalSettings};
use glidepath_interpolator::IndexPulse;

/// A turn of an emulated motor, mm or degrees.
const TURN: f64 = 5.0;
/// A 23 bit encoder on a spindle of 5 mm, counts a mm.
const COUNTS: f64 = 8_388_608.0 / 5.0;
/// Counts that a drive has on either side of zero, with something to spare.
const REACH: f64 = 2.0e9;
/// How far away the home switch of a joint is that has one, mm or degrees.
const TO_HOME: f64 = 5.0;
/// How far the maps of an axis are from those of the one before, as drives and emulated ones have it.
pub(super) const MAP_STEP: u16 = 0x10;

/// Drives that no file describes.
pub(super) fn desk_drives(
    best_effort: bool,
    config: &MachineConfig,
    begins: &[f64],
) -> impl Iterator<Item = DriveSettings> {
    let reach = config.travel();
    let reach = reach
        .0
        .iter()
        .chain(reach.1.iter())
        .filter(|place| place.is_finite());
    let reach = reach.fold(1000.0_f64, |most, place| most.max(place.abs()));
    let homes = config.feedback.homing == HomingBy::Drive;
    let velocities = drives::joint_velocities(config).into_iter().enumerate();
    velocities.map(move |(joint, max_v)| DriveSettings {
        joint,
        position: joint,
        axis: 0,
        map_step: MAP_STEP,
        vendor: 0,
        product: 0,
        alias: 0,
        process_at: None,
        mapping: Mapping::Written,
        counts_per_unit: COUNTS.min(REACH / reach),
        is_modulo: false,
        is_inverted: false,
        home_offset: if homes { begins[joint] - TO_HOME } else { 0.0 },
        homing: homes.then_some(HomingSettings {
            method: 17,
            fast_v: 20.0,
            slow_v: 2.0,
            acceleration_a: 500.0,
            sequence: 0,
        }),
        // A host that stands still is no fault of theirs.
        following_error: if best_effort { 50.0 } else { 2.0 },
        following_ms: 50,
        enable_window: 0.05,
        quick_stop_a: 4000.0,
        torque_limits: [None; 2],
        feed_forward: None,
        probe: None,
        index: keeps_index(config, joint).then_some(1),
        has_inputs: false,
        max_v,
    })
}

/// Whether the drive of a joint is to keep its index pulse.
fn keeps_index(config: &MachineConfig, joint: usize) -> bool {
    let home = config.home_of_joints.get(joint).and_then(Option::as_ref);
    home.is_some_and(|home| home.index == Some(IndexPulse::Drive))
}

/// An index pulse every turn, and one where its drive counts zero.
#[allow(clippy::cast_possible_truncation, reason = "judged: 1e10 at most")]
fn zero_impulse(drive: &DriveSettings) -> ZeroImpulse {
    let turn_counts = ((TURN * drive.counts_per_unit).round() as i64).max(2);
    ZeroImpulse {
        turn_counts,
        at_counts: 0,
        wide_counts: turn_counts / 100,
    }
}

/// All devices, the drives among them as they begin.
pub(super) fn as_they_are(
    drives: &[DriveSettings],
    terminals: &[TerminalSettings],
    begins: &[f64],
) -> Vec<Emulated> {
    let positions = drives.iter().map(|drive| drive.position);
    let positions = positions.chain(terminals.iter().map(|terminal| terminal.position));
    let last = positions.max().unwrap_or(0);
    let mut emulated = vec![Emulated::default(); last + 1];
    for drive in drives {
        let begin = drive.counts(begins[drive.joint]);
        // One that turns on and on begins inside its range.
        let begin = begin.and_then(|counts| i32::try_from(counts).ok());
        let begin = begin.unwrap_or(0);
        let there = &mut emulated[drive.position];
        there.axes = there.axes.max(usize::from(drive.axis) + 1);
        if drive.probe.is_some() || drive.index.is_some() {
            let probe = there.touch_probe.get_or_insert_default();
            // That of the first axis that keeps one.
            probe.zero = probe.zero.or(drive.index.map(|_| zero_impulse(drive)));
        }
        if drive.is_modulo {
            there.range = Some((i32::MIN, i32::MAX));
        }
        if drive.feed_forward.is_some() {
            there.offsets = OffsetAccess::Mapped;
        }
        there.identity[0] = if drive.vendor == 0 {
            there.identity[0]
        } else {
            drive.vendor
        };
        there.identity[1] = if drive.product == 0 {
            there.identity[1]
        } else {
            drive.product
        };
        if drive.homing.is_some() {
            #[allow(clippy::cast_possible_truncation, reason = "some millimetres")]
            let switch = (-TO_HOME * drive.counts_per_unit) as i64;
            there.home = Some(HomeSwitch { at_counts: switch });
        } else {
            there.start_counts.resize(there.axes, 0);
            there.start_counts[usize::from(drive.axis)] = begin;
        }
    }
    emulated
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::*;
    use crate::config;
    use glidepath_ethercat::TouchProbe;

    /// A drive of the desk at a place of the line.
    fn drive(joint: usize, (position, axis): (usize, u16), index: Option<u8>) -> DriveSettings {
        let machine = config::parse("machine.toml", config::EMBEDDED).unwrap();
        let drive = desk_drives(false, &machine, &[0.0; 9]).nth(joint).unwrap();
        DriveSettings {
            position,
            axis,
            index,
            probe: Some(TouchProbe {
                unit: 1,
                number: 0,
                is_inverted: false,
                source: None,
            }),
            ..drive
        }
    }

    #[test]
    fn a_device_has_a_zero_impulse_if_one_of_its_axes_keeps_it() {
        for index in [[Some(1), None], [None, Some(1)], [Some(1), Some(1)]] {
            let drives = [drive(0, (0, 0), index[0]), drive(1, (0, 1), index[1])];
            let emulated = as_they_are(&drives, &[], &[0.0; 9]);
            let probe = emulated[0].touch_probe.unwrap();
            assert!(probe.zero.is_some(), "{index:?}");
        }
    }

    #[test]
    fn a_drive_of_the_desk_keeps_the_index_pulse_that_its_joint_looks_for() {
        let machine = config::EMBEDDED.replace("source = \"none\"", "source = \"drives\"");
        let machine = machine.replace("homing = \"none\"", "homing = \"controller\"");
        let home = "\n[home.J0]\nlatch_velocity = 2.0\nindex = \"drive\"\nsearch_travel = 6.0\n[home.J1]\n[home.J2]\n";
        let machine = config::parse("machine.toml", &(machine + home)).unwrap();
        let drives: Vec<_> = desk_drives(false, &machine, &[0.0; 9]).collect();
        let index: Vec<_> = drives.iter().map(|drive| drive.index).collect();
        assert_eq!(index[..2], [Some(1), None]);
        assert!(
            as_they_are(&drives, &[], &[0.0; 9])[0]
                .touch_probe
                .is_some()
        );
    }
}
