//! A picture of a motion: the tool path coloured by the limit that binds, or by feed where that is
//! not known; and feed, velocity, acceleration and jerk of each axis, and of each joint where
//! joints are not axes, against time with their limits, as one SVG file. Under the motion lies the
//! programmed path; the deviation from it is drawn against time with its tolerance as a band. Below
//! stands how smooth the motion is.
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
mod program_trace;
mod quantities;
mod strip;
mod svg;
mod ticks;
mod track;
mod view;

use crate::report::SmoothnessFigures;
use crate::sample::Sample;
use bound::Bound;
use colour::{DEVIATION, INK, QUIET};
use envelope::Envelope;
use glidepath_geometry::Axis;
use glidepath_kinematics::JointLimits;
use glidepath_program::{Item, Limits};
pub use lateness::{Series, lateness};
use program_trace::ProgramTrace;
use quantities::{PositionCurves, Quantities};
use std::collections::BTreeMap;
use strip::{Strip, TimeAxis};
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
    smoothness: figures::Parts,
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
            smoothness: figures::Parts::new(),
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

    /// Takes how smooth the motion is, by part: `whole`, `at_feed`.
    pub fn smoothness(&mut self, parts: &BTreeMap<&'static str, SmoothnessFigures>) {
        self.smoothness.clone_from(parts);
    }

    /// Takes the next sample; their ticks ascend.
    pub fn push(&mut self, sample: &Sample) {
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
        if let Some(deviation) = sample.deviation {
            let both = [deviation.distance_mm, deviation.tolerance_mm];
            for (envelope, mm) in self.deviation.iter_mut().zip(both) {
                envelope.push(tick, 1e3 * mm);
            }
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
        let height = height + figures::height(&self.smoothness);
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
        figures::draw(&mut svg, &self.smoothness, &area);
        svg.finish()
    }

    fn draw_views(&self, svg: &mut Svg, bottom: f64) {
        let (low, high) = self.track.extent();
        let right = WIDTH - 24.0;
        let top = Area {
            x: LEFT,
            y: 84.0,
            width: right - LEFT,
            height: bottom - 84.0 - 56.0,
        };
        let moves = |axis: usize| high[axis] > low[axis];
        if moves(2) && !moves(1) {
            view::draw(svg, View::Front, &self.track, self.program.points(), &top);
        } else if moves(2) {
            let half = Area {
                width: 660.0,
                ..top
            };
            view::draw(svg, View::Top, &self.track, self.program.points(), &half);
            let side = half.right() + 52.0;
            let front = Area {
                x: side,
                width: right - side,
                height: 150.0,
                ..top
            };
            view::draw(svg, View::Front, &self.track, self.program.points(), &front);
            let y = front.bottom() + 42.0;
            let isometric = Area {
                y,
                height: top.bottom() - y,
                ..front
            };
            view::draw(
                svg,
                View::Isometric,
                &self.track,
                self.program.points(),
                &isometric,
            );
        } else {
            view::draw(svg, View::Top, &self.track, self.program.points(), &top);
        }
        let area = Area {
            x: LEFT + 62.0,
            y: bottom - 30.0,
            width: 420.0,
            height: 10.0,
        };
        if !self.program.points().is_empty() {
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
        if tolerance.peak() > 0.0 {
            strips.push(Strip {
                title: "deviation".to_owned(),
                unit: "µm",
                colour: DEVIATION,
                curve: deviation,
                limit: Some(tolerance.peak()),
                band: Some(tolerance),
                signed: false,
            });
        }
        strips.extend(self.axes.strips());
        strips.extend(self.joints.strips());
        strips
    }
}
