//! Programs from a pipe, which cannot be checked before anything moves.

use std::io::{self, BufRead, BufReader, Read};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel};
use std::time::{Duration, Instant};

use glidepath_gcode::Options;

use crate::run::refusal::Refusal;
use crate::source::item_source::{ItemSource, SILENCE, Supply};
use crate::source::program::{BUFFER, ProgramSource};
use crate::source::run_channels::RunChannels;

/// Items read ahead from a pipe.
const READ_AHEAD: usize = 1024;

/// Between two looks for the answer to an M66.
const ANSWER_POLL: Duration = Duration::from_millis(2);

/// A program from a pipe. It is read in a thread of its own, so that a pipe that is slow never
/// keeps the planner from looking after the motion.
#[derive(Debug)]
pub struct PipeSource {
    pieces: Receiver<Supply>,
    lines: Arc<AtomicU64>,
    waiting: Waiting,
}

/// Since when the thread that reads a pipe waits for somebody to write.
#[derive(Debug, Clone)]
struct Waiting {
    began: Instant,
    /// ns from there on; 0 while it does not wait.
    since_ns: Arc<AtomicU64>,
}

impl Waiting {
    fn new() -> Self {
        Self {
            began: Instant::now(),
            since_ns: Arc::default(),
        }
    }

    fn now_ns(&self) -> u64 {
        let passed = self.began.elapsed().as_nanos();
        u64::try_from(passed).unwrap_or(u64::MAX).max(1)
    }

    /// How long it has waited, if it does.
    fn waited(&self) -> Option<Duration> {
        let since_ns = self.since_ns.load(Ordering::Acquire);
        (since_ns > 0).then(|| Duration::from_nanos(self.now_ns().saturating_sub(since_ns)))
    }
}

/// A pipe of which it is known since when it has been waited for.
struct Watched<R> {
    pipe: R,
    waiting: Waiting,
}

impl<R: Read> Read for Watched<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let Waiting { since_ns, .. } = &self.waiting;
        since_ns.store(self.waiting.now_ns(), Ordering::Release);
        let read = self.pipe.read(into);
        since_ns.store(0, Ordering::Release);
        read
    }
}

impl PipeSource {
    /// Starts to read. The thread ends with the input, or when the source is dropped and the input
    /// gives another item. It shares what it comes to with whoever attends to its run.
    ///
    /// # Errors
    /// The thread cannot be started.
    pub fn spawn<R: Read + Send + 'static>(
        input: R,
        options: Options,
        channels: RunChannels,
    ) -> Result<Self, Refusal> {
        let (sender, pieces) = sync_channel(READ_AHEAD);
        let lines = Arc::new(AtomicU64::new(0));
        let counter = Arc::clone(&lines);
        let waiting = Waiting::new();
        let input = Watched {
            pipe: input,
            waiting: waiting.clone(),
        };
        std::thread::Builder::new()
            .name("program reader".to_owned())
            .spawn(move || {
                let source = ProgramSource::new(BufReader::with_capacity(BUFFER, input), options)
                    .attended(channels);
                read_all(source, &sender, &counter);
            })?;
        Ok(Self {
            pieces,
            lines,
            waiting,
        })
    }
}

fn read_all<R: BufRead>(
    mut source: ProgramSource<R>,
    sender: &SyncSender<Supply>,
    lines: &AtomicU64,
) {
    loop {
        let supply = source.next_item();
        if matches!(supply, Supply::Pending) {
            std::thread::sleep(ANSWER_POLL);
            continue;
        }
        let last = !matches!(supply, Supply::Item(_) | Supply::Probe);
        lines.store(source.lines_read(), Ordering::Relaxed);
        if sender.send(supply).is_err() || last {
            return;
        }
    }
}

impl ItemSource for PipeSource {
    fn next_item(&mut self) -> Supply {
        match self.pieces.try_recv() {
            Ok(supply) => supply,
            Err(TryRecvError::Empty) => Supply::Pending,
            Err(TryRecvError::Disconnected) => Supply::Refused(Refusal::Read(io::Error::other(
                "the thread that reads the program died",
            ))),
        }
    }

    fn is_silent(&mut self) -> bool {
        self.waiting
            .waited()
            .is_some_and(|waited| waited >= SILENCE)
    }

    fn lines_read(&self) -> u64 {
        self.lines.load(Ordering::Relaxed)
    }
}
