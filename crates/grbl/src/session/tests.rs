//! A session with a machine and a service that are not there.

use super::*;
use crate::{AXES, End, JobIntent, Refused, Stage};
use std::collections::VecDeque;

mod leaving;
mod numbers;
mod questions;
mod resets;

/// A machine that moves by hand in no time, and a service that reads a line at each look.
struct Desk {
    session: Session,
    machine: MachineView,
    now: Duration,
    job: u64,
    lines: VecDeque<String>,
    taken: u64,
    read: u64,
    facts: Facts,
    /// How often modes and offsets were reset.
    resets: u32,
    /// Lines that were executed.
    executed: Vec<String>,
    acts: Vec<Act>,
    /// The machine does not answer what is asked of it.
    is_silent: bool,
    /// The service reads nothing.
    is_full: bool,
    /// How often it looks with nothing to read before a job ends.
    idle: u32,
    over: Option<End>,
    refused: Option<Refused>,
    ahead_t: f64,
}

impl Desk {
    fn new() -> Self {
        let mut desk = Self {
            session: Session::new(MachineSettings {
                has_homing: true,
                ..MachineSettings::default()
            }),
            machine: MachineView {
                doing: Doing::Idle,
                ..MachineView::default()
            },
            now: Duration::ZERO,
            job: 0,
            lines: VecDeque::new(),
            taken: 0,
            read: 0,
            facts: Facts::default(),
            resets: 0,
            executed: Vec::new(),
            acts: Vec::new(),
            is_silent: false,
            is_full: false,
            idle: 0,
            over: None,
            refused: None,
            ahead_t: 0.0,
        };
        desk.look();
        desk.session.connected(desk.now);
        desk.said();
        desk
    }

    fn said(&mut self) -> Vec<String> {
        let out = String::from_utf8(self.session.take_output()).unwrap();
        out.lines().map(str::to_owned).collect()
    }

    fn look(&mut self) {
        self.now += Duration::from_millis(5);
        self.session.see(&self.machine, self.now);
        self.serve();
        for act in self.session.take_acts() {
            match &act {
                Act::Jog { by, .. } => {
                    self.machine.doing = Doing::Jogging;
                    for (place, by) in self.machine.position.iter_mut().zip(by) {
                        *place += by;
                    }
                }
                Act::LetGo => self.machine.doing = Doing::Idle,
                Act::Judge(line) => {
                    let refused = line
                        .contains("G999")
                        .then(|| refusal("unknown-g-code", false));
                    self.session.judged(refused.as_ref());
                }
                Act::Abort => {
                    self.over = Some(End::Failed("aborted".to_owned()));
                    self.machine.doing = match self.machine.doing {
                        Doing::Homing | Doing::NotHomed => Doing::NotHomed,
                        _ => Doing::Idle,
                    };
                }
                Act::Hold => self.machine.doing = Doing::Held,
                Act::Resume => self.machine.doing = Doing::Running,
                _ => {}
            }
            if !self.is_silent {
                self.session.accepted(&act);
            }
            self.acts.push(act);
        }
    }

    fn serve(&mut self) {
        let request = self.session.request();
        if request.wish == JobIntent::Reset {
            self.resets += 1;
            self.facts = Facts::default();
            let told = self.told(request.job, Stage::Over(End::Done));
            self.session.told(&told, self.now);
            return;
        }
        if request.job > self.job {
            (self.job, self.taken, self.read, self.idle) = (request.job, 0, 0, 0);
            (self.over, self.refused) = (None, None);
            self.lines.clear();
        }
        if request.job == self.job && self.job > 0 && self.over.is_none() {
            for (number, line) in (request.first..).zip(&request.lines) {
                if number == self.taken + 1 {
                    self.lines.push_back(line.clone());
                    self.taken += 1;
                }
            }
            if request.wish == JobIntent::Cancel {
                self.over = Some(End::Failed("ended by its client".to_owned()));
            } else if self.refused.is_none() && !self.is_full && request.wish != JobIntent::Close {
                self.read_a_line();
            } else if request.wish == JobIntent::Close {
                self.over = Some(End::Done);
            }
        }
        let stage = match (&self.over, request.job) {
            (_, 0) => Stage::Unknown,
            (Some(end), _) => Stage::Over(end.clone()),
            (None, _) => Stage::Open,
        };
        let told = self.told(request.job, stage);
        self.session.told(&told, self.now);
    }

