//! The refiner: it replaces S-curves by a time parametrisation where that is worth its work.

mod motion_chain;
mod refiner;
mod worth;

pub(crate) use refiner::{RATE_R, Refiner};
