//! Tests of what is kept, whenever the power goes.

mod disk;
mod files;
mod generations;
mod power_cut;
mod texts;
