//! An instance of its own for each test.

use crate::peer::CAPACITY;
use bytemuck::Zeroable;
use core::time::Duration;
use glidepath_link::{
    CommandReply, CommandRequest, Ipc, LinkConfig, MachineState, SetpointFrame, Subscriber,
};
use std::path::PathBuf;
use std::time::Instant;

/// Far longer than anything here takes on a loaded machine: only a hang reaches it.
const WATCHDOG: Duration = Duration::from_secs(60);

/// An instance in a directory of its own. Nothing of it may be left when it is dropped.
pub(crate) struct Instance {
    pub(crate) config: LinkConfig,
    _root: tempfile::TempDir,
}

impl Instance {
    pub(crate) fn new() -> Self {
        let root = tempfile::tempdir_in("/dev/shm").unwrap();
        let config = LinkConfig {
            instance: "processes".to_owned(),
            root: root.path().join("link"),
            capacity: CAPACITY,
        };
        Self {
            config,
            _root: root,
        }
    }

    pub(crate) fn connect(&self) -> Ipc {
        Ipc::connect(&self.config).unwrap()
    }

    /// What the instance has: its directory, if there is anything.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let root = &self.config.root;
        root.exists().then(|| root.clone()).into_iter().collect()
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let left = self.files();
            assert!(left.is_empty(), "left behind: {left:?}");
        }
    }
}

/// Repeats until there is something.
pub(crate) fn wait_for<T>(mut poll: impl FnMut() -> Option<T>) -> T {
    let started = Instant::now();
    loop {
        if let Some(found) = poll() {
            return found;
        }
        assert!(
            started.elapsed() < WATCHDOG,
            "nothing within the watchdog's time"
        );
        std::thread::sleep(Duration::from_millis(1));
    }
}

pub(crate) fn take<R>(source: &mut dyn Subscriber<R>) -> R {
    wait_for(|| source.take().unwrap())
}

pub(crate) fn frame(sequence: u64) -> SetpointFrame {
    SetpointFrame {
        epoch: 1,
        sequence,
        ..SetpointFrame::zeroed()
    }
}

pub(crate) fn reply_to(request: &CommandRequest) -> CommandReply {
    CommandReply::new(7, request.number, Ok(()), MachineState::Idle, "")
}
