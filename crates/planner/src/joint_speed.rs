//! The speed limits of joints as limits of path speed, item by item.
//!
//! ```text
//!   item ── places along it, STEP apart ──▶ least of the speeds joints allow there ──▶ rate "up to"
//! ```
//!
//! An item keeps its rate where no override could make joints too fast.
//!
//! The motion may leave the path by the tolerance e, and so differ from its direction: where the
//! path has curvature κ, a smoother one cuts it by e over a length of √(8e/κ), at whose ends it
//! differs by an angle of about √(2eκ). For items that follow each other, κ is the change of
//! direction over the length of an item.

use glidepath_geometry::{Axis, AxisVector, ROTARY_ABC, Segment, limit_along};
use glidepath_kinematics::{Heading, PathCaps, PlaceCaps};
use glidepath_motion::ItemPacer;
use glidepath_program::{Item, ItemKind, PathMode, Settings};

/// Largest change of any axis between two places that are looked at, mm or degrees.
const STEP: f64 = 1.0;
/// Speeds are rounded down to a power of two to so many steps, so that neighbours are alike.
const STEPS_PER_OCTAVE: f64 = 16.0;

/// Keeps the speed of items where joints can follow.
#[derive(Debug, Clone)]
pub(crate) struct JointSpeed {
    caps: PathCaps,
    settings: Settings,
    /// The direction in which the last item ended, and how curved it was, in linear and rotary
    /// axes.
    last: Option<(AxisVector, [f64; 2])>,
    /// The place that was looked at last.
    place: Option<(AxisVector, PlaceCaps)>,
}

impl JointSpeed {
    pub(crate) const fn new(caps: PathCaps, settings: Settings) -> Self {
        Self {
            caps,
            settings,
            last: None,
            place: None,
        }
    }

    /// The speed that joints can follow along a move, if that is less than what axes can.
    fn limit(&mut self, segment: &Segment, mode: PathMode) -> Option<f64> {
        let tolerance_mm = match mode {
            PathMode::ExactStop | PathMode::ExactPath => 0.0,
            PathMode::Continuous { tolerance_mm } => {
                tolerance_mm.unwrap_or(self.settings.tolerance_mm)
            }
        };
        let spread = self
            .curvature(segment)
            .map(|curvature_k| (2.0 * tolerance_mm * curvature_k).sqrt());
        let (joints_v, axes_v) = self.along(segment, spread);
        let octaves = (joints_v.log2() * STEPS_PER_OCTAVE).floor() / STEPS_PER_OCTAVE;
        (joints_v < axes_v).then(|| octaves.exp2())
    }

    /// How curved the path is, 1/mm and °/mm², at a segment or where it begins or the last one did.
    fn curvature(&mut self, segment: &Segment) -> [f64; 2] {
        let length_s = segment.length();
        let [start, end] = [0.0, length_s].map(|s| segment.jet(s));
        let mut curvature = groups(&start.d2);
        let mut before = [0.0; 2];
        if let Some((last_d1, last)) = self.last {
            let turn = groups(&(start.d1 - last_d1));
            for group in 0..2 {
                curvature[group] = curvature[group].max(turn[group] / length_s);
                before[group] = last[group];
            }
        }
        self.last = Some((end.d1, curvature));
        [0, 1].map(|group| curvature[group].max(before[group]))
    }

    /// The least speeds that joints and axes allow on a segment.
    fn along(&mut self, segment: &Segment, spread: [f64; 2]) -> (f64, f64) {
        let length_s = segment.length();
        // The fastest axis per unit of path position, which rotary axes may be many times over.
        let fastest = (0..=8)
            .map(|i| segment.jet(length_s * f64::from(i) / 8.0).d1.amax())
            .fold(1.0, f64::max);
        let steps = (length_s * fastest / STEP).ceil().clamp(1.0, 1e6);
        let (mut joints_v, mut axes_v) = (f64::INFINITY, f64::INFINITY);
        let mut step = 0.0;
        while step <= steps {
            let at = segment.jet(length_s * step / steps);
            axes_v = axes_v.min(limit_along(&at.d1, &self.settings.limits.velocity));
            // Where a machine cannot go is told by those who look at the path for that.
            let heading = Heading {
                d1: at.d1,
                linear_spread: spread[0],
                rotary_spread: spread[1],
            };
            if let Some(speed_v) = self.at(&at.position, &heading) {
                joints_v = joints_v.min(speed_v);
            }
            step += 1.0;
        }
        (joints_v, axes_v)
    }

    fn at(&mut self, position: &AxisVector, heading: &Heading) -> Option<f64> {
        let is_near = |(place, _): &(AxisVector, PlaceCaps)| {
            Axis::ALL
                .into_iter()
                .all(|axis| (place[axis.index()] - position[axis.index()]).abs() < STEP)
        };
        if !self.place.as_ref().is_some_and(is_near) {
            self.place = Some((*position, self.caps.at(position).ok()?));
        }
        let (_, caps) = self.place.as_ref()?;
        caps.speed(position, heading).ok()
    }
}

impl ItemPacer for JointSpeed {
    fn pace(&mut self, item: &Item) -> Item {
        let mut paced = *item;
        let ItemKind::Move {
            segment,
            rate,
            mode,
        } = &mut paced.kind
        else {
            self.last = None;
            return paced;
        };
        if let Some(most_v) = self.limit(segment, *mode) {
            *rate = rate.up_to(most_v.min(rate.most_v()));
        }
        paced
    }

    fn again(&self) -> Box<dyn ItemPacer> {
        Box::new(self.clone())
    }
}

/// Length of a vector in the linear axes, and in the rotary ones.
fn groups(vector: &AxisVector) -> [f64; 2] {
    let rotary = vector
        .as_slice()
        .get(ROTARY_ABC)
        .map_or(0.0, |part| part.iter().map(|x| x * x).sum::<f64>());
    [
        (vector.norm_squared() - rotary).max(0.0).sqrt(),
        rotary.sqrt(),
    ]
}
