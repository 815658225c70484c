//! The SVG document of a plot, and the few elements that it is made of.

use core::fmt::Write as _;

/// Where a text stands relative to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    const fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// A rectangle in pixels, y downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Area {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Area {
    pub(super) fn right(&self) -> f64 {
        self.x + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.y + self.height
    }

    pub(super) fn contains(&self, x: f64, y: f64) -> bool {
        (self.x..=self.right()).contains(&x) && (self.y..=self.bottom()).contains(&y)
    }
}

/// An SVG document as it grows.
#[derive(Debug)]
pub(super) struct Svg {
    text: String,
    clips: usize,
}

// Writing to a String does not fail, so the results of `write!` carry nothing.
impl Svg {
    pub(super) fn new(width: f64, height: f64) -> Self {
        let mut text = String::new();
        let _ = write!(
            text,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" \
             font-family=\"'DejaVu Sans','Segoe UI',Helvetica,Arial,sans-serif\" \
             font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        );
        Self { text, clips: 0 }
    }

    /// From here on nothing is drawn outside of an area.
    pub(super) fn begin_clip(&mut self, area: &Area) {
        let id = self.clips;
        self.clips += 1;
        let _ = writeln!(self.text, "<clipPath id=\"clip{id}\">");
        self.rect(area, "");
        let _ = writeln!(self.text, "</clipPath>\n<g clip-path=\"url(#clip{id})\">");
    }

    /// Ends what was begun last.
    pub(super) fn end_clip(&mut self) {
        self.text.push_str("</g>\n");
    }

    /// A text; `style` is further attributes, for example `fill="#333"`.
    pub(super) fn text(&mut self, x: f64, y: f64, anchor: Anchor, style: &str, words: &str) {
        let anchor = anchor.name();
        let _ = writeln!(
            self.text,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" {style}>{}</text>",
            escaped(words)
        );
    }

    pub(super) fn line(&mut self, from: (f64, f64), to: (f64, f64), style: &str) {
        let _ = writeln!(
            self.text,
            "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" {style}/>",
            from.0, from.1, to.0, to.1
        );
    }

    pub(super) fn rect(&mut self, area: &Area, style: &str) {
        let Area {
            x,
            y,
            width,
            height,
        } = area;
        let _ = writeln!(
            self.text,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" {style}/>"
        );
    }

    pub(super) fn path(&mut self, path: &Path, style: &str) {
        if !path.data.is_empty() {
            let _ = writeln!(self.text, "<path d=\"{}\" {style}/>", path.data);
        }
    }

    /// The whole document.
    pub(super) fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }
}

/// The `d` of a path, in steps of a tenth of a pixel, relative so that it stays short.
#[derive(Debug, Clone, Default)]
pub(super) struct Path {
    data: String,
    /// Where the pen is, in tenths of a pixel.
    pen: (i32, i32),
    /// Nothing was drawn since it was put there.
    is_fresh: bool,
}

impl Path {
    pub(super) fn move_to(&mut self, x: f64, y: f64) {
        self.pen = (tenths(x), tenths(y));
        self.is_fresh = true;
        self.data.push('M');
        self.number(self.pen.0);
        self.data.push(' ');
        self.number(self.pen.1);
    }

    pub(super) fn line_to(&mut self, x: f64, y: f64) {
        let to = (tenths(x), tenths(y));
        let (dx, dy) = (to.0 - self.pen.0, to.1 - self.pen.1);
        if (dx, dy) == (0, 0) {
            // A hole that is seen from above is a dot.
            if core::mem::take(&mut self.is_fresh) {
                self.data.push_str("h0");
            }
            return;
        }
        (self.pen, self.is_fresh) = (to, false);
        self.data.push('l');
        self.number(dx);
        if dy >= 0 {
            self.data.push(' ');
        }
        self.number(dy);
    }

    pub(super) fn close(&mut self) {
        self.data.push('z');
    }

    /// True if the pen stands at a point, to a tenth of a pixel.
    pub(super) fn is_at(&self, x: f64, y: f64) -> bool {
        !self.data.is_empty() && self.pen == (tenths(x), tenths(y))
    }

    fn number(&mut self, tenths: i32) {
        let sign = if tenths < 0 { "-" } else { "" };
        let (whole, tenth) = (tenths.unsigned_abs() / 10, tenths.unsigned_abs() % 10);
        let _ = match (whole, tenth) {
            (_, 0) => write!(self.data, "{sign}{whole}"),
            (0, _) => write!(self.data, "{sign}.{tenth}"),
            _ => write!(self.data, "{sign}{whole}.{tenth}"),
        };
    }
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "pixels of a plot; a cast saturates"
)]
fn tenths(pixels: f64) -> i32 {
    (pixels.clamp(-1e6, 1e6) * 10.0).round() as i32
}

fn escaped(words: &str) -> String {
    words
        .chars()
        .map(|c| match c {
            '<' => "&lt;".to_owned(),
            '>' => "&gt;".to_owned(),
            '&' => "&amp;".to_owned(),
            '"' => "&quot;".to_owned(),
            // XML has no way to write the other control characters.
            c if c.is_control() => "\u{fffd}".to_owned(),
            c => c.to_string(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_relative_and_in_tenths() {
        let mut path = Path::default();
        path.move_to(10.04, 20.0);
        path.line_to(10.5, 19.9);
        path.line_to(10.5, 19.9);
        path.line_to(0.0, 30.0);
        assert_eq!(path.data, "M10 20l.5-.1l-10.5 10.1");
        assert!(path.is_at(0.0, 30.0));
        path.move_to(5.0, 5.0);
        path.line_to(5.0, 5.0);
        path.line_to(5.0, 5.0);
        assert!(path.data.ends_with("M5 5h0"), "{}", path.data);
    }

    #[test]
    fn words_cannot_break_the_document() {
        assert_eq!(escaped("a<b>&\"\u{7}"), "a&lt;b&gt;&amp;&quot;\u{fffd}");
    }
}
