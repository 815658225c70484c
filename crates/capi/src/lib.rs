//! `libglidepath`: setpoints, status, commands, feedback and the servo for programs in C, and in
//! every language that can call C.
//!
//! ```text
//! C, C++, Python, … ─► border: pointers, threads, panics ─► glidepath-link ─► interpolator
//!                        layout: what structures look like ─► header, Python package, manual
//! ```
//!
//! The header [`glidepath.h`](../include/glidepath.h) is the documentation of the functions. The
//! structures are the records of `glidepath-link` themselves; [`layout`] lists their fields, and the
//! compiler refuses a record that is not as listed. From the lists come the structures of the
//! header, the Python package and the manual's page of offsets; a test compares them, and writes
//! them anew with `GLIDEPATH_BLESS=1 cargo test -p glidepath-capi --lib`.
//!
//! Invariants:
//!
//! * all `unsafe` code is in [`border`], but for what `Pod` is derived to;
//! * no panic leaves a function, and no function ends the process;
//! * a handle is used by the thread it belongs to, or not at all.

mod border;
mod failure;
mod layout;
mod servo;
