//! The fuzz target: foreign bytes: decoding never panics, and what it lets through is usable and
//! encodes to itself.
//!
//! `cargo +nightly fuzz run decode` in `crates/link`.

#![no_main]

use glidepath_link::{
    Auxiliary, CommandReply, CommandRequest, Feedback, JogDemand, Record, SegmentReply,
    SegmentRequest, Setpoint, SetpointFrame, Status, StreamItem, decode,
};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some((&choice, bytes)) = data.split_first() else {
        return;
    };
    match choice % 10 {
        0 => {
            if let Some(record) = read::<SetpointFrame>(bytes) {
                let frame = record.to_frame().expect("it was checked");
                let back = SetpointFrame::from_frame(&frame, record.epoch, record.period_ns);
                // An event without a number says the same whatever number comes with it.
                assert_eq!(back.to_frame().expect("it was checked"), frame);
            }
        }
        1 => {
            if let Some(record) = read::<Setpoint>(bytes) {
                record.state().expect("it was checked");
                for event in record.events() {
                    event.event().expect("it was checked");
                }
            }
        }
        2 => {
            if let Some(record) = read::<Status>(bytes) {
                record.fault().expect("it was checked");
                record.end_of_epoch().expect("it was checked");
            }
        }
        3 => {
            if let Some(record) = read::<CommandRequest>(bytes) {
                let command = record.command().expect("it was checked");
                let back = CommandRequest::new(record.client, record.number, command);
                assert_eq!(back.command().expect("it was checked"), command);
            }
        }
        4 => {
            if let Some(record) = read::<CommandReply>(bytes) {
                record.outcome().expect("it was checked").ok();
            }
        }
        5 => {
            if let Some(record) = read::<SegmentRequest>(bytes) {
                let item: StreamItem = record.item().expect("it was checked");
                let back = SegmentRequest::new(record.session, record.number, &item);
                assert_eq!(back.item().expect("it was checked"), item);
            }
        }
        6 => {
            read::<SegmentReply>(bytes);
        }
        7 => {
            read::<Feedback>(bytes);
        }
        8 => {
            if let Some(record) = read::<JogDemand>(bytes) {
                record.mode().expect("it was checked");
            }
        }
        _ => {
            if let Some(record) = read::<Auxiliary>(bytes) {
                record.spindle().expect("it was checked");
            }
        }
    }
});

/// Decodes the bytes, filled up or cut to the record's size, so that the fields are what is fuzzed.
fn read<R: Record>(bytes: &[u8]) -> Option<R> {
    let _ = decode::<R>(bytes);
    let mut exact = bytes.to_vec();
    exact.resize(size_of::<R>(), 0);
    let record = decode::<R>(&exact).ok()?;
    assert_eq!(bytemuck::bytes_of(&record), exact);
    Some(record)
}
