//! Tests of mechanisms, held against vectors, and there and back.

mod calibration;
mod caps;
mod curve_rates;
mod five_axis;
mod five_bar;
mod mechanisms;
mod other_formulas;
mod skewed;
mod support;
mod vectors;
