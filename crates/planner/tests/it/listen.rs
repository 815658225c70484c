//! The listening planner and its clients.

#![allow(
    clippy::unwrap_used,
    reason = "test code, which clippy does not see as such"
)]

use crate::support;

use std::cell::{Cell, RefCell};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::support::attended;
use crate::support::interpolator::Interpolator;
use crate::support::items::{Listed, PERIOD_NS, point, records, settings, staircase};
use glidepath_gcode::ReadingWatch;
use glidepath_geometry::AxisVector;
use glidepath_link::{
    Client, EndOfEpoch, InProcess, SegmentRefusal, SegmentReply, SegmentRequest, SetpointFrame,
    StreamItem, Transport,
};
use glidepath_planner::{
    CLIENT_SILENCE, Control, FeedError, Feeding, ItemSource, Listening, Pace, Refusal, RunError,
    SoftLimits, Supply, feed, listen,
};
use glidepath_program::{Item, ItemKind};

fn listening() -> Listening {
    Listening {
        joints: None,
        settings: settings(),
        pace: Pace {
            period_ns: PERIOD_NS,
            horizon_frames: 50,
        },
        limits: Some(SoftLimits {
            low: AxisVector::repeat(-100.0),
            high: AxisVector::repeat(100.0),
        }),
    }
}

/// A client that sends its requests one after the other, then repeats the last one as long as it lives.
struct Scripted {
    port: Box<dyn Client<SegmentRequest, SegmentReply>>,
    requests: Vec<SegmentRequest>,
    sent: usize,
    replies: Vec<SegmentReply>,
    /// Takes a planner that is not ready for an answer.
    impatient: bool,
    lives: Cell<bool>,
}

impl Scripted {
    fn new(transport: &InProcess, session: u64, script: &[StreamItem]) -> Self {
        let requests = (0..).zip(script);
        let requests = requests
            .map(|(i, item)| SegmentRequest::new(session, i, item))
            .collect();
        let port = transport.segment_client().unwrap();
        Self {
            port,
            requests,
            sent: 0,
            replies: Vec::new(),
            impatient: false,
            lives: Cell::new(true),
        }
    }

    fn go_on(&mut self) {
        let is_said = self.sent == self.requests.len() && self.replies.len() == self.sent;
        if let Some(last) = self.requests.last().filter(|_| is_said && self.lives.get()) {
            // What is answered to that was answered before.
            while let Some(_again) = self.port.reply().unwrap() {}
            self.port.ask(last).unwrap();
            return;
        }
        while let Some(reply) = self.port.reply().unwrap() {
            let not_ready = reply.number == 0 && reply.refusal == SegmentRefusal::Stopped.code();
            if not_ready && !self.impatient {
                self.sent = 0;
            } else {
                self.replies.push(reply);
            }
        }
        if self.replies.len() == self.sent
            && let Some(request) = self.requests.get(self.sent)
        {
            self.port.ask(request).unwrap();
            self.sent += 1;
        }
    }

    fn refusals(&self) -> Vec<SegmentRefusal> {
        self.replies
            .iter()
            .filter_map(|reply| reply.outcome().unwrap().err())
            .collect()
    }
}

/// Of a client that does not say when it asked.
const OPEN: StreamItem = StreamItem::Open { asked_ns: 0 };

fn script(items: &[Item], end: bool) -> Vec<StreamItem> {
    let mut script = vec![OPEN];
    script.extend(items.iter().copied().map(StreamItem::Item));
    script.extend(end.then_some(StreamItem::End));
    script
}

/// Runs a listening planner with clients until `done`.
fn listen_to(
    transport: &InProcess,
    clients: &mut [Scripted],
    done: impl Fn(&Interpolator, &[Scripted]) -> bool,
) -> (Interpolator, Vec<String>) {
    let interpolator = RefCell::new(Interpolator::new(transport, 128));
    let stop = AtomicBool::new(false);
    let (result, notices) = attended(
        &stop,
        |time| {
            let mut interpolator = interpolator.borrow_mut();
            interpolator.pass(time);
            for client in clients.iter_mut() {
                client.go_on();
            }
            stop.store(done(&interpolator, clients), Ordering::Relaxed);
        },
        |control| listen(transport, &listening(), control),
    );
    assert!(matches!(result, Err(RunError::Interrupted)), "{result:?}");
    (interpolator.into_inner(), notices)
}

#[test]
fn a_stream_gives_the_frames_of_the_same_program() {
    let transport = InProcess::default();
    let items = staircase(12);
    let mut clients = [Scripted::new(&transport, 1, &script(&items, true))];
    let (interpolator, notices) = listen_to(&transport, &mut clients, |i, _| {
        i.end() == EndOfEpoch::Completed
    });
    assert_eq!(clients[0].refusals(), []);
    assert!(
        interpolator.executed == records(&items, 1),
        "other frames than planned"
    );
    assert_eq!(notices[..2], ["Listening", "StreamOpened { session: 1 }"]);
}

