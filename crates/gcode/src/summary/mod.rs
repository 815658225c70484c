//! The summary of a program: counts and sums, and what is seen along its path.

pub(crate) mod extent;
pub(crate) mod part_box;
pub(crate) mod pole_turns;
pub(crate) mod remark;
pub(crate) mod survey;
pub(crate) mod totals;
