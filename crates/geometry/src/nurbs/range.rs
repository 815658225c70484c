//! The numbers a curve may be made of: those with which lengths and pieces come out with digits to
//! spare. Beyond, halving a span goes on for ever, because no half is better known than the whole.

/// How far a coordinate may be from zero, mm or degrees: the longest travel an axis may have. A
/// double then resolves 1e-10 mm.
pub(super) const MOST_MM: f64 = 1e6;
/// The least weight and the largest: their ratio takes as many digits from the points between, and
/// leaves a nanometre of a metre.
pub(super) const LEAST_WEIGHT: f64 = 1e-6;
pub(super) const MOST_WEIGHT: f64 = 1e6;
/// How far a knot may be from zero: where it counts millimetres, a thousand kilometres.
pub(super) const MOST_KNOT: f64 = 1e9;
/// The least difference of the last knot from the first: the fifth derivative by the parameter is
/// as its fifth power.
pub(super) const LEAST_DOMAIN: f64 = 1e-9;