    fn told(&self, job: u64, stage: Stage) -> Told {
        Told {
            job,
            stage,
            taken: self.taken,
            read: self.read,
            refused: self.refused.clone(),
            ahead_t: self.ahead_t,
            facts: self.facts.clone(),
        }
    }

    fn read_a_line(&mut self) {
        let Some(line) = self.lines.pop_front() else {
            self.idle += 1;
            if self.idle > 20 {
                self.over = Some(End::Done);
            }
            return;
        };
        self.idle = 0;
        if line.contains("G999") {
            let is_moving = self.machine.doing == Doing::Running;
            self.refused = Some(refusal("unknown-g-code", is_moving));
            return;
        }
        self.read += 1;
        if line == "M30" {
            self.over = Some(End::ProgramEnd);
        }
        self.executed.push(line);
    }

    fn looks(&mut self, count: u32) {
        for _ in 0..count {
            self.look();
        }
    }

    fn says(&mut self, bytes: &[u8]) -> Vec<String> {
        self.session.hear(bytes, self.now);
        self.looks(40);
        self.said()
    }

    fn state(&mut self) -> String {
        self.session.hear(b"?", self.now);
        let said = self.said();
        let report = said.iter().find(|line| line.starts_with('<')).unwrap();
        report[1..].split('|').next().unwrap().to_owned()
    }
}

fn refusal(name: &str, is_in_motion: bool) -> Refused {
    Refused {
        column: 3,
        name: name.to_owned(),
        text: "no such code".to_owned(),
        is_in_motion,
    }
}

fn answers(said: &[String]) -> Vec<&str> {
    let is_answer = |line: &&str| *line == "ok" || line.starts_with("error:");
    said.iter().map(String::as_str).filter(is_answer).collect()
}

#[test]
fn every_line_has_one_answer_in_its_order() {
    let mut desk = Desk::new();
    let said = desk.says(b"G21\r\n$G\n\n(comment)\nG0 X1\nG999\n$Q\n%\nG1 X2\n");
    assert_eq!(
        answers(&said),
        [
            "ok", "ok", "ok", "ok", "ok", "error:20", "error:3", "ok", "ok"
        ],
        "{said:?}"
    );
    assert_eq!(desk.executed, ["G21", "G0 X1", "G1 X2"]);
    let error = said.iter().position(|line| line == "error:20").unwrap();
    assert_eq!(said[error - 1], "[MSG:column 3: no such code]");
}

#[test]
fn a_thousand_lines_by_character_counting_are_answered_and_executed_in_order() {
    let mut desk = Desk::new();
    let lines: Vec<String> = (0..1000).map(|n| format!("G1 X{n} F1000")).collect();
    let (mut sent, mut out, mut answered) = (0, VecDeque::new(), 0);
    while answered < lines.len() {
        while sent < lines.len() && out.iter().sum::<usize>() + lines[sent].len() < 128 {
            desk.session
                .hear(format!("{}\n", lines[sent]).as_bytes(), desk.now);
            out.push_back(lines[sent].len() + 1);
            sent += 1;
        }
        desk.is_full = answered % 7 == 3 && !desk.now.as_millis().is_multiple_of(50);
        desk.look();
        let said = desk.said();
        for answer in answers(&said) {
            assert_eq!(answer, "ok");
            assert!(out.pop_front().is_some());
            answered += 1;
        }
    }
    assert_eq!(desk.executed, lines);
}

#[test]
fn a_line_refused_in_motion_holds_what_is_behind_it_until_somebody_goes_on() {
    let mut desk = Desk::new();
    desk.machine.doing = Doing::Running;
    let said = desk.says(b"G1 X1 F1\nG999\nG1 X2\n");
    assert_eq!(answers(&said), ["ok", "error:20"]);
    assert_eq!(desk.executed, ["G1 X1 F1"]);
    assert_eq!(desk.state(), "Hold:1");
    desk.machine.doing = Doing::Idle;
    desk.looks(3);
    assert_eq!(desk.state(), "Hold:0");
    assert_eq!(answers(&desk.says(b"")), [""; 0]);
    assert_eq!(answers(&desk.says(b"~")), ["ok"]);
    assert_eq!(desk.executed, ["G1 X1 F1", "G1 X2"]);
}

