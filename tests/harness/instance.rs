//! An instance for one test: its shared memory.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use glidepath_link::{Ipc, LinkConfig, Status, Transport, remove_leftovers};
use tempfile::TempDir;

use crate::{glidepath, seats, wall_clock};

/// How long a status is waited for: far longer than it ever takes.
const PATIENCE: Duration = Duration::from_secs(120);

/// An instance of its own. While it lives there are at most two for each core in all, in this process and
/// others: the tests run processes at the speed of the clock, and would take each other's processor.
#[derive(Debug)]
pub struct Instance {
    config: LinkConfig,
    root: TempDir,
    wall_clock: Option<PathBuf>,
    _seats: Vec<File>,
}

impl Instance {
    /// Waits for its turn.
    #[must_use]
    pub fn new() -> Self {
        Self::seated(|count| vec![seats::one(count)])
    }

    /// One beside which there is no other: for what measures, and for what loads every core.
    #[must_use]
    pub fn alone() -> Self {
        let instance = Self::seated(|_| seats::all());
        let _binary = glidepath();
        instance
    }

    fn seated(seats: impl FnOnce(u32) -> Vec<File>) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let seats = seats(count);
        let root = tempfile::Builder::new()
            .prefix("glidepath-e2e")
            .tempdir_in("/dev/shm")
            .unwrap();
        let mut config = LinkConfig::new(&format!("e2e-{}-{count}", std::process::id()));
        // Where processes look that have this directory as their runtime directory.
        config.root = root.path().join("glidepath");
        Self {
            config,
            root,
            wall_clock: None,
            _seats: seats,
        }
    }

    /// The same for a test of processes, with the binary at hand: that can take long where it has
    /// to be built.
    #[must_use]
    pub fn for_processes() -> Self {
        let instance = Self::new();
        let _binary = glidepath();
        instance
    }

    /// From now on processes start with a wall clock that jumps.
    #[must_use]
    pub fn with_a_wall_clock_that_jumps(mut self) -> Self {
        self.wall_clock = Some(wall_clock::make(self.directory()));
        self
    }

    /// What processes load first, for their wall clock to jump.
    pub(crate) fn wall_clock(&self) -> Option<&Path> {
        self.wall_clock.as_deref()
    }

    /// How processes find each other.
    #[must_use]
    pub const fn config(&self) -> &LinkConfig {
        &self.config
    }

    /// A directory for the files of the test.
    #[must_use]
    pub fn directory(&self) -> &Path {
        self.root.path()
    }

    /// A way to the services, for this thread.
    #[must_use]
    pub fn connect(&self) -> Ipc {
        Ipc::connect(&self.config).unwrap()
    }

    /// Waits for a status that pleases; the test ends with the last one if none comes.
    pub fn wait_for_status(&self, wanted: impl Fn(&Status) -> bool) -> Status {
        let transport = self.connect();
        let mut source = transport.status_source().unwrap();
        let begun = Instant::now();
        let mut last = None;
        loop {
            last = source.take().unwrap().or(last);
            if let Some(status) = last.filter(&wanted) {
                return status;
            }
            assert!(begun.elapsed() < PATIENCE, "{last:#?}");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Writes a file for the test; returns its path.
    #[must_use]
    pub fn file(&self, name: &str, text: &str) -> String {
        let path = self.root.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    }

    /// The path of a file that a process is to write.
    #[must_use]
    pub fn path(&self, name: &str) -> String {
        self.root.path().join(name).to_str().unwrap().to_owned()
    }

    /// What lies in shared memory of this instance, and of others that a process made in the same
    /// runtime directory.
    #[must_use]
    pub fn shared_memory(&self) -> Vec<String> {
        let instances = std::fs::read_dir(&self.config.root).into_iter().flatten();
        let directories = instances.filter_map(|instance| Some(instance.ok()?.path()));
        let files = directories.flat_map(|path| std::fs::read_dir(path).into_iter().flatten());
        let names = files.filter_map(|file| file.ok()?.file_name().into_string().ok());
        names.filter(|name| name.starts_with("gp_")).collect()
    }
}

impl Default for Instance {
    fn default() -> Self {
        Self::new()
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        let removed = remove_leftovers(&self.config);
        if !std::thread::panicking() {
            assert!(
                matches!(removed, Ok(true)),
                "the instance is still in use: {removed:?}"
            );
            assert_eq!(
                self.shared_memory(),
                Vec::<String>::new(),
                "left in shared memory"
            );
        }
    }
}
