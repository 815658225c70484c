//! Tests of the lines of a sender, without a machine: what is read, when it counts as read, and
//! what is in force.

use std::time::Duration;

use glidepath_gcode::{Connections, Options, Program};
use glidepath_link::{LinesReply, LinesRequest, LinesState, LinesWish, LongText, Text};
use glidepath_program::{Item, ItemKind};

use super::facts::{Found, LineFacts};
use super::followed::Followed;
use super::inbox::{LineInbox, LinesEnd};
use super::source::SentLines;
use crate::source::item_source::{ItemSource as _, Supply};
use crate::source::run_channels::RunChannels;

fn request(first: u64, text: &str) -> LinesRequest {
    LinesRequest {
        client: 7,
        number: 1,
        asked_ns: 0,
        first,
        ahead_t: 3.0,
        wish: LinesWish::Execute.code(),
        reserved: 0,
        name: Text::default(),
        text: LongText::new(text),
    }
}

struct Desk {
    inbox: LineInbox,
    source: SentLines,
}

impl Desk {
    fn new() -> Self {
        Self::with_system(0.0)
    }

    /// On a machine whose G55 has its zero at this X.
    fn with_system(x: f64) -> Self {
        let inbox = LineInbox::new(LineFacts::default(), Found::default());
        let mut options = Options {
            connections: Connections::Simulated,
            ..Options::default()
        };
        options.offsets.systems[1].origin[0] = x;
        let source = SentLines::new(inbox.clone(), options, RunChannels::default());
        Self { inbox, source }
    }

    fn reply(&self) -> LinesReply {
        self.inbox.reply(&request(1, ""))
    }

    /// All that can be had now.
    fn items(&mut self) -> Vec<Item> {
        let mut items = Vec::new();
        while let Supply::Item(item) = self.source.next_item() {
            items.push(item);
        }
        items
    }

    fn executed(&self, block: u32) {
        self.inbox.follow(&Followed {
            ahead_t: 0.0,
            rests: true,
            block,
        });
    }
}

#[test]
fn lines_are_taken_once_and_read_in_their_order() {
    let mut desk = Desk::new();
    desk.inbox.take(&request(1, "G21 G90 F600\nG1 X1\n"));
    desk.inbox.take(&request(1, "G21 G90 F600\nG1 X1\nX2\n"));
    // One that is missing is waited for.
    desk.inbox.take(&request(5, "X9\n"));
    assert_eq!(desk.items().len(), 2);
    let reply = desk.reply();
    assert_eq!((reply.taken, reply.read), (3, 3));
    assert_eq!(reply.state(), Ok(LinesState::Open));
    assert_eq!(
        reply.words.as_str(),
        "G1 G54 G17 G21 G90 G94 M5 M9 T0 F600 S0"
    );
}

#[test]
fn items_are_those_of_the_same_lines_in_a_file() {
    let text = "G21 G90 G64 F3000\nG1 X10\n(a comment)\nG2 X20 I5\nG91\nG1 X1 Y1\nG90 G0 X0 Y0\nM3 S100\nG4 P1\nX5\n";
    let file = Program::new(text.as_bytes(), Options::default());
    let whole: Vec<ItemKind> = file.map(|item| item.unwrap().kind).collect();
    let mut desk = Desk::new();
    let mut sent = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        desk.inbox.take(&request(number, &format!("{line}\n")));
        sent.extend(desk.items().into_iter().map(|item| item.kind));
        desk.executed(u32::try_from(sent.len()).unwrap());
        assert_eq!(desk.items(), []);
        assert_eq!(desk.reply().read, number, "{line}");
    }
    assert_eq!(sent, whole);
}

#[test]
fn what_ends_at_rest_counts_when_it_is_executed() {
    let mut desk = Desk::new();
    desk.inbox.take(&request(1, "G4 P1\nG0 X1\nM0\nG0 X2\n"));
    assert_eq!(desk.items().len(), 1);
    assert_eq!((desk.reply().taken, desk.reply().read), (4, 0));
    desk.executed(1);
    assert_eq!(desk.items().len(), 2, "the move and the stop");
    assert_eq!(desk.reply().read, 2);
    desk.executed(3);
    assert_eq!(desk.items().len(), 1);
    assert_eq!(desk.reply().read, 4);
}