#[test]
fn a_machine_that_is_about_to_move_is_not_idle() {
    let mut desk = Desk::new();
    desk.ahead_t = 0.5;
    desk.session.hear(b"G0 X1\n", desk.now);
    desk.machine.doing = Doing::Waiting;
    desk.looks(5);
    assert_eq!(answers(&desk.said()), ["ok"]);
    assert_eq!(desk.state(), "Run");
    desk.ahead_t = 0.0;
    desk.looks(2);
    assert_eq!(desk.state(), "Idle");
}

#[test]
fn the_end_of_a_program_is_told_and_what_follows_is_executed() {
    let mut desk = Desk::new();
    desk.says(b"\x91");
    let said = desk.says(b"G0 X1\nM30\nG4 P0.5\n");
    assert_eq!(answers(&said), ["ok", "ok", "ok"]);
    assert!(said.contains(&"[MSG:Pgm End]".to_owned()));
    assert_eq!(desk.executed, ["G0 X1", "M30", "G4 P0.5"]);
    assert!(desk.acts.contains(&Act::FeedOverride(1.0)));
}

#[test]
fn an_axis_that_stands_outside_jogs_inwards() {
    let mut desk = Desk::new();
    desk.machine.position[0] = desk.session.settings.most(0) + 3.0;
    desk.looks(1);
    let said = desk.says(b"$J=G91 X1 F600\n$J=G91 X-1 F600\n");
    assert_eq!(answers(&said), ["error:15", "ok"]);
}

#[test]
fn jogs_are_queued_bounded_by_travel_and_ended() {
    let mut desk = Desk::new();
    let said = desk.says(b"$J=G91 X5 F600\n$J=G91 X5 F600\n$J=X99999 F1\n");
    assert_eq!(answers(&said), ["ok", "ok", "error:15"]);
    assert!((desk.machine.position[0] - 10.0).abs() < 1e-9);
    assert_eq!(desk.state(), "Jog");
    assert_eq!(answers(&desk.says(b"G0 X1\n")), ["error:9"]);
    desk.says(b"\x85");
    assert_eq!(desk.state(), "Idle");
    desk.acts.clear();
    // Three and their end in one write: nothing moves.
    let said = desk.says(b"$J=G91 X5 F600\n$J=G91 X5 F600\n$J=G91 X5 F600\n\x85");
    assert_eq!(answers(&said), ["ok", "ok", "ok"]);
    assert!((desk.machine.position[0] - 10.0).abs() < 1e-9);
    // A sender that asked for reports, and is silent.
    for _ in 0..4 {
        desk.says(b"?");
    }
    desk.session.hear(b"$J=G91 X100 F600\n", desk.now);
    desk.looks(10);
    assert_eq!(desk.machine.doing, Doing::Jogging);
    desk.looks(250);
    assert_eq!(desk.machine.doing, Doing::Idle);
}

#[test]
fn a_locked_machine_executes_nothing_until_it_is_unlocked() {
    let mut desk = Desk::new();
    desk.machine.doing = Doing::Faulted;
    desk.machine.fault = Some((Alarm::HardLimit, "limit switch of X".to_owned()));
    desk.look();
    let said = desk.said();
    assert_eq!(said, ["ALARM:1", "[MSG:limit switch of X]"]);
    assert_eq!(
        answers(&desk.says(b"G0 X1\n$#\n$J=X1 F1\n")),
        ["error:9", "ok", "error:8"]
    );
    desk.says(b"$X\n");
    assert_eq!(desk.acts, [Act::Reset, Act::Enable]);
    desk.machine.doing = Doing::Idle;
    desk.looks(2);
    assert_eq!(answers(&desk.said()), ["ok"]);
    assert_eq!(answers(&desk.says(b"G0 X1\n")), ["ok"]);
}

#[test]
fn a_job_that_somebody_else_ends_locks_the_machine() {
    let mut desk = Desk::new();
    desk.says(b"G1 X1 F1\n");
    desk.is_full = true;
    desk.says(b"G1 X2\nG1 X3\n");
    desk.over = Some(End::Failed("aborted at the interpolator".to_owned()));
    desk.looks(3);
    let said = desk.said();
    assert!(said.contains(&"ALARM:3".to_owned()), "{said:?}");
    assert_eq!(answers(&said), ["error:9", "error:9"]);
    assert_eq!(desk.executed, ["G1 X1 F1"]);
}

