//! The state that a machine keeps over a restart: coordinate systems, reference positions, the
//! offset of G92, what programs made of the tool table, where the machine rested last, and what it
//! answered the program under way.
//!
//! ```text
//!   PersistentState ─text──▶ checksum, version, generation ─Store─▶ kept.new ─fsync─▶ rename ─fsync folder─▶ done
//!    ▲                                                          (Storage: a folder, or a test's)
//!    └── var: LinuxCNC's parameter file, read and written by command
//! ```
//!
//! Two files take turns, `kept.0` and `kept.1`: a new generation is written beside them and renamed
//! over the older one, so that the newer one is never touched. Whenever the power goes, what is read
//! afterwards is the generation that was answered last, or the one that was being written, never a
//! mixture. A file that is damaged all the same is not passed over: the operator decides.
//!
//! * [`PersistentState`] is what is kept; nothing of it moves anything.
//! * [`Store`] reads and writes it; [`Directory`] is where.
//! * [`InputLog`] is what a program was told by inputs and by the probe.
//! * [`var`] converts LinuxCNC's parameter files.
//!
//! ```
//! use glidepath_persistence::{Directory, PersistentState, Store};
//!
//! let folder = tempfile::tempdir()?;
//! let mut store = Store::new(Directory::open(folder.path())?);
//! assert!(store.read()?.is_none());
//!
//! let mut kept = PersistentState::default();
//! kept.offsets.systems[0].origin[2] = -12.5;
//! store.write(&kept)?;
//! let (generation, read) = store.read()?.expect("it was just written");
//! assert_eq!((generation, read), (1, kept));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod directory;
mod error;
mod input_log;
mod state;
mod storage;
mod store;
mod text;
pub mod var;

pub use directory::{Directory, DirectoryLock};
pub use error::StoreError;
pub use input_log::{InputLog, LoggedInput, LoggedValue};
pub use state::{AXES, Offsets, PersistentState, Rest, SYSTEMS, System, Tool, UnderWay, Variable};
pub use storage::Storage;
pub use store::{SLOTS, Store};