#[test]
fn what_was_read_is_told_to_be_ahead_until_it_is_executed() {
    let mut desk = Desk::new();
    assert!(desk.reply().ahead_t <= 0.0);
    desk.inbox.take(&request(1, "G0 X1\n"));
    assert_eq!(desk.items().len(), 1);
    assert_eq!(desk.reply().read, 1);
    assert!(desk.reply().ahead_t > 0.0, "nothing is planned yet");
    desk.executed(1);
    assert!(desk.reply().ahead_t <= 0.0);
}

#[test]
fn lines_wait_while_enough_is_planned() {
    let mut desk = Desk::new();
    desk.inbox.follow(&Followed {
        ahead_t: 3.0,
        rests: false,
        block: 0,
    });
    desk.inbox.take(&request(1, "G0 X1\n"));
    assert_eq!(desk.items().len(), 0);
    assert!(!desk.source.is_silent());
    desk.inbox.follow(&Followed {
        ahead_t: 2.9,
        rests: false,
        block: 0,
    });
    assert_eq!(desk.items().len(), 1);
}

/// A sender whose window is full may send nothing before it is told that a line was read, and one that begins a
/// program pauses: a rest at the end of what has come would mark the part.
#[test]
fn a_program_that_begins_is_waited_for_and_a_single_move_is_not() {
    let mut desk = Desk::new();
    let pause = Duration::from_millis(50);
    desk.inbox.take(&request(1, "G91 G0 X1\n"));
    assert_eq!(desk.items().len(), 1);
    desk.inbox.age(pause);
    assert!(!desk.source.is_silent(), "nobody was told that it is read");
    desk.reply();
    assert!(!desk.source.is_silent(), "the client has just been told");
    desk.inbox.age(pause);
    assert!(desk.source.is_silent());
    desk.executed(1);
    desk.inbox.take(&request(2, "G1 X1 F600\nG1 X2\n"));
    assert_eq!(desk.items().len(), 2);
    desk.reply();
    desk.inbox.age(pause);
    assert!(!desk.source.is_silent(), "two moves are a program");
    desk.inbox.age(Duration::from_millis(260));
    assert!(desk.source.is_silent());
    // What moves is not waited for so long: it would stop by itself.
    desk.inbox.follow(&Followed {
        ahead_t: 0.1,
        rests: false,
        block: 2,
    });
    desk.inbox.age(pause);
    assert!(desk.source.is_silent());
}

#[test]
fn a_job_ends_when_nothing_more_comes_and_all_is_executed() {
    let mut desk = Desk::new();
    desk.inbox.take(&request(1, "G0 X1\n"));
    assert_eq!(desk.items().len(), 1);
    assert_eq!(desk.reply().read, 1);
    assert!(!desk.source.is_silent());
    desk.inbox.age(Duration::from_secs(1));
    assert!(desk.source.is_silent());
    assert!(matches!(desk.source.next_item(), Supply::Pending));
    desk.executed(1);
    assert!(matches!(desk.source.next_item(), Supply::End));
    // What comes now is the next job's.
    desk.inbox.take(&request(2, "G0 X2\n"));
    desk.inbox.end(LinesEnd::Done, "");
    let reply = desk.reply();
    assert_eq!((reply.state(), reply.taken), (Ok(LinesState::Done), 1));
}

#[test]
fn a_line_that_is_refused_changes_nothing_and_ends_the_job_in_front_of_it() {
    let mut desk = Desk::new();
    desk.inbox
        .take(&request(1, "G55 G91\nG0 X1\nG54 G999\nG0 X2\n"));
    assert_eq!(desk.items().len(), 1);
    assert!(matches!(desk.source.next_item(), Supply::End));
    let reply = desk.reply();
    assert_eq!(
        (reply.is_refused, reply.read, reply.refused_column),
        (1, 2, 5)
    );
    assert_eq!(reply.refused_in_motion, 1);
    assert_eq!(reply.diagnostic.as_str(), "unknown-g-code");
    assert!(reply.words.as_str().starts_with("G0 G55 G17 G21 G91"));
    let modal = desk.source.in_force();
    assert_eq!(modal.work_offsets().active, 1);
}

