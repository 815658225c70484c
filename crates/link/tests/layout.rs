//! The layout of the records, byte by byte: a change here is a new version of the record.

use core::mem::{align_of, offset_of, size_of};
use glidepath_link::{
    CommandReply, CommandRequest, Quantiles, Record, SegmentReply, SegmentRequest, Setpoint,
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

layout!(setpoint_frame, SetpointFrame, "glidepath.SetpointFrame.v2", 296, {
    epoch: 0, sequence: 8, period_ns: 16, line: 24, flags: 28, event_kind: 32, block: 36,
    event_value: 40, path_v: 48, path_s: 56, planned_override: 64, program: 72, position: 80,
    velocity: 152, acceleration: 224,
});
layout!(setpoint, Setpoint, "glidepath.Setpoint.v2", 568, {
    boot_id: 0, number: 8, tick: 16, scheduled_ns: 24, apply_ns: 32, lateness_ns: 40,
    missed_ticks: 48, epoch: 56, sequence: 64, fraction: 72, line: 80, flags: 84, marks: 88,
    state: 92, event_kind: 96, block: 100, event_value: 104, path_s: 112, feed_v: 120,
    effective_override: 128, position: 136, velocity: 208, acceleration: 280, joint_position: 352,
    joint_velocity: 424, joint_acceleration: 496,
});
layout!(status, Status, "glidepath.Status.v4", 880, {
    boot_id: 0, updated_ns: 8, period_ns: 16, tick: 24, epoch: 32, frames_received: 40,
    frames_executed: 48, queue_depth: 56, queue_capacity: 60, pid: 64, state: 68, end_of_epoch: 72,
    fault: 76, fault_line: 80, fault_axis: 84, fault_sequence: 88, fault_value: 96,
    fault_limit: 104, line: 112, grants: 116, block: 120, single_block: 124, program: 128,
    program_start: 136, position: 208, path_s: 280, block_path_s: 288, feed_v: 296,
    feed_override: 304, rapid_override: 312, effective_override: 320, ticks: 328,
    missed_ticks: 336, late_ticks: 344, setpoints_published: 352, setpoints_lost: 360,
    reserve_stops: 368, starved_ticks: 376, commands_served: 384, commands_refused: 392,
    frames_refused: 400, lateness: 496, work: 528, latency: 560, response: 592, last_error: 624,
    last_event: 752,
});
layout!(command_request, CommandRequest, "glidepath.CommandRequest.v2", 32, {
    client: 0, number: 8, value: 16, kind: 24, reserved: 28,
});
layout!(command_reply, CommandReply, "glidepath.CommandReply.v2", 152, {
    boot_id: 0, number: 8, refusal: 16, state: 20, message: 24,
});
layout!(segment_request, SegmentRequest, "glidepath.SegmentRequest.v2", 352, {
    session: 0, number: 8, kind: 16, line: 20, rapid: 24, mode: 28, plane: 32, event_kind: 36,
    event_value: 40, feed_v: 48, tolerance_mm: 56, dwell_t: 64, sweep_rad: 72, center: 80,
    start: 96, end: 168, tangents: 240, bends: 288, length: 336, error_mm: 344,
});
layout!(segment_reply, SegmentReply, "glidepath.SegmentReply.v1", 232, {
    session: 0, number: 8, accepted: 16, credit: 24, refusal: 28, position: 32, message: 104,
});

#[test]
fn parts_of_records() {
    assert_eq!((size_of::<Quantiles>(), align_of::<Quantiles>()), (32, 8));
    assert_eq!((size_of::<Text>(), align_of::<Text>()), (128, 1));
}
