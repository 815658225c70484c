//! Solver of the convex sub-problem: [`problem`] states it, [`interior`] solves it, [`band`] does
//! the linear algebra. Everything is linear in the number of knot intervals, and allocates nothing
//! once it has been used at full size.

mod ahead;
mod band;
mod constraints;
mod hard_constraint;
mod interior;
mod normal;
mod problem;
mod rest;
mod soft_constraint;
#[cfg(test)]
mod tests;

pub(super) use interior::{Allowance, Goal, Interior};
pub(super) use problem::{FAR, FIRM_PRICE, PRICE, Problem, RowBounds, SPAN, WideRow, combine, dot};
