//! Tests of curves, held against vectors, and against what is known of them otherwise.

mod arcs;
mod bezier_pair;
mod corner_vectors;
mod cubic;
mod numbers;
mod nurbs;
mod pieces;
mod support;
mod transitions;
