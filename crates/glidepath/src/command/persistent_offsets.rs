//! The work offsets that the machine keeps, and the offsets in force beside them.

use crate::config::MachineConfig;
use crate::persistence::convert::system_name;
use crate::position_offsets_note;
use crate::report::WorkOffset;
use glidepath_gcode::PositionOffsets;
use glidepath_kinematics::FiveAxis;
use glidepath_link::{LinkConfig, Status};
use glidepath_persistence::{Directory, Store};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Between two looks at the offsets. Those beside them are looked at every time: they change under way.
const EVERY: Duration = Duration::from_secs(1);

/// What is kept, looked at now and then.
pub(super) struct PersistentOffsets {
    folder: Option<PathBuf>,
    /// The directory of the instance.
    directory: PathBuf,
    five_axis: Option<FiveAxis>,
    looked: Option<Instant>,
    offset: Option<WorkOffset>,
}

impl PersistentOffsets {
    pub(super) fn new(config: &MachineConfig, link: &LinkConfig) -> Self {
        Self {
            folder: config.state_directory.clone(),
            directory: link.directory(),
            five_axis: config.five_axis(),
            looked: None,
            offset: None,
        }
    }

    /// The coordinate system in force; `None` if none is kept, it cannot be read just now, or the machine executes a
    /// stream: which offsets its program has in force, nobody here knows.
    pub(super) fn look(&mut self, status: &Status) -> Option<WorkOffset> {
        if status.is_of_stream() {
            return None;
        }
        let is_due = self.looked.is_none_or(|looked| looked.elapsed() >= EVERY);
        if is_due {
            self.looked = Some(Instant::now());
            self.offset = self.read();
        }
        let offset = self.offset.clone()?;
        Some(WorkOffset {
            beside: position_offsets_note::in_force(&self.directory),
            ..offset
        })
    }

    fn read(&self) -> Option<WorkOffset> {
        let folder = self.folder.as_deref()?;
        let (_, kept) = Store::new(Directory::at(folder)).read().ok()??;
        let system = usize::from(kept.offsets.active).checked_sub(1)?;
        let system = kept.offsets.systems.get(system)?;
        Some(WorkOffset {
            name: system_name(kept.offsets.active),
            origin: system.origin,
            rotation_deg: system.rotation_deg,
            beside: PositionOffsets::default(),
            five_axis: self.five_axis,
        })
    }
}
