//! The service: what is executed when, and for whom.
//!
//! * `readiness` is whether the machine is ready for a program, and where the one before it was left.
//! * `job` is a line, lines or a program, with who executes it; `job_queue` is where they are handed in, one at a time, and
//!   `job_client_handler` attends to the client of the one in execution.
//! * `listen` waits for all of them, and for streams of segments.
//!
//! It may know every other room, and none knows it.

pub(crate) mod job;
pub(crate) mod job_client_handler;
pub(crate) mod job_queue;
pub(crate) mod listen;
pub(crate) mod readiness;
