//! The strategies of random records: any frame, any item of a stream, any command.

use glidepath_geometry::{Arc, AxisVector, Plane, Quintic, Segment};
use glidepath_link::{ALL_JOINTS, Command, EventId, OVERRIDE_MAX, StreamItem};
use glidepath_program::{
    CodeWord, EVENTS_MOST, Event, Frame, FrameEvents, FrameFlags, Item, ItemKind, OrientWay,
    PHASE_STEPS, PathMode, Rate, TAP_DEPTHS_UM,
};
use proptest::prelude::*;

pub(crate) fn finite() -> impl Strategy<Value = f64> {
    any::<f64>().prop_filter("finite", |value| value.is_finite())
}

pub(crate) fn positive() -> impl Strategy<Value = f64> {
    finite()
        .prop_map(f64::abs)
        .prop_filter("positive", |value| *value >= f64::MIN_POSITIVE)
}

pub(crate) fn vector() -> impl Strategy<Value = AxisVector> {
    proptest::array::uniform9(finite()).prop_map(AxisVector::from)
}

pub(crate) fn event() -> impl Strategy<Value = Event> {
    prop_oneof![
        finite().prop_map(Event::SpindleSpeed),
        (1..=5_u32).prop_map(Event::SpindleGear),
        (0.0..=360.0, 0..3_usize).prop_map(|(deg, way)| Event::SpindleAngle {
            deg,
            way: [
                OrientWay::Shortest,
                OrientWay::Clockwise,
                OrientWay::Counterclockwise
            ][way],
        }),
        any::<u32>().prop_map(Event::SelectTool),
        any::<u32>().prop_map(Event::MCode),
        any::<u32>().prop_map(Event::PassingCode),
        any::<u32>().prop_map(Event::ProgramStop),
        Just(Event::OptionalStop),
        any::<bool>().prop_map(|release| Event::Probe { release }),
        (any::<bool>(), finite()).prop_map(|(is_p, value)| Event::CodeWord {
            word: if is_p { CodeWord::P } else { CodeWord::Q },
            value,
        }),
        any::<u32>().prop_map(Event::Await),
        (any::<u32>(), any::<bool>()).prop_map(|(number, on)| Event::DigitalOutput {
            number: number >> 8,
            on
        }),
        (any::<u32>(), finite()).prop_map(|(number, value)| Event::AnalogOutput {
            number: number >> 8,
            value
        }),
        (1e-3..1e3, 0..PHASE_STEPS)
            .prop_map(|(pitch_mm, phase)| Event::Synchronise { pitch_mm, phase }),
        (0..9_u32, 1e-3..1e3, 0..TAP_DEPTHS_UM).prop_map(|(axis, pitch_mm, depth_um)| {
            Event::Tap {
                axis,
                pitch_mm,
                depth_um,
            }
        }),
    ]
}

/// Events of a period of 4 ms, in order, of which the last may be at rest.
pub(crate) fn events() -> impl Strategy<Value = FrameEvents> {
    let passing = event().prop_filter("passes", |event| !event.is_at_rest());
    let passing = proptest::collection::vec((passing, 0..4_000_000_u32), 0..EVENTS_MOST);
    (passing, proptest::option::of(event())).prop_map(|(mut passing, last)| {
        passing.sort_by_key(|(_, offset_ns)| *offset_ns);
        passing.extend(last.map(|event| (event, 4_000_000)));
        let mut events = FrameEvents::NONE;
        for (event, offset_ns) in passing {
            assert!(events.push(event, offset_ns));
        }
        events
    })
}

prop_compose! {
    pub(crate) fn frame()(
        (sequence, line, flags) in (any::<u64>(), any::<u32>(), 0..128_u32),
        events in events(),
        planned_override in 0.001..=OVERRIDE_MAX,
        (path_v, path_s, programmed_v) in (finite(), finite(), positive()),
        (position, velocity, acceleration) in (vector(), vector(), vector()),
    ) -> Frame {
        let flags = FrameFlags(flags);
        Frame { block: 0,
            sequence,
            line,
            flags,
            events,
            planned_override,
            path_v,
            path_s,
            programmed_v,
            position,
            velocity,
            acceleration,
        }
    }
}

