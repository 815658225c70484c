//! A machine with a coupler and terminals beside its drives: a whole life of it, and what is left of
//! it when a cable is pulled.
//!
//! ```text
//!  drives 0 1 2 ─── coupler 3 ─── inputs 4 ─── outputs 5 ─── analog outputs 6 ─── analog inputs 7
//! ```

use crate::life::{Day, assert_clean};
use crate::machine::{COUNTS, Case, Hands, Outcome, Setup, run};
use glidepath_emulator::{ClockKind, DriveSettings as Emulated, OutputRecord, Segment};
use glidepath_ethercat::{
    AnalogInput, AnalogOutput, At, DigitalInput, DigitalOutput, Event, Parameter, Quantity, Signal,
    TerminalSettings,
};
use glidepath_interpolator::{JointHoming, ProbeInput};
use glidepath_link::{Command, ContactKind, MachineState};
use glidepath_program::Event as Told;

pub(crate) const INPUTS: usize = 4;
pub(crate) const OUTPUTS: usize = 5;
const SPEED: usize = 6;
pub(crate) const LEVEL: usize = 7;
/// Bits of the outputs: forward, reverse, flood, output 5, and one that is on at rest.
pub(crate) const FORWARD: u8 = 1;
pub(crate) const FLOOD: u8 = 4;
pub(crate) const FIFTH: u8 = 8;
pub(crate) const LAMP: u8 = 16;
/// Where the home switch of J0 closes and the part begins, as the drives count, mm.
const EDGE: f64 = -10.0;
const PART_Z: f64 = -7.25;

const fn object(index: u16, sub: u8) -> At {
    At::Object { index, sub }
}

const fn input(index: u16) -> DigitalInput {
    DigitalInput {
        at: object(index, 1),
        number: None,
        home: None,
        limit_low: None,
        limit_high: None,
        is_inverted: false,
    }
}

const fn output(index: u16, from: Signal) -> DigitalOutput {
    DigitalOutput {
        at: object(index, 1),
        from,
        is_inverted: false,
        rest: false,
    }
}

fn terminals() -> Vec<TerminalSettings> {
    let at = |position| TerminalSettings {
        position,
        ..TerminalSettings::default()
    };
    vec![
        at(3),
        TerminalSettings {
            inputs: vec![
                DigitalInput {
                    home: Some(0),
                    ..input(0x6000)
                },
                DigitalInput {
                    number: Some(0),
                    ..input(0x6010)
                },
                // A switch that opens.
                DigitalInput {
                    limit_high: Some(1),
                    is_inverted: true,
                    ..input(0x6020)
                },
            ],
            ..at(INPUTS)
        },
        TerminalSettings {
            outputs: vec![
                output(0x7000, Signal::SpindleForward),
                output(0x7010, Signal::SpindleReverse),
                output(0x7020, Signal::Flood),
                output(0x7030, Signal::Output(5)),
                DigitalOutput {
                    rest: true,
                    ..output(0x7040, Signal::Output(6))
                },
            ],
            ..at(OUTPUTS)
        },
        TerminalSettings {
            analog_outputs: vec![AnalogOutput {
                at: object(0x7010, 1),
                from: Quantity::SpindleSpeed,
                full: 24_000.0,
                full_counts: 32_767,
                rest: 0.0,
            }],
            parameters: vec![Parameter {
                index: 0x8000,
                sub: 1,
                size: 2,
                value: 7,
            }],
            ..at(SPEED)
        },
        TerminalSettings {
            assign_inputs: Some(vec![0x1a00, 0x1a03]),
            analog_inputs: vec![AnalogInput {
                at: object(0x6010, 0x11),
                number: 2,
                scale: 10.0 / 32_768.0,
                offset: 0.0,
                is_signed: true,
            }],
            ..at(LEVEL)
        },
    ]
}