#[test]
fn checking_moves_nothing() {
    let mut desk = Desk::new();
    let said = desk.says(b"$C\nG0 X5\nG999\n");
    assert_eq!(answers(&said), ["ok", "ok", "error:20"]);
    assert_eq!(desk.state(), "Check");
    let said = desk.says(b"$C\n");
    assert!(said.iter().any(|line| line.starts_with("Grbl")));
    assert!(desk.executed.is_empty());
}

#[test]
fn a_sender_changes_no_setting_of_the_machine() {
    let mut desk = Desk::new();
    for line in ["$130=12", "$RST=*", "$N0=G20", "$I=x"] {
        let said = desk.says(format!("{line}\n").as_bytes());
        assert_eq!(answers(&said), ["error:3"], "{line}");
    }
    assert_eq!(answers(&desk.says(b"$13=1\n$10=0\n")), ["ok", "ok"]);
    desk.session.hear(b"?", desk.now);
    assert!(desk.said()[0].starts_with("<Idle|WPos:0.0000,"));
}

#[test]
fn homing_is_answered_at_its_end() {
    let mut desk = Desk::new();
    desk.machine.doing = Doing::NotHomed;
    desk.look();
    assert_eq!(desk.state(), "Alarm");
    assert_eq!(answers(&desk.says(b"$H\n")), [""; 0]);
    assert_eq!(desk.acts, [Act::Home(None)]);
    desk.machine.doing = Doing::Homing;
    desk.looks(3);
    assert_eq!(desk.state(), "Home");
    desk.machine.doing = Doing::Idle;
    desk.looks(3);
    assert_eq!(answers(&desk.said()), ["ok"]);
}

#[test]
fn a_hold_ends_a_search_for_home_and_its_line_is_answered() {
    for stop in [&b"!"[..], b"\x84"] {
        let mut desk = Desk::new();
        desk.machine.doing = Doing::NotHomed;
        desk.look();
        desk.says(b"$H\n");
        desk.machine.doing = Doing::Homing;
        desk.looks(3);
        desk.acts.clear();
        let said = desk.says(stop);
        assert!(said.iter().any(|line| line.contains("cannot be held")));
        assert_eq!(desk.acts, [Act::Abort]);
        assert!(said.contains(&"ALARM:6".to_owned()), "{said:?}");
        assert_eq!(answers(&said), ["error:9"]);
    }
}

#[test]
fn a_stop_right_behind_the_order_of_a_search_for_home_is_obeyed() {
    for stop in [&b"$H\n!"[..], b"$H\n\x18"] {
        let mut desk = Desk::new();
        desk.machine.doing = Doing::NotHomed;
        desk.look();
        desk.acts.clear();
        desk.says(stop);
        assert_eq!(desk.acts, [Act::Abort], "it has not begun");
    }
    // The order is on its way already.
    for stop in [&b"!"[..], b"\x18"] {
        let mut desk = Desk::new();
        desk.machine.doing = Doing::NotHomed;
        desk.look();
        desk.says(b"$H\n");
        desk.acts.clear();
        desk.says(stop);
        assert_eq!(desk.acts, [Act::Abort]);
    }
}

#[test]
fn whatever_is_sent_memory_is_bounded() {
    let mut desk = Desk::new();
    desk.is_full = true;
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    for _ in 0..2_000 {
        let bytes: Vec<u8> = (0..100)
            .map(|_| {
                state ^= state << 13;
                state ^= state >> 7;
                state ^= state << 17;
                state.to_le_bytes()[3]
            })
            .collect();
        if desk.session.wants_bytes() {
            desk.session.hear(&bytes, desk.now);
        }
        desk.look();
        assert!(desk.session.kept_bytes() < MOST_KEPT + 300);
        if !desk.session.wants_bytes() {
            desk.said();
        }
    }
    assert!(
        desk.machine
            .position
            .iter()
            .zip([500.0; AXES])
            .all(|(at, most)| at.abs() <= most)
    );
}
