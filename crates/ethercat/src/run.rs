//! The process of `glidepath ethercat`: three threads, and the rings between them.
//!
//! | thread | scheduling | does |
//! |---|---|---|
//! | setpoints | ordinary | takes setpoints from shared memory, fills a ring |
//! | bus | real time | [`drive_bus`] |
//! | the calling one | ordinary | feedback to the interpolator, lines to the log, the auxiliary record to the bus |

use crate::counts::Counts;
use crate::cycle::{Ends, drive_bus};
use crate::demand::Demand;
use crate::error::BusError;
use crate::event::Event;
use crate::settings::Settings;
use crate::wire::Wire;
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use glidepath_link::servo::{RingFiller, ring};
use glidepath_link::{
    Auxiliary, Feedback, LinkError, Record as _, Setpoint, Subscriber, Transport,
};
use glidepath_realtime::{Mode, NotRealTime, Request, enter};
use rtrb::{Consumer, Producer, RingBuffer};
use std::sync::mpsc::{Receiver, channel};

/// Between two looks for feedback.
const POLL: Duration = Duration::from_micros(500);
/// Records and events that wait: a second and more at 1 ms.
const FEEDBACK: usize = 1024;
const EVENTS: usize = 256;
const DEMANDS: usize = 4096;
/// Auxiliary records on their way: only the last one counts.
const RECORDS: usize = 16;

/// The settings of the process.
#[derive(Debug, Clone, Copy)]
pub struct RunSettings {
    /// What the bus thread asks for.
    pub request: Request,
    /// Whether it goes on without.
    pub mode: Mode,
}

/// The reason why the process ends.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The bus does not come into operation, or the interface fails.
    #[error(transparent)]
    Bus(#[from] BusError),
    /// Shared memory cannot be used.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// Real time is not granted.
    #[error(transparent)]
    NotRealTime(#[from] NotRealTime),
    /// A thread ended for no reason that is known.
    #[error("the {0} thread ended")]
    Thread(&'static str),
}

/// The listeners to the log and to the measurements.
pub struct Listeners<'l, 'd> {
    /// Given lines for the log.
    pub log: &'l mut dyn FnMut(&str),
    /// Given the demand of every cycle, if anybody wants it.
    pub demands: Option<&'d mut dyn FnMut(Demand)>,
}

impl core::fmt::Debug for Listeners<'_, '_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Listeners").finish_non_exhaustive()
    }
}

/// Runs until `stop` is set. `transport` makes the ports, once for the thread of the setpoints and
/// once for this one.
///
/// # Errors
///
/// The bus or the link cannot be used, or real time is not granted.
pub fn run<W: Wire + Send>(
    wire: &mut W,
    settings: &Settings,
    run: RunSettings,
    transport: impl Fn() -> Result<Box<dyn Transport>, LinkError> + Clone + Send + 'static,
    stop: &AtomicBool,
    listeners: Listeners<'_, '_>,
) -> Result<Counts, RunError> {
    let Listeners { log, mut demands } = listeners;
    let own = transport()?;
    let mut sink = own.feedback_sink()?;
    let connect = move || -> Result<Box<dyn Subscriber<Setpoint>>, LinkError> {
        transport()?.setpoint_source()
    };
    let (source, filler) = ring(connect)?;
    let (feedback, mut records) = RingBuffer::new(FEEDBACK);
    let (events, mut happened) = RingBuffer::new(EVENTS);
    let (told, mut asked) = RingBuffer::new(DEMANDS);
    let (lines, said) = channel();
    let (auxiliary, mut record) = if settings.terminals.is_empty() {
        (None, None)
    } else {
        let (into, from) = RingBuffer::new(RECORDS);
        (Some(from), Some((own.auxiliary_source()?, into)))
    };
    let mut ends = Ends {
        feedback,
        events,
        log: lines,
        demands: demands.is_some().then_some(told),
        auxiliary,
    };
    let is_over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let over = &is_over;
        let bus = std::thread::Builder::new()
            .name("gp-ethercat".to_owned())
            .spawn_scoped(scope, move || -> Result<Counts, RunError> {
                let _end = SetOnDrop(over);
                let entered = enter(&run.request, run.mode)?;
                for refusal in entered.grants.refusals() {
                    let _ = ends.log.send(format!("not granted: {refusal}"));
                }
                let boot_id = &mut boot_id;
                Ok(drive_bus(wire, settings, source, &mut ends, stop, boot_id)?)
            })
            .map_err(|_| RunError::Thread("bus"))?;
        let mut written = Ok(());
        loop {
            let is_last = is_over.load(Ordering::Relaxed);
            if written.is_ok() {
                written = publish(&mut records, sink.as_mut());
                if let Err(error) = &written {
                    log(&format!("feedback cannot be sent: {error}"));
                }
            }
            if let Some((source, into)) = &mut record
                && let Err(error) = pass_on(source.as_mut(), into)
            {
                log(&format!(
                    "outputs obey setpoints alone from here on: {error}"
                ));
                record = None;
            }
            tell(&mut happened, &said, log);
            while let Ok(demand) = asked.pop() {
                if let Some(demands) = &mut demands {
                    demands(demand);
                }
            }
            if is_last {
                break;
            }
            std::thread::sleep(POLL);
        }
        let counts = bus.join().map_err(|_| RunError::Thread("bus"))??;
        finish(filler)?;
        written?;
        Ok(counts)
    })
}

fn finish(filler: RingFiller) -> Result<(), RunError> {
    Ok(filler.finish()?)
}

struct SetOnDrop<'a>(&'a AtomicBool);

impl Drop for SetOnDrop<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

fn publish(
    records: &mut Consumer<Feedback>,
    sink: &mut dyn glidepath_link::Publisher<Feedback>,
) -> Result<(), LinkError> {
    while let Ok(record) = records.pop() {
        sink.publish(&record)?;
    }
    Ok(())
}

/// Hands the auxiliary record to the thread of the bus. One that fails its check is none.
fn pass_on(
    source: &mut dyn Subscriber<Auxiliary>,
    into: &mut Producer<Auxiliary>,
) -> Result<(), LinkError> {
    while !into.is_full()
        && let Some(record) = source.take()?
    {
        if record.check().is_ok() {
            // There is room: nobody else puts anything in.
            let _ = into.push(record);
        }
    }
    Ok(())
}

fn tell(events: &mut Consumer<Event>, said: &Receiver<String>, log: &mut dyn FnMut(&str)) {
    while let Ok(event) = events.pop() {
        log(&event.to_string());
    }
    while let Ok(line) = said.try_recv() {
        log(&line);
    }
}

/// A number that no other life of a bus has.
fn boot_id() -> u64 {
    use glidepath_realtime::{Clock as _, Monotonic};
    (Monotonic.now_ns() ^ u64::from(std::process::id()).rotate_right(16)).max(1)
}
