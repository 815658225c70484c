//! Objects of more than four bytes: as a whole, in segments, and what can be wrong with those.

use crate::wire::{MemoryWire, Quiet};
use glidepath_emulator::{DriveSettings as Emulated, InjectedFault, Segment, SegmentFault};
use glidepath_ethercat::{BusError, Init, PreOp, TransferTrouble, object};

const NAME: (u16, u8) = (0x1008, 0);
const RECIPE: (u16, u8) = (0x2100, 3);
const MOST: usize = 4096;
/// Around what fits into a message of 128 bytes, and into one and two segments behind it.
const LENGTHS: [usize; 14] = [0, 1, 4, 5, 8, 111, 112, 113, 118, 119, 120, 231, 232, 700];

fn bytes(count: usize) -> Vec<u8> {
    (0..count).map(|nth| (nth * 7 + 3) as u8).collect()
}

fn device(count: usize, segment_fault: SegmentFault) -> Emulated {
    Emulated {
        name: "LONG".to_owned(),
        long_objects: vec![(NAME, bytes(count)), (RECIPE, Vec::new())],
        segment_fault,
        drops_repeats: true,
        ..Emulated::default()
    }
}

fn wire(device: Emulated) -> MemoryWire<Quiet> {
    MemoryWire::new(Segment::new(&[device]), Quiet, 0)
}

fn pre_op(wire: &mut MemoryWire<Quiet>) -> PreOp<'_, MemoryWire<Quiet>> {
    Init::find(wire).unwrap().into_pre_op().unwrap()
}

fn read(count: usize, fault: SegmentFault) -> Result<Vec<u8>, BusError> {
    let mut wire = wire(device(count, fault));
    let mut bus = pre_op(&mut wire);
    let told = bus.read_bytes(0, NAME, MOST);
    // Whatever came of it, the next question is answered.
    assert_eq!(bus.read(0, object(0x1018, 1, 4)).unwrap(), 0xe1e);
    told
}

fn write(count: usize, fault: SegmentFault) -> (Result<(), BusError>, Vec<u8>) {
    let mut wire = wire(device(0, fault));
    let mut bus = pre_op(&mut wire);
    let told = bus.write_bytes(0, RECIPE, &bytes(count));
    assert_eq!(bus.read(0, object(0x1018, 1, 4)).unwrap(), 0xe1e);
    let written = wire.segment.long_object(0, RECIPE).unwrap().to_vec();
    (told, written)
}

/// What is wrong with a transfer.
fn trouble<T: std::fmt::Debug>(told: Result<T, BusError>) -> TransferTrouble {
    match told.unwrap_err() {
        BusError::Transfer { trouble, .. } => trouble,
        other => panic!("{other}"),
    }
}

#[test]
fn objects_of_any_length_come_and_go_as_they_are() {
    for count in LENGTHS {
        assert_eq!(
            read(count, SegmentFault::None).unwrap(),
            bytes(count),
            "{count}"
        );
        let (told, written) = write(count, SegmentFault::None);
        told.unwrap();
        assert_eq!(written, bytes(count), "{count}");
    }
}

#[test]
fn a_segment_that_comes_twice_is_told() {
    // With one segment nothing has to change.
    assert_eq!(read(200, SegmentFault::SameToggle).unwrap(), bytes(200));
    let told = read(700, SegmentFault::SameToggle);
    let words = told.as_ref().unwrap_err().to_string();
    assert_eq!(
        words,
        "device 0 (LONG): object 0x1008:0 did not go as a whole: a segment came twice or is missing (its \
         toggle bit did not change)"
    );
    assert_eq!(trouble(told), TransferTrouble::Toggle);
    let (told, written) = write(700, SegmentFault::SameToggle);
    assert_eq!(trouble(told), TransferTrouble::Toggle);
    assert!(written.is_empty(), "{written:?}");
}

#[test]
fn lengths_that_are_wrong_are_told() {
    let of = |more| trouble(read(300, SegmentFault::Length(more)));
    let length = |told, given| TransferTrouble::Length { told, given };
    assert_eq!(of(4), length(304, 300));
    assert_eq!(of(-4), length(296, 300));
    // More than anybody reads is not begun.
    let long = TransferTrouble::TooLong {
        told: 1_000_300,
        most: MOST,
    };
    assert_eq!(of(1_000_000), long);
    assert_eq!(
        trouble(read(300, SegmentFault::Empty)),
        TransferTrouble::Empty
    );
}

#[test]
fn a_transfer_that_is_aborted_is_refused_with_the_code() {
    for (nth, code) in [(0, 0x0800_0020), (1, 0x0504_0005)] {
        let is_code = |error: BusError| matches!(error, BusError::Object { code: told, index, .. } if told == code && index != 0);
        assert!(is_code(
            read(700, SegmentFault::Abort(nth, code)).unwrap_err()
        ));
        let (told, written) = write(700, SegmentFault::Abort(nth, code));
        assert!(is_code(told.unwrap_err()));
        assert!(written.is_empty(), "{written:?}");
    }
    let mut wire = wire(device(0, SegmentFault::None));
    let refused = pre_op(&mut wire).read_bytes(0, (0x1009, 0), MOST);
    assert!(matches!(
        refused,
        Err(BusError::Object {
            code: 0x0602_0000,
            ..
        })
    ));
}

#[test]
fn a_segment_that_is_not_answered_begins_the_transfer_anew() {
    for nth in 0..3 {
        assert_eq!(read(400, SegmentFault::Silent(nth)).unwrap(), bytes(400));
        let (told, written) = write(400, SegmentFault::Silent(nth));
        told.unwrap();
        assert_eq!(written, bytes(400));
    }
}

#[test]
fn an_emergency_between_segments_is_passed_over() {
    let mut wire = wire(device(700, SegmentFault::None));
    let _ = pre_op(&mut wire);
    for code in [0x7380, 0x8611, 0x2310] {
        wire.segment.inject(0, InjectedFault::Emergency(code), 0);
    }
    // A start resets the mailbox; these come with the answers.
    let mut bus = pre_op(&mut wire);
    assert_eq!(bus.read_bytes(0, NAME, MOST).unwrap(), bytes(700));
}

#[test]
fn a_number_that_is_longer_than_a_number_is_refused_and_no_silence() {
    let mut wire = wire(device(12, SegmentFault::None));
    let mut bus = pre_op(&mut wire);
    let told = bus.read(0, object(0x1008, 0, 4));
    let long = TransferTrouble::TooLong { told: 12, most: 4 };
    assert_eq!(trouble(told), long);
}
