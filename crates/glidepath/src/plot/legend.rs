//! The legend of a track: what its colours and lines stand for.

use super::bound::Bound;
use super::colour::{self, PROGRAM, QUIET, RAPID};
use super::svg::{Anchor, Area, Svg};
use super::ticks::{label, ticks};
use super::track::{MotionTrace, TrackPoint};

/// Names the colours that a track has.
pub(super) fn of_bounds(svg: &mut Svg, track: &MotionTrace, area: &Area) {
    let text = format!("fill=\"{QUIET}\" font-size=\"10\"");
    let below = area.bottom() - 1.0;
    svg.text(area.x - 8.0, below, Anchor::End, &text, "bound by");
    let mut x = area.x;
    for bound in Bound::ALL {
        let is_there = |point: &TrackPoint| !point.rapid && point.bound == Some(bound);
        if !track.points().iter().any(is_there) {
            continue;
        }
        let swatch = Area {
            x,
            width: 18.0,
            ..*area
        };
        svg.rect(&swatch, &format!("fill=\"{}\"", bound.colour()));
        svg.text(x + 23.0, below, Anchor::Start, &text, bound.label());
        x += 100.0;
    }
    if track.points().iter().any(|point| point.rapid) {
        rapid(svg, x, area);
    }
}

/// Draws the scale of feed colours.
pub(super) fn of_feed(svg: &mut Svg, max_feed_v: f64, area: &Area) {
    #[allow(clippy::cast_precision_loss, reason = "a small count")]
    let width = area.width / colour::SHADES as f64;
    let mut x = area.x;
    for shade in 0..colour::SHADES {
        // Half a pixel of overlap, or renderers show seams.
        let cell = Area {
            x,
            width: width + 0.5,
            ..*area
        };
        svg.rect(&cell, &format!("fill=\"{}\"", colour::hex(shade)));
        x += width;
    }
    let text = format!("fill=\"{QUIET}\" font-size=\"10\"");
    let below = area.bottom() + 12.0;
    for feed_v in ticks(0.0, max_feed_v, 5.0) {
        let x = (feed_v / max_feed_v.max(f64::MIN_POSITIVE)).mul_add(area.width, area.x);
        svg.line(
            (x, area.bottom()),
            (x, area.bottom() + 3.0),
            &format!("stroke=\"{QUIET}\""),
        );
        svg.text(x, below, Anchor::Middle, &text, &label(feed_v));
    }
    svg.text(
        area.x - 8.0,
        area.bottom() - 1.0,
        Anchor::End,
        &text,
        "feed mm/s",
    );
    rapid(svg, area.right() + 24.0, area);
}

/// Draws what the programmed path looks like, from `x` on.
pub(super) fn program(svg: &mut Svg, x: f64, area: &Area) {
    let middle = area.y + area.height / 2.0;
    svg.line(
        (x, middle),
        (x + 26.0, middle),
        &format!("stroke=\"{PROGRAM}\" stroke-width=\"5\" stroke-linecap=\"round\""),
    );
    svg.text(
        x + 34.0,
        area.bottom() - 1.0,
        Anchor::Start,
        &format!("fill=\"{QUIET}\" font-size=\"10\""),
        "programmed path",
    );
}

/// Draws what a rapid looks like, from `x` on.
fn rapid(svg: &mut Svg, x: f64, area: &Area) {
    let middle = area.y + area.height / 2.0;
    svg.line(
        (x, middle),
        (x + 26.0, middle),
        &format!("stroke=\"{RAPID}\" stroke-dasharray=\"4 3\""),
    );
    svg.text(
        x + 32.0,
        area.bottom() - 1.0,
        Anchor::Start,
        &format!("fill=\"{QUIET}\" font-size=\"10\""),
        "rapid",
    );
}

/// Says whose coordinates the views have.
pub(super) fn coordinates(svg: &mut Svg, words: &str, x: f64, area: &Area) {
    let text = format!("fill=\"{QUIET}\" font-size=\"10\"");
    svg.text(x, area.bottom() - 1.0, Anchor::Start, &text, words);
}
