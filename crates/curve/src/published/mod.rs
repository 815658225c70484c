//! The methods of Lu, Zhao, Wang, Jiang (2010), kept for comparison as they were published. Nothing
//! else in this crate uses them. Their third method, the bisection of a chord, is a way to solve
//! the same equation inside the same bracket:
//! [`parametric::Method::Bisection`](crate::parametric::Method::Bisection).

mod equal_division;
mod linear_step;

pub use equal_division::{EqualChords, equal_chords};
pub use linear_step::{Reading, linear_step};
