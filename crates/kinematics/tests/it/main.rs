//! Tests of mechanisms, held against vectors, and there and back.

mod caps;
mod five_axis;
mod mechanisms;
mod support;
mod vectors;
