//! The thread of the bus: brings it up, and exchanges a frame a cycle until it is told to end.
//!
//! ```text
//!      send                SYNC0
//!  ─────┼──── shift ─────────┼──────────────┼─────
//!       │ demand at SYNC0    │ drives take targets over, and measure
//!       └ frame ───► answer: what was measured at the SYNC0 before
//! ```
//!
//! A frame that does not come back is not sent again: the next one has the demand of its own time.
//! After too many in a row, or when a drive has left OP and all are off, the bus is brought up from
//! the beginning: there is one way into operation, and it ends with drives without power.

use crate::bridge::Bridge;
use crate::bus::{Init, Op, Reception};
use crate::bus_clock::{Beat, BusClock};
use crate::counts::Counts;
use crate::demand::Demand;
use crate::diagnosis::Diagnosis;
use crate::error::BusError;
use crate::event::Event;
use crate::image::Inputs;
use crate::settings::Settings;
use crate::wire::Wire;
use core::sync::atomic::{AtomicBool, Ordering};
use glidepath_link::{Auxiliary, Feedback, Setpoint, Subscriber};
use rtrb::{Consumer, Producer};
use std::sync::mpsc::Sender;

/// Cycles before the bus is left in which every drive hears that it has no power, and every output that
/// it is at rest.
const LAST_CYCLES: u32 = 10;
/// Between two attempts to bring the bus up again.
const PAUSE_NS: u64 = 500_000_000;
/// How long nothing may come back until the bus is brought up anew.
const SILENCE_NS: u64 = 200_000_000;
/// How long the joints may take to come to rest and to lose their power at the end, and what a spindle may
/// take longer than its ramp.
const FAREWELL_NS: u64 = 5_000_000_000;

/// The ends of the rings in which the thread puts what others wait for.
#[derive(Debug)]
pub struct Ends {
    /// What is known of the joints, once a cycle. What does not fit is left out.
    pub feedback: Producer<Feedback>,
    /// What happened. What does not fit is left out.
    pub events: Producer<Event>,
    /// Lines for the log, while no cycles run.
    pub log: Sender<String>,
    /// The demand of every cycle, for measurements; `None` for none.
    pub demands: Option<Producer<Demand>>,
    /// The auxiliary record, whenever it changes; `None` where nothing obeys it.
    pub auxiliary: Option<Consumer<Auxiliary>>,
}

impl Ends {
    fn tell(&mut self, event: Event) {
        // A log that nobody reads is not waited for.
        let _ = self.events.push(event);
    }

    fn say(&self, line: String) {
        // Nobody is left to read it.
        let _ = self.log.send(line);
    }
}

/// Why cycles end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    /// It was asked for, and all drives are off.
    Asked,
    /// The bus has to be brought up anew.
    BusLost,
}

/// Drives the bus until `stop` is set; then the joints come to rest, and the drives lose their power.
/// `boot_id` gives a number for each life of the bus that no other has.
///
/// # Errors
///
/// The bus does not come into operation the first time. Later it is tried again and again.
pub fn drive_bus<W: Wire, S: Subscriber<Setpoint>>(
    wire: &mut W,
    settings: &Settings,
    source: S,
    ends: &mut Ends,
    stop: &AtomicBool,
    boot_id: &mut dyn FnMut() -> u64,
) -> Result<Counts, BusError> {
    let mut bridge = Bridge::new(settings, source);
    let mut counts = Counts::default();
    let mut is_first = true;
    loop {
        let op = bring_up(&mut *wire, settings);
        match op {
            Ok(op) => {
                let mut run = Run {
                    op,
                    bridge: &mut bridge,
                    counts: &mut counts,
                    ends: &mut *ends,
                    settings,
                    inputs: vec![Inputs::default(); settings.drives.len()],
                    lost: 0,
                    targets_ns: 0,
                    has_spindle_failed: false,
                };
                let end = run.cycles(stop, boot_id());
                let stale = run.op.stale();
                // Who does not hear it has a watchdog.
                let _ = run.op.leave();
                counts.stale += stale;
                if end == End::Asked {
                    return Ok(counts);
                }
            }
            Err(error) if is_first => return Err(error),
            Err(error) => ends.say(format!("the bus does not come up: {error}")),
        }
        if stop.load(Ordering::Relaxed) {
            return Ok(counts);
        }
        is_first = false;
        counts.restarts += 1;
        let until_ns = wire.now_ns() + PAUSE_NS;
        wire.sleep_until(until_ns);
    }
}

