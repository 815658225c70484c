//! Tests of records: they say back what was put in, bit for bit, and bad ones are refused.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use bytemuck::Zeroable;
use glidepath_geometry::{AXES, AxisVector, Segment};
use glidepath_link::{
    Auxiliary, Command, CommandKind, CommandRefusal, CommandReply, CommandRequest, ContactKind,
    DriveState, EndOfEpoch, EventKind, EventRecord, FRAME_REFUSALS, FaultCause, Feedback,
    FrameRefusal, JogDemand, JogMode, LatchKind, Loss, MachineState, MotionMode, OVERRIDE_MAX,
    Power, Record, RecordError, RequestKind, SegmentRefusal, SegmentReply, SegmentRequest,
    Setpoint, SetpointFrame, Status, StreamItem, Text, decode, printable,
};
use glidepath_program::{Event, Item, ItemKind, PathMode, Rate};
use proptest::prelude::*;
use strategies::{command, frame, item};

mod strategies;

fn bits(vector: &AxisVector) -> [u64; AXES] {
    <[f64; AXES]>::from(*vector).map(f64::to_bits)
}

proptest! {
    #[test]
    fn a_frame_comes_back_bit_for_bit(
        frame in frame(),
        epoch in 1..=u64::MAX,
        period_ns in 4_000_000..=1_000_000_000_u64,
    ) {
        let record = SetpointFrame::from_frame(&frame, epoch, period_ns);
        let record: SetpointFrame = decode(bytemuck::bytes_of(&record)).unwrap();
        prop_assert_eq!((record.epoch, record.period_ns), (epoch, period_ns));
        prop_assert_eq!(record.planned_override.to_bits(), frame.planned_override.to_bits());
        let back = record.to_frame().unwrap();
        prop_assert_eq!(back, frame);
        for (back, frame) in [
            (&back.position, &frame.position),
            (&back.velocity, &frame.velocity),
            (&back.acceleration, &frame.acceleration),
        ] {
            prop_assert_eq!(bits(back), bits(frame));
        }
    }

    #[test]
    fn a_stream_item_comes_back(item in item(), session: u64, number: u64) {
        let record = SegmentRequest::new(session, number, &item);
        let record: SegmentRequest = decode(bytemuck::bytes_of(&record)).unwrap();
        prop_assert_eq!((record.session, record.number), (session, number));
        prop_assert_eq!(record.item().unwrap(), item);
    }

    #[test]
    fn a_command_comes_back(command in command(), client: u64, number: u64) {
        let record = CommandRequest::new(client, number, command);
        let record: CommandRequest = decode(bytemuck::bytes_of(&record)).unwrap();
        prop_assert_eq!((record.client, record.number), (client, number));
        prop_assert_eq!(record.command().unwrap(), command);
    }

    #[test]
    fn a_text_comes_back_up_to_what_fits(text in "[^\0]{0,200}") {
        let short = Text::new(&text);
        // What a terminal would obey is shown by a sign, and a text is one line.
        let text = printable(&text).replace('\n', " ");
        if text.len() <= Text::CAPACITY {
            prop_assert_eq!(short.as_str(), text);
        } else {
            // One that is cut says so.
            let head = short.as_str().strip_suffix('…');
            prop_assert!(head.is_some_and(|head| text.starts_with(head)), "{}", short.as_str());
            prop_assert!(short.as_str().len() + 4 > Text::CAPACITY);
        }
    }

    #[test]
    fn foreign_bytes_are_refused_or_usable(bytes in proptest::collection::vec(any::<u8>(), 0..600)) {
        // Any length: the right one is in the list for each record.
        fn read<R: Record>(bytes: &[u8]) -> Result<(), TestCaseError> {
            let exact: Vec<u8> = bytes.iter().copied().cycle().take(size_of::<R>()).collect();
            for bytes in [bytes, &exact] {
                match decode::<R>(bytes) {
                    Ok(record) => prop_assert!(record.check().is_ok()),
                    Err(RecordError::Size { expected, actual, .. }) => {
                        prop_assert_ne!(expected, actual);
                    }
                    Err(_) => prop_assert_eq!(bytes.len(), size_of::<R>()),
                }
            }
            Ok(())
        }
        read::<SetpointFrame>(&bytes)?;
        read::<Setpoint>(&bytes)?;
        read::<Status>(&bytes)?;
        read::<CommandRequest>(&bytes)?;
        read::<CommandReply>(&bytes)?;
        read::<SegmentRequest>(&bytes)?;
        read::<SegmentReply>(&bytes)?;
        read::<Feedback>(&bytes)?;
        read::<JogDemand>(&bytes)?;
    }
}

fn good_frame() -> SetpointFrame {
    SetpointFrame {
        epoch: 1,
        period_ns: 4_000_000,
        planned_override: 1.0,
        ..Zeroable::zeroed()
    }
}

fn good_setpoint() -> Setpoint {
    Setpoint {
        state: MachineState::Running.code(),
        ..Zeroable::zeroed()
    }
}

fn good_status() -> Status {
    Status {
        state: MachineState::Idle.code(),
        ..Zeroable::zeroed()
    }
}

