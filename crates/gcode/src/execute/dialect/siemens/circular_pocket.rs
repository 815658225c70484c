//! POCKET4 and POCKET2: a circular pocket, cleared in circles from its centre outwards.

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::dialect::siemens::pocket::{Insertion, Places, Pocket};
use crate::execute::interpreter::Interpreter;

const PLACES: Places = Places {
    center: 5,
    depth: 7,
    premachined: 15..17,
    helix: 17,
};

/// A circle about the centre, from its point in the direction of the first axis.
fn circle(lines: &mut Lines, pocket: &Pocket, radius: f64) {
    let start = [pocket.center[0] + radius, pocket.center[1]];
    lines.across("G1", start);
    lines.arc(pocket.arc(), start, None, [-radius, 0.0], 1);
}

/// The lines of `pocket`, which has this radius.
pub(super) fn circular(pocket: &Pocket, radius: f64, arguments: Arguments<'_>) -> Outcome<Lines> {
    let outermost = radius - pocket.tool_radius;
    let rough = outermost - pocket.edge;
    if rough <= 0.0 {
        return Err(arguments
            .refused(
                "the tool is too large for the pocket",
                "its radius and FAL leave no way inside of PRAD",
            )
            .help("use a smaller tool, or write plain blocks for a hole of its size"));
    }
    if let Insertion::Helix(helix, _) = pocket.insertion
        && helix > rough
    {
        return Err(arguments
            .refused(
                "the helix is wider than the pocket",
                "RAD1 counts from the centre to the tool's",
            )
            .help(format!("write an RAD1 of {rough} or less")));
    }
    // The bottom is finished up to the edge, which is finished already.
    let reach = if pocket.finishes { outermost } else { rough };
    let rings = pocket.rings(reach);
    let clear = |lines: &mut Lines| {
        let mut ring = 0.0;
        while ring < rings {
            ring += 1.0;
            circle(lines, pocket, reach * ring / rings);
        }
    };
    let finish = |lines: &mut Lines| {
        let [x, y] = pocket.center;
        // On a quarter circle to the edge and off it, half as wide as the pocket.
        let quarter = 0.5 * outermost;
        let side = if pocket.is_clockwise {
            quarter
        } else {
            -quarter
        };
        let (inner, edge) = (x + outermost - quarter, [x + outermost, y]);
        lines.across("G1", [inner, y + side]);
        lines.arc(pocket.arc(), edge, None, [0.0, -side], 1);
        lines.arc(pocket.arc(), edge, None, [-outermost, 0.0], 1);
        lines.arc(pocket.arc(), [inner, y - side], None, [-quarter, 0.0], 1);
    };
    pocket.machined(arguments, 2.0 * rings, clear, finish)
}

impl Interpreter {
    pub(super) fn circular_pocket(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let pocket = self.pocket(arguments, &PLACES)?;
        let radius = arguments.positive(4, "PRAD", "the radius of the pocket")?;
        circular(&pocket, radius, arguments)
    }
}
