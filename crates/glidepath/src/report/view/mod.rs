//! The view of a machine that an operator looks at while it works.

mod ahead;
mod object;
mod screen;
mod seen;

pub use ahead::Ahead;
pub use object::view_object;
pub use screen::view_text;
pub use seen::{ProgramPlace, View};
