//! CYCLE802: positions one by one, up to nine of them.
//!
//! `CYCLE802(XA, YA, X0, Y0, … X8, Y8, VARI, UMODE, DMODE)`: of XA and YA the ones say of X0 and Y0 how
//! they are meant, the tens of X1 and Y1, and so on: 1 a coordinate, 2 the way from the position before.
//! What is left out behind the last position is none. VARI and UMODE are 0; DMODE is 0, or 1, 2 or 3 in
//! the plane G17, G18 or G19.

use glidepath_geometry::Plane;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::newer_arguments::number_of;

/// Positions of one call.
const MOST: usize = 9;
/// The first argument that is a coordinate.
const FIRST: usize = 2;
/// VARI, UMODE and DMODE.
const VARIANT: usize = FIRST + 2 * MOST;
const DMODE: usize = VARIANT + 2;

/// How a coordinate of a position is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Absolute,
    Increment,
}

/// What the digit of a position says; without any all are coordinates.
fn way(digits: Option<f64>, position: usize) -> Option<Way> {
    let Some(digits) = digits else {
        return Some(Way::Absolute);
    };
    let mut rest = digits;
    for _ in 0..position {
        rest = (rest / 10.0).trunc();
    }
    let is = |digit: f64| (rest % 10.0 - digit).abs() < 1e-6;
    match position {
        1.. if is(2.0) => Some(Way::Increment),
        _ => is(1.0).then_some(Way::Absolute),
    }
}

/// The positions of a call, in the two axes of the plane.
pub(super) fn single_places(
    arguments: &[Option<f64>],
    plane: Plane,
    span: SourceSpan,
) -> Outcome<Vec<[f64; 2]>> {
    let get = |index: usize| arguments.get(index).copied().flatten();
    let refuse = |message: &str, reason: &str, help: &str| {
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                .because(reason)
                .help(help),
        )
    };
    let others = [VARIANT, VARIANT + 1].into_iter().filter_map(get);
    let is_other = others.into_iter().any(|value| value != 0.0)
        || get(DMODE).is_some_and(|mode| mode != 0.0 && Some(mode) != number_of(plane))
        || arguments.iter().skip(DMODE + 1).any(Option::is_some);
    if is_other {
        return refuse(
            "CYCLE802 with other modes than 0",
            "of VARI, UMODE and DMODE only the plane in force is read: 1 in G17, 2 in G18, 3 in G19",
            "leave them out, or write each position as a block behind MCALL",
        );
    }
    let mut places: Vec<[f64; 2]> = Vec::new();
    for position in 0..MOST {
        let values = [0, 1].map(|axis| get(FIRST + 2 * position + axis));
        let [Some(first), Some(second)] = values else {
            if values == [None, None] {
                break;
            }
            return refuse(
                "a position of CYCLE802 with one coordinate",
                "a position has two",
                "write both",
            );
        };
        let before = places.last().copied().unwrap_or_default();
        let mut place = [first, second];
        for (axis, value) in place.iter_mut().enumerate() {
            match way(get(axis), position) {
                Some(Way::Absolute) => {}
                Some(Way::Increment) => *value += before[axis],
                None => {
                    return refuse(
                        "XA or YA of CYCLE802 with another digit than 1 and 2",
                        "1 is a coordinate, 2 the way from the position before, which the first has none of",
                        "write a digit for each position, that of the first one last",
                    );
                }
            }
        }
        places.push(place);
    }
    let rest = FIRST + 2 * places.len();
    if places.is_empty() || (rest..VARIANT).filter_map(get).count() > 0 {
        return refuse(
            "CYCLE802 with a gap between its positions",
            "the positions follow each other, from X0 and Y0 on",
            "write them without a gap",
        );
    }
    Ok(places)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(arguments: &[f64]) -> Option<Vec<[f64; 2]>> {
        let arguments: Vec<Option<f64>> = arguments.iter().copied().map(Some).collect();
        single_places(&arguments, Plane::Xy, SourceSpan::default()).ok()
    }

    #[test]
    fn positions_by_hand() {
        // X1 counts from X0, all others are coordinates.
        assert_eq!(
            places(&[111_111_121.0, 111_111_111.0, 10.0, 5.0, 20.0, 7.0]),
            Some(vec![[10.0, 5.0], [30.0, 7.0]])
        );
        assert_eq!(places(&[112.0, 111.0, 1.0, 1.0]), None);
        assert_eq!(places(&[111.0, 111.0, 1.0]), None);
        assert_eq!(places(&[111.0, 111.0]), None);
    }
}
