//! What commands report, as text and as JSON.

mod finding;
mod memory;
mod motion;
mod quantity;

pub use finding::{ProgramFinding, finding_object};
pub use memory::peak_rss_bytes;
pub use motion::{MotionReport, Planning};
pub use quantity::{grouped, seconds};
