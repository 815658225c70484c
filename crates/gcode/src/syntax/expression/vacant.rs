//! FANUC's null: what a variable holds that nothing was assigned to.
//!
//! A word with it counts as not written, `EQ` and `NE` tell it from zero, and it is zero in sums,
//! products, functions and the other comparisons. It is kept as a number that is none: every result
//! of an expression is finite ([`crate::syntax::expression::finite`]), so nothing else is one.

/// The null.
pub(crate) const VACANT: f64 = f64::NAN;

pub(crate) const fn is_vacant(value: f64) -> bool {
    value.is_nan()
}

/// The value in a sum: zero where there is none.
pub(crate) const fn or_zero(value: f64) -> f64 {
    if is_vacant(value) { 0.0 } else { value }
}
