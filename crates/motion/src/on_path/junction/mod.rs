//! Where two segments meet.

mod decision;
mod stop_or_pass;

pub(crate) use decision::{Joint, Leg, chord_error_mm, join};
