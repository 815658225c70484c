//! The field numbers of every record in a recording. A number is never given to another field, and
//! the number of a field that is gone is not given again.

use crate::table::message;
use glidepath_link::{EventRecord, Setpoint, Status};

// 16 and 20 were the one event that there was.
message!(Setpoint, "glidepath.Setpoint", {
    1 boot_id,
    2 reference,
    3 number,
    4 tick,
    5 scheduled_ns,
    6 apply_ns,
    7 lateness_ns,
    8 missed_ticks,
    9 epoch,
    10 sequence,
    11 fraction,
    12 line,
    13 flags,
    14 marks,
    15 state,
    17 block,
    18 enable,
    19 home,
    21 path_s,
    22 feed_v,
    23 effective_override,
    24 position,
    25 velocity,
    26 acceleration,
    27 joint_position,
    28 joint_velocity,
    29 joint_acceleration,
    30 away,
    31 event_count,
    32 events,
    33 superposed,
    34 index,
    35 reserved,
});

message!(EventRecord, "glidepath.Event", {
    1 value,
    2 offset_ns,
    3 kind,
    4 number,
    5 axis,
    6 depth_um,
    7 phase,
});

// 84 was nothing.
message!(Status, "glidepath.Status", {
    1 boot_id,
    2 updated_ns,
    3 period_ns,
    4 tick,
    5 epoch,
    6 frames_received,
    7 frames_executed,
    8 queue_depth,
    9 queue_capacity,
    10 pid,
    11 state,
    12 end_of_epoch,
    13 fault,
    14 fault_line,
    15 fault_axis,
    16 fault_joint,
    17 drive_fault,
    18 fault_sequence,
    19 fault_value,
    20 fault_limit,
    21 line,
    22 grants,
    23 block,
    24 single_block,
    25 program,
    26 program_start,
    27 position,
    28 away,
    29 power,
    30 mode,
    31 joints,
    32 enabled,
    33 homed,
    34 drive_faults,
    35 reference,
    36 feedback_age_ns,
    37 joint_actual,
    38 following_error,
    39 following_peak,
    40 awaited_sequence,
    41 awaited_since_ns,
    42 awaited_value,
    43 awaited_kind,
    44 awaited_line,
    45 path_s,
    46 block_path_s,
    47 feed_v,
    48 feed_override,
    49 rapid_override,
    50 jog_override,
    51 effective_override,
    52 ticks,
    53 missed_ticks,
    54 late_ticks,
    55 setpoints_published,
    56 setpoints_lost,
    57 reserve_stops,
    58 starved_ticks,
    59 commands_served,
    60 commands_refused,
    61 frames_refused,
    62 lateness,
    63 work,
    64 latency,
    65 response,
    66 last_error,
    67 last_event,
    68 message,
    69 contact,
    70 contact_kind,
    71 unanswered,
    72 awaited_words,
    73 adaptive_feed,
    74 job_number,
    75 next_epoch,
    76 job_stage,
    77 job_held,
    78 job,
    79 job_end,
    80 jog_client,
    81 jog_number,
    82 spindle_v,
    83 spindle_flags,
    85 superposition,
    86 superposed,
    87 freeze_reason,
    88 job_stream,
    89 spindle_override,
    90 spindle_load,
});

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Message;

    fn read_back<R: Message + bytemuck::Pod>(without_text: impl Fn(&mut R)) {
        // Plain data has no padding: fields of its size are all its fields.
        let sizes = R::fields().into_iter().map(|field| field.size);
        assert_eq!(
            sizes.sum::<usize>(),
            size_of::<R>(),
            "{} lacks a field",
            R::NAME
        );
        // Every byte another one; texts stay empty.
        let mut record: R = bytemuck::Zeroable::zeroed();
        for (index, byte) in bytemuck::bytes_of_mut(&mut record).iter_mut().enumerate() {
            *byte = u8::try_from(index * 37 % 251).unwrap();
        }
        without_text(&mut record);
        let mut written = Vec::new();
        record.put(&mut written);
        let mut read: R = bytemuck::Zeroable::zeroed();
        read.read(&written).unwrap();
        assert_eq!(bytemuck::bytes_of(&read), bytemuck::bytes_of(&record));
    }

    #[test]
    fn records_are_read_back_to_the_bit_and_no_field_is_left_out() {
        read_back::<Setpoint>(|_| ());
        read_back::<Status>(|status| {
            let Status {
                last_error,
                last_event,
                message,
                job,
                job_end,
                ..
            } = status;
            for text in [last_error, last_event, message, job, job_end] {
                *text = glidepath_link::Text::default();
            }
        });
    }

    #[test]
    fn numbers_are_given_once() {
        for fields in [Setpoint::fields(), Status::fields()] {
            let mut numbers: Vec<u32> = fields.iter().map(|field| field.number).collect();
            numbers.sort_unstable();
            numbers.dedup();
            assert_eq!(numbers.len(), fields.len());
        }
    }
}
