//! Straight moves that one can lay a ruler to: both ways of planning keep them straight in their middle half.

/// From which length on a straight feed move has such a middle half, mm.
pub(crate) const RULED_MM: f64 = 5.0;
/// How far the motion may be beside it there, mm: a tolerance is for corners and curves.
pub(crate) const BESIDE_MM: f64 = 1e-3;
/// What of that such a move may turn by when it is drawn together with others, mm.
pub(crate) const TURNED_MM: f64 = 0.4 * BESIDE_MM;
