//! The thread that reads what is streamed.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel};
use std::thread::{Builder, Scope};
use std::time::Duration;

use glidepath_gcode::ReadingWatch;

use super::FeedError;
use crate::run::refusal::Refusal;
use crate::source::item_source::{ItemSource, Supply};

/// Items read ahead.
const READ_AHEAD: usize = 256;
/// Between two looks at a source that has nothing yet.
const PENDING_POLL: Duration = Duration::from_millis(2);

/// What the thread has read.
#[derive(Debug)]
pub(super) struct Reader {
    opened: Receiver<Result<(), Refusal>>,
    supplies: Receiver<Supply>,
    lines: Arc<AtomicU64>,
}

impl Reader {
    /// Starts to open a source, and to read it. The thread ends with the source, when the reader is dropped, or at the
    /// next line once the watch says so.
    ///
    /// # Errors
    /// The thread cannot be started.
    pub(super) fn spawn<'scope, S: ItemSource>(
        scope: &'scope Scope<'scope, '_>,
        watch: ReadingWatch,
        make_source: impl FnOnce() -> Result<S, Refusal> + Send + 'scope,
    ) -> io::Result<Self> {
        let (tell, opened) = sync_channel(1);
        let (sender, supplies) = sync_channel(READ_AHEAD);
        let lines = Arc::new(AtomicU64::new(0));
        let counter = Arc::clone(&lines);
        let thread = Builder::new().name("program reader".to_owned());
        thread.spawn_scoped(scope, move || {
            let (source, told) = match make_source() {
                Ok(source) => (Some(source), Ok(())),
                Err(refusal) => (None, Err(refusal)),
            };
            // Nobody may want it any more.
            if let (Ok(()), Some(source)) = (tell.send(told), source) {
                read_all(source, &watch, &sender, &counter);
            }
        })?;
        Ok(Self {
            opened,
            supplies,
            lines,
        })
    }

    /// Whether the source is open.
    ///
    /// # Errors
    /// Why it is not opened.
    pub(super) fn is_open(&mut self) -> Result<bool, FeedError> {
        match self.opened.try_recv() {
            Ok(opened) => Ok(opened.map(|()| true)?),
            Err(TryRecvError::Disconnected) => Err(died().into()),
            Err(TryRecvError::Empty) => Ok(false),
        }
    }

    /// What was read next.
    pub(super) fn next(&mut self) -> Supply {
        match self.supplies.try_recv() {
            Ok(supply) => supply,
            Err(TryRecvError::Empty) => Supply::Pending,
            Err(TryRecvError::Disconnected) => Supply::Refused(died()),
        }
    }

    /// Lines of the program read so far.
    pub(super) fn lines_read(&self) -> u64 {
        self.lines.load(Ordering::Relaxed)
    }
}

fn died() -> Refusal {
    Refusal::Read(io::Error::other("the thread that reads the program died"))
}

fn read_all<S: ItemSource>(
    mut source: S,
    watch: &ReadingWatch,
    sender: &SyncSender<Supply>,
    lines: &AtomicU64,
) {
    while !watch.is_to_end() {
        let supply = source.next_item();
        if matches!(supply, Supply::Pending) {
            std::thread::sleep(PENDING_POLL);
            continue;
        }
        let is_last = !matches!(supply, Supply::Item(_));
        lines.store(source.lines_read(), Ordering::Relaxed);
        if sender.send(supply).is_err() || is_last {
            return;
        }
    }
}
