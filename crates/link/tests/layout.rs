//! The layout of the records, byte by byte: a change here is a new version of the record.

use core::mem::{align_of, offset_of, size_of};
use glidepath_link::{
    Auxiliary, CommandReply, CommandRequest, EventId, Feedback, JobReply, JobRequest, JogDemand,
    Latch, LinesReply, LinesRequest, Quantiles, Record, SegmentReply, SegmentRequest, Setpoint,
    SetpointFrame, Status, Text,
};

macro_rules! layout {
    ($test:ident, $record:ty, $name:literal, $size:literal, { $($field:ident: $offset:literal),+ $(,)? }) => {
        #[test]
        fn $test() {
            assert_eq!(<$record>::NAME, $name);
            #[allow(unsafe_code, reason = "the trait's function is unsafe for other languages' sake")]
            // SAFETY: the layout is the one this test asserts.
            let wire_name = unsafe { <$record as iceoryx2::prelude::ZeroCopySend>::type_name() };
            assert_eq!(wire_name, $name);
            assert_eq!(size_of::<$record>(), $size);
            assert_eq!(align_of::<$record>(), 8);
            $(assert_eq!(offset_of!($record, $field), $offset, stringify!($field));)+
        }
    };
}

layout!(setpoint_frame, SetpointFrame, "glidepath.SetpointFrame.v3", 800, {
    epoch: 0, sequence: 8, period_ns: 16, line: 24, flags: 28, event_count: 32, block: 36,
    path_v: 40, path_s: 48, planned_override: 56, program: 64, position: 72,
    velocity: 144, acceleration: 216, events: 288,
});
layout!(setpoint, Setpoint, "glidepath.Setpoint.v4", 1160, {
    boot_id: 0, reference: 8, number: 16, tick: 24, scheduled_ns: 32, apply_ns: 40,
    lateness_ns: 48, missed_ticks: 56, epoch: 64, sequence: 72, fraction: 80, line: 88, flags: 92,
    marks: 96, state: 100, event_count: 104, block: 108, enable: 112, home: 116,
    path_s: 120, feed_v: 128, effective_override: 136, position: 144, velocity: 216,
    acceleration: 288, joint_position: 360, joint_velocity: 432, joint_acceleration: 504,
    away: 576, events: 648,
});
layout!(status, Status, "glidepath.Status.v13", 1808, {
    boot_id: 0, updated_ns: 8, period_ns: 16, tick: 24, epoch: 32, frames_received: 40,
    frames_executed: 48, queue_depth: 56, queue_capacity: 60, pid: 64, state: 68, end_of_epoch: 72,
    fault: 76, fault_line: 80, fault_axis: 84, fault_joint: 88, drive_fault: 92,
    fault_sequence: 96, fault_value: 104, fault_limit: 112, line: 120, grants: 124, block: 128,
    single_block: 132, program: 136, program_start: 144, position: 216, away: 288, power: 360,
    mode: 364, joints: 368, enabled: 372, homed: 376, drive_faults: 380, reference: 384,
    feedback_age_ns: 392, joint_actual: 400, following_error: 472, following_peak: 544,
    awaited_sequence: 616, awaited_since_ns: 624, awaited_value: 632,
    awaited_kind: 640, awaited_line: 644, awaited_words: 648, contact: 672, contact_kind: 744, unanswered: 748, path_s: 752, block_path_s: 760, feed_v: 768,
    feed_override: 776, rapid_override: 784, jog_override: 792, effective_override: 800, adaptive_feed: 808, ticks: 816,
    missed_ticks: 824, late_ticks: 832, setpoints_published: 840, setpoints_lost: 848,
    reserve_stops: 856, starved_ticks: 864, commands_served: 872, commands_refused: 880,
    frames_refused: 888, lateness: 984, work: 1016, latency: 1048, response: 1080,
    job_number: 1112, next_epoch: 1120, job_stage: 1128, job_held: 1132, last_error: 1136,
    last_event: 1264, message: 1392, job: 1520, job_end: 1648,
    jog_client: 1776, jog_number: 1784, spindle_v: 1792, spindle_flags: 1800, reserved: 1804,
});
layout!(command_request, CommandRequest, "glidepath.CommandRequest.v7", 200, {
    client: 0, number: 8, value: 16, kind: 24, joints: 28, event: 32, job: 56, asked_ns: 64, text: 72,
});
layout!(auxiliary, Auxiliary, "glidepath.Auxiliary.v2", 656, {
    boot_id: 0, generation: 8, epoch: 16, sequence: 24, awaited: 32, awaited_since_ns: 56,
    awaited_until_ns: 64, awaited_value: 72, awaited_kind: 80, line: 84, awaited_words: 88, spindle_speed: 112,
    spindle: 120, coolant: 124, tool: 128, prepared_tool: 132, digital_out: 136, analog_out: 144,
});
layout!(command_reply, CommandReply, "glidepath.CommandReply.v3", 152, {
    boot_id: 0, number: 8, refusal: 16, state: 20, message: 24,
});
layout!(feedback, Feedback, "glidepath.Feedback.v2", 816, {
    boot_id: 0, number: 8, sample_ns: 16, reference: 24, setpoint_number: 32, joints: 40,
    enabled: 44, homed: 48, homing: 52, fault: 56, limit_low: 60, limit_high: 64, home_switch: 68,
    position: 72, velocity: 144, drive_state: 216, fault_code: 252, digital_in: 288, analog_in: 296,
    spindle_angle: 360, spindle_v: 368, spindle_index_count: 376, spindle_flags: 384, loss: 388,
    loss_value: 392, latch: 400,
});
layout!(jog_demand, JogDemand, "glidepath.JogDemand.v2", 136, {
    client: 0, number: 8, sent_ns: 16, asked_ns: 24, mode: 32, mask: 36, by_joint: 40, reserved: 44,
    velocity_v: 48, scale: 56, value: 64,
});
layout!(job_request, JobRequest, "glidepath.JobRequest.v4", 1080, {
    client: 0, number: 8, asked_ns: 16, program: 24, kind: 32, from_line: 36, pass: 40, confirmed: 44, resumes: 48,
    wish: 52, text: 56,
});
layout!(job_reply, JobReply, "glidepath.JobReply.v3", 1048, {
    client: 0, number: 8, state: 16, reserved: 20, text: 24,
});
layout!(lines_request, LinesRequest, "glidepath.LinesRequest.v1", 1200, {
    client: 0, number: 8, asked_ns: 16, first: 24, ahead_t: 32, wish: 40, reserved: 44, name: 48, text: 176,
});
layout!(lines_reply, LinesReply, "glidepath.LinesReply.v1", 2424, {
    client: 0, number: 8, taken: 16, read: 24, state: 32, is_refused: 36, refused_column: 40,
    refused_in_motion: 44, ahead_t: 48, zero: 56, systems: 128, references: 776, shift: 920, tool: 992,
    probe: 1064, probe_made: 1136, probes: 1140, diagnostic: 1144, words: 1272, text: 1400,
});
layout!(segment_request, SegmentRequest, "glidepath.SegmentRequest.v3", 360, {
    session: 0, number: 8, asked_ns: 16, kind: 24, line: 28, rapid: 32, mode: 36, plane: 40, event_kind: 44,
    event_value: 48, feed_v: 56, tolerance_mm: 64, dwell_t: 72, sweep_rad: 80, center: 88,
    start: 104, end: 176, tangents: 248, bends: 296, length: 344, error_mm: 352,
});
layout!(segment_reply, SegmentReply, "glidepath.SegmentReply.v1", 232, {
    session: 0, number: 8, accepted: 16, credit: 24, refusal: 28, position: 32, message: 104,
});

#[test]
fn parts_of_records() {
    assert_eq!((size_of::<Quantiles>(), align_of::<Quantiles>()), (32, 8));
    assert_eq!((size_of::<EventId>(), align_of::<EventId>()), (24, 8));
    assert_eq!((size_of::<Latch>(), align_of::<Latch>()), (104, 8));
    assert_eq!((size_of::<Text>(), align_of::<Text>()), (128, 1));
}
