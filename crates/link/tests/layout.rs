//! The layout of the records, byte by byte: a change here is a new version of the record; and that no number
//! that is not finite gets past the check of any.

use bytemuck::Zeroable;
use core::mem::{align_of, offset_of, size_of, size_of_val};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_link::{
    Auxiliary, CodeWords, Command, CommandReply, CommandRequest, EventId, EventRecord, Feedback,
    JobReply, JobRequest, JogDemand, Latch, LinesReply, LinesRequest, LongText, MachineState,
    Quantiles, Record, SegmentReply, SegmentRequest, Setpoint, SetpointFrame, Status, StreamItem,
    Text,
};
use glidepath_program::{Item, ItemKind, PathMode, Rate};

/// The offsets of the numbers of a field that might not be finite. Those of events are judged only as far as a
/// record says that it has some.
trait Field {
    fn numbers(&self) -> Vec<usize> {
        Vec::new()
    }
}

impl Field for u32 {}
impl Field for u64 {}
impl Field for Text {}
impl Field for LongText {}
impl Field for EventId {}
impl Field for EventRecord {}
impl Field for Quantiles {}

impl Field for f64 {
    fn numbers(&self) -> Vec<usize> {
        vec![0]
    }
}

impl Field for CodeWords {
    fn numbers(&self) -> Vec<usize> {
        vec![offset_of!(Self, p), offset_of!(Self, q)]
    }
}

impl Field for Latch {
    fn numbers(&self) -> Vec<usize> {
        let position = self.position.numbers().into_iter();
        position
            .map(|offset| offset_of!(Self, position) + offset)
            .collect()
    }
}

impl<F: Field, const N: usize> Field for [F; N] {
    fn numbers(&self) -> Vec<usize> {
        let each = |(index, field): (usize, &F)| {
            let from = index * size_of::<F>();
            let numbers = field.numbers().into_iter();
            numbers.map(move |offset| from + offset).collect::<Vec<_>>()
        };
        self.iter().enumerate().flat_map(each).collect()
    }
}

/// Whoever writes a record may write anything into a number of it: none that is not finite gets past
/// its check.
fn refuses_not_finite<R: Record>(good: &R, field: &str, numbers: impl Iterator<Item = usize>) {
    for offset in numbers {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut bytes = bytemuck::bytes_of(good).to_vec();
            bytes[offset..offset + 8].copy_from_slice(&bad.to_ne_bytes());
            let record: R = bytemuck::pod_read_unaligned(&bytes);
            assert!(
                record.check().is_err(),
                "`check` takes {bad} of {field}, at {offset}"
            );
        }
    }
}

macro_rules! layout {
    ($test:ident, $record:ty, $name:literal, $size:literal, $good:expr, { $($field:ident: $offset:literal),+ $(,)? }) => {
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
            let good: $record = $good;
            assert_eq!(good.check(), Ok(()));
            // A record has no gaps.
            assert_eq!(0 $(+ size_of_val(&good.$field))+, $size, "a field is not in the list");
            $({
                let numbers = good.$field.numbers().into_iter().map(|offset| $offset + offset);
                refuses_not_finite(&good, stringify!($field), numbers);
            })+
        }
    };
}

