//! The resume point: where a program was left.

use glidepath_gcode::Probed;
use glidepath_geometry::AxisVector;
use glidepath_link::{ContactKind, EndOfEpoch, LinkError, MotionMode, Status};

use crate::run::error::RunError;
use crate::run::resume_error::ResumeError;

/// The point at which a program was left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResumePoint {
    /// Where the machine stands.
    pub position: AxisVector,
    /// Where it stood when the program began: what the program is read with.
    pub program_start: AxisVector,
    /// Which program: see [`ItemSource::fingerprint`](crate::ItemSource::fingerprint).
    pub program: u64,
    /// The block being executed: see [`glidepath_link::SetpointFrame::block`].
    pub block: u32,
    /// Its line, 0 if unknown. On the way to the line that a program is begun at, that line, which the block is
    /// not of.
    pub line: u32,
    /// Path position, mm.
    pub path_s: f64,
    /// The same at the beginning of the block.
    pub block_path_s: f64,
    /// The event of that block was not answered, or not let pass: it is not done.
    pub unanswered: bool,
    /// What the probe has found in the motion that was left, for a machine that stands there.
    pub found: Option<Probed>,
}

impl ResumePoint {
    pub(crate) fn of(status: &Status) -> Result<Self, RunError> {
        match status.end_of_epoch().map_err(LinkError::from)? {
            EndOfEpoch::None => Err(ResumeError::NothingToResume)?,
            EndOfEpoch::Completed => Err(ResumeError::Completed)?,
            EndOfEpoch::Open | EndOfEpoch::Aborted | EndOfEpoch::Faulted | EndOfEpoch::Tripped => {}
        }
        let is_open = status.end_of_epoch == EndOfEpoch::Open.code();
        if is_open && status.mode().map_err(LinkError::from)? == MotionMode::Backwards {
            Err(ResumeError::GoesBack)?;
        }
        let position = AxisVector::from(status.position);
        let kind = status.contact().map_err(LinkError::from)?;
        let found = (kind != ContactKind::None).then(|| Probed {
            contact: Some(AxisVector::from(status.contact)),
            was_so: kind == ContactKind::AlreadySo,
            stands: position,
        });
        Ok(Self {
            position,
            program_start: AxisVector::from(status.program_start),
            program: status.program,
            block: status.block,
            line: status.line,
            path_s: status.path_s,
            block_path_s: status.block_path_s,
            unanswered: status.unanswered == 1,
            found,
        })
    }

    /// The machine does not stand on the path of a line of this program.
    pub(super) const fn off_path(&self, line: u32, away: Option<AxisVector>) -> RunError {
        RunError::Resume(ResumeError::OffPath {
            block: self.block,
            line,
            away,
        })
    }
}