fn good_segment() -> SegmentRequest {
    let segment = Segment::line(AxisVector::zeros(), AxisVector::repeat(1.0));
    let mode = PathMode::Continuous {
        tolerance_mm: Some(0.1),
    };
    let kind = ItemKind::Move {
        segment,
        rate: Rate::Feed(10.0),
        mode,
    };
    SegmentRequest::new(
        1,
        1,
        &StreamItem::Item(Item {
            block: 0,
            line: 1,
            kind,
        }),
    )
}

#[test]
fn frames_out_of_range_are_refused() {
    let good = good_frame();
    let tool = EventRecord::new(Event::SelectTool(2), 1);
    for bad in [
        SetpointFrame { epoch: 0, ..good },
        SetpointFrame {
            period_ns: 0,
            ..good
        },
        SetpointFrame {
            period_ns: 1_000_000_001,
            ..good
        },
        SetpointFrame {
            planned_override: 0.0,
            ..good
        },
        SetpointFrame {
            planned_override: OVERRIDE_MAX * 1.01,
            ..good
        },
        with_events(good, &[EventRecord { value: 1.5, ..tool }]),
        with_events(
            good,
            &[EventRecord {
                value: -1.0,
                ..tool
            }],
        ),
        with_events(good, &[EventRecord { number: 1, ..tool }]),
        with_events(good, &[EventRecord { phase: 1, ..tool }]),
        // Later than the end of the period, and before the one before it.
        with_events(
            good,
            &[EventRecord {
                offset_ns: 4_000_001,
                ..tool
            }],
        ),
        with_events(
            good,
            &[
                EventRecord {
                    offset_ns: 2,
                    ..tool
                },
                tool,
            ],
        ),
        SetpointFrame {
            event_count: 17,
            ..good
        },
    ] {
        assert!(
            matches!(bad.to_frame(), Err(RecordError::OutOfRange { .. })),
            "{bad:?}"
        );
    }
    let bad = SetpointFrame {
        flags: 1 << 8,
        ..good
    };
    assert!(matches!(
        bad.to_frame(),
        Err(RecordError::UnknownFlags { bits: 256, .. })
    ));
    for code in [0, 17] {
        let bad = with_events(good, &[EventRecord { kind: code, ..tool }]);
        assert!(matches!(
            bad.to_frame(),
            Err(RecordError::UnknownCode { code: of, .. }) if of == code
        ));
    }
    // What the machine rests for is the last of its period.
    let rest = EventRecord::new(Event::MCode(3), 1);
    assert!(with_events(good, &[tool, rest]).to_frame().is_ok());
    assert!(with_events(good, &[rest, tool]).to_frame().is_err());
}

/// A frame with other events.
fn with_events(good: SetpointFrame, events: &[EventRecord]) -> SetpointFrame {
    let mut frame = good;
    frame.silence();
    frame.events[..events.len()].copy_from_slice(events);
    frame.event_count = events.len().try_into().unwrap();
    frame
}

/// A good record with one field spoilt.
fn refused<R: Record>(good: R, spoil: impl FnOnce(&mut R)) -> RecordError {
    good.check().unwrap();
    let mut bad = good;
    spoil(&mut bad);
    decode::<R>(bytemuck::bytes_of(&bad)).unwrap_err()
}

