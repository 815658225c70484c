//! The encoders of joints at a device.

use super::Devices;
use crate::config::Range;
use crate::drives::raw_device::RawJointEncoder;
use core::ops::Range as Span;
use glidepath_ethercat::{At, EncoderUse, JointEncoderSettings};
use toml::Spanned;

/// Where terminals have the counter of their first channel.
const COUNTER: At = At::Object {
    index: 0x6000,
    sub: 0x11,
};
const KEY: &str = "device.joint_encoders";
const COUNTS: Range = Range {
    min: 1e-3,
    max: 1e9,
    unit: "counts",
    help: "what the terminal counts on a mm or a degree of the joint: four times the lines, of one that only counts",
};
const PLACE: Range = Range {
    min: -1e6,
    max: 1e6,
    unit: "mm or °",
    help: "where the joint is when an absolute encoder says zero",
};
const APART: Range = Range {
    min: 1e-6,
    max: 1e3,
    unit: "mm or °",
    help: "more than the play and the twist between motor and load, and less than what spoils a part",
};
const USES: &str = "give \"position\" (the joint is where this encoder says) or \"watch\" (it is compared with the drive's, \
                    and stops the machine when both are apart)";

impl Devices<'_> {
    pub(super) fn joint_encoder(
        &mut self,
        position: usize,
        raw: &Spanned<RawJointEncoder>,
    ) -> Option<JointEncoderSettings> {
        let (span, raw) = (raw.span(), raw.as_ref());
        let most = i64::try_from(self.joints).unwrap_or(1) - 1;
        let help = "the machine has no more joints";
        let key = "device.joint_encoders.joint";
        let joint: Option<usize> = self.judge.whole(key, &raw.joint, (0, most), help);
        if let Some(joint) = joint
            && !self.claims.take("encoder of joint", joint)
        {
            let message = format!("J{joint} has two encoders at terminals");
            let help = "a joint has that of its drive, and one at a terminal";
            self.tell(KEY, message, help, raw.joint.span());
        }
        let used = self.encoder_use(&raw.used);
        if let (Some(offset), Some(EncoderUse::Watch)) = (&raw.home_offset, used) {
            let message = "home_offset is for an encoder with use = \"position\"".to_owned();
            let help = "leave it out: an encoder that is only compared begins where the drive says";
            self.tell(KEY, message, help, offset.span());
        }
        if let (Some(offset), Some(joint)) = (&raw.home_offset, joint)
            && self.homes_itself.contains(&joint)
        {
            let message =
                format!("J{joint} has an absolute encoder, and its drive looks for a home");
            let help = "leave out home_offset if this encoder only counts, or [drive.homing]";
            self.tell(KEY, message, help, offset.span());
        }
        if let (Some(offset), Some(joint)) = (&raw.home_offset, joint)
            && self.turns_on.contains(&joint)
        {
            let message = format!(
                "J{joint} turns on and on, and its absolute encoder says where it is in one range alone"
            );
            let help =
                "leave out home_offset, so that the encoder only counts, or modulo of its drive";
            self.tell(KEY, message, help, offset.span());
        }
        if let (Some(signed), None) = (&raw.signed, &raw.home_offset) {
            let message = "signed is for an absolute encoder, with home_offset".to_owned();
            let help =
                "leave it out: one that only counts goes round at its end, whatever its sign";
            self.tell(KEY, message, help, signed.span());
        }
        let at = match &raw.at {
            None => COUNTER,
            Some(at) => {
                let (index, sub) = self.object("device.joint_encoders.at", at)?;
                self.note(
                    position,
                    Some((At::Object { index, sub }, false)),
                    at.span(),
                );
                At::Object { index, sub }
            }
        };
        let counts_per_unit = self.counts_of_joint(raw, span);
        let key = "device.joint_encoders.home_offset";
        let offset = raw.home_offset.as_ref();
        let home_offset = offset.map(|offset| self.judge.number(key, offset, &PLACE));
        let key = "device.joint_encoders.apart";
        let apart = self.judge.number(key, &raw.apart, &APART);
        Some(JointEncoderSettings {
            joint: joint?,
            at,
            counts_per_unit,
            is_inverted: raw.invert,
            home_offset,
            is_unsigned: raw.signed.as_ref().is_some_and(|signed| !signed.get_ref()),
            used: used?,
            apart,
        })
    }

    fn encoder_use(&mut self, raw: &Spanned<String>) -> Option<EncoderUse> {
        match raw.as_ref().as_str() {
            "position" => Some(EncoderUse::Position),
            "watch" => Some(EncoderUse::Watch),
            other => {
                let message = format!("device.joint_encoders.use = \"{other}\" is not known");
                self.tell("device.joint_encoders.use", message, USES, raw.span());
                None
            }
        }
    }

    fn counts_of_joint(&mut self, raw: &RawJointEncoder, span: Span<usize>) -> f64 {
        match (&raw.counts_per_mm, &raw.counts_per_deg) {
            (Some(counts), None) => {
                let key = "device.joint_encoders.counts_per_mm";
                self.judge.number(key, counts, &COUNTS)
            }
            (None, Some(counts)) => {
                let key = "device.joint_encoders.counts_per_deg";
                self.judge.number(key, counts, &COUNTS)
            }
            _ => {
                let message = "an encoder has counts_per_mm, or counts_per_deg".to_owned();
                self.tell(KEY, message, "give one of them", span);
                1.0
            }
        }
    }
}
