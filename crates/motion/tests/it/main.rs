//! Tests of plans, held against limits, brute force, and what is known of them otherwise.

mod along_nurbs;
mod butterfly;
mod dense;
mod diagnosis;
mod figure;
mod helices;
mod interleaving;
mod joints;
mod limits;
mod overrides;
mod plan;
mod planned;
mod preview;
mod rates;
mod refusals;
mod scurve;
mod small_arcs;
mod straight_walls;
#[path = "../support/mod.rs"]
mod support;
mod tolerance_split;
