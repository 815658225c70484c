//! The process of the bridge: its threads, and what goes through the rings between them.

use crate::machine::servo;
use glidepath_emulator::{DriveSettings as Emulated, Segment};
use glidepath_ethercat::{
    At, BusSettings, DigitalOutput, Listeners, MAX_FRAME, RunSettings, Settings, Signal,
    TerminalSettings, Wire, run,
};
use glidepath_link::{
    Auxiliary, EventRecord, InProcess, MachineState, Publisher, Setpoint, SpindleState, Transport,
};
use glidepath_program::Event;
use glidepath_realtime::{Clock as _, Mode, Monotonic, Request};
use std::collections::VecDeque;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

const PERIOD: Duration = Duration::from_millis(4);
/// Far longer than anything here takes.
const PATIENCE: Duration = Duration::from_secs(60);
/// Bits of the outputs: output 0, output 1, the spindle.
const RECORDED: u8 = 1;
const TOLD: u8 = 2;
const SPINDLE: u8 = 4;

/// Devices that answer at once, by the clock of this host.
struct Near {
    segment: Arc<Mutex<Segment>>,
    back: VecDeque<Vec<u8>>,
}

impl Wire for Near {
    fn now_ns(&self) -> u64 {
        Monotonic.now_ns()
    }

    fn sleep_until(&mut self, deadline_ns: u64) {
        Monotonic.sleep_until(deadline_ns);
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        let mut frame = frame.to_vec();
        self.segment.lock().unwrap().pass(&mut frame, self.now_ns());
        self.back.push_back(frame);
        Ok(())
    }

    fn receive(&mut self, into: &mut [u8], until_ns: u64) -> io::Result<Option<usize>> {
        let Some(frame) = self.back.pop_front() else {
            self.sleep_until(until_ns);
            return Ok(None);
        };
        assert!(frame.len() <= MAX_FRAME);
        into[..frame.len()].copy_from_slice(&frame);
        Ok(Some(frame.len()))
    }
}

fn settings() -> Settings {
    let output = |bit, from| DigitalOutput {
        at: At::Bit(bit),
        from,
        is_inverted: false,
        rest: false,
    };
    let mut servo = servo();
    // A host may stand still for a while.
    servo.patience_ns = 20_000_000_000;
    Settings {
        bus: BusSettings {
            period_ns: 4_000_000,
            shift_ns: 2_000_000,
            lost_frames: 1000,
            watchdog_ns: 6_000_000_000,
            ..BusSettings::default()
        },
        drives: vec![crate::machine::drive(0)],
        drive_inputs: Vec::new(),
        terminals: vec![TerminalSettings {
            position: 1,
            outputs: vec![
                output(0, Signal::Output(0)),
                output(1, Signal::Output(1)),
                output(2, Signal::SpindleOn),
            ],
            ..TerminalSettings::default()
        }],
        servo,
    }
}

/// An interpolator that is off, and tells what happens.
struct Teller {
    setpoints: Box<dyn Publisher<Setpoint>>,
    records: Box<dyn Publisher<Auxiliary>>,
    number: u64,
    start_ns: u64,
}

/// The bridge ends with the test, however that does.
struct Ending<'s>(&'s AtomicBool);

impl Drop for Ending<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl Teller {
    /// Tells setpoints until outputs are something; with the first one, what happens.
    fn tell_until(&mut self, segment: &Mutex<Segment>, bits: u8, events: &[Event]) {
        let (began, mut events) = (Instant::now(), events.iter());
        while segment.lock().unwrap().outputs(1) != [bits] {
            let scheduled_ns = self.start_ns + self.number * 4_000_000;
            let mut setpoint = Setpoint {
                boot_id: 7,
                reference: 1,
                number: self.number,
                tick: self.number,
                scheduled_ns,
                apply_ns: scheduled_ns + 4_000_000,
                state: MachineState::Off.code(),
                ..<Setpoint as bytemuck::Zeroable>::zeroed()
            };
            for event in events.by_ref() {
                assert!(setpoint.tell(EventRecord::new(*event, 0)));
            }
            self.setpoints.publish(&setpoint).unwrap();
            // Who comes late gets the record, too.
            self.records.refresh().unwrap();
            self.number += 1;
            std::thread::sleep(PERIOD);
            let said = segment.lock().unwrap().outputs(1).to_vec();
            assert!(began.elapsed() < PATIENCE, "{said:?}, not {bits:#b}");
        }
    }
}

/// An output of a program, and a spindle, which is not started for it.
fn record() -> Auxiliary {
    Auxiliary {
        boot_id: 7,
        generation: 1,
        digital_out: 1,
        spindle: SpindleState::Clockwise.code(),
        ..Auxiliary::default()
    }
}

#[test]
fn outputs_obey_the_record_and_setpoints_through_all_threads() {
    let line = [Emulated::default(), Emulated::outputs(4)];
    let segment = Arc::new(Mutex::new(Segment::new_at(&line, Monotonic.now_ns())));
    let link = InProcess::default();
    let mut teller = Teller {
        setpoints: link.setpoint_sink().unwrap(),
        records: link.auxiliary_sink().unwrap(),
        number: 0,
        start_ns: Monotonic.now_ns(),
    };
    let connect = move || Ok(Box::new(link.clone()) as Box<dyn Transport>);
    let (settings, stop) = (settings(), AtomicBool::new(false));
    let mut wire = Near {
        segment: Arc::clone(&segment),
        back: VecDeque::new(),
    };
    let how = RunSettings {
        request: Request::default(),
        mode: Mode::BestEffort,
    };
    std::thread::scope(|scope| {
        let bridge = scope.spawn(|| {
            let listeners = Listeners {
                log: &mut |_| {},
                demands: None,
            };
            run(&mut wire, &settings, how, connect, &stop, listeners)
        });
        let ending = Ending(&stop);
        teller.records.publish(&record()).unwrap();
        teller.tell_until(&segment, RECORDED, &[]);
        let on = [
            Event::DigitalOutput {
                number: 1,
                on: true,
            },
            Event::MCode(3),
        ];
        teller.tell_until(&segment, RECORDED | TOLD | SPINDLE, &on);
        drop(ending);
        let ended = bridge.join().unwrap();
        assert!(ended.is_ok(), "{ended:?}");
    });
    assert_eq!(segment.lock().unwrap().outputs(1), [0]);
}
