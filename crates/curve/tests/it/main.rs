//! Tests of curves by formulas, in equal chords.

mod expressions;
mod files;
mod implicit;
mod nodes;
mod parametric;
mod support;
mod table;