#[test]
fn a_client_that_dies_leaves_the_machine_at_the_last_accepted_segment() {
    let transport = InProcess::default();
    let items = staircase(12);
    let mut clients = [Scripted::new(&transport, 1, &script(&items[..7], false))];
    let (interpolator, notices) = listen_to(&transport, &mut clients, |i, clients| {
        clients[0].lives.set(i.executed.is_empty());
        i.end() == EndOfEpoch::Completed
    });
    // Where nothing more comes the motion rests, as behind an exact stop.
    let mut known = items[..7].to_vec();
    known.push(Item {
        block: items[6].block,
        line: items[6].line,
        kind: ItemKind::Dwell(0.0),
    });
    let mut planned = records(&known, 1);
    // The rest is no block of the stream, and belongs to the last one.
    for frame in planned.iter_mut().filter(|frame| frame.block == 8) {
        frame.block = 7;
    }
    assert!(planned.iter().all(|frame| frame.block <= 7));
    assert!(
        interpolator.executed == planned,
        "other frames than planned"
    );
    assert_eq!(interpolator.position, point(20.0, 15.0));
    assert_eq!(notices.len(), 3, "{notices:?}");
}

/// Its planner may have hung meanwhile.
#[test]
fn a_client_that_is_silent_when_the_first_frame_is_ready_moves_nothing() {
    let transport = InProcess::default();
    let mut clients = [Scripted::new(&transport, 1, &script(&staircase(1), false))];
    clients[0].lives.set(false);
    let looks = Cell::new(0);
    let (interpolator, notices) = listen_to(&transport, &mut clients, |_, _| {
        looks.set(looks.get() + 1);
        looks.get() > 20_000
    });
    assert_eq!(clients[0].refusals(), []);
    assert!(
        interpolator.executed.is_empty(),
        "it moves: {} frames, {notices:?}",
        interpolator.executed.len()
    );
    assert_eq!(notices.len(), 4, "{notices:?}");
    assert!(
        notices[2].contains("fell silent before anything moved"),
        "{notices:?}"
    );
}

#[test]
fn a_second_client_is_refused_while_the_first_is_served() {
    let transport = InProcess::default();
    let items = staircase(12);
    let mut clients = [
        Scripted::new(&transport, 1, &script(&items, true)),
        Scripted::new(&transport, 2, &[OPEN, StreamItem::End]),
    ];
    let (interpolator, _) = listen_to(&transport, &mut clients, |i, _| {
        i.end() == EndOfEpoch::Completed
    });
    assert_eq!(clients[0].refusals(), []);
    assert_eq!(clients[1].refusals(), [SegmentRefusal::Busy; 2]);
    assert!(interpolator.executed == records(&items, 1));
}

#[test]
fn the_next_stream_starts_where_the_last_one_ended() {
    let transport = InProcess::default();
    let there = staircase(2);
    let back = support::items::polyline(&[point(5.0, 5.0), point(0.0, 0.0)]);
    let mut clients = [
        Scripted::new(&transport, 1, &script(&there, true)),
        Scripted::new(&transport, 2, &[]),
    ];
    let executed = records(&there, 1).len();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let stop = AtomicBool::new(false);
    let (_, notices) = attended(
        &stop,
        |time| {
            let mut interpolator = interpolator.borrow_mut();
            interpolator.pass(time);
            clients[0].go_on();
            if interpolator.executed.len() == executed && clients[1].requests.is_empty() {
                clients[1] = Scripted::new(&transport, 2, &script(&back, true));
            }
            clients[1].go_on();
            // A client that comes too early, before the planner has seen the end, is refused.
            if clients[1].refusals().contains(&SegmentRefusal::Busy) {
                clients[1] = Scripted::new(&transport, 2, &script(&back, true));
            }
            let returned = interpolator.executed.len() > executed;
            stop.store(
                returned && interpolator.end() == EndOfEpoch::Completed,
                Ordering::Relaxed,
            );
        },
        |control| listen(&transport, &listening(), control),
    );
    assert_eq!(
        interpolator.into_inner().position,
        point(0.0, 0.0),
        "{notices:?}"
    );
}

#[test]
fn an_unready_machine_opens_no_stream() {
    let transport = InProcess::default();
    let mut clients = [Scripted::new(&transport, 1, &[OPEN])];
    clients[0].impatient = true;
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    interpolator
        .borrow_mut()
        .fail(glidepath_link::FaultCause::Output);
    let stop = AtomicBool::new(false);
    let (result, _) = attended(
        &stop,
        |time| {
            interpolator.borrow_mut().pass(time);
            clients[0].go_on();
            stop.store(!clients[0].replies.is_empty(), Ordering::Relaxed);
        },
        |control| listen(&transport, &listening(), control),
    );
    assert!(matches!(result, Err(RunError::Interrupted)), "{result:?}");
    assert_eq!(clients[0].refusals(), [SegmentRefusal::Stopped]);
}

