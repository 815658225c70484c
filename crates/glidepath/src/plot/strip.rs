//! A strip: a quantity against time, with its limit lines.

use super::colour::{BAND, FRAME, GRID, INK, LIMIT, QUIET};
use super::envelope::Envelope;
use super::svg::{Anchor, Area, Path, Svg};
use super::ticks::{label, ticks};

/// What a strip shows.
#[derive(Debug)]
pub(super) struct Strip<'a> {
    pub(super) title: String,
    pub(super) unit: &'static str,
    pub(super) colour: &'static str,
    pub(super) curve: &'a Envelope,
    /// Both ±limit are drawn.
    pub(super) limit: Option<f64>,
    /// What the curve may be inside of at each time, drawn as a band; the largest of it is the
    /// limit.
    pub(super) band: Option<Band<'a>>,
    /// False for a quantity that is never negative.
    pub(super) signed: bool,
}

/// What a curve may be inside of at each time.
#[derive(Debug)]
pub(super) struct Band<'a> {
    pub(super) curve: &'a Envelope,
    /// It is as wide at all times: then its edge is a limit line.
    pub(super) is_constant: bool,
    /// The largest share of it that is used at a time.
    pub(super) share: f64,
}

/// The time axis all strips share.
#[derive(Debug, Clone, Copy)]
pub(super) struct TimeAxis {
    pub(super) period_t: f64,
    /// Length in seconds, > 0.
    pub(super) end_t: f64,
}

/// Below this share of the limit a curve would be a flat line: then the scale is the curve's own
/// and the limit is off it.
const SMALLEST_SHARE: f64 = 0.04;

impl Strip<'_> {
    /// Largest value of the scale.
    fn top(&self) -> f64 {
        let peak = self.curve.peak();
        match self.limit {
            Some(limit) if self.band.is_some() => 1.12 * limit.max(peak),
            Some(limit) if peak >= SMALLEST_SHARE * limit || peak <= 0.0 => 1.12 * limit.max(peak),
            _ if peak > 0.0 => 1.15 * peak,
            _ => 1.0,
        }
    }

    pub(super) fn draw(&self, svg: &mut Svg, time: &TimeAxis, area: &Area) {
        let top = self.top();
        let bottom = if self.signed { -top } else { 0.0 };
        let x = |t: f64| (t / time.end_t).mul_add(area.width, area.x);
        let y = |value: f64| (top - value) / (top - bottom) * area.height + area.y;

        if let Some(band) = &self.band {
            let style = format!("fill=\"{BAND}\" stroke=\"{BAND}\"");
            let ends = band
                .curve
                .stretches()
                .map(|(tick, ends)| (tick, ends.map(|(_, high)| (0.0, high))));
            outline(svg, ends, &|tick| x(tick * time.period_t), &y, &style);
        }
        for t in ticks(0.0, time.end_t, 12.0) {
            svg.line(
                (x(t), area.y),
                (x(t), area.bottom()),
                &format!("stroke=\"{GRID}\""),
            );
        }
        svg.line(
            (area.x, y(0.0)),
            (area.right(), y(0.0)),
            &format!("stroke=\"{FRAME}\""),
        );
        let colour = self.colour;
        let style = format!(
            "fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"1.1\" stroke-linejoin=\"round\""
        );
        let at = |tick: f64| x(tick * time.period_t);
        outline(svg, self.curve.stretches(), &at, &y, &style);
        let has_line = self.band.as_ref().is_none_or(|band| band.is_constant);
        if let Some(limit) = self.limit.filter(|limit| has_line && *limit <= top) {
            let style = format!("stroke=\"{LIMIT}\" stroke-width=\".8\" stroke-dasharray=\"5 3\"");
            let both = if self.signed {
                vec![limit, -limit]
            } else {
                vec![limit]
            };
            for value in both {
                svg.line((area.x, y(value)), (area.right(), y(value)), &style);
                svg.text(
                    area.x - 5.0,
                    y(value) + 3.5,
                    Anchor::End,
                    &format!("fill=\"{LIMIT}\" font-size=\"9\""),
                    &label(value),
                );
            }
        }
        svg.rect(area, &format!("fill=\"none\" stroke=\"{FRAME}\""));
        self.draw_names(svg, area);
    }

    /// Name and peak, to the right of the strip.
    fn draw_names(&self, svg: &mut Svg, area: &Area) {
        let left = area.right() + 8.0;
        let middle = area.y + area.height / 2.0;
        let title = format!("fill=\"{INK}\" font-weight=\"600\"");
        svg.text(left, middle - 8.0, Anchor::Start, &title, &self.title);
        let quiet = format!("fill=\"{QUIET}\" font-size=\"10\"");
        let peak = format!("peak {} {}", label(self.curve.peak()), self.unit);
        svg.text(left, middle + 6.0, Anchor::Start, &quiet, &peak);
        if let Some(limit) = self.limit {
            let (share, what) = match &self.band {
                Some(band) => (100.0 * band.share, "tolerance"),
                None => (100.0 * self.curve.peak() / limit, "limit"),
            };
            let words = format!("{} % of the {what}", label(share));
            svg.text(left, middle + 19.0, Anchor::Start, &quiet, &words);
        }
    }
}

/// Draws the area between the smallest and the largest value of each stretch.
fn outline(
    svg: &mut Svg,
    stretches: impl Iterator<Item = (f64, Option<(f64, f64)>)>,
    x: &impl Fn(f64) -> f64,
    y: &impl Fn(f64) -> f64,
    style: &str,
) {
    let mut outline = Path::default();
    let mut stretch: Vec<(f64, f64, f64)> = Vec::new();
    let mut flush = |stretch: &mut Vec<(f64, f64, f64)>| {
        for (i, (tick, _, high)) in stretch.iter().enumerate() {
            if i == 0 {
                outline.move_to(x(*tick), y(*high));
            } else {
                outline.line_to(x(*tick), y(*high));
            }
        }
        for (tick, low, _) in stretch.iter().rev() {
            outline.line_to(x(*tick), y(*low));
        }
        if !stretch.is_empty() {
            outline.close();
        }
        stretch.clear();
    };
    for (tick, values) in stretches {
        match values {
            Some((low, high)) => stretch.push((tick, low, high)),
            None => flush(&mut stretch),
        }
    }
    flush(&mut stretch);
    svg.path(&outline, style);
}

/// Draws the seconds under the last strip.
pub(super) fn seconds(svg: &mut Svg, time: &TimeAxis, area: &Area) {
    let style = format!("fill=\"{QUIET}\" font-size=\"10\"");
    for t in ticks(0.0, time.end_t, 12.0) {
        let x = (t / time.end_t).mul_add(area.width, area.x);
        svg.text(x, area.bottom() + 13.0, Anchor::Middle, &style, &label(t));
    }
    svg.text(
        area.right() + 8.0,
        area.bottom() + 13.0,
        Anchor::Start,
        &style,
        "seconds",
    );
}
