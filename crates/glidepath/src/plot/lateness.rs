//! The plot of lateness: how often a loop was how late, both on logarithmic scales, so that one
//! outlier in a million shows.

use super::colour::{CURVES, FRAME, GRID, INK, QUIET};
use super::svg::{Anchor, Area, Path, Svg};
use super::ticks::label;
use crate::jitter::Bin;

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 460.0;
const AREA: Area = Area {
    x: 70.0,
    y: 84.0,
    width: 850.0,
    height: 310.0,
};

/// One histogram.
#[derive(Debug, Clone, PartialEq)]
pub struct LatenessSeries {
    /// Its name in the legend.
    pub name: &'static str,
    /// Its bins, ascending and without gaps.
    pub bins: Vec<Bin>,
}

/// The decades the axes span, as powers of ten.
struct Scale {
    first: f64,
    last: f64,
    top: f64,
}

impl Scale {
    #[allow(clippy::cast_precision_loss, reason = "for display")]
    fn of(series: &[LatenessSeries]) -> Self {
        let bins = || series.iter().flat_map(|series| &series.bins);
        let ends = bins().map(|bin| bin.high_us).filter(|us| us.is_finite());
        let lows = bins().map(|bin| bin.low_us.max(1.0));
        let last = ends.fold(10.0, f64::max).log10().ceil();
        let most = bins().map(|bin| bin.count).max().unwrap_or(1).max(10);
        let first = lows.fold(f64::INFINITY, f64::min).min(10.0).log10().floor();
        Self {
            first,
            last: last.max(first + 1.0),
            top: (most as f64).log10().ceil(),
        }
    }

    fn x(&self, us: f64) -> f64 {
        let part = (us.max(1e-3).log10() - self.first) / (self.last - self.first);
        AREA.width.mul_add(part.clamp(0.0, 1.0), AREA.x)
    }

    /// Zero stands at the bottom, one a little above it.
    #[allow(clippy::cast_precision_loss, reason = "for display")]
    fn y(&self, count: u64) -> f64 {
        let height = if count == 0 {
            0.0
        } else {
            ((count as f64).log10() + 0.3) / (self.top + 0.3)
        };
        AREA.bottom() - AREA.height * height
    }
}

/// The plot as an SVG document.
#[must_use]
pub fn lateness(title: &str, subtitle: &str, series: &[LatenessSeries]) -> String {
    let scale = Scale::of(series);
    let mut svg = Svg::new(WIDTH, HEIGHT);
    let large = format!("fill=\"{INK}\" font-size=\"19\" font-weight=\"600\"");
    svg.text(AREA.x, 32.0, Anchor::Start, &large, title);
    let quiet = format!("fill=\"{QUIET}\" font-size=\"11\"");
    svg.text(AREA.x, 51.0, Anchor::Start, &quiet, subtitle);
    grid(&mut svg, &scale);
    let mut legend_x = AREA.x;
    for (series, colour) in series.iter().zip(CURVES) {
        let style = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\"");
        svg.path(&steps(&series.bins, &scale), &style);
        let style = format!("fill=\"{colour}\" font-weight=\"600\"");
        svg.text(legend_x, 73.0, Anchor::Start, &style, series.name);
        legend_x += 90.0;
    }
    svg.finish()
}

fn steps(bins: &[Bin], scale: &Scale) -> Path {
    let mut path = Path::default();
    let Some(first) = bins.first() else {
        return path;
    };
    path.move_to(scale.x(first.low_us), scale.y(0));
    for bin in bins {
        path.line_to(scale.x(bin.low_us), scale.y(bin.count));
        path.line_to(scale.x(bin.high_us), scale.y(bin.count));
    }
    if let Some(last) = bins.last() {
        path.line_to(scale.x(last.high_us), scale.y(0));
    }
    path
}

fn grid(svg: &mut Svg, scale: &Scale) {
    let line = format!("stroke=\"{GRID}\"");
    let quiet = format!("fill=\"{QUIET}\" font-size=\"10\"");
    let mut decade = scale.first;
    while decade <= scale.last {
        let us = 10_f64.powf(decade);
        let x = scale.x(us);
        svg.line((x, AREA.y), (x, AREA.bottom()), &line);
        svg.text(x, AREA.bottom() + 15.0, Anchor::Middle, &quiet, &label(us));
        decade += 1.0;
    }
    let mut count: u64 = 1;
    while scale.y(count) >= AREA.y - 0.5 {
        let y = scale.y(count);
        svg.line((AREA.x, y), (AREA.right(), y), &line);
        let words = crate::report::grouped(count);
        svg.text(AREA.x - 6.0, y + 3.5, Anchor::End, &quiet, &words);
        count = count.saturating_mul(10);
    }
    svg.rect(&AREA, &format!("fill=\"none\" stroke=\"{FRAME}\""));
    let middle = AREA.x + AREA.width / 2.0;
    let words = "lateness, µs (both scales logarithmic; vertical: number of ticks)";
    svg.text(middle, AREA.bottom() + 36.0, Anchor::Middle, &quiet, words);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bin(low_us: f64, high_us: f64, count: u64) -> Bin {
        Bin {
            low_us,
            high_us,
            count,
        }
    }

    #[test]
    fn one_outlier_shows_and_everything_is_inside() {
        let bins = vec![
            bin(10.0, 20.0, 1_000_000),
            bin(20.0, 50.0, 0),
            bin(50.0, 100.0, 1),
        ];
        let series = [LatenessSeries { name: "loop", bins }];
        let scale = Scale::of(&series);
        assert!((scale.x(10.0) - AREA.x).abs() < 1e-9);
        assert!((scale.x(100.0) - AREA.right()).abs() < 1e-9);
        assert!((scale.y(1_000_000) - AREA.y).abs() < 1e-9);
        assert!(scale.y(1) < AREA.bottom() - 10.0);
        assert!((scale.y(0) - AREA.bottom()).abs() < 1e-9);
        let svg = lateness("title", "sub", &series);
        assert!(svg.contains(">1 000 000<") && svg.contains(">loop<"));
    }

    #[test]
    fn nothing_measured_is_an_empty_frame() {
        let svg = lateness("title", "sub", &[]);
        assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN"));
    }
}
