//! The structure tests, which hold the plan of the code against it: which crate may know which, that
//! the files of a crate do not import each other in circles, and which room of a crate may know which.
//!
//! * `arrows`: the dependencies between crates are those that `crates/README.md` draws, and what it
//!   says must never know each other does not, directly or by way of others.
//! * `circles`: inside a crate, no file imports by way of others what imports it (`modules` reads
//!   the imports). The few circles that stand are named there, each with its reason.
//! * `links`: links between pages lead to what is there.
//! * `names`: no public type name stands twice across crates that know each other.
//! * `readmes`: the pages of crates on a registry say what their documentation says.
//! * `recipes`: what the recipes in the page for contributors name is there, and so are the tests that it runs.
//! * `rooms`: in a crate that has rooms, each imports those alone that `crates/README.md` draws, and every file is in one.
//! * `told`: people are not told names of variants, and no state or command is forgotten.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

#[cfg(test)]
mod arrows;
#[cfg(test)]
mod circles;
#[cfg(test)]
mod links;
#[cfg(test)]
mod modules;
#[cfg(test)]
mod names;
#[cfg(test)]
mod readmes;
#[cfg(test)]
mod recipes;
#[cfg(test)]
mod rooms;
#[cfg(test)]
mod told;

#[cfg(test)]
use std::path::{Path, PathBuf};

/// The top level of the project.
#[cfg(test)]
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .expect("the tests stand two folders below the top level")
        .to_path_buf()
}