#[test]
fn the_end_of_a_program_counts_when_all_is_executed() {
    let mut desk = Desk::new();
    desk.inbox.take(&request(1, "G91 G0 X1\nM30\nG0 X2\n"));
    assert_eq!(desk.items().len(), 1);
    assert_eq!(desk.reply().read, 1);
    desk.inbox.end(LinesEnd::Done, "executed");
    let reply = desk.reply();
    assert_eq!((reply.state(), reply.read), (Ok(LinesState::ProgramEnd), 2));
    let words = reply.words.as_str();
    assert!(words.contains("G90"), "{words}");
}

#[test]
fn what_is_in_force_and_the_zero_are_those_of_the_block_that_is_executed() {
    let mut desk = Desk::with_system(100.0);
    let text = "G0 X1\nG55\nG0 X2\nX3\n#100=5\nX4\n";
    desk.inbox.take(&request(1, text));
    assert_eq!(desk.items().len(), 4);
    let zero = |block: u32| {
        desk.inbox.follow(&Followed {
            ahead_t: 1.0,
            rests: false,
            block,
        });
        desk.reply().zero[0]
    };
    assert!(zero(1).abs() < 1e-9 && (zero(2) - 100.0).abs() < 1e-9);
    let mut desk = Desk::with_system(100.0);
    desk.inbox.take(&request(1, text));
    assert_eq!(desk.items().len(), 4);
    let active = |block| {
        desk.inbox
            .in_force_at(block)
            .map(|it| it.work_offsets().active)
    };
    assert_eq!([active(0), active(1), active(2)], [None, Some(0), Some(1)]);
}

/// What was answered and is executed is in force, whatever ends the job then.
#[test]
fn what_is_in_force_at_rest_is_that_of_the_last_line() {
    let mut desk = Desk::with_system(100.0);
    desk.inbox.take(&request(1, "G0 X1\nG55\n"));
    assert_eq!(desk.items().len(), 1);
    let active = |desk: &Desk| desk.inbox.in_force_at(1).unwrap().work_offsets().active;
    assert_eq!(active(&desk), 0);
    desk.executed(1);
    assert_eq!(active(&desk), 1);
}

/// grbl rests, stores and answers then: a reset right behind the answer takes nothing back.
#[test]
fn a_line_that_stores_counts_as_read_when_its_job_is_over() {
    let mut desk = Desk::new();
    let lines = "G0 X1\nG10 L20 P1 X0\nG0 X2\n";
    desk.inbox.take(&request(1, lines));
    assert_eq!(desk.items().len(), 1);
    assert!(matches!(desk.source.next_item(), Supply::End));
    assert_eq!((desk.reply().taken, desk.reply().read), (3, 1));
    let stored = desk.source.in_force().work_offsets();
    assert!((stored.systems[0].origin[0] - 1.0).abs() < 1e-12);
    desk.inbox.end(LinesEnd::Done, "executed");
    let reply = desk.reply();
    assert_eq!((reply.state(), reply.read), (Ok(LinesState::Done), 2));
    // In the middle of a structure there is no end.
    let mut desk = Desk::new();
    let lines = "o1 if [1]\nG10 L20 P1 X0\nG0 X2\no1 endif\n";
    desk.inbox.take(&request(1, lines));
    assert_eq!((desk.items().len(), desk.items().len()), (0, 1));
    assert_eq!(desk.reply().read, 4);
}

#[test]
fn a_closed_job_reads_nothing_more() {
    let mut desk = Desk::new();
    desk.inbox.take(&request(1, "G0 X1\n"));
    assert_eq!(desk.items().len(), 1);
    desk.inbox.take(&request(2, "G0 X2\n"));
    desk.inbox.close();
    assert!(matches!(desk.source.next_item(), Supply::End));
    assert_eq!(desk.reply().read, 1);
}