type FedResult = Result<glidepath_planner::Fed, FeedError>;

/// Feeds a source to a listening planner in another thread, both at the speed of the clock.
fn fed(source: &Listed) -> (FedResult, Vec<SetpointFrame>) {
    let goes_on = AtomicBool::new(false);
    fed_until(&goes_on, &mut || {}, &|_| source.clone())
}

/// The same with a source that knows when its reading is to end, until the flag is set.
fn fed_until<S: ItemSource>(
    client_stop: &AtomicBool,
    abort: &mut dyn FnMut(),
    make_source: &(dyn Fn(ReadingWatch) -> S + Sync),
) -> (FedResult, Vec<SetpointFrame>) {
    let transport = InProcess::default();
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let planner = scope.spawn(|| {
            let transport = transport.clone();
            let mut interpolator = Interpolator::new(&transport, 128);
            let mut pause = |time| {
                std::thread::sleep(time);
                interpolator.pass(time);
            };
            let mut control = Control {
                stop: &stop,
                pause: &mut pause,
                notify: &mut |_| {},
            };
            let result = listen(&transport, &listening(), &mut control);
            assert!(matches!(result, Err(RunError::Interrupted)), "{result:?}");
            interpolator.executed
        });
        let mut control = Control {
            stop: client_stop,
            pause: &mut std::thread::sleep,
            notify: &mut |_| {},
        };
        let result = loop {
            let mut feeding = Feeding { asked_ns: 0, abort };
            let make_source = |_, watch| Ok(make_source(watch));
            match feed(&transport, &mut feeding, make_source, &mut control) {
                // The planner's thread has not opened its port yet, or not seen the machine.
                Err(FeedError::Link(glidepath_link::LinkError::NoServer { .. })) => {}
                Err(FeedError::RefusedByPlanner {
                    refusal: SegmentRefusal::Stopped,
                    ..
                }) => {}
                other => break other,
            }
            std::thread::sleep(Duration::from_millis(20));
        };
        stop.store(true, Ordering::Relaxed);
        (result, planner.join().unwrap())
    })
}

/// A program whose last loop goes on and on.
struct Turning {
    items: Listed,
    watch: ReadingWatch,
}

impl ItemSource for Turning {
    fn next_item(&mut self) -> Supply {
        let supply = self.items.next_item();
        while matches!(supply, Supply::End) && !self.watch.is_to_end() {
            std::thread::sleep(Duration::from_millis(1));
        }
        supply
    }

    fn lines_read(&self) -> u64 {
        self.items.lines_read()
    }
}

#[test]
fn the_bundled_client_lives_and_is_ended_however_long_its_program_gives_nothing() {
    let items = staircase(3);
    let stop = AtomicBool::new(false);
    let mut aborts = 0;
    let (result, executed) = std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(CLIENT_SILENCE + Duration::from_millis(500));
            stop.store(true, Ordering::Relaxed);
        });
        fed_until(&stop, &mut || aborts += 1, &|watch| Turning {
            items: Listed::new(&items),
            watch,
        })
    });
    // Nobody obeys the abort here.
    assert!(matches!(result, Err(FeedError::NotEnded)), "{result:?}");
    assert!(aborts > 0);
    let position = executed.last().map(|frame| frame.position[0]);
    assert_eq!(position, Some(10.0), "what has come is done");
}

#[test]
fn the_bundled_client_streams_a_program_whole() {
    let items = staircase(6);
    let (result, executed) = fed(&Listed::new(&items));
    assert_eq!(result.unwrap().items, 6);
    assert!(executed == records(&items, 1), "other frames than planned");
}

#[test]
fn the_bundled_client_reports_what_the_planner_refuses() {
    let mut items = staircase(3);
    items.extend(support::items::polyline(&[
        point(10.0, 5.0),
        point(101.0, 5.0),
    ]));
    let (result, executed) = fed(&Listed::new(&items));
    match result {
        Err(FeedError::RefusedByPlanner {
            refusal: SegmentRefusal::SoftLimit,
            line: 1,
            ..
        }) => {}
        other => panic!("{other:?}"),
    }
    assert!(executed.is_empty() || executed[..] == records(&items[..3], 1)[..executed.len()]);
}

#[test]
fn a_source_that_fails_midway_is_streamed_up_to_there() {
    let items = staircase(3);
    let mut source = Listed::new(&items);
    source.fails = true;
    let (result, executed) = fed(&source);
    assert!(
        matches!(result, Err(FeedError::Refused(Refusal::Read(_)))),
        "{result:?}"
    );
    assert!(executed == records(&items, 1), "other frames than planned");
}