/// Three axes and the terminals; J0 is brought home by its switch.
pub(crate) fn setup() -> Setup {
    let mut setup = Setup::absolute(2_000_000);
    setup.emulated.extend([
        Emulated::terminal("COUPLER", ClockKind::Bits64),
        Emulated::inputs(4),
        Emulated::outputs(8),
        Emulated::analog_outputs(2),
        Emulated::analog_inputs(4),
    ]);
    setup.terminals = terminals();
    setup.homing = Some(JointHoming {
        search_v: -20.0,
        latch_v: 1.0,
        final_v: 50.0,
        index_input: None,
        offset: -10.5,
        home: 0.0,
        absolute: None,
        sequence: 0,
        is_shared: false,
        is_volatile: false,
        ignores_limits: false,
        search_travel: 60.0,
        clearance: 2.0,
    });
    setup.probe = Some(ProbeInput {
        number: 0,
        high: true,
        protects: false,
    });
    setup
}

/// What happens one after the other: a program, or something else.
#[derive(Debug, Clone, Copy)]
enum Part {
    /// A program is run to its end.
    Program(&'static str),
    /// It is aborted so many ticks after it began.
    Aborted(&'static str, u64),
    /// The terminals are unplugged so many ticks after it began.
    Unplugged(&'static str, u64),
    /// They are plugged in again.
    Plugged,
    /// The fault is reset.
    Reset,
    /// The interpolator dies so many ticks after it began.
    Orphaned(&'static str, u64),
    /// The bridge dies.
    Killed(&'static str, u64),
    /// Another interpolator is there.
    Adopted,
}

/// What outputs were when a part was over: digital ones, and counts of the speed.
pub(crate) type Pins = (u8, u16);

pub(crate) fn pins(segment: &Segment) -> Pins {
    let (bits, speed) = (segment.outputs(OUTPUTS), segment.outputs(SPEED));
    (bits[0], u16::from_le_bytes([speed[2], speed[3]]))
}

/// Switches on, comes home, and does one part after the other.
#[derive(Debug)]
struct Shift {
    parts: Vec<Part>,
    nth: usize,
    began: Option<u64>,
    asked: u64,
    /// For how many ticks the part is over.
    over: u32,
    /// Pins after each part, and while each ran.
    after: Vec<Pins>,
    during: Vec<Pins>,
    contact: Option<(u32, f64)>,
    unplugged_ns: Option<u64>,
    runs: bool,
}

impl Shift {
    fn new(parts: &[Part]) -> Self {
        Self {
            parts: parts.to_vec(),
            nth: 0,
            began: None,
            asked: 0,
            over: 0,
            after: Vec::new(),
            during: vec![Pins::default(); parts.len()],
            contact: None,
            unplugged_ns: None,
            runs: false,
        }
    }

    /// What stands at the inputs, by where the drives are.
    fn press(hands: &Hands<'_>, segment: &mut Segment) {
        let Some(feedback) = hands.feedback else {
            return;
        };
        segment.set_input(INPUTS, 0, feedback.position[0] <= EDGE);
        segment.set_input(INPUTS, 1, feedback.position[2] <= PART_Z);
        segment.set_input(INPUTS, 2, true);
        segment.set_input_bytes(LEVEL, 4, &(-16_384_i16).to_le_bytes());
    }

    fn is_over(&self, hands: &Hands<'_>, part: Part, since: u64) -> bool {
        let state = hands.state();
        match part {
            Part::Unplugged(..) => since > 200 && state == Some(MachineState::Faulted),
            Part::Plugged => since > 600,
            Part::Reset => since > 25 && state == Some(MachineState::Off),
            Part::Orphaned(_, ticks) | Part::Killed(_, ticks) => since > ticks + 100,
            Part::Adopted => since > 100,
            // Behind a contact nobody says how the program goes on.
            _ => since > 25 && matches!(state, Some(MachineState::Idle | MachineState::Waiting)),
        }
    }

    fn begin(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let Some(part) = self.parts.get(self.nth) else {
            hands.wants.end = true;
            return;
        };
        self.began = Some(hands.tick);
        match part {
            Part::Program(text)
            | Part::Aborted(text, _)
            | Part::Unplugged(text, _)
            | Part::Orphaned(text, _)
            | Part::Killed(text, _) => {
                hands.wants.program = Some(text);
            }
            Part::Adopted => hands.wants.interpolator = Some(true),
            Part::Reset => hands.wants.command = Some(Command::Reset),
            Part::Plugged => segment.unplug(INPUTS..LEVEL + 1, false, hands.now_ns),
        }
    }

    fn go_on(&mut self, hands: &mut Hands<'_>, segment: &mut Segment, began: u64) {
        let (part, since) = (self.parts[self.nth], hands.tick - began);
        match part {
            Part::Aborted(_, ticks) if since == ticks => {
                self.during[self.nth] = pins(segment);
                hands.wants.command = Some(Command::Abort);
            }
            Part::Unplugged(_, ticks) if since == ticks => {
                self.during[self.nth] = pins(segment);
                segment.unplug(INPUTS..LEVEL + 1, true, hands.now_ns);
                self.unplugged_ns = Some(hands.now_ns);
            }
            Part::Orphaned(_, ticks) if since == ticks => {
                self.during[self.nth] = pins(segment);
                hands.wants.interpolator = Some(false);
            }
            Part::Killed(_, ticks) if since == ticks => {
                self.during[self.nth] = pins(segment);
                hands.wants.killed = true;
                self.unplugged_ns = Some(hands.now_ns);
            }
            _ => {}
        }
        // Outputs are played later than setpoints say.
        self.over = if self.is_over(hands, part, since) {
            self.over + 1
        } else {
            0
        };
        if self.over > 5 {
            self.over = 0;
            self.after.push(pins(segment));
            self.contact = hands
                .status
                .filter(|status| status.contact_kind != 0)
                .map(|status| (status.contact_kind, status.contact[2]))
                .or(self.contact);
            (self.nth, self.began) = (self.nth + 1, None);
        }
    }
}

impl Case for Shift {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        Self::press(hands, segment);
        let rested = hands.tick.saturating_sub(self.asked) > 25;
        self.runs = hands.state() == Some(MachineState::Running);
        let command = match (hands.state(), self.began) {
            (_, Some(began)) => {
                self.go_on(hands, segment, began);
                None
            }
            (Some(MachineState::Off), None) if self.nth == 0 => Some(Command::Enable),
            (Some(MachineState::NotHomed), None) if self.nth == 0 => Some(Command::Home(1)),
            (Some(MachineState::Homing), None) | (None, None) => None,
            (Some(_), None) => {
                if rested {
                    self.begin(hands, segment);
                }
                None
            }
        };
        if rested && command.is_some() {
            self.asked = hands.tick;
            hands.wants.command = command;
        }
        let seen = (hands.state(), hands.status, hands.feedback, hands.events);
        assert!(hands.tick < 40_000, "{self:?} {seen:#?}");
    }

    fn counts(&self) -> bool {
        self.runs
    }
}

const MARKED: &str =
    "G21 G90 G64 P0.02 F6000\nM3 S6000\nM8\nM62 P5\nG1 X10\nM63 P5\nM62 P6\nG1 X0\nM2\n";
const TOUCH: &str = "G21 G90 F300\nG38.2 Z-20\n";
const LONG: &str = "G21 G90 G64 P0.02 F3000\nM3 S6000\nM8\nM62 P5\nG1 X50\nM2\n";
/// 6000 of 24 000 rev/min.
pub(crate) const QUARTER: u16 = 8192;

/// The changes of a bit of the outputs, from the first on.
fn changes(records: &[OutputRecord], bit: u8) -> Vec<(u64, bool)> {
    let mut changes: Vec<(u64, bool)> = Vec::new();
    for record in records {
        let is_on = record.outputs[0] & bit != 0;
        if changes.last().map_or(is_on, |(_, before)| *before != is_on) {
            changes.push((record.at_ns, is_on));
        }
    }
    changes
}

/// When output 5 was commanded to be on and off.
fn commanded(outcome: &Outcome) -> Vec<(u64, bool)> {
    let of = |setpoint: &glidepath_link::Setpoint| {
        let events = setpoint.events().to_vec().into_iter();
        let since_ns = setpoint.scheduled_ns;
        events.filter_map(move |record| match record.event() {
            Ok(Told::DigitalOutput { number: 5, on }) => {
                Some((since_ns + u64::from(record.offset_ns), on))
            }
            _ => None,
        })
    };
    outcome.setpoints.iter().flat_map(of).collect()
}

#[test]
fn a_whole_life_with_terminals() {
    let setup = setup();
    let mut shift = Shift::new(&[
        Part::Program(MARKED),
        Part::Program(TOUCH),
        Part::Aborted(LONG, 60),
        Part::Program(LONG),
    ]);
    let mut outcome = run(&setup, &mut shift);
    let counts = &outcome.counts;
    let bad = (counts.lost, counts.short, counts.stale, counts.missed);
    assert_eq!(bad, (0, 0, 0, 0));
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    // Home: the edge of the switch is at −10.5 of the machine, and −10 of the drive.
    let home = outcome
        .setpoints
        .iter()
        .find(|setpoint| setpoint.epoch == 1);
    let home = home.unwrap();
    let off = home.joint_position[0] - home.position[0];
    assert!((off - 0.5).abs() < 0.05, "{off}");
    // The probe touched within what it went in a tick of the case and a period of the bus.
    let (kind, z) = shift.contact.unwrap();
    assert_eq!(kind, ContactKind::Made.code());
    assert!((z - PART_Z).abs() < 5.0 * 0.008, "{z}");
    // Spindle and coolant are on after a program that does not switch them off, and off after an abort,
    // which leaves outputs of programs as they are.
    let (running, aborted) = (FORWARD | FLOOD, FIFTH | LAMP);
    assert_eq!(shift.after[0], (running | LAMP, QUARTER));
    assert_eq!(shift.during[2], (running | FIFTH | LAMP, QUARTER));
    assert_eq!(shift.after[2], (aborted, 0));
    assert_eq!(shift.after[3], (running | aborted, QUARTER));
    // M62 and M63 are in place to the period of the bus: half of it before to half of it after.
    let records = outcome.left.0.take_output_records(OUTPUTS);
    let seen = changes(&records, FIFTH);
    let meant = commanded(&outcome);
    assert!(meant.len() >= 4, "{meant:?}");
    for (at_ns, on) in &meant[..2] {
        let due_ns = at_ns + setup.bus.delay_ns;
        let near = |(seen_ns, seen_on): &&(u64, bool)| {
            seen_on == on && seen_ns.abs_diff(due_ns) <= setup.bus.period_ns / 2 + 50_000
        };
        assert!(
            seen.iter().any(|change| near(&change)),
            "{due_ns} {on}: {seen:?}"
        );
    }
    // At the end the spindle comes to rest first, then all others; before the bus is left.
    let ends = &records[records.len() - 2..];
    let last: Vec<_> = ends.iter().map(|record| record.outputs[0]).collect();
    assert_eq!(last[1], 0, "{records:?}");
    let spindle_ns = changes(&records, FORWARD).last().unwrap().0;
    let flood_ns = changes(&records, FLOOD).last().unwrap().0;
    assert!(
        spindle_ns + setup.bus.period_ns <= flood_ns + 1_000,
        "{records:?}"
    );
    assert!(!changes(&records, LAMP).last().unwrap().1);
}

#[test]
fn inputs_are_told_with_the_joints() {
    #[derive(Debug, Default)]
    struct Look {
        day: Day,
        seen: Option<(u64, u32, u32, f64)>,
    }
    impl Case for Look {
        fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
            segment.set_input(INPUTS, 0, true);
            segment.set_input(INPUTS, 1, true);
            segment.set_input(INPUTS, 2, true);
            segment.set_input_bytes(LEVEL, 4, &(-16_384_i16).to_le_bytes());
            if hands.tick > 50
                && let Some(said) = hands.feedback
            {
                let switches = (said.home_switch, said.limit_high);
                self.seen = Some((said.digital_in, switches.0, switches.1, said.analog_in[2]));
            }
            self.day.tick(hands, segment);
        }

        fn counts(&self) -> bool {
            self.day.counts()
        }
    }
    let mut setup = setup();
    (setup.homing, setup.probe) = (None, None);
    let mut look = Look::default();
    let outcome = run(&setup, &mut look);
    assert_clean(&setup, &outcome);
    // The limit switch is one that opens.
    assert_eq!(look.seen, Some((1, 1, 0, -5.0)));
}

#[test]
fn without_the_cable_behind_the_coupler_everything_comes_to_rest() {
    let setup = setup();
    let mut shift = Shift::new(&[Part::Unplugged(LONG, 60), Part::Plugged, Part::Reset]);
    let mut outcome = run(&setup, &mut shift);
    let running = FORWARD | FLOOD | FIFTH;
    assert_eq!(shift.during[0], (running, QUARTER));
    // By the terminals' own watchdogs.
    let records = outcome.left.0.take_output_records(OUTPUTS);
    let unplugged_ns = shift.unplugged_ns.unwrap();
    let fell = records.iter().find(|record| record.at_ns > unplugged_ns);
    let fell = fell.unwrap();
    let late_ns = fell.at_ns - unplugged_ns;
    assert_eq!(fell.outputs, [0]);
    assert!(
        late_ns <= setup.bus.watchdog_ns + setup.bus.period_ns,
        "{late_ns}"
    );
    // A lost terminal is told from a lost drive, and the drives come to rest on the path.
    assert!(
        outcome.events.contains(&Event::TerminalGone(INPUTS)),
        "{:?}",
        outcome.events
    );
    let is_of_drive = |event: &Event| matches!(event, Event::Gone(_) | Event::LeftOp(..));
    assert!(
        !outcome.events.iter().any(is_of_drive),
        "{:?}",
        outcome.events
    );
    assert!(!outcome.events.contains(&Event::NobodyStops));
    let status = outcome.setpoints.iter().rfind(|s| s.enable != 0).unwrap();
    assert!(status.velocity[0].abs() < 1e-9, "{status:?}");
    // The bus comes up again; outputs of programs come back when the fault is reset, and the spindle does not.
    assert!(outcome.counts.restarts > 0);
    assert_eq!(shift.after[1..], [(LAMP, 0), (FIFTH, 0)]);
}

#[test]
fn without_an_interpolator_outputs_are_at_rest_when_the_joints_are() {
    let setup = setup();
    let mut shift = Shift::new(&[Part::Orphaned(LONG, 60), Part::Adopted]);
    let mut outcome = run(&setup, &mut shift);
    assert_eq!(shift.during[0], (FORWARD | FLOOD | FIFTH, QUARTER));
    assert_eq!(shift.after[0], (LAMP, 0));
    // The spindle turned until the joints stood: until the frame that told them the last target.
    let records = outcome.left.0.take_output_records(OUTPUTS);
    let spindle_ns = changes(&records, FORWARD)[1].0;
    let moved = outcome.records[0].windows(2);
    let mut moved = moved.filter(|pair| pair[0].follows && pair[0].target != pair[1].target);
    let rests_ns = moved.next_back().unwrap()[1].at_ns;
    let led_ns = spindle_ns + setup.bus.shift_ns + 100_000;
    assert!(led_ns > rests_ns, "{led_ns} {rests_ns}");
    // Nothing is on that another interpolator did not switch on.
    assert_eq!(shift.after[1], (0, 0));
}

#[test]
fn without_a_bridge_outputs_fall_by_their_own_watchdogs() {
    let setup = setup();
    let mut shift = Shift::new(&[Part::Killed(LONG, 60)]);
    let mut outcome = run(&setup, &mut shift);
    let (records, killed_ns) = (
        outcome.left.0.take_output_records(OUTPUTS),
        shift.unplugged_ns.unwrap(),
    );
    assert_eq!(shift.during[0], (FORWARD | FLOOD | FIFTH, QUARTER));
    let fell = records.last().unwrap();
    let late_ns = fell.at_ns - killed_ns;
    assert_eq!(fell.outputs, [0]);
    assert!(
        late_ns <= setup.bus.watchdog_ns + setup.bus.period_ns,
        "{late_ns}"
    );
}

/// The drives behind the terminals are unplugged in motion.
#[derive(Debug, Default)]
struct DrivesGone {
    day: Day,
    gone: Option<u64>,
}

impl Case for DrivesGone {
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        let moves = hands.last.is_some_and(|s| s.velocity[0].abs() > 20.0);
        match self.gone {
            None if moves => {
                segment.unplug(2..4, true, hands.now_ns);
                self.gone = Some(hands.tick);
            }
            None => self.day.tick(hands, segment),
            Some(gone) => hands.wants.end = hands.tick > gone + 100,
        }
    }
}

#[test]
fn a_lost_drive_is_told_from_a_lost_terminal() {
    let mut setup = setup();
    (setup.homing, setup.probe) = (None, None);
    let drive = setup.emulated[0].clone();
    setup.emulated = vec![drive.clone(), Emulated::inputs(4), drive.clone(), drive];
    for (drive, position) in setup.drives.iter_mut().zip([0, 2, 3]) {
        drive.position = position;
    }
    setup.terminals = vec![TerminalSettings {
        position: 1,
        inputs: vec![DigitalInput {
            number: Some(0),
            ..input(0x6000)
        }],
        ..TerminalSettings::default()
    }];
    let outcome = run(&setup, &mut DrivesGone::default());
    let gone = |joint| outcome.events.contains(&Event::Gone(joint));
    assert_eq!(
        [0, 1, 2].map(gone),
        [false, true, true],
        "{:?}",
        outcome.events
    );
    let is_of_terminal = |event: &Event| {
        matches!(
            event,
            Event::TerminalGone(_) | Event::TerminalLeftOp(..) | Event::TerminalsShort
        )
    };
    assert!(
        !outcome.events.iter().any(is_of_terminal),
        "{:?}",
        outcome.events
    );
}

#[test]
fn terminals_change_nothing_for_the_drives() {
    let mut with = setup();
    (with.homing, with.probe) = (None, None);
    for (drive, position) in with.drives.iter_mut().zip([0, 6, 7]) {
        drive.position = position;
    }
    // Drives before and behind the terminals, one of which knows no LRW.
    let [drive, coupler, inputs, outputs] = [
        Emulated::default(),
        Emulated::terminal("COUPLER", ClockKind::Bits64),
        Emulated::inputs(4),
        Emulated::outputs(16),
    ];
    let lacks = Emulated {
        image: glidepath_emulator::ImageAccess::NoLrwByFeatures,
        ..Emulated::inputs(2)
    };
    for last in [Emulated::inputs(2), lacks] {
        let mut setup = with.clone();
        setup.emulated = vec![
            drive.clone(),
            coupler.clone(),
            inputs.clone(),
            outputs.clone(),
            Emulated::terminal("OLD", ClockKind::None),
            last,
            drive.clone(),
            drive.clone(),
        ];
        let at = |position| TerminalSettings {
            position,
            ..TerminalSettings::default()
        };
        setup.terminals = vec![
            at(5),
            TerminalSettings {
                inputs: vec![input(0x6030)],
                ..at(2)
            },
            TerminalSettings {
                // In the second window.
                outputs: vec![output(0x70f0, Signal::Output(0))],
                ..at(3)
            },
        ];
        let outcome = run(&setup, &mut Day::default());
        let counts = &outcome.counts;
        let bad = (counts.lost, counts.short, counts.stale, counts.missed);
        assert_eq!((bad, outcome.allocations), ((0, 0, 0, 0), 0));
        let end = outcome.setpoints.last().unwrap();
        assert!((end.position[0] - 5.0).abs() < 1e-3, "{}", end.position[0]);
        let rests = outcome.records[2].last().unwrap().actual;
        assert!((f64::from(rests) / COUNTS - 3.0).abs() < 1e-3, "{rests}");
    }
}
