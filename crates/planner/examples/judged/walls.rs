//! Walls round a program: travel that ends where the program does.

use glidepath_geometry::AxisVector;
use glidepath_program::{Item, ItemKind, Travel};

/// Ends of travel on every axis where the program itself ends, and where the machine stands before it.
pub(crate) fn walls(items: &[Item]) -> Travel {
    let mut travel = Travel {
        lowest: AxisVector::zeros(),
        highest: AxisVector::zeros(),
    };
    for item in items {
        if let ItemKind::Move { segment, .. } = &item.kind {
            let (low, high) = segment.bounding_box();
            travel.lowest = travel.lowest.inf(&low);
            travel.highest = travel.highest.sup(&high);
        }
    }
    travel
}
