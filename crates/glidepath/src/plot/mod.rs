//! A picture of a motion: the tool path coloured by the limit that binds, or by feed where that is
//! not known; and feed, velocity, acceleration and jerk of each axis, and of each joint where
//! joints are not axes, against time with their limits, as one SVG file. Under the motion lies the
//! programmed path; the deviation from it is drawn against time with its tolerance as a band. Below
//! stands how smooth the motion is, and how true its shape.
//!
//! Samples are taken one by one and kept in bounded memory, so that a motion of any length gives a
//! file of at most about 2 MB. Velocity, acceleration and jerk are finite differences of the
//! positions: what a drive makes of them, not what the planner says about them.

mod bound;
mod colour;
pub mod curve;
mod envelope;
mod figures;
mod lateness;
mod legend;
mod part;
mod program_trace;
mod quantities;
mod strip;
mod svg;
mod ticks;
mod track;
mod view;

use crate::report::DiagnosisReport;
use crate::sample::TickSample;
use bound::Bound;
use colour::{DEVIATION, INK, QUIET};
use envelope::Envelope;
use glidepath_geometry::Axis;
use glidepath_kinematics::JointLimits;
use glidepath_program::{Item, Limits};
pub use lateness::{LatenessSeries, lateness};
use program_trace::ProgramTrace;
use quantities::{PositionCurves, Quantities};
use strip::{Band, Strip, TimeAxis};
use svg::{Anchor, Area, Svg};
use track::{MotionTrace, TrackPoint};
use view::View;

const WIDTH: f64 = 1280.0;
const LEFT: f64 = 66.0;
const RIGHT: f64 = 150.0;
const STRIP_HEIGHT: f64 = 62.0;
const STRIP_GAP: f64 = 9.0;

/// A picture as it grows.
#[derive(Debug)]
pub struct Plot {
    axes: Quantities,
    joints: Quantities,
    period_t: f64,
    track: MotionTrace,
    program: ProgramTrace,
    feed: Envelope,
    /// Distance from the programmed path and its tolerance, µm.
    deviation: [Envelope; 2],
    /// The smallest and the largest tolerance in force, µm, and the largest share of it in use.
    tolerances_um: Option<[f64; 2]>,
    tolerance_share: f64,
    /// The program's zero in machine coordinates, where it is known.
    work_zero: Option<[f64; 3]>,
    /// The machine has no Y: it is a lathe.
    is_lathe: bool,
    figures: figures::Figures,
    first_tick: Option<u64>,
    ticks: u64,
}

impl Plot {
    /// An empty picture of a machine with these axes.
    #[must_use]
    pub fn new(axes: &[Axis], limits: Limits, period_t: f64) -> Self {
        let rows = axes.iter().map(|axis| {
            let i = axis.index();
            let limits = [limits.velocity, limits.acceleration, limits.jerk].map(|limit| limit[i]);
            let units = if axis.is_rotary() {
                ["°/s", "°/s²", "°/s³"]
            } else {
                ["mm/s", "mm/s²", "mm/s³"]
            };
            PositionCurves::new(axis.to_string(), i, limits, units)
        });
        Self {
            axes: Quantities::new(rows.collect()),
            joints: Quantities::new(Vec::new()),
            period_t,
            track: MotionTrace::default(),
            program: ProgramTrace::default(),
            feed: Envelope::new(),
            deviation: [const { Envelope::new() }; 2],
            tolerances_um: None,
            tolerance_share: 0.0,
            work_zero: None,
            is_lathe: !axes.contains(&Axis::Y),
            figures: figures::Figures::default(),
            first_tick: None,
            ticks: 0,
        }
    }

    /// The same picture, with the first `count` joints, too.
    #[must_use]
    pub fn with_joints(self, limits: &JointLimits, count: usize) -> Self {
        let rows = limits
            .0
            .iter()
            .take(count)
            .enumerate()
            .map(|(joint, limit)| {
                let limits = [limit.velocity, limit.acceleration, limit.jerk];
                // Joints are lengths or angles, as the mechanism has it.
                PositionCurves::new(format!("J{joint}"), joint, limits, ["/s", "/s²", "/s³"])
            });
        Self {
            joints: Quantities::new(rows.collect()),
            ..self
        }
    }

    /// Takes the next item of the program that the motion follows.
    pub fn program(&mut self, item: &Item) {
        self.program.push(item);
    }

    /// Takes how smooth the motion is, and how true its shape.
    pub fn told(&mut self, diagnosis: &DiagnosisReport) {
        self.figures = figures::Figures::new(diagnosis);
    }

    /// Takes where the program's zero is in machine coordinates: the views are in the program's.
    pub const fn work_zero(&mut self, zero: [f64; 3]) {
        self.work_zero = Some(zero);
    }

