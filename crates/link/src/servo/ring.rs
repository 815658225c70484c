//! The ring of setpoints between a port and a real-time thread.
//!
//! ```text
//!   shared memory ──► port ──► thread of its own ──► ring ──► Servo in the real-time thread
//! ```
//!
//! A port allocates, locks and makes system calls. Here a thread under ordinary scheduling owns it,
//! and hands setpoints over through a ring that neither side waits at: [`RingSource`] makes no
//! system call and no allocation, and goes to whatever thread plays the setpoints.
//!
//! When the ring is full the rest stays in the port, which loses its oldest when that is full, too.

use crate::service::SETPOINTS;
use crate::{LinkError, Setpoint, Subscriber};
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use rtrb::{Consumer, RingBuffer};
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;

/// Setpoints in the ring: a second at 4 ms.
const RING: usize = 256;
/// Between two looks at the port before the first setpoint, and the longest time after it.
const POLL_MAX: Duration = Duration::from_millis(1);
/// The shortest time between two looks, for short periods.
const POLL_MIN: Duration = Duration::from_micros(50);

/// The end of the ring for the thread that plays setpoints.
#[derive(Debug)]
pub struct RingSource {
    setpoints: Consumer<Setpoint>,
}

impl Subscriber<Setpoint> for RingSource {
    /// Never fails: a port that fails falls silent, and [`RingFiller::finish`] says why.
    fn take(&mut self) -> Result<Option<Setpoint>, LinkError> {
        Ok(self.setpoints.pop().ok())
    }
}

/// The thread that fills the ring. It ends when this is dropped.
#[derive(Debug)]
pub struct RingFiller {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<Result<(), LinkError>>>,
}

impl RingFiller {
    /// Whether the port failed, and no more setpoints come.
    #[must_use]
    pub fn has_failed(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Ends the thread.
    ///
    /// # Errors
    ///
    /// Why the port failed, if it did.
    pub fn finish(mut self) -> Result<(), LinkError> {
        self.join()
    }

    fn join(&mut self) -> Result<(), LinkError> {
        self.stop.store(true, Ordering::Relaxed);
        match self.thread.take().map(JoinHandle::join) {
            Some(Ok(ended)) => ended,
            Some(Err(_)) => Err(failed("filling a ring", "its thread panicked".into())),
            None => Ok(()),
        }
    }
}

impl Drop for RingFiller {
    fn drop(&mut self) {
        // Who wants to know why the port failed calls `finish`.
        let _ = self.join();
    }
}

fn failed(action: &'static str, detail: crate::BoxedError) -> LinkError {
    LinkError::Transport {
        service: SETPOINTS,
        action,
        detail,
    }
}

/// Starts a thread that takes setpoints from the port that `connect` makes there.
///
/// It looks four times a period, from the first setpoint on. Returns when the port is made.
///
/// # Errors
///
/// That of `connect`, or there is no thread to be had.
pub fn ring(
    connect: impl FnOnce() -> Result<Box<dyn Subscriber<Setpoint>>, LinkError> + Send + 'static,
) -> Result<(RingSource, RingFiller), LinkError> {
    let (mut into, setpoints) = RingBuffer::new(RING);
    let stop = Arc::new(AtomicBool::new(false));
    let (is_to_stop, (made, is_made)) = (Arc::clone(&stop), channel());
    let fill = move || {
        let mut port = port(connect, &made)?;
        let mut poll = POLL_MAX;
        while !is_to_stop.load(Ordering::Relaxed) {
            while !into.is_full()
                && let Some(setpoint) = port.take()?
            {
                poll = poll_of(&setpoint);
                // There is room: nobody else puts anything in.
                let _ = into.push(setpoint);
            }
            std::thread::sleep(poll);
        }
        Ok(())
    };
    let thread = std::thread::Builder::new()
        .name("gp-setpoints".to_owned())
        .spawn(fill)
        .map_err(|error| failed("starting a thread", error.into()))?;
    let filler = RingFiller {
        stop,
        thread: Some(thread),
    };
    // A thread that ends before it has said anything has failed.
    match is_made.recv() {
        Ok(()) => Ok((RingSource { setpoints }, filler)),
        Err(_) => match filler.finish() {
            Err(error) => Err(error),
            Ok(()) => Err(failed("filling a ring", "its thread ended".into())),
        },
    }
}

fn port(
    connect: impl FnOnce() -> Result<Box<dyn Subscriber<Setpoint>>, LinkError>,
    made: &Sender<()>,
) -> Result<Box<dyn Subscriber<Setpoint>>, LinkError> {
    let port = connect()?;
    // Who waits for it cannot have gone away: see `ring`.
    let _ = made.send(());
    Ok(port)
}

/// A quarter of the period of a setpoint, within bounds.
fn poll_of(setpoint: &Setpoint) -> Duration {
    let period_ns = setpoint.apply_ns.saturating_sub(setpoint.scheduled_ns);
    Duration::from_nanos(period_ns / 4).clamp(POLL_MIN, POLL_MAX)
}
