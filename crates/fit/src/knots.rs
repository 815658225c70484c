//! The choice of knots: how many, and where.
//!
//! 1. *Greedy*: every span whose error exceeds the tolerance gets a knot at the point that halves
//!    its squared error, until none does.
//! 2. Where that comes to a standstill (the points allow no further knot), *equidistribution*:
//!    knots with the density |c''''|^¼ of the curve so far, as many as it takes, by bisection.
//! 3. *Removal*: the knots whose jump of c''' matters least, |jump|·gap³, in batches, then one by
//!    one, as long as the fit stays within the tolerance.
//!
//! Sources: the density is de Boor's `newknot` (*A Practical Guide to Splines*, chapter 12); the
//! cost of a knot follows Lyche and Mørken, *Knot removal for parametric B-spline curves*, 1987.

use crate::least_squares;
use crate::part::{Candidate, Part};
use crate::spline::inside;

/// Share of the knots the first batch of a removal takes.
const BATCH: f64 = 0.25;
/// What a batch that failed is multiplied with.
const SMALLER: f64 = 0.6;
/// Removal ends when this many of the cheapest knots cannot go.
const LAST_TRIALS: usize = 12;

/// A part with its least-squares fit.
#[derive(Debug)]
pub(crate) struct Placed {
    /// The part as it is.
    pub(crate) part: Part,
    /// The part as it was fitted.
    pub(crate) fitted: Part,
    pub(crate) candidate: Candidate,
}

impl Placed {
    /// The part as it is, if its points determine the spline by themselves; else as it was fitted.
    pub(crate) fn determined(&self) -> &Part {
        if least_squares::determined(&self.part.x, &self.candidate.spline.knots) {
            &self.part
        } else {
            &self.fitted
        }
    }
}

/// The spline with few knots within the tolerance; the part again if there is none.
///
/// Where the curve can be near to the points but not to the chords between them, the middles of the
/// chords are fitted too.
pub(crate) fn place_within(part: Part) -> Result<Placed, Part> {
    for fitted in [part.clone(), part.refined()] {
        if let Some(candidate) = within(&fitted) {
            return Ok(Placed {
                part,
                fitted,
                candidate,
            });
        }
    }
    Err(part)
}

/// The best spline where the chords are too long for any smooth curve to stay that near to them:
/// they are allowed to bulge.
pub(crate) fn place_bulging(part: Part) -> Placed {
    let fitted = part.bulging();
    let candidate = within(&fitted)
        .or_else(|| greedy(&fitted))
        // Two or three points determine no cubic.
        .unwrap_or_else(|| fitted.judge(fitted.straight()));
    Placed {
        part,
        fitted,
        candidate,
    }
}

fn within(part: &Part) -> Option<Candidate> {
    let greedy = greedy(part)?;
    if greedy.max_mm() <= part.tolerance_mm {
        return Some(remove(part, greedy));
    }
    equidistribute(part, &greedy).map(|even| remove(part, even))
}

/// The best of the fits with ever more knots. With knots as many as the points allow, a spline may
/// swing out far between the points: the last is not always the best.
fn greedy(part: &Part) -> Option<Candidate> {
    let mut knots: Vec<f64> = Vec::new();
    let mut last = part.fit(&knots)?;
    let mut best = last.clone();
    while last.max_mm() > part.tolerance_mm {
        let before = knots.len();
        for candidate in wanted(part, &last) {
            let at = knots.partition_point(|knot| *knot < candidate);
            let near = |knot: Option<&f64>| {
                knot.is_some_and(|knot| (knot - candidate).abs() <= 1e-9 * part.length())
            };
            if near(knots.get(at)) || (at > 0 && near(knots.get(at - 1))) {
                continue;
            }
            knots.insert(at, candidate);
            if !least_squares::determined(&part.x, &part.knots(&knots)) {
                knots.remove(at);
            }
        }
        if knots.len() == before {
            return Some(best);
        }
        match part.fit(&knots) {
            Some(next) => last = next,
            None => return Some(best),
        }
        if last.max_mm() < best.max_mm() {
            best.clone_from(&last);
        }
    }
    Some(best)
}

/// For every span with an error above the tolerance, the parameter that halves its squared error.
fn wanted(part: &Part, candidate: &Candidate) -> Vec<f64> {
    let mut breaks = inside(&candidate.spline.knots).to_vec();
    breaks.push(f64::INFINITY);
    let mut wanted = Vec::new();
    let mut first = 0;
    for end in breaks {
        let last = part.x.partition_point(|x| *x < end);
        let errors_mm = &candidate.errors_mm[first..last];
        if errors_mm.iter().any(|error| *error > part.tolerance_mm) {
            let total: f64 = errors_mm.iter().map(|e| e * e).sum();
            let mut sum = 0.0;
            let half = errors_mm.iter().position(|e| {
                sum += e * e;
                sum >= 0.5 * total
            });
            wanted.extend(half.map(|half| part.x[first + half]));
        }
        first = last;
    }
    wanted
}

