//! What commands report, as text and as JSON.

mod memory;
mod motion;
mod quantity;

pub use memory::peak_rss_bytes;
pub use motion::MotionReport;
pub use quantity::{grouped, seconds};