pub(crate) fn plane() -> impl Strategy<Value = Plane> {
    use Plane::{Uv, Vw, Wu, Xy, Yz, Zx};
    proptest::sample::select(vec![Xy, Zx, Yz, Uv, Wu, Vw])
}

pub(crate) fn segment() -> impl Strategy<Value = Segment> {
    let arc = (
        vector(),
        vector(),
        plane(),
        proptest::array::uniform2(finite()),
        positive(),
        any::<bool>(),
    );
    prop_oneof![
        (vector(), vector()).prop_map(|(start, end)| Segment::line(start, end)),
        (
            (vector(), vector(), positive(), finite()),
            proptest::array::uniform4(proptest::array::uniform3(finite())),
        )
            .prop_map(|((start, end, length, error_mm), ends)| {
                let [t0, t1, b0, b1] = ends.map(Into::into);
                Segment::Curve(Quintic {
                    start,
                    end,
                    tangents: [t0, t1],
                    bends: [b0, b1],
                    length,
                    error_mm: error_mm.abs(),
                })
            }),
        arc.prop_map(|(start, end, plane, center, sweep, clockwise)| {
            let sweep_rad = if clockwise { -sweep } else { sweep };
            Segment::Arc(Arc {
                start,
                end,
                plane,
                center,
                sweep_rad,
            })
        }),
    ]
}

pub(crate) fn item() -> impl Strategy<Value = StreamItem> {
    let rate = prop_oneof![Just(Rate::Rapid), positive().prop_map(Rate::Feed)];
    let mode = prop_oneof![
        Just(PathMode::ExactStop),
        Just(PathMode::ExactPath),
        proptest::option::of(positive())
            .prop_map(|tolerance_mm| PathMode::Continuous { tolerance_mm }),
    ];
    let kind = prop_oneof![
        (segment(), rate, mode).prop_map(|(segment, rate, mode)| ItemKind::Move {
            segment,
            rate,
            mode
        }),
        finite().prop_map(|dwell| ItemKind::Dwell(dwell.abs())),
        event().prop_map(ItemKind::Event),
    ];
    prop_oneof![
        any::<u64>().prop_map(|asked_ns| StreamItem::Open { asked_ns }),
        Just(StreamItem::End),
        (any::<u32>(), kind).prop_map(|(line, kind)| StreamItem::Item(Item {
            block: 0,
            line,
            kind
        })),
    ]
}

pub(crate) fn command() -> impl Strategy<Value = Command> {
    prop_oneof![
        proptest::sample::select(vec![
            Command::Ping,
            Command::Hold,
            Command::Resume,
            Command::Abort,
            Command::StopAtEndOfBlock,
            Command::Reset,
            Command::Step,
            Command::Enable,
            Command::Disable,
            Command::Return,
            Command::Tell,
        ]),
        (-OVERRIDE_MAX..=OVERRIDE_MAX).prop_map(Command::FeedOverride),
        Just(Command::Reverse),
        Just(Command::Forward),
        (0.0..=OVERRIDE_MAX).prop_map(Command::RapidOverride),
        (0.0..=1.0).prop_map(Command::JogOverride),
        (0.0..=2.0).prop_map(Command::SpindleOverride),
        any::<bool>().prop_map(Command::SingleBlock),
        (0..9_u32, finite()).prop_map(|(joint, position)| Command::SetPosition { joint, position }),
        (0..=ALL_JOINTS).prop_map(Command::Home),
        (0..=ALL_JOINTS).prop_map(Command::Unhome),
        (any::<u64>(), any::<u64>(), any::<u64>(), any::<bool>()).prop_map(
            |(boot_id, epoch, sequence, done)| Command::Acknowledge {
                event: EventId {
                    boot_id,
                    epoch,
                    sequence,
                },
                done,
            }
        ),
    ]
}
