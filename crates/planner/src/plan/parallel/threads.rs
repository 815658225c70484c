//! The threads of a plan.

use std::io;
use std::num::NonZeroUsize;
use std::sync::mpsc::{Receiver, channel, sync_channel};
use std::sync::{Arc, Mutex};
use std::thread::{Builder, JoinHandle};

use glidepath_geometry::AxisVector;
use glidepath_kinematics::LimitedMechanism;
use glidepath_program::Settings;

use super::bounds::Bounds;
use super::message::PlanPiece;
use super::reader::{Outlets, ReadEnd, read};
use super::worker::work;
use crate::source::item_source::ItemSource;

/// Parts whose plans wait, or are made, for each worker.
const PARTS_PER_WORKER: usize = 16;

/// The reader and the workers.
#[derive(Debug)]
pub(super) struct Threads {
    reader: Option<JoinHandle<Option<ReadEnd>>>,
    workers: Vec<JoinHandle<()>>,
}

impl Threads {
    /// Starts them; returns where the plans of the parts come out, in order.
    ///
    /// # Errors
    /// A thread cannot be started.
    pub(super) fn start<S: ItemSource + Send + 'static>(
        source: S,
        (settings, start): (Settings, AxisVector),
        joints: Option<LimitedMechanism>,
        workers: NonZeroUsize,
        bounds: &Arc<Bounds>,
    ) -> io::Result<(Self, Receiver<Receiver<PlanPiece>>)> {
        let (parts, waiting) = channel();
        let (plans, planned) = sync_channel(PARTS_PER_WORKER * workers.get());
        let waiting = Arc::new(Mutex::new(waiting));
        let mut threads = Self {
            reader: None,
            workers: Vec::with_capacity(workers.get()),
        };
        for _ in 0..workers.get() {
            let (waiting, bounds) = (Arc::clone(&waiting), Arc::clone(bounds));
            let worker = Builder::new().name("planning".to_owned());
            let worker = worker.spawn(move || work(&waiting, (settings, joints), &bounds))?;
            threads.workers.push(worker);
        }
        let outlets = Outlets {
            workers: parts,
            plans,
            bounds: Arc::clone(bounds),
        };
        let reader = Builder::new().name("reading".to_owned());
        let reader = reader.spawn(move || read(source, &settings, start, outlets))?;
        threads.reader = Some(reader);
        Ok((threads, planned))
    }

    /// Waits for the end of all of them. Should one have died, its panic goes on here.
    pub(super) fn join(&mut self) -> Option<ReadEnd> {
        let read = self.reader.take().map(JoinHandle::join);
        let worked: Vec<_> = self.workers.drain(..).map(JoinHandle::join).collect();
        for worked in worked {
            if let Err(panic) = worked {
                std::panic::resume_unwind(panic);
            }
        }
        match read? {
            Ok(end) => end,
            Err(panic) => std::panic::resume_unwind(panic),
        }
    }

    /// Waits for the end of all of them, however they end.
    pub(super) fn end(&mut self) {
        let reader = self.reader.take().map(|reader| reader.join().is_ok());
        let workers = self.workers.drain(..).map(|worker| worker.join().is_ok());
        // Those that died said why when they did.
        let _ = (reader, workers.count());
    }
}
