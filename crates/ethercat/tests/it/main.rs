//! The bridge against emulated drives: on a wire in memory, whose time is none but its own, and on a
//! pair of virtual interfaces.
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    clippy::panic,
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "tests"
)]

mod axes;
mod bring_up;
mod captures;
mod encoder;
mod ending;
mod feed_forward;
mod gears;
mod history;
mod judge;
mod life;
mod load_side;
mod losses;
mod machine;
mod maps;
mod matrix;
mod modulo;
mod orientation;
mod probing;
mod segments;
mod spindle;
mod terminals;
mod terminals_up;
mod threads;
mod torque_limits;
mod whole_machine;
mod wire;

/// The thread of the bus does not allocate.
#[global_allocator]
static ALLOCATOR: glidepath_realtime::CountingAllocator = glidepath_realtime::CountingAllocator;
