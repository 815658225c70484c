//! The table in the documentation of `glidepath_motion::preview`: points evaluated by the three
//! methods on the reference curves.
//!
//! `cargo run --release -p glidepath-motion --example preview_table >
//! crates/motion/src/preview/table.md`
#![allow(clippy::print_stdout, reason = "a command that prints")]

#[path = "../tests/it/preview/curves.rs"]
mod curves;
#[path = "../tests/it/preview/table.rs"]
mod table;

fn main() {
    print!("{}", table::markdown());
}
