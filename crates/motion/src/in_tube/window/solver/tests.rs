//! The solver against all vertices: a linear problem has its best point where as many bounds meet
//! as there are unknowns, so trying every such point is an oracle that shares nothing with it.

use super::interior::{Allowance, Goal, Interior};
use super::problem::{DIFFERENCES, FAR, PRICE, Problem, RowBounds, WideRow};

/// Intervals; the unknown control points are 3, 4, 5, and 6 with its two copies.
const INTERVALS: usize = 6;
const UNKNOWNS: usize = 4;
/// `row · x ≤ bound`
type Bound = ([f64; UNKNOWNS], f64);

fn lcg(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

/// A weighted sum of control points as a row of the unknowns; the given ones are at zero.
fn row(first: usize, weights: &[f64]) -> [f64; UNKNOWNS] {
    let mut row = [0.0; UNKNOWNS];
    for (offset, weight) in weights.iter().enumerate() {
        if let Some(unknown) = (first + offset).checked_sub(3) {
            row[unknown.min(UNKNOWNS - 1)] += weight;
        }
    }
    row
}

/// Solves four equations; `None` if they are dependent.
fn meet(bounds: [Bound; UNKNOWNS]) -> Option<[f64; UNKNOWNS]> {
    let mut table = bounds;
    for column in 0..UNKNOWNS {
        let size = |at: &usize| table[*at].0[column].abs();
        let pivot = (column..UNKNOWNS).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        table.swap(column, pivot);
        let (row, value) = table[column];
        if row[column].abs() < 1e-9 {
            return None;
        }
        for other in (0..UNKNOWNS).filter(|&other| other != column) {
            let factor = table[other].0[column] / row[column];
            for k in 0..UNKNOWNS {
                table[other].0[k] -= factor * row[k];
            }
            table[other].1 -= factor * value;
        }
    }
    Some(core::array::from_fn(|k| table[k].1 / table[k].0[k]))
}

fn value(row: &[f64; UNKNOWNS], x: &[f64; UNKNOWNS]) -> f64 {
    row.iter().zip(x).map(|(a, b)| a * b).sum()
}

/// The largest `aim · x` over all points where four bounds meet and none is exceeded.
fn best_vertex(bounds: &[Bound], aim: &[f64; UNKNOWNS]) -> f64 {
    let mut best = f64::NEG_INFINITY;
    let n = bounds.len();
    for a in 0..n {
        for b in a + 1..n {
            for c in b + 1..n {
                for d in c + 1..n {
                    let Some(x) = meet([bounds[a], bounds[b], bounds[c], bounds[d]]) else {
                        continue;
                    };
                    if bounds
                        .iter()
                        .all(|(row, most)| value(row, &x) <= most + 1e-9)
                    {
                        best = best.max(value(aim, &x));
                    }
                }
            }
        }
    }
    best
}

#[test]
fn the_best_vertex_is_found() {
    for seed in 0..12 {
        let mut state = seed;
        let mut problem = Problem::<2>::new();
        problem.clear(INTERVALS, false);
        let mut best = 0.0;
        let mut aims = [[0.0; UNKNOWNS]; 2];
        let limit = lcg(&mut state) * 0.8 + 0.2;
        for axis in 0..2 {
            let mut bounds: Vec<Bound> = Vec::new();
            for order in 0..3 {
                let bound = 0.3 + lcg(&mut state);
                problem.bounds[order][axis] = bound;
                for first in 2 - order..INTERVALS {
                    let row = row(first, &DIFFERENCES[order]);
                    bounds.push((row, bound));
                    bounds.push((row.map(|r| -r), bound));
                }
            }
            if axis == 0 {
                // One soft row, which can be kept and is worth its price.
                bounds.push((row(3, &[0.0, 1.0]), limit));
            }
            if axis == 1 {
                bounds.push((row(3, &[0.3, -0.2, 0.5, 0.4]), limit));
            }
            for (k, aim) in aims[axis].iter_mut().enumerate() {
                *aim = lcg(&mut state) - 0.3;
                problem.aims[3 + k][axis] = *aim;
            }
            best += best_vertex(&bounds, &aims[axis]);
        }
        // A wide row on the other axis: the same bound, of points with parts of their own.
        let parts = [0.3, -0.2, 0.5, 0.4].map(|part| [0.0, part]);
        problem.wide_rows.push(WideRow {
            first: 3,
            parts,
            bounds: RowBounds {
                low: -FAR,
                high: limit,
                price: PRICE,
            },
        });
        problem.add_site(3, [0.0, 1.0, 0.0, 0.0]);
        problem.add_row([1.0, 0.0], &[0.0; 2], [-FAR, limit]);
        let mut points = vec![[0.0; 2]; INTERVALS + 3];
        let goal = Goal {
            mu: 1e-9,
            iterations: 60,
            damping: 1e-9,
        };
        let mut interior = Interior::new();
        interior.allow(Allowance {
            wanted: usize::MAX,
            most: usize::MAX,
        });
        assert!(interior.solve(&problem, &mut points, goal), "seed {seed}");
        let found: f64 = (0..2)
            .flat_map(|axis| (0..UNKNOWNS).map(move |k| (axis, k)))
            .map(|(axis, k)| aims[axis][k] * points[3 + k][axis])
            .sum();
        assert!(
            (found - best).abs() < 1e-6,
            "seed {seed}: {found} of {best}"
        );
        assert!(interior.violation() < 1e-6);
    }
}
