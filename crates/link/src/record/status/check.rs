//! The check of a status, which another process wrote.

use super::Status;
use crate::record::check::{Fields, RecordError};
use crate::record::{ALL_JOINTS, Grants, OVERRIDE_MAX, Record, SpindleFlags};
use glidepath_geometry::AXES;

impl Record for Status {
    const NAME: &'static str = "glidepath.Status.v16";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        fields.all_finite("position", &self.position)?;
        fields.all_finite("program_start", &self.program_start)?;
        fields.all_finite("away", &self.away)?;
        fields.all_finite("joint_actual", &self.joint_actual)?;
        fields.all_finite("following_error", &self.following_error)?;
        fields.all_finite("following_peak", &self.following_peak)?;
        fields.finite("path_s", self.path_s)?;
        fields.finite("block_path_s", self.block_path_s)?;
        fields.finite("feed_v", self.feed_v)?;
        fields.finite("fault_value", self.fault_value)?;
        fields.finite("fault_limit", self.fault_limit)?;
        fields.signed_override("feed_override", self.feed_override)?;
        fields.override_ratio("rapid_override", self.rapid_override)?;
        fields.range("jog_override", self.jog_override, 0.0, 1.0)?;
        fields.override_ratio("spindle_override", self.spindle_override)?;
        fields.range(
            "effective_override",
            self.effective_override,
            0.0,
            OVERRIDE_MAX,
        )?;
        fields.range("adaptive_feed", self.adaptive_feed, -1.0, 1.0)?;
        fields.flags("grants", self.grants, Grants::KNOWN)?;
        fields.flags("single_block", self.single_block, 1)?;
        for (field, mask) in [
            ("joints", self.joints),
            ("enabled", self.enabled),
            ("homed", self.homed),
            ("drive_faults", self.drive_faults),
        ] {
            fields.flags(field, mask, ALL_JOINTS)?;
        }
        fields.all_finite("contact", &self.contact)?;
        fields.flags("unanswered", self.unanswered, 1)?;
        self.power()?;
        self.mode()?;
        self.contact()?;
        if self.fault_joint().is_some_and(|joint| joint >= AXES) {
            let (record, field) = (Self::NAME, "fault_joint");
            return Err(RecordError::UnknownCode {
                record,
                field,
                code: self.fault_joint,
            });
        }
        if self.fault_axis != 0 && self.fault_axis().is_none() {
            let (record, field) = (Self::NAME, "fault_axis");
            return Err(RecordError::UnknownCode {
                record,
                field,
                code: self.fault_axis,
            });
        }
        self.state()?;
        self.awaited_event()?;
        self.awaited_words.check(Self::NAME)?;
        self.end_of_epoch()?;
        self.fault()?;
        self.last_event.check(Self::NAME, "last_event")?;
        self.message.check(Self::NAME, "message")?;
        self.job_stage()?;
        fields.flags("job_held", self.job_held, 1)?;
        fields.finite("spindle_v", self.spindle_v)?;
        fields.finite("spindle_load", self.spindle_load)?;
        fields.flags("spindle_flags", self.spindle_flags, SpindleFlags::KNOWN)?;
        fields.all_finite("superposed", &self.superposed)?;
        self.superposition()?;
        self.freeze_reason()?;
        fields.flags("job_stream", self.job_stream, 1)?;
        self.job.check(Self::NAME, "job")?;
        self.job_end.check(Self::NAME, "job_end")?;
        self.last_error.check(Self::NAME, "last_error")
    }
}
