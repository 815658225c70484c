//! A view of the tool path from one side, coloured by what binds or by feed.

use super::bound::Bound;
use super::colour::{self, FRAME, GRID, INK, PROGRAM, QUIET, RAPID};
use super::part;
use super::svg::{Anchor, Area, Path, Svg};
use super::ticks::{label, ticks};
use super::track::{MotionTrace, TrackPoint};

/// The side from which the path is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum View {
    /// From above: X to the right, Y upwards.
    Top,
    /// From the front: X to the right, Z upwards.
    Front,
    /// As at a lathe: Z to the right, X upwards.
    Turning,
    /// From the right, front and above, all three axes equally foreshortened.
    Isometric,
}

impl View {
    const fn title(self) -> &'static str {
        match self {
            Self::Top => "top: X → Y ↑ mm",
            Self::Front => "front: X → Z ↑ mm",
            Self::Turning => "from above: Z → X ↑ mm",
            Self::Isometric => "isometric",
        }
    }

    /// Right and up, in mm.
    fn project(self, [x, y, z]: [f64; 3]) -> (f64, f64) {
        match self {
            Self::Top => (x, y),
            Self::Front => (x, z),
            Self::Turning => (z, x),
            Self::Isometric => {
                let (cos, sin) = (3.0_f64.sqrt() / 2.0, 0.5);
                ((x + y) * cos, (y - x).mul_add(sin, z))
            }
        }
    }

    /// Smallest and largest right and up of a track's part.
    fn extent(self, track: &MotionTrace) -> ((f64, f64), (f64, f64)) {
        const NOTHING: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);
        let points = part::of(track.points()).into_iter();
        let points = points.map(|at| self.project(at));
        let (x, y) = points.fold((NOTHING, NOTHING), |(x, y), (px, py)| {
            ((x.0.min(px), x.1.max(px)), (y.0.min(py), y.1.max(py)))
        });
        if x.0 <= x.1 {
            (x, y)
        } else {
            ((0.0, 0.0), (0.0, 0.0))
        }
    }
}

/// mm to pixels, the same scale both ways.
struct Scale {
    pixels_per_mm: f64,
    /// mm at the middle of the area, and the middle in pixels.
    middle_mm: (f64, f64),
    middle: (f64, f64),
}

impl Scale {
    fn fit(area: &Area, (x, y): ((f64, f64), (f64, f64))) -> Self {
        const MARGIN: f64 = 14.0;
        let width = (x.1 - x.0).max(1e-6);
        let height = (y.1 - y.0).max(1e-6);
        Self {
            pixels_per_mm: ((area.width - 2.0 * MARGIN) / width)
                .min((area.height - 2.0 * MARGIN) / height),
            middle_mm: (x.0.midpoint(x.1), y.0.midpoint(y.1)),
            middle: (area.x + area.width / 2.0, area.y + area.height / 2.0),
        }
    }

    fn x(&self, mm: f64) -> f64 {
        (mm - self.middle_mm.0).mul_add(self.pixels_per_mm, self.middle.0)
    }

    fn y(&self, mm: f64) -> f64 {
        (mm - self.middle_mm.1).mul_add(-self.pixels_per_mm, self.middle.1)
    }

    /// mm at a pixel.
    fn mm(&self, x: f64, y: f64) -> (f64, f64) {
        (
            (x - self.middle.0) / self.pixels_per_mm + self.middle_mm.0,
            (self.middle.1 - y) / self.pixels_per_mm + self.middle_mm.1,
        )
    }
}