/// Knots by density, the fewest for which the fit is within the tolerance.
fn equidistribute(part: &Part, from: &Candidate) -> Option<Candidate> {
    let distribution = Distribution::of(from);
    let most = part.points.len().saturating_sub(4);
    let mut low = 0;
    let mut count = from.spline.control.len().clamp(1, most.max(1));
    let mut found = None;
    while found.is_none() {
        found = part.fit_within(&distribution.knots(count));
        if found.is_none() {
            low = count;
            count *= 2;
            if low >= most {
                return None;
            }
            count = count.min(most);
        }
    }
    let mut high = count;
    while high - low > 1 {
        let middle = usize::midpoint(low, high);
        match part.fit_within(&distribution.knots(middle)) {
            Some(candidate) => {
                found = Some(candidate);
                high = middle;
            }
            None => low = middle,
        }
    }
    found
}

/// Where knots are wanted: the integral of |c''''|^¼.
struct Distribution {
    breaks: Vec<f64>,
    cumulative: Vec<f64>,
}

impl Distribution {
    fn of(candidate: &Candidate) -> Self {
        let pieces = candidate.spline.pieces();
        let count = pieces.count();
        let jump = |piece: usize| {
            if piece == 0 || piece >= count {
                0.0
            } else {
                pieces.jump(piece)
            }
        };
        let densities: Vec<f64> = (0..count)
            .map(|piece| {
                let (from, to) = pieces.bounds(piece);
                let fourth = 0.5 * (jump(piece) + jump(piece + 1)) / (to - from);
                fourth.sqrt().sqrt()
            })
            .collect();
        // Nowhere none at all.
        let floor = 1e-3 * densities.iter().copied().fold(1e-12, f64::max);
        let mut breaks = vec![pieces.bounds(0).0];
        let mut cumulative = vec![0.0];
        let mut sum = 0.0;
        for (piece, density) in densities.iter().enumerate() {
            let (from, to) = pieces.bounds(piece);
            sum += density.max(floor) * (to - from);
            breaks.push(to);
            cumulative.push(sum);
        }
        Self { breaks, cumulative }
    }

    /// So many knots inside, each with the same share.
    fn knots(&self, count: usize) -> Vec<f64> {
        let total = self.cumulative[self.cumulative.len() - 1];
        let at = |share: f64| {
            let wanted = share * total;
            let next = self.cumulative.partition_point(|sum| *sum <= wanted);
            let next = next.clamp(1, self.breaks.len() - 1);
            let (a, b) = (self.cumulative[next - 1], self.cumulative[next]);
            let (from, to) = (self.breaks[next - 1], self.breaks[next]);
            from + (to - from) * ((wanted - a) / (b - a)).clamp(0.0, 1.0)
        };
        (1..=count)
            .map(|i| at(i as f64 / (count + 1) as f64))
            .collect()
    }
}

/// Takes knots out as long as the fit stays within the tolerance.
fn remove(part: &Part, start: Candidate) -> Candidate {
    let mut best = start;
    let mut share = BATCH;
    loop {
        let knots = inside(&best.spline.knots).to_vec();
        let batch = (share * knots.len() as f64).floor();
        if batch < 2.0 {
            break;
        }
        match without_some(part, &best, &knots, batch) {
            Some(next) => best = next,
            None => share *= SMALLER,
        }
    }
    while let Some(next) = without_one(part, &best) {
        best = next;
    }
    best
}

/// Without a batch of the cheapest knots, no two of them neighbours.
fn without_some(part: &Part, from: &Candidate, knots: &[f64], batch: f64) -> Option<Candidate> {
    let mut goes = vec![false; knots.len()];
    let mut count = 0.0;
    for i in by_cost(from) {
        let neighbour = (i > 0 && goes[i - 1]) || goes.get(i + 1).is_some_and(|goes| *goes);
        if !neighbour {
            goes[i] = true;
            count += 1.0;
        }
        if count >= batch {
            break;
        }
    }
    let stay = knots.iter().zip(&goes).filter(|(_, goes)| !**goes);
    let stay: Vec<f64> = stay.map(|(knot, _)| *knot).collect();
    part.fit_within(&stay)
}

/// Without one of the cheapest knots.
pub(crate) fn without_one(part: &Part, from: &Candidate) -> Option<Candidate> {
    let knots = inside(&from.spline.knots);
    by_cost(from).into_iter().take(LAST_TRIALS).find_map(|i| {
        let mut stay = knots.to_vec();
        stay.remove(i);
        part.fit_within(&stay)
    })
}

/// Indices of the knots inside, the one that matters least first.
pub(crate) fn by_cost(candidate: &Candidate) -> Vec<usize> {
    let pieces = candidate.spline.pieces();
    let mut costs: Vec<(f64, usize)> = (1..pieces.count())
        .map(|piece| {
            let (from, at) = pieces.bounds(piece - 1);
            let to = pieces.bounds(piece).1;
            (
                pieces.jump(piece) * (at - from).min(to - at).powi(3),
                piece - 1,
            )
        })
        .collect();
    costs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    costs.into_iter().map(|(_, i)| i).collect()
}