layout!(setpoint_frame, SetpointFrame, "glidepath.SetpointFrame.v4", 808,
    SetpointFrame { epoch: 1, period_ns: 4_000_000, planned_override: 1.0, ..Zeroable::zeroed() }, {
    epoch: 0, sequence: 8, period_ns: 16, line: 24, flags: 28, event_count: 32, block: 36,
    path_v: 40, path_s: 48, planned_override: 56, program: 64, programmed_v: 72, position: 80,
    velocity: 152, acceleration: 224, events: 296,
});
layout!(setpoint, Setpoint, "glidepath.Setpoint.v6", 1240,
    Setpoint { state: MachineState::Running.code(), ..Zeroable::zeroed() }, {
    boot_id: 0, reference: 8, number: 16, tick: 24, scheduled_ns: 32, apply_ns: 40,
    lateness_ns: 48, missed_ticks: 56, epoch: 64, sequence: 72, fraction: 80, line: 88, flags: 92,
    marks: 96, state: 100, event_count: 104, block: 108, enable: 112, home: 116,
    path_s: 120, feed_v: 128, effective_override: 136, position: 144, velocity: 216,
    acceleration: 288, joint_position: 360, joint_velocity: 432, joint_acceleration: 504,
    away: 576, events: 648, superposed: 1160, index: 1232,
    reserved: 1236,
});
layout!(status, Status, "glidepath.Status.v16", 1904,
    Status { state: MachineState::Idle.code(), ..Zeroable::zeroed() }, {
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
    jog_client: 1776, jog_number: 1784, spindle_v: 1792, spindle_flags: 1800, superposition: 1804, superposed: 1808, freeze_reason: 1880, job_stream: 1884, spindle_override: 1888, spindle_load: 1896,
});
layout!(command_request, CommandRequest, "glidepath.CommandRequest.v8", 208,
    CommandRequest::new(1, 1, Command::Ping), {
    client: 0, number: 8, value: 16, kind: 24, joints: 28, event: 32, job: 56, asked_ns: 64, job_stream: 72, reserved: 76, text: 80,
});
layout!(auxiliary, Auxiliary, "glidepath.Auxiliary.v4", 688,
    Auxiliary::default(), {
    boot_id: 0, generation: 8, epoch: 16, sequence: 24, awaited: 32, awaited_since_ns: 56,
    awaited_until_ns: 64, awaited_value: 72, awaited_kind: 80, line: 84, awaited_words: 88, spindle_speed: 112,
    spindle: 120, coolant: 124, tool: 128, prepared_tool: 132, digital_out: 136, analog_out: 144,
    spindle_angle: 656, spindle_override: 664, spindle_turn: 672, spindle_override_locked: 676, spindle_gear: 680,
    reserved: 684,
});
layout!(command_reply, CommandReply, "glidepath.CommandReply.v3", 152,
    CommandReply { state: 1, ..Zeroable::zeroed() }, {
    boot_id: 0, number: 8, refusal: 16, state: 20, message: 24,
});
layout!(feedback, Feedback, "glidepath.Feedback.v5", 904,
    Zeroable::zeroed(), {
    boot_id: 0, number: 8, sample_ns: 16, reference: 24, setpoint_number: 32, joints: 40,
    enabled: 44, homed: 48, homing: 52, fault: 56, limit_low: 60, limit_high: 64, home_switch: 68,
    position: 72, velocity: 144, drive_state: 216, fault_code: 252, digital_in: 288, analog_in: 296,
    spindle_angle: 360, spindle_v: 368, spindle_index_count: 376, spindle_flags: 384, loss: 388,
    loss_value: 392, latch: 400, index_armed: 816, index_kept: 820, index_position: 824, spindle_load: 896,
});
layout!(jog_demand, JogDemand, "glidepath.JogDemand.v2", 136,
    Zeroable::zeroed(), {
    client: 0, number: 8, sent_ns: 16, asked_ns: 24, mode: 32, mask: 36, by_joint: 40, reserved: 44,
    velocity_v: 48, scale: 56, value: 64,
});
layout!(job_request, JobRequest, "glidepath.JobRequest.v5", 1088,
    JobRequest { kind: 1, wish: 1, tolerance_ratio: 1.0, ..Zeroable::zeroed() }, {
    client: 0, number: 8, asked_ns: 16, program: 24, tolerance_ratio: 32, kind: 40, from_line: 44, pass: 48,
    confirmed: 52, resumes: 56, wish: 60, text: 64,
});
layout!(job_reply, JobReply, "glidepath.JobReply.v3", 1048,
    JobReply { state: 1, ..Zeroable::zeroed() }, {
    client: 0, number: 8, state: 16, reserved: 20, text: 24,
});
layout!(lines_request, LinesRequest, "glidepath.LinesRequest.v2", 1200,
    LinesRequest { wish: 1, ahead_t: 1.0, ..Zeroable::zeroed() }, {
    client: 0, number: 8, asked_ns: 16, first: 24, ahead_t: 32, wish: 40, reserved: 44, name: 48, text: 176,
});
layout!(lines_reply, LinesReply, "glidepath.LinesReply.v1", 2424,
    LinesReply { state: 1, ..Zeroable::zeroed() }, {
    client: 0, number: 8, taken: 16, read: 24, state: 32, is_refused: 36, refused_column: 40,
    refused_in_motion: 44, ahead_t: 48, zero: 56, systems: 128, references: 776, shift: 920, tool: 992,
    probe: 1064, probe_made: 1136, probes: 1140, diagnostic: 1144, words: 1272, text: 1400,
});
layout!(segment_request, SegmentRequest, "glidepath.SegmentRequest.v3", 360,
    segment(), {
    session: 0, number: 8, asked_ns: 16, kind: 24, line: 28, rapid: 32, mode: 36, plane: 40, event_kind: 44,
    event_value: 48, feed_v: 56, tolerance_mm: 64, dwell_t: 72, sweep_rad: 80, center: 88,
    start: 104, end: 176, tangents: 248, bends: 296, length: 344, error_mm: 352,
});
layout!(segment_reply, SegmentReply, "glidepath.SegmentReply.v2", 1128,
    Zeroable::zeroed(), {
    session: 0, number: 8, accepted: 16, credit: 24, refusal: 28, position: 32, message: 104,
});

fn segment() -> SegmentRequest {
    let kind = ItemKind::Move {
        segment: Segment::line(AxisVector::zeros(), AxisVector::repeat(1.0)),
        rate: Rate::Feed(10.0),
        mode: PathMode::Continuous {
            tolerance_mm: Some(0.1),
        },
    };
    let (block, line) = (0, 1);
    SegmentRequest::new(1, 1, &StreamItem::Item(Item { block, line, kind }))
}

#[test]
fn parts_of_records() {
    assert_eq!((size_of::<Quantiles>(), align_of::<Quantiles>()), (32, 8));
    assert_eq!((size_of::<EventId>(), align_of::<EventId>()), (24, 8));
    assert_eq!((size_of::<Latch>(), align_of::<Latch>()), (104, 8));
    assert_eq!((size_of::<Text>(), align_of::<Text>()), (128, 1));
}