fn bring_up<'w, W: Wire>(wire: &'w mut W, settings: &Settings) -> Result<Op<'w, W>, BusError> {
    Init::find(wire)?
        .into_pre_op()?
        .into_safe_op(settings)?
        .into_op(&settings.bus)
}

struct Run<'a, 'w, W, S: Subscriber<Setpoint>> {
    op: Op<'w, W>,
    bridge: &'a mut Bridge<S>,
    counts: &'a mut Counts,
    ends: &'a mut Ends,
    settings: &'a Settings,
    inputs: Vec<Inputs>,
    /// Frames lost in a row.
    lost: u32,
    /// The SYNC0 whose targets have reached the drives last, ns.
    targets_ns: u64,
    /// The drive of the spindle reports a fault.
    has_spindle_failed: bool,
}

impl<W: Wire, S: Subscriber<Setpoint>> Run<'_, '_, W, S> {
    fn cycles(&mut self, stop: &AtomicBool, boot_id: u64) -> End {
        let now_ns = self.op.wire().now_ns();
        let clock = self.op.take_clock();
        let mut clock = clock.unwrap_or_else(|| BusClock::new(&self.settings.bus, now_ns, now_ns));
        // Where the drives are, before anything is demanded.
        let beat = clock.next(now_ns);
        let standing = vec![crate::image::Outputs::default(); self.inputs.len()];
        self.op.wire().sleep_until(beat.send_ns);
        let is_sent = self.op.send(&standing).is_ok();
        self.hear(&mut clock, &beat, is_sent);
        self.bridge.begin_terminals(self.op.wiring());
        let ends = &mut *self.ends;
        self.bridge
            .hear_terminals(self.op.answered(), &mut |event| ends.tell(event));
        self.bridge.begin(boot_id, &self.inputs);
        self.ends.tell(Event::InOperation);
        let (mut ends_ns, mut off) = (None, 0);
        loop {
            if ends_ns.is_none() && stop.load(Ordering::Relaxed) {
                let now_ns = self.op.wire().now_ns();
                self.bridge.end();
                // Outputs hear it, too.
                let farewell_ns = FAREWELL_NS + self.settings.spindle_ramp_ns();
                (ends_ns, off) = (Some(now_ns + farewell_ns), 0);
            }
            let now_ns = self.cycle(&mut clock);
            off = if self.bridge.is_off() { off + 1 } else { 0 };
            if ends_ns.is_some_and(|ends_ns| off > LAST_CYCLES || now_ns > ends_ns) {
                return End::Asked;
            }
            if self.lost == self.settings.bus.lost_frames {
                self.bridge.lose_bus(now_ns);
                self.ends.tell(Event::BusLost);
            }
            let has_lost_device = self.bridge.has_lost_device() && off > LAST_CYCLES;
            let silent_ns = u64::from(self.lost) * clock.period_ns();
            if has_lost_device || silent_ns > SILENCE_NS {
                return End::BusLost;
            }
        }
    }

