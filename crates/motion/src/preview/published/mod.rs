//! The two older methods, reproduced as published: to compare with the certified one.

mod advance_retreat;
mod traditional;

pub use advance_retreat::AdvanceRetreat;
pub use traditional::Traditional;
