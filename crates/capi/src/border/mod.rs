//! The border: the functions that other languages call.
//!
//! Here, and nowhere else, pointers become references and back: in [`handle`] (a handle, its kind
//! and its thread) and [`pointer`] (arguments that may be null), by types that only a caller in C
//! can make. The functions themselves are safe; what they have in common is in [`call`] (panics and
//! failures become codes). Each is documented in the header.
#![allow(
    unsafe_code,
    reason = "functions of C have unmangled names, and pointers whose ends nobody checks"
)]

mod call;
mod feedback;
mod handle;
mod jog;
mod link;
mod pointer;
mod segments;
mod servo;
mod setpoints;
mod text;
mod thread;
mod wording;
