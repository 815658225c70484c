//! The errors of what is kept: why it cannot be used.

use glidepath_persistence::StoreError;
use thiserror::Error;

/// Why what is kept cannot be used.
#[derive(Debug, Error)]
pub(crate) enum StateError {
    /// It cannot be read or written.
    #[error(transparent)]
    Kept(StoreError),
    /// Another process writes it.
    #[error(
        "{0}. If it executes a program, wait for its end, or end it with `glidepath abort`; a planner's service takes \
         programs itself, by `glidepath run-file FILE`. Two machines need a `directory` of [state] each"
    )]
    Taken(StoreError),
    /// A file is damaged.
    #[error(
        "{0}. Nothing moves before somebody has decided: `glidepath offsets recover` takes the newest \
         generation that is whole, and shows it"
    )]
    Damaged(StoreError),
    /// No file is whole.
    #[error(
        "{source}, and no other generation in {folder} is whole: what was kept is lost. Move the files kept.0 and \
         kept.1 there away, and set it anew: `glidepath offsets --help` tells how"
    )]
    Lost {
        /// The folder.
        folder: String,
        /// What is wrong with the last file that was read.
        source: StoreError,
    },
    /// What was there before is there no longer.
    #[error(
        "what the machine keeps in {folder} is gone or was set back: generation {newest} was there before. Nothing \
         moves with other offsets than those. Put the files kept.0 and kept.1 back, or mount their disk; to go on \
         with what is there now, restart the planner's service"
    )]
    Gone {
        /// The folder.
        folder: String,
        /// The newest generation that was there.
        newest: u64,
    },
    /// What inputs and the probe answered is not known any more.
    #[error(
        "{0}. The program cannot be taken up again behind what it asked of inputs or the probe; run it \
         from its beginning, which writes that file anew"
    )]
    Answers(StoreError),
    /// It is that of another machine.
    #[error(
        "what is kept in {folder} belongs to a machine with other axes or other kinematics. \
         `glidepath offsets show` shows it, `glidepath offsets adopt` takes it over for this machine"
    )]
    OtherMachine {
        /// The folder.
        folder: String,
    },
    /// The configuration names no folder.
    #[error("the configuration names no folder to keep anything in: `directory` of [state]")]
    NoFolder,
    /// The thread that writes ended.
    #[error("the thread that writes what is kept ended")]
    NoWriter,
}

impl From<StoreError> for StateError {
    fn from(error: StoreError) -> Self {
        match error {
            error @ StoreError::Taken { .. } => Self::Taken(error),
            error @ StoreError::Damaged { .. } => Self::Damaged(error),
            error => Self::Kept(error),
        }
    }
}
