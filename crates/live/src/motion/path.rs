//! A path in space, in bounded memory and in levels of detail.
//!
//! When there are too many points, those that show least are dropped: the ones nearest to the
//! straight line between their neighbours, a change of what binds and of the feed counted as a
//! distance. Two neighbours are never dropped together.

use super::bytes::Bytes;

/// Points at most.
const CAPACITY: usize = 65_536;
/// Points of the coarser levels: what is drawn while the view turns.
const LEVELS: [usize; 3] = [3_000, 10_000, 30_000];

/// A point of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vertex {
    pub(super) at: [f64; 3],
    /// Number of the sample, or the source line of the programmed path.
    pub(super) sequence: u64,
    pub(super) feed_v: f64,
    /// See [`super::sample::MotionSample`].
    pub(super) code: u8,
}

#[derive(Debug, Default)]
pub(super) struct Path {
    vertices: Vec<Vertex>,
    low: [f64; 3],
    high: [f64; 3],
    most_v: f64,
}

impl Path {
    pub(super) fn push(&mut self, vertex: &Vertex) {
        #[allow(
            clippy::float_cmp,
            reason = "a machine at rest repeats its position exactly"
        )]
        match self.vertices.last_mut() {
            None => (self.low, self.high) = (vertex.at, vertex.at),
            Some(last) if last.at == vertex.at => return,
            Some(_) => {}
        }
        for ((value, low), high) in vertex.at.into_iter().zip(&mut self.low).zip(&mut self.high) {
            *low = low.min(value);
            *high = high.max(value);
        }
        if vertex.code < 128 {
            self.most_v = self.most_v.max(vertex.feed_v);
        }
        self.vertices.push(*vertex);
        if self.vertices.len() >= CAPACITY {
            let vertices = core::mem::take(&mut self.vertices);
            self.vertices = self.thinner(vertices);
        }
    }

    fn extent(&self) -> f64 {
        let spans = self.low.iter().zip(self.high).map(|(low, high)| high - low);
        spans.fold(f64::MIN_POSITIVE, f64::max)
    }

    /// About a quarter fewer points, or half of them where all show as little.
    fn thinner(&self, mut vertices: Vec<Vertex>) -> Vec<Vertex> {
        let extent = self.extent();
        // A change from slow to fast shows as much as a bend of 1 % of the picture.
        let mm_per_v = 0.01 * extent / self.most_v.max(f64::MIN_POSITIVE);
        let worth: Vec<f64> = vertices
            .windows(3)
            .map(|three| worth(three, mm_per_v, 0.003 * extent))
            .collect();
        let mut sorted = worth.clone();
        let at = sorted.len() / 2;
        let threshold = if sorted.is_empty() {
            0.0
        } else {
            *sorted.select_nth_unstable_by(at, f64::total_cmp).1
        };
        let mut index = 0_usize;
        let mut dropped = false;
        vertices.retain(|_| {
            // `worth` begins with the second point and ends with the last but one.
            let of = index.checked_sub(1).and_then(|before| worth.get(before));
            index += 1;
            dropped = !dropped && of.is_some_and(|worth| *worth <= threshold);
            !dropped
        });
        vertices
    }

    /// The coarsest level that each point belongs to: 0 for those of all levels.
    fn levels(&self) -> Vec<u8> {
        #[allow(clippy::cast_possible_truncation, reason = "a handful of levels")]
        let finest = LEVELS.len() as u8;
        let mut of = vec![finest; self.vertices.len()];
        // The vertices of a level, each with its number in place of its sequence.
        let mut rest: Vec<Vertex> = (0_u64..)
            .zip(&self.vertices)
            .map(|(sequence, vertex)| Vertex {
                sequence,
                ..*vertex
            })
            .collect();
        for (level, most) in (0..finest).zip(LEVELS).rev() {
            while rest.len() > most {
                let before = rest.len();
                rest = self.thinner(rest);
                if rest.len() == before {
                    break;
                }
            }
            for vertex in &rest {
                let at = usize::try_from(vertex.sequence).unwrap_or(usize::MAX);
                if let Some(of) = of.get_mut(at) {
                    *of = level;
                }
            }
        }
        of
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a speed is not negative; the page draws single precision; points are fewer than the capacity, and more \
                  than 2^32 samples are half a year"
    )]
    pub(super) fn bytes(&self, mark: &[u8; 4]) -> Vec<u8> {
        let mut bytes = Bytes::new(mark);
        bytes.word(self.vertices.len() as u32);
        bytes.word(self.most_v.ceil() as u32);
        bytes.word(0);
        let vertices = &self.vertices;
        let coordinates = vertices.iter().flat_map(|vertex| vertex.at);
        bytes.column(coordinates.map(|value| (value as f32).to_le_bytes()));
        bytes.column(vertices.iter().map(|v| (v.sequence as u32).to_le_bytes()));
        bytes.column(vertices.iter().map(|v| (v.feed_v as f32).to_le_bytes()));
        bytes.column(vertices.iter().map(|vertex| [vertex.code]));
        bytes.column(self.levels().into_iter().map(|level| [level]));
        bytes.finish()
    }
}

/// What the middle one of three points shows, in mm.
fn worth(three: &[Vertex], mm_per_v: f64, change_mm: f64) -> f64 {
    let [a, b, c] = three else {
        return f64::INFINITY;
    };
    if a.code >> 7 != b.code >> 7 || b.code >> 7 != c.code >> 7 {
        return f64::INFINITY;
    }
    let difference =
        |p: &Vertex, q: &Vertex| [p.at[0] - q.at[0], p.at[1] - q.at[1], p.at[2] - q.at[2]];
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let (chord, to_b) = (difference(c, a), difference(b, a));
    let length2 = dot(chord, chord);
    let along = if length2 > 0.0 {
        (dot(to_b, chord) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let away = [0, 1, 2].map(|i| to_b[i] - along * chord[i]);
    let feed = (b.feed_v - (c.feed_v - a.feed_v).mul_add(along, a.feed_v)).abs();
    let changes = b.code & 7 != c.code & 7;
    let change = if changes { change_mm } else { 0.0 };
    dot(away, away).sqrt().max(feed * mm_per_v).max(change)
}
