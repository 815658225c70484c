//! The feedback of a bridge: what is known of the joints and of the inputs.

use super::load_side::LoadSide;
use super::{Bridge, WINDOW};
use crate::probe::Seen;
use crate::state;
use crate::terminal::At;
use bytemuck::Zeroable as _;
use glidepath_geometry::AXES;
use glidepath_link::{DriveState, Feedback, Setpoint, Subscriber};

/// Added to the code of a state, where that is told in the place of a drive's own fault.
const AL_CODE: u32 = 0x1_0000;

impl<S: Subscriber<Setpoint>> Bridge<S> {
    /// What is known of the joints, as it was when the setpoints of `sample_ns` were played.
    #[allow(clippy::cast_precision_loss, reason = "a few periods")]
    pub fn feedback(&mut self, sample_ns: u64) -> Feedback {
        let mut feedback = Feedback {
            boot_id: self.boot_id,
            number: self.number,
            sample_ns,
            joints: self.joints,
            ..Feedback::zeroed()
        };
        if let Some(setpoint) = self.servo.last() {
            (feedback.reference, feedback.setpoint_number) = (setpoint.reference, setpoint.number);
        }
        let slot = self.cycles % WINDOW;
        let window_t = (WINDOW as u64 * self.period_ns) as f64 * 1e-9;
        for drive in &mut self.drives {
            let joint = drive.axis.settings.joint.min(AXES - 1);
            let place = match &mut drive.load_side {
                None => drive.axis.settings.place(drive.inputs.actual),
                Some(load_side) => {
                    let terminals = self.terminals.as_ref();
                    let said = terminals.and_then(|it| it.joint_place(joint, sample_ns));
                    load_side.sample(said, &mut drive.axis, drive.inputs.actual)
                }
            };
            let before = core::mem::replace(&mut drive.places[slot], place);
            feedback.position[joint] = place;
            feedback.velocity[joint] = (place - before) / window_t;
            let bit = |is: bool| u32::from(is) << joint;
            let is_present = drive.is_present();
            feedback.enabled |= bit(is_present && drive.axis.is_enabled());
            feedback.homed |= bit(is_present && drive.axis.is_homed());
            feedback.homing |= bit(is_present && drive.axis.is_homing());
            feedback.fault |= bit(drive.has_failed());
            feedback.drive_state[joint] = if is_present {
                state::of(drive.inputs.status).code()
            } else {
                DriveState::Unknown.code()
            };
            feedback.fault_code[joint] = if !is_present {
                AL_CODE | u32::from(drive.device.code)
            } else if drive.has_failed() {
                drive.inputs.fault.into()
            } else {
                0
            };
        }
        if let Some(terminals) = &mut self.terminals {
            terminals.tell(&mut feedback);
        }
        for (nth, input) in &self.drive_inputs {
            let digital = self
                .drives
                .get(*nth)
                .map_or(0, |drive| drive.inputs.digital);
            if let At::Bit(bit) = input.at {
                input.tell(digital >> (bit & 31) & 1 == 1, &mut feedback);
            }
        }
        let seen = self.drives.iter().map(|drive| Seen {
            settings: &drive.axis.settings,
            inputs: drive.inputs.probe,
            is_present: drive.is_present(),
            added: drive.load_side.as_ref().map_or(0.0, LoadSide::added),
            places: &drive.places,
            newest: slot,
        });
        self.indices.sample(&mut feedback, seen.clone());
        if let Some(probing) = &mut self.probing {
            let left = seen.enumerate();
            let left = left.map(|(nth, seen)| self.indices.left_of(nth, seen));
            probing.sample(&mut feedback, left);
        }
        self.tell_loss(&mut feedback);
        self.number += 1;
        self.cycles = self.cycles.wrapping_add(1);
        feedback
    }
}
