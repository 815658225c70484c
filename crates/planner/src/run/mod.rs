//! The run of a program as its caller sees it, and what all rooms say of it.
//!
//! * `control` is the caller's side: it stops a run, is told how far it is (with its `statistics`), and lends it a way to wait.
//! * `refusal`, `resume_error` and `error` are the reasons why a program is not planned, cannot be taken up again, or does
//!   not come to its end; `nearness` is how far two places are from each other, and what of it is rounding.
//! * `interval` is time that is waited for and measured.
//!
//! It may know no other room.

pub(crate) mod control;
pub(crate) mod error;
pub(crate) mod interval;
pub(crate) mod nearness;
pub(crate) mod refusal;
pub(crate) mod resume_error;
pub(crate) mod statistics;
