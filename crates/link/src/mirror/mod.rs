//! The mirror: setpoints and status of an instance as ordinary services of iceoryx2, for any program
//! that looks on.
//!
//! [`Mirror::open`] makes the services, and [`Mirror::relay`] hears an instance as every consumer
//! does and publishes what it hears. The services are iceoryx2's own (`ipc::Service`, stock storage),
//! in the domain of its stock programs or in one of the user's:
//!
//! | service | type | buffer of a reader | history |
//! |---|---|---|---|
//! | `glidepath/INSTANCE/setpoints` | [`SetpointMirror`] | 1024 | 1 |
//! | `glidepath/INSTANCE/status` | [`StatusMirror`] | 16 | 1 |
//!
//! Each has room for 16 readers and one publisher. A reader that is behind by more than its buffer
//! loses the oldest, which the numbers in the records show. Nobody is waited for.
//!
//! What is read there can be forged by any program of the same user, and ended by others. So the
//! records have types of their own, which nothing that moves drives accepts, and nothing ever comes
//! back from the services.

mod copies;
mod error;
mod gap;
mod obstacle;
mod record;
mod reserve;
mod shortage;

pub use error::MirrorError;
pub use gap::Gap;
pub use obstacle::obstacle;
pub use record::{SetpointMirror, StatusMirror};
pub use shortage::MirrorNote;

use crate::{LinkError, Record as _, Transport};
use copies::{Copies, Depth, Domain};
use core::sync::atomic::{AtomicBool, Ordering};
use gap::Gaps;
use reserve::Reserved;
use shortage::Shortage;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Between two looks: no longer than a setpoint of the fastest machine applies.
const POLL: Duration = Duration::from_millis(1);
/// Between two looks for processes that died, and for readers that came.
const CHORES_EVERY: Duration = Duration::from_millis(200);

/// The settings of a mirror.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MirrorSettings {
    /// Name of the instance, part of the services' names.
    pub instance: String,
    /// Directory of iceoryx2's domain; `None` for that of its stock programs on this host.
    pub root: Option<PathBuf>,
}

/// How many records were mirrored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MirrorCounts {
    /// Setpoints published.
    pub setpoints: u64,
    /// Status records published.
    pub statuses: u64,
    /// Setpoints of the interpolator that never came here.
    pub lost: u64,
    /// Records that failed their check, and were left out.
    pub refused: u64,
}

/// The stock services of an instance. It stays in the thread that opened it.
#[derive(Debug)]
pub struct Mirror {
    setpoints: Copies<SetpointMirror>,
    statuses: Copies<StatusMirror>,
    /// After the ports.
    domain: Domain,
    reserved: Reserved,
    shortage: Shortage,
}

impl Mirror {
    /// Makes the services. What a mirror left that was killed is cleaned up.
    ///
    /// This takes as long as iceoryx2 takes, which may be for ever where another user has put a file
    /// in its way: a caller that has to end in time calls it in a thread of its own.
    ///
    /// # Errors
    ///
    /// [`MirrorError`], but not [`MirrorError::Link`].
    pub fn open(settings: &MirrorSettings) -> Result<Self, MirrorError> {
        let domain = Domain::join(settings.root.as_deref())?;
        let name = |what| format!("glidepath/{}/{what}", settings.instance);
        let mut mirror = Self {
            setpoints: domain.copies(&name("setpoints"), Depth::SETPOINTS)?,
            statuses: domain.copies(&name("status"), Depth::STATUS)?,
            domain,
            reserved: Reserved::default(),
            shortage: Shortage::default(),
        };
        mirror.reserved.take()?;
        Ok(mirror)
    }

    /// Hears an instance, and publishes what it hears, until `ending` is set. Tells of setpoints that
    /// never came, and of memory that readers who came would need. The interpolator may end and start again meanwhile.
    ///
    /// # Errors
    ///
    /// [`MirrorError::Link`] if the instance cannot be heard, or was removed;
    /// [`MirrorError::Publish`].
    pub fn relay(
        &mut self,
        link: &dyn Transport,
        ending: &AtomicBool,
        tell: &mut dyn FnMut(MirrorNote),
    ) -> Result<MirrorCounts, MirrorError> {
        let mut setpoints = link.setpoint_source()?;
        let mut statuses = link.status_source()?;
        let mut counts = MirrorCounts::default();
        let mut gaps = Gaps::default();
        let mut chores = Instant::now();
        while !ending.load(Ordering::Relaxed) {
            while let Some(setpoint) = setpoints.take()? {
                if setpoint.check().is_err() {
                    counts.refused += 1;
                    continue;
                }
                if let Some(gap) = gaps.next(&setpoint) {
                    counts.lost += gap.count();
                    tell(MirrorNote::Lost(gap));
                }
                self.setpoints.publish(SetpointMirror(setpoint))?;
                counts.setpoints += 1;
            }
            while let Some(status) = statuses.take()? {
                if status.check().is_err() {
                    counts.refused += 1;
                    continue;
                }
                self.statuses.publish(StatusMirror(status))?;
                counts.statuses += 1;
            }
            if chores.elapsed() >= CHORES_EVERY {
                chores = Instant::now();
                self.clean_up(link)?;
                let note = self.shortage.next(self.reserved.take());
                note.into_iter().for_each(&mut *tell);
            }
            std::thread::sleep(POLL);
        }
        Ok(counts)
    }

    /// Frees what the dead hold on both sides, and gives readers that came the last record.
    fn clean_up(&mut self, link: &dyn Transport) -> Result<(), MirrorError> {
        link.clean_up_dead_peers()?;
        link.stands()?;
        self.domain.clean_up();
        self.setpoints.refresh()?;
        self.statuses.refresh()?;
        Ok(())
    }
}

impl From<LinkError> for MirrorError {
    fn from(error: LinkError) -> Self {
        Self::Link(error)
    }
}