/// Draws a view of the track into an area, over the programmed path.
pub(super) fn draw(
    svg: &mut Svg,
    view: View,
    track: &MotionTrace,
    program: &[TrackPoint],
    area: &Area,
) {
    let scale = Scale::fit(area, view.extent(track));
    if view != View::Isometric {
        grid(svg, &scale, area);
    }
    svg.rect(area, &format!("fill=\"none\" stroke=\"{FRAME}\""));
    svg.text(
        area.x,
        area.y - 6.0,
        Anchor::Start,
        &format!("fill=\"{QUIET}\""),
        view.title(),
    );

    let at = |point: &TrackPoint| {
        let (x, y) = view.project(point.at);
        (scale.x(x), scale.y(y))
    };
    let mut programmed = Path::default();
    for pair in program.windows(2) {
        let [from, to] = pair else { continue };
        if !to.rapid {
            draw_on(&mut programmed, at(from), at(to));
        }
    }
    let style = "fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\"";
    // Rapids may go far beyond.
    svg.begin_clip(area);
    svg.path(
        &programmed,
        &format!("{style} stroke=\"{PROGRAM}\" stroke-width=\"5\""),
    );
    let mut rapids = Path::default();
    let mut shades: Vec<Path> = vec![Path::default(); colour::SHADES];
    let mut bounds: Vec<Path> = vec![Path::default(); Bound::ALL.len()];
    for pair in track.points().windows(2) {
        let [from, to] = pair else { continue };
        let share = from.feed_v.midpoint(to.feed_v) / track.max_feed_v().max(f64::MIN_POSITIVE);
        let path = match to.bound {
            _ if to.rapid => Some(&mut rapids),
            Some(bound) => bounds.get_mut(bound.index()),
            None => shades.get_mut(colour::shade(share)),
        };
        let Some(path) = path else { continue };
        draw_on(path, at(from), at(to));
    }
    svg.path(
        &rapids,
        &format!("fill=\"none\" stroke=\"{RAPID}\" stroke-width=\"1\" stroke-dasharray=\"4 3\""),
    );
    let shades = shades
        .iter()
        .enumerate()
        .map(|(shade, path)| (colour::hex(shade), path));
    let bounds = Bound::ALL
        .iter()
        .zip(&bounds)
        .map(|(bound, path)| (bound.colour().to_owned(), path));
    for (colour, path) in shades.chain(bounds) {
        svg.path(
            path,
            &format!("{style} stroke=\"{colour}\" stroke-width=\"2\""),
        );
    }
    svg.end_clip();
    if let Some(first) = track.points().first() {
        begin(svg, first, at(first), area);
    }
}

/// Marks where the track begins, or says where that is, out of view.
fn begin(svg: &mut Svg, first: &TrackPoint, (x, y): (f64, f64), area: &Area) {
    if !area.contains(x, y) {
        let [x, y, z] = first.at.map(label);
        svg.text(
            area.x + 6.0,
            area.y + 13.0,
            Anchor::Start,
            &format!("fill=\"{QUIET}\" font-size=\"10\""),
            &format!("begins outside, at X {x} Y {y} Z {z}"),
        );
        return;
    }
    let dot = Area {
        x: x - 3.0,
        y: y - 3.0,
        width: 6.0,
        height: 6.0,
    };
    svg.rect(
        &dot,
        &format!("rx=\"3\" fill=\"#ffffff\" stroke=\"{INK}\" stroke-width=\"1.4\""),
    );
}

/// Draws a line on a path, whose pen may be elsewhere.
fn draw_on(path: &mut Path, start: (f64, f64), end: (f64, f64)) {
    if !path.is_at(start.0, start.1) {
        path.move_to(start.0, start.1);
    }
    path.line_to(end.0, end.1);
}

/// Where a point of the view stands, in pixels.
pub(super) fn pixel(view: View, track: &MotionTrace, area: &Area, at: [f64; 3]) -> (f64, f64) {
    let scale = Scale::fit(area, view.extent(track));
    let (x, y) = view.project(at);
    (scale.x(x), scale.y(y))
}

fn grid(svg: &mut Svg, scale: &Scale, area: &Area) {
    let (left, top) = scale.mm(area.x, area.y);
    let (right, bottom) = scale.mm(area.right(), area.bottom());
    let text = format!("fill=\"{QUIET}\" font-size=\"10\"");
    let line = format!("stroke=\"{GRID}\"");
    for mm in ticks(left, right, area.width / 70.0) {
        let x = scale.x(mm);
        svg.line((x, area.y), (x, area.bottom()), &line);
        if (area.x + 6.0..area.right() - 6.0).contains(&x) {
            svg.text(x, area.bottom() + 12.0, Anchor::Middle, &text, &label(mm));
        }
    }
    for mm in ticks(bottom, top, area.height / 45.0) {
        let y = scale.y(mm);
        svg.line((area.x, y), (area.right(), y), &line);
        if (area.y + 4.0..area.bottom() - 4.0).contains(&y) {
            svg.text(area.x - 5.0, y + 3.5, Anchor::End, &text, &label(mm));
        }
    }
}
