//! Where a time parametrisation takes the place of S-curves.

mod motion_chain;
mod refiner;
mod worth;

pub(crate) use refiner::{RATE_R, Refiner};
