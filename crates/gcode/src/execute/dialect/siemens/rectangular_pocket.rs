//! POCKET3 and POCKET1: a rectangular pocket with round corners, cleared in rings from its middle outwards.

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::dialect::siemens::pocket::{Insertion, Places, Pocket};
use crate::execute::dialect::siemens::rectangle::{Rectangle, Ring};
use crate::execute::interpreter::Interpreter;

const PLACES: Places = Places {
    center: 7,
    depth: 10,
    premachined: 18..21,
    helix: 21,
};

/// Its size, and the angle of its length to the first axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Size {
    pub(super) length: f64,
    pub(super) width: f64,
    pub(super) corner: f64,
    pub(super) angle: f64,
}

impl Size {
    /// The arguments `first`, LENG, WID and CRAD, and STA.
    pub(super) fn read(arguments: Arguments<'_>, first: usize, angle: usize) -> Outcome<Self> {
        Ok(Self {
            length: arguments.positive(first, "LENG", "the length of the pocket")?,
            width: arguments.positive(first + 1, "WID", "the width of the pocket")?,
            corner: arguments.need(first + 2, "CRAD", "the radius of the corners")?,
            angle: arguments.or_zero(angle),
        })
    }

    /// The lines of `pocket`.
    pub(super) fn machined(self, pocket: &Pocket, arguments: Arguments<'_>) -> Outcome<Lines> {
        let Self {
            length,
            width,
            corner,
            angle,
        } = self;
        let tool = pocket.tool_radius;
        if corner < tool * (1.0 - 1e-9) || 2.0 * corner > length.min(width) * (1.0 + 1e-9) {
            let message = format!("corners with a radius of {corner}");
            return Err(arguments
                .refused(
                    message,
                    "they are at least as wide as the tool, and at most as the pocket",
                )
                .help("use a smaller tool, or check CRAD"));
        }
        let outermost = Ring {
            half: [0.5 * length - tool, 0.5 * width - tool],
            corner: (corner - tool).max(0.0),
        };
        let rough = outermost.inside(pocket.edge);
        let narrow = rough.half[0].min(rough.half[1]);
        if narrow <= 0.0 {
            return Err(arguments
                .refused(
                    "the tool is too large for the pocket",
                    "its radius and FAL leave no way inside",
                )
                .help("use a smaller tool"));
        }
        if let Insertion::Helix(helix, _) = pocket.insertion
            && helix > narrow
        {
            return Err(arguments
                .refused(
                    "the helix is wider than the pocket",
                    "RAD1 counts from the centre to the tool's",
                )
                .help(format!("write an RAD1 of {narrow} or less")));
        }
        let (sin, cos) = angle.to_radians().sin_cos();
        let rectangle = Rectangle {
            center: pocket.center,
            is_clockwise: pocket.is_clockwise,
            turn: [cos, sin],
        };
        let last = if pocket.finishes { outermost } else { rough };
        let reach = last.half[0].min(last.half[1]);
        let rings = pocket.rings(reach);
        let clear = |lines: &mut Lines| {
            // The middle is a line where the pocket is longer than wide, or wider than long.
            let middle = last.inside(reach);
            let [a, b] = middle.half;
            if a > 0.0 || b > 0.0 {
                rectangle.line_to(lines, [-a, -b]);
                rectangle.line_to(lines, [a, b]);
                rectangle.line_to(lines, [0.0, 0.0]);
            }
            let mut ring = 0.0;
            while ring < rings {
                ring += 1.0;
                let ring = last.inside(reach * (1.0 - ring / rings));
                rectangle.line_to(lines, [ring.half[0], 0.0]);
                rectangle.around(lines, ring);
            }
        };
        let finish = |lines: &mut Lines| {
            let [a, b] = outermost.half;
            let quarter = 0.5 * a.min(b);
            rectangle.line_to(lines, [a - quarter, -quarter]);
            rectangle.arc_to(lines, [a, 0.0], [0.0, quarter]);
            rectangle.around(lines, outermost);
            rectangle.arc_to(lines, [a - quarter, quarter], [-quarter, 0.0]);
        };
        pocket.machined(arguments, 10.0 * rings + 4.0, clear, finish)
    }
}

impl Interpreter {
    pub(super) fn rectangular_pocket(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let pocket = self.pocket(arguments, &PLACES)?;
        Size::read(arguments, 4, 9)?.machined(&pocket, arguments)
    }
}