#[test]
fn unknown_codes_and_bits_are_refused() {
    for error in [
        refused(good_setpoint(), |s| s.state = 0),
        refused(good_setpoint(), |s| s.state = 17),
        refused(good_status(), |s| s.state = 0),
        refused(good_status(), |s| s.fault = 24),
        refused(good_status(), |s| s.fault_axis = 10),
        refused(good_status(), |s| s.fault_axis = u32::MAX),
        refused(good_status(), |s| s.end_of_epoch = 6),
        refused(good_status(), |s| s.contact_kind = 3),
        refused(good_status(), |s| s.fault_joint = 10),
        refused(good_status(), |s| s.power = 4),
        refused(good_status(), |s| s.mode = 6),
        refused(Feedback::zeroed(), |f| f.drive_state[8] = 9),
        refused(Feedback::zeroed(), |f| f.latch[3].kind = 5),
        refused(Feedback::zeroed(), |f| f.loss = 6),
        refused(JogDemand::zeroed(), |j| j.mode = 5),
        refused(CommandRequest::new(1, 1, Command::Ping), |c| c.kind = 0),
        refused(CommandRequest::new(1, 1, Command::Ping), |c| c.kind = 24),
        refused(Auxiliary::default(), |a| a.spindle_turn = 4),
        refused(SegmentReply::zeroed(), |r| r.refusal = 12),
        refused(good_segment(), |s| s.kind = 0),
        refused(good_segment(), |s| s.mode = 5),
        refused(good_segment(), |s| s.rapid = 2),
        refused(good_segment(), |s| s.kind = RequestKind::Event.code()),
    ] {
        assert!(matches!(error, RecordError::UnknownCode { .. }), "{error}");
    }
    for error in [
        refused(good_setpoint(), |s| s.marks = 4),
        refused(good_setpoint(), |s| s.flags = 256),
        refused(good_status(), |s| s.grants = 64),
        refused(good_status(), |s| s.unanswered = 2),
        refused(good_status(), |s| s.spindle_flags = 512),
        refused(good_status(), |s| s.awaited_words.given = 4),
        refused(good_status(), |s| s.homed = 1 << 9),
        refused(good_setpoint(), |s| s.enable = 1 << 9),
        refused(good_setpoint(), |s| s.home = 1 << 9),
        refused(Feedback::zeroed(), |f| f.joints = 1 << 9),
        refused(Feedback::zeroed(), |f| f.home_switch = 1 << 31),
        refused(Feedback::zeroed(), |f| f.spindle_flags = 512),
        refused(JogDemand::zeroed(), |j| j.mask = 1 << 9),
        refused(CommandRequest::new(1, 1, Command::Home(1)), |c| {
            c.joints = 1 << 9;
        }),
    ] {
        assert!(matches!(error, RecordError::UnknownFlags { .. }), "{error}");
    }
    for error in [
        refused(good_setpoint(), |s| s.fraction = 1.5),
        refused(Auxiliary::default(), |a| a.spindle_gear = 6),
        refused(good_setpoint(), |s| s.effective_override = -0.1),
        refused(good_status(), |s| s.feed_override = OVERRIDE_MAX + 0.1),
        refused(good_status(), |s| s.adaptive_feed = 1.01),
        refused(good_segment(), |s| s.feed_v = 0.0),
        refused(good_segment(), |s| s.tolerance_mm = 0.0),
        refused(good_segment(), |s| s.kind = RequestKind::Arc.code()),
        refused(CommandRequest::new(1, 1, Command::FeedOverride(1.0)), |c| {
            c.value = 2.1;
        }),
        refused(CommandRequest::new(1, 1, Command::SingleBlock(true)), |c| {
            c.value = 0.5;
        }),
        refused(
            CommandRequest::new(
                1,
                1,
                Command::SetPosition {
                    joint: 0,
                    position: 1.0,
                },
            ),
            |c| c.joints = 9,
        ),
        refused(Feedback::zeroed(), |f| f.latch[0].input = 64),
        refused(JogDemand::zeroed(), |j| j.velocity_v = -1.0),
    ] {
        assert!(matches!(error, RecordError::OutOfRange { .. }), "{error}");
    }
}

#[test]
fn text_that_is_not_utf8_is_refused() {
    let reply = CommandReply::new(
        1,
        1,
        Err(CommandRefusal::WrongState),
        MachineState::Held,
        "why",
    );
    reply.check().unwrap();
    let mut bytes = bytemuck::bytes_of(&reply).to_vec();
    *bytes.get_mut(24).unwrap() = 0xff;
    let error = decode::<CommandReply>(&bytes).unwrap_err();
    assert!(matches!(error, RecordError::NotText { .. }), "{error}");
}

#[test]
fn codes_are_consecutive_and_known() {
    fn in_sequence(codes: impl Iterator<Item = u32>, first: u32, last: u32) {
        assert_eq!(
            codes.collect::<Vec<_>>(),
            (first..=last).collect::<Vec<_>>()
        );
    }
    in_sequence(MachineState::ALL.iter().map(|code| code.code()), 1, 16);
    in_sequence(EndOfEpoch::ALL.iter().map(|code| code.code()), 0, 5);
    in_sequence(ContactKind::ALL.iter().map(|code| code.code()), 0, 2);
    in_sequence(FrameRefusal::ALL.iter().map(|code| code.code()), 1, 12);
    in_sequence(CommandKind::ALL.iter().map(|code| code.code()), 1, 23);
    in_sequence(CommandRefusal::ALL.iter().map(|code| code.code()), 1, 5);
    in_sequence(SegmentRefusal::ALL.iter().map(|code| code.code()), 1, 11);
    in_sequence(Power::ALL.iter().map(|code| code.code()), 0, 3);
    in_sequence(MotionMode::ALL.iter().map(|code| code.code()), 0, 5);
    in_sequence(JogMode::ALL.iter().map(|code| code.code()), 0, 4);
    in_sequence(LatchKind::ALL.iter().map(|code| code.code()), 0, 4);
    in_sequence(Loss::ALL.iter().map(|code| code.code()), 0, 5);
    in_sequence(DriveState::ALL.iter().map(|code| code.code()), 0, 8);
    in_sequence(EventKind::ALL.iter().map(|code| code.code()), 0, 16);
    assert_eq!(FrameRefusal::ALL.len(), FRAME_REFUSALS);
    assert!(
        FrameRefusal::ALL
            .iter()
            .enumerate()
            .all(|(index, code)| code.index() == index)
    );
    let faults: Vec<u32> = (0..0x200)
        .filter(|code| FaultCause::from_code(*code).is_some())
        .collect();
    assert_eq!(faults, (1..=23).chain(0x101..=0x10c).collect::<Vec<_>>());
    for code in faults {
        assert_eq!(FaultCause::from_code(code).unwrap().code(), code);
    }
}
