//! What an operator looks at while the machine works.

mod object;
mod screen;
mod seen;

pub use object::view_object;
pub use screen::view_text;
pub use seen::{Place, View, WorkOffset};