    /// One cycle; returns the time at its end.
    fn cycle(&mut self, clock: &mut BusClock) -> u64 {
        let beat = clock.next(self.op.wire().now_ns());
        self.counts.missed += beat.missed;
        self.op.wire().sleep_until(beat.send_ns);
        let now_ns = self.op.wire().now_ns();
        self.counts
            .lateness
            .record(now_ns.saturating_sub(beat.send_ns));
        let since_ns = beat.sync_ns.saturating_sub(self.targets_ns);
        let ends = &mut *self.ends;
        while let Some(Ok(record)) = ends.auxiliary.as_mut().map(Consumer::pop) {
            self.bridge.hear_record(&record, now_ns);
        }
        let failed = &mut self.has_spindle_failed;
        let mut tell = |event| {
            *failed |= matches!(event, Event::SpindleFault(_));
            ends.tell(event);
        };
        let meant_ns = beat.sync_ns.saturating_sub(self.settings.bus.delay_ns);
        self.bridge.cycle(now_ns, meant_ns, since_ns, &mut tell);
        self.bridge
            .outputs((now_ns, meant_ns), self.op.outputs(), &mut tell);
        let is_sent = self.op.send(self.bridge.targets()).is_ok();
        let played = self.bridge.played();
        if let Some(demands) = &mut self.ends.demands {
            let _ = demands.push(Demand {
                index: self.op.index(),
                sync_ns: beat.sync_ns,
                missed_ticks: played.missed_ticks,
                lost_setpoints: played.lost,
                coasts: played.coasts,
            });
        }
        self.hear(clock, &beat, is_sent);
        self.counts.cycles += 1;
        self.counts.quartz = clock.rate();
        self.counts.coasts = played.coasts;
        if self.lost == 0 {
            self.targets_ns = beat.sync_ns;
            // What was answered was measured at the SYNC0 before, and belongs to the setpoints that were
            // played then.
            let behind_ns = clock.period_ns() + self.settings.bus.delay_ns;
            let sample_ns = beat.sync_ns.saturating_sub(behind_ns);
            let feedback = self.bridge.feedback(sample_ns);
            let _ = self.ends.feedback.push(feedback);
        }
        if let Some((nth, code)) = self.op.take_emergency() {
            self.ends.tell(emergency(self.settings, nth, code));
        }
        if core::mem::take(&mut self.has_spindle_failed) {
            // That of a drive or a terminal shows in its state; this one's is among its inputs.
            let mut terminals = self.settings.terminals.iter();
            let spindle = terminals.position(|terminal| terminal.spindle.is_some());
            self.op
                .want_history(self.settings.drives.len() + spindle.unwrap_or(0));
        }
        if let Some((nth, diagnosis)) = self.op.take_diagnosis() {
            self.ends.tell(history(self.settings, nth, diagnosis));
        }
        self.op.wire().now_ns()
    }

    /// Waits for the answer. An interface that fails is one that loses frames.
    fn hear(&mut self, clock: &mut BusClock, beat: &Beat, is_sent: bool) {
        let received = if is_sent {
            self.op.receive(beat.give_up_ns, &mut self.inputs)
        } else {
            Ok(Reception::Lost)
        };
        let reception = received.unwrap_or(Reception::Lost);
        let (ends, failed) = (&mut *self.ends, &mut self.has_spindle_failed);
        let mut tell = |event| {
            *failed |= matches!(event, Event::SpindleFault(_));
            ends.tell(event);
        };
        match reception {
            Reception::Good(times) => {
                clock.hear(times);
                let trip_ns = times.received_ns.saturating_sub(times.sent_ns);
                self.counts.round_trip.record(trip_ns);
                self.bridge.hear(&self.inputs, self.op.states(), &mut tell);
                let answered = self.op.answered();
                self.counts.short += u64::from(!answered.is_whole);
                self.bridge.hear_terminals(answered, &mut tell);
                self.lost = 0;
            }
            Reception::Short { counted, .. } => {
                self.counts.short += 1;
                self.bridge.hear(&self.inputs, self.op.states(), &mut tell);
                self.bridge.hear_terminals(self.op.answered(), &mut tell);
                // The drives that answer can be led to rest; one that does not has failed.
                let says_why = counted > 0 && self.bridge.has_lost_drive();
                self.lost = if says_why { 0 } else { self.lost + 1 };
                if !says_why && self.lost < self.settings.bus.lost_frames {
                    tell(Event::FrameLost);
                }
            }
            Reception::Lost => {
                self.counts.lost += 1;
                self.lost = self.lost.saturating_add(1);
                // The others of a row are one event, that of the bus.
                if self.lost < self.settings.bus.lost_frames {
                    tell(Event::FrameLost);
                }
            }
        }
    }
}

/// An emergency of the nth device: drives first, then all others.
fn emergency(settings: &Settings, nth: usize, code: u16) -> Event {
    if let Some(drive) = settings.drives.get(nth) {
        return Event::Emergency(drive.joint, code);
    }
    Event::TerminalEmergency(position(settings, nth), code)
}

/// A message of its diagnosis history.
fn history(settings: &Settings, nth: usize, diagnosis: Diagnosis) -> Event {
    if let Some(drive) = settings.drives.get(nth) {
        return Event::History(drive.joint, diagnosis);
    }
    Event::TerminalHistory(position(settings, nth), diagnosis)
}

/// Where the nth device is, if that is no drive.
fn position(settings: &Settings, nth: usize) -> usize {
    let other = nth.saturating_sub(settings.drives.len());
    let terminal = settings.terminals.get(other);
    terminal.map_or(nth, |terminal| terminal.position)
}