    /// Takes the next sample; their ticks ascend.
    pub fn push(&mut self, sample: &TickSample) {
        let at = [sample.position[0], sample.position[1], sample.position[2]];
        self.track.push(TrackPoint {
            at,
            feed_v: sample.feed_v,
            rapid: sample.rapid,
            bound: sample.binding.map(Bound::of),
        });
        let first = *self.first_tick.get_or_insert(sample.tick);
        let tick = sample.tick.saturating_sub(first);
        self.ticks = tick + 1;
        self.feed.push(tick, sample.feed_v);
        // Before the first period there is no move, and so no tolerance of one.
        if let Some(deviation) = sample.deviation.filter(|_| tick > 0) {
            let both = [deviation.distance_mm, deviation.tolerance_mm].map(|mm| 1e3 * mm);
            for (envelope, um) in self.deviation.iter_mut().zip(both) {
                envelope.push(tick, um);
            }
            let [distance_um, tolerance_um] = both;
            let [least, most] = self.tolerances_um.unwrap_or([tolerance_um; 2]);
            self.tolerances_um = Some([least.min(tolerance_um), most.max(tolerance_um)]);
            let share = distance_um / tolerance_um.max(f64::MIN_POSITIVE);
            self.tolerance_share = self.tolerance_share.max(share);
        }
        self.axes.push(tick, self.period_t, &sample.position);
        self.joints.push(tick, self.period_t, &sample.joints);
    }

    /// The SVG document. The title is the largest text, the subtitle stands below it.
    #[must_use]
    pub fn render(&self, title: &str, subtitle: &str) -> String {
        let views_bottom = 590.0;
        let strips = self.strips();
        #[allow(clippy::cast_precision_loss, reason = "a few dozen strips")]
        let height = views_bottom + 34.0 + strips.len() as f64 * (STRIP_HEIGHT + STRIP_GAP) + 30.0;
        let figures_y = height;
        let height = height + self.figures.height();
        let mut svg = Svg::new(WIDTH, height);
        svg.text(
            LEFT,
            32.0,
            Anchor::Start,
            &format!("fill=\"{INK}\" font-size=\"19\" font-weight=\"600\""),
            title,
        );
        let quiet = format!("fill=\"{QUIET}\" font-size=\"12\"");
        svg.text(LEFT, 51.0, Anchor::Start, &quiet, subtitle);
        self.draw_views(&mut svg, views_bottom);

        #[allow(clippy::cast_precision_loss, reason = "pixels, not arithmetic")]
        let end_t = self.ticks.saturating_sub(1).max(1) as f64 * self.period_t;
        let time = TimeAxis {
            period_t: self.period_t,
            end_t,
        };
        let mut area = Area {
            x: LEFT,
            y: views_bottom + 34.0,
            width: WIDTH - LEFT - RIGHT,
            height: STRIP_HEIGHT,
        };
        for strip in &strips {
            strip.draw(&mut svg, &time, &area);
            area.y += STRIP_HEIGHT + STRIP_GAP;
        }
        area.y -= STRIP_HEIGHT + STRIP_GAP;
        strip::seconds(&mut svg, &time, &area);
        area.y = figures_y;
        area.width = WIDTH - LEFT;
        self.figures.draw(&mut svg, &area);
        svg.finish()
    }

    fn draw_views(&self, svg: &mut Svg, bottom: f64) {
        let zero = self.work_zero.unwrap_or_default();
        let track = &self.track.seen_from(zero);
        let program = &self.program.seen_from(zero);
        let (low, high) = part::extent(&part::of(track.points()));
        let right = WIDTH - 24.0;
        let top = Area {
            x: LEFT,
            y: 84.0,
            width: right - LEFT,
            height: bottom - 84.0 - 56.0,
        };
        let moves = |axis: usize| high[axis] > low[axis];
        if self.is_lathe && moves(2) {
            view::draw(svg, View::Turning, track, program.points(), &top);
        } else if moves(2) && !moves(1) {
            view::draw(svg, View::Front, track, program.points(), &top);
        } else if moves(2) {
            let half = Area {
                width: 660.0,
                ..top
            };
            view::draw(svg, View::Top, track, program.points(), &half);
            let side = half.right() + 52.0;
            let front = Area {
                x: side,
                width: right - side,
                height: 150.0,
                ..top
            };
            view::draw(svg, View::Front, track, program.points(), &front);
            let y = front.bottom() + 42.0;
            let isometric = Area {
                y,
                height: top.bottom() - y,
                ..front
            };
            view::draw(svg, View::Isometric, track, program.points(), &isometric);
        } else {
            view::draw(svg, View::Top, track, program.points(), &top);
        }
        let area = Area {
            x: LEFT + 62.0,
            y: bottom - 30.0,
            width: 420.0,
            height: 10.0,
        };
        let coordinates = self
            .work_zero
            .map_or("machine coordinates", |_| "work coordinates");
        legend::coordinates(svg, coordinates, right - 300.0, &area);
        if !program.points().is_empty() {
            legend::program(svg, right - 130.0, &area);
        }
        if self.track.has_bounds() {
            legend::of_bounds(svg, &self.track, &area);
        } else {
            legend::of_feed(svg, self.track.max_feed_v(), &area);
        }
    }

    fn strips(&self) -> Vec<Strip<'_>> {
        let feed = Strip {
            title: "feed".to_owned(),
            unit: "mm/s",
            colour: INK,
            curve: &self.feed,
            limit: None,
            band: None,
            // On a way back.
            signed: self.feed.is_ever_negative(),
        };
        let mut strips = vec![feed];
        let [deviation, tolerance] = &self.deviation;
        if let Some([least, most]) = self.tolerances_um.filter(|_| tolerance.peak() > 0.0) {
            strips.push(Strip {
                title: "deviation".to_owned(),
                unit: "µm",
                colour: DEVIATION,
                curve: deviation,
                limit: Some(most),
                band: Some(Band {
                    curve: tolerance,
                    is_constant: least >= most,
                    share: self.tolerance_share,
                }),
                signed: false,
            });
        }
        strips.extend(self.axes.strips());
        strips.extend(self.joints.strips());
        strips
    }
}
