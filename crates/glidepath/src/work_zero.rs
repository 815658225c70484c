//! The zero of a program in machine coordinates, for who looks at it.

use crate::config::MachineConfig;
use glidepath_geometry::AxisVector;
use glidepath_planner::{FileSource, ItemSource as _, Supply};
use glidepath_program::ItemKind;
use std::path::Path;

/// Items that are read at most until the first feed move.
const MOST_ITEMS: usize = 100_000;

/// The zero in force at the first feed move of a program, with all offsets; none for curves, which
/// have none, and where the program cannot be read that far.
#[must_use]
pub(crate) fn find(path: &Path, config: &MachineConfig) -> Option<AxisVector> {
    let options = config.program_options(config.start());
    let mut source = FileSource::unchecked(path, options, &config.settings()).ok()?;
    for _ in 0..MOST_ITEMS {
        match source.next_item() {
            Supply::Item(item) => {
                if matches!(item.kind, ItemKind::Move { rate, .. } if !rate.is_rapid()) {
                    break;
                }
            }
            Supply::Pending | Supply::Probe => {}
            Supply::End => break,
            Supply::Refused(_) => return None,
        }
    }
    source.in_force().map(|in_force| in_force.zero())
}
