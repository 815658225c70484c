//! The corners of a run of points: places where it turns so sharply that no smooth curve belongs
//! there.

use crate::point::Point;

/// The points without those that repeat the one before them, which has no direction.
pub(crate) fn distinct(points: &[Point]) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::with_capacity(points.len());
    for point in points {
        if kept.last().is_none_or(|last| (point - last).norm() > 1e-9) {
            kept.push(*point);
        }
    }
    kept
}

/// Indices at which to split: both ends, and between them every point where the polyline turns by
/// more than the angle. Of neighbouring points only the one that turns most: a sharp tip that was
/// sampled shows as several corners in a row.
pub(crate) fn split_at_tips(points: &[Point], angle_rad: f64) -> Vec<usize> {
    let turns = turns(points, angle_rad);
    let tips = turns
        .chunk_by(|a, b| a.0 + 1 == b.0)
        .filter_map(|row| row.iter().max_by(|a, b| a.1.total_cmp(&b.1)))
        .map(|tip| tip.0);
    core::iter::once(0)
        .chain(tips)
        .chain(core::iter::once(points.len() - 1))
        .collect()
}

/// The point inside that turns most, if it turns by more than the angle.
pub(crate) fn sharpest(points: &[Point], angle_rad: f64) -> Option<usize> {
    let turns = turns(points, angle_rad);
    let sharpest = turns.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    sharpest.map(|(index, _)| *index)
}

/// Indices of the points that turn by more than the angle, with their turns.
fn turns(points: &[Point], angle_rad: f64) -> Vec<(usize, f64)> {
    let turn = |three: &[Point]| {
        let (before, after) = (three[1] - three[0], three[2] - three[1]);
        before.cross(&after).norm().atan2(before.dot(&after))
    };
    let all = points.windows(3).map(turn).enumerate();
    all.filter(|(_, turn)| *turn > angle_rad)
        .map(|(i, turn)| (i + 1, turn))
        .collect()
}
