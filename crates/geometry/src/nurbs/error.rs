//! The errors of a NURBS definition: why numbers are no curve.

/// An error in the definition of a curve. Indices count from 0.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NurbsError {
    /// The degree is not supported.
    #[error("degree {degree}: it must be 1 to {max}", max = super::degree::MAX_DEGREE)]
    Degree {
        /// The degree asked for.
        degree: usize,
    },
    /// Fewer control points than one span needs.
    #[error("{points} control points: degree {degree} needs at least {}", degree + 1)]
    TooFewPoints {
        /// Control points given.
        points: usize,
        /// The degree.
        degree: usize,
    },
    /// Not one weight for each control point.
    #[error("{weights} weights for {points} control points: each point has one")]
    WeightCount {
        /// Weights given.
        weights: usize,
        /// Control points given.
        points: usize,
    },
    /// Not the number of knots the points and the degree call for.
    #[error("{knots} knots: control points + degree + 1 makes {expected}")]
    KnotCount {
        /// Knots given.
        knots: usize,
        /// Knots needed.
        expected: usize,
    },
    /// A coordinate that is infinite or no number.
    #[error("control point {index} is not finite")]
    Point {
        /// Its index.
        index: usize,
    },
    /// A coordinate too far from zero for its digits to mean anything.
    #[error("control point {index} is farther than {max} mm from zero", max = super::range::MOST_MM)]
    FarPoint {
        /// Its index.
        index: usize,
    },
    /// A weight whose ratio to the others leaves too few digits for the points.
    #[error(
        "weight {index} is {weight}: weights are {min} to {max}",
        min = super::range::LEAST_WEIGHT,
        max = super::range::MOST_WEIGHT
    )]
    WeightRange {
        /// Its index.
        index: usize,
        /// Its value.
        weight: f64,
    },
    /// A knot too far from zero.
    #[error("knot {index} is {knot}: knots are within {max}", max = super::range::MOST_KNOT)]
    KnotRange {
        /// Its index.
        index: usize,
        /// Its value.
        knot: f64,
    },
    /// Knots so near to each other that derivatives by them have no value.
    #[error(
        "the knots go from {from_u} to {to_u}: they span {min} at least",
        min = super::range::LEAST_DOMAIN
    )]
    ShortDomain {
        /// The first.
        from_u: f64,
        /// The last.
        to_u: f64,
    },
    /// A weight that is not positive and finite.
    #[error("weight {index} is {weight}: weights are greater than zero")]
    Weight {
        /// Its index.
        index: usize,
        /// Its value.
        weight: f64,
    },
    /// A knot that is infinite, no number, or below the one before it.
    #[error("knot {index} is {knot}: knots are finite and never descend")]
    KnotOrder {
        /// Its index.
        index: usize,
        /// Its value.
        knot: f64,
    },
    /// A knot inside the curve so often that the curve would have a gap.
    #[error(
        "the knot {knot} stands {multiplicity} times inside a curve of degree {degree}: at most {degree} times"
    )]
    KnotMultiplicity {
        /// Its value.
        knot: f64,
        /// How often it is there.
        multiplicity: usize,
        /// The degree.
        degree: usize,
    },
    /// The knots leave no room for a curve.
    #[error("the knots leave no interval for the curve: knot {first} and knot {last} are equal")]
    EmptyDomain {
        /// Index of the knot at the start of the curve.
        first: usize,
        /// Index of the knot at its end.
        last: usize,
    },
    /// A part of the curve is a single point.
    #[error(
        "from u = {from_u} to {to_u} all control points coincide: the curve stands still there"
    )]
    StandsStill {
        /// Start of the part.
        from_u: f64,
        /// End of the part.
        to_u: f64,
    },
}
