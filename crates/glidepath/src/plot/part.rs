//! The part: what of a track the views fit.
//!
//! Where the machine stands before a program is no part of what it makes. A rapid from there, or to a
//! tool change, may be ten times as long as the part: it is drawn as far as it is in view, and does
//! not set the scale.

use super::track::TrackPoint;

/// Rapids are in view as far as they are no further from the feed moves than this share of the
/// largest extent of those.
const AROUND_R: f64 = 0.5;

/// The points that have to be in view: feed moves with their starts, and rapids near them. Without
/// feed moves all.
pub(super) fn of(points: &[TrackPoint]) -> Vec<[f64; 3]> {
    let is_cut = |index: usize| {
        let feeds = |point: &TrackPoint| !point.rapid;
        let is_start = points.get(index + 1).is_some_and(feeds);
        is_start || (index > 0 && points.get(index).is_some_and(feeds))
    };
    let mut extent: Option<([f64; 3], [f64; 3])> = None;
    for (index, point) in points.iter().enumerate() {
        if is_cut(index) {
            let (low, high) = extent.get_or_insert((point.at, point.at));
            for axis in 0..3 {
                low[axis] = low[axis].min(point.at[axis]);
                high[axis] = high[axis].max(point.at[axis]);
            }
        }
    }
    let Some((low, high)) = extent else {
        return points.iter().map(|point| point.at).collect();
    };
    let largest = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
    let around = AROUND_R * largest;
    let is_near =
        |at: &[f64; 3]| (0..3).all(|i| (low[i] - around..=high[i] + around).contains(&at[i]));
    let shown = points.iter().map(|point| point.at);
    shown.filter(is_near).collect()
}

/// Smallest and largest X, Y, Z of some points; of none all zero.
pub(super) fn extent(points: &[[f64; 3]]) -> ([f64; 3], [f64; 3]) {
    let Some((first, others)) = points.split_first() else {
        return ([0.0; 3], [0.0; 3]);
    };
    let both = |(low, high): ([f64; 3], [f64; 3]), at: &[f64; 3]| {
        (
            core::array::from_fn(|i| low[i].min(at[i])),
            core::array::from_fn(|i| high[i].max(at[i])),
        )
    };
    others.iter().fold((*first, *first), both)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(points: &[([f64; 3], bool)]) -> Vec<TrackPoint> {
        let point = |&(at, rapid): &([f64; 3], bool)| TrackPoint {
            at,
            feed_v: 10.0,
            rapid,
            bound: None,
        };
        points.iter().map(point).collect()
    }

    #[test]
    fn rapids_from_afar_are_no_part_and_those_between_cuts_are() {
        let cut = [([300.0, 200.0, -1.0], false), ([320.0, 200.0, -1.0], false)];
        let approach = [([0.0; 3], true), ([300.0, 200.0, 5.0], true)];
        let retract = [([320.0, 200.0, 5.0], true), ([0.0; 3], true)];
        let all = [&approach[..], &cut, &retract].concat();
        let (low, high) = extent(&of(&track(&all)));
        assert_eq!((low, high), ([300.0, 200.0, -1.0], [320.0, 200.0, 5.0]));
    }

    #[test]
    fn without_feed_moves_everything_is_shown() {
        let all = track(&[([0.0; 3], true), ([300.0, 1.0, 0.0], true)]);
        assert_eq!(extent(&of(&all)), ([0.0; 3], [300.0, 1.0, 0.0]));
        assert_eq!(extent(&of(&[])), ([0.0; 3], [0.0; 3]));
    }
}
