//! The plot of a curve by itself: coloured by a speed, with marked points.

use super::colour::{INK, LIMIT, QUIET};
use super::legend;
use super::part;
use super::svg::{Anchor, Area, Svg};
use super::track::{MotionTrace, TrackPoint};
use super::view::{self, View};
use glidepath_geometry::AxisVector;

const WIDTH: f64 = 1280.0;
const HEIGHT: f64 = 860.0;

/// What a mark stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Something found on the curve.
    Found,
    /// A control point.
    Control,
}

/// A picture of a curve as it grows.
#[derive(Debug, Default)]
pub struct CurvePlot {
    track: MotionTrace,
    marks: Vec<([f64; 3], Mark)>,
}

impl CurvePlot {
    /// An empty picture.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The next point of the curve and the speed that colours it, mm/s.
    pub fn point(&mut self, position: &AxisVector, feed_v: f64) {
        self.track.push(TrackPoint {
            at: xyz(position),
            feed_v,
            rapid: false,
            bound: None,
        });
    }

    /// A mark beside the curve.
    pub fn mark(&mut self, position: &AxisVector, mark: Mark) {
        self.marks.push((xyz(position), mark));
    }

    /// The SVG document.
    #[must_use]
    pub fn render(&self, title: &str, subtitle: &str) -> String {
        let mut svg = Svg::new(WIDTH, HEIGHT);
        let large = format!("fill=\"{INK}\" font-size=\"19\" font-weight=\"600\"");
        svg.text(66.0, 32.0, Anchor::Start, &large, title);
        let quiet = format!("fill=\"{QUIET}\" font-size=\"12\"");
        svg.text(66.0, 51.0, Anchor::Start, &quiet, subtitle);
        let area = Area {
            x: 66.0,
            y: 84.0,
            width: WIDTH - 90.0,
            height: HEIGHT - 170.0,
        };
        let (low, high) = part::extent(&part::of(self.track.points()));
        let (x, y, z) = (high[0] - low[0], high[1] - low[1], high[2] - low[2]);
        let seen = if z <= 0.0 {
            View::Top
        } else if y <= 0.0 && x > 0.0 {
            View::Front
        } else {
            View::Isometric
        };
        view::draw(&mut svg, seen, &self.track, &[], &area);
        for (at, mark) in &self.marks {
            let style = match mark {
                Mark::Found => format!("rx=\"3\" fill=\"{LIMIT}\""),
                Mark::Control => format!("fill=\"none\" stroke=\"{QUIET}\""),
            };
            let (x, y) = view::pixel(seen, &self.track, &area, *at);
            let dot = Area {
                x: x - 3.0,
                y: y - 3.0,
                width: 6.0,
                height: 6.0,
            };
            svg.rect(&dot, &style);
        }
        let below = Area {
            x: 128.0,
            y: HEIGHT - 44.0,
            width: 420.0,
            height: 10.0,
        };
        legend::of_feed(&mut svg, self.track.max_feed_v(), &below);
        svg.finish()
    }
}

fn xyz(position: &AxisVector) -> [f64; 3] {
    [position[0], position[1], position[2]]
}
