//! POCKET1 and POCKET2: a rectangular and a circular pocket as older controls have them.
//!
//! | VARI | |
//! |---|---|
//! | 0 | roughing, then finishing where FAL leaves something |
//! | 1 | roughing: FAL is left at the edge |
//! | 2 | finishing of the edge |
//!
//! The tool goes down in the middle, at the feed FFD. CDIR is 2 (`G2`) or 3 (`G3`). Levels of finishing are
//! MIDF deep at most, or MID; its feed is FFP2, or FFP1. Not covered: another speed for finishing (SSF).

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::circular_pocket::circular;
use crate::execute::dialect::siemens::cycle::plane_axes;
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::dialect::siemens::pocket::{Insertion, MAX_WIDTH, Pocket};
use crate::execute::dialect::siemens::rectangular_pocket::Size;
use crate::execute::interpreter::Interpreter;

/// The pocket to rough out or to finish, and the one to finish behind it.
struct Parts {
    first: Pocket,
    then: Option<Pocket>,
}

impl Parts {
    fn lines(self, lines_of: impl Fn(&Pocket) -> Outcome<Lines>) -> Outcome<Lines> {
        let mut lines = lines_of(&self.first)?;
        if let Some(then) = self.then {
            lines.steps.extend(lines_of(&then)?.steps);
        }
        Ok(lines)
    }
}

impl Interpreter {
    pub(super) fn older_rectangular_pocket(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let parts = self.older_pocket(arguments, 8, 11)?;
        let size = Size::read(arguments, 5, 10)?;
        parts.lines(|pocket| size.machined(pocket, arguments))
    }

    pub(super) fn older_circular_pocket(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        let parts = self.older_pocket(arguments, 6, 8)?;
        let radius = arguments.positive(5, "PRAD", "the radius of the pocket")?;
        parts.lines(|pocket| circular(pocket, radius, arguments))
    }

    /// What the arguments say but for the shape: `center` is where CPA is, and `feeds` where FFD is.
    fn older_pocket(
        &self,
        arguments: Arguments<'_>,
        center: usize,
        feeds: usize,
    ) -> Outcome<Parts> {
        let levels = arguments.levels(arguments.get(4))?;
        let axes = plane_axes(self, arguments)?;
        for (index, name) in [(center, "CPA"), (center + 1, "CPO")] {
            let _given = arguments.need(index, name, "the centre of the pocket")?;
        }
        let plunge = arguments.positive(feeds, "FFD", "the feed down")?;
        let feed = arguments.positive(feeds + 1, "FFP1", "the feed in the plane")?;
        let step = arguments.positive(feeds + 2, "MID", "how deep a level is at most")?;
        let is_clockwise = arguments.choice(feeds + 3, "CDIR", &[2, 3])? == 2;
        let edge = arguments.not_negative(feeds + 4, "FAL", "what is left at the edge")?;
        let variant = arguments.choice(feeds + 5, "VARI", &[0, 1, 2])?;
        let finish_step =
            arguments.not_negative(feeds + 6, "MIDF", "how deep a level is, finishing")?;
        let finish_feed = arguments.not_negative(feeds + 7, "FFP2", "the feed of finishing")?;
        let finishes = variant == 2 || (variant == 0 && edge > 0.0);
        if finishes && arguments.or_zero(feeds + 8) != 0.0 {
            return Err(arguments
                .refused(
                    "another speed for finishing (SSF)",
                    "which speed is in force behind the cycle depends on the control",
                )
                .help("write VARI 1, then S and the cycle once more with VARI 2"));
        }
        let tool_radius = self.mill_radius(arguments)?;
        let rough = Pocket {
            levels,
            axes,
            center: self.pocket_center(arguments, center, axes)?,
            step,
            edge,
            floor: 0.0,
            feed,
            plunge,
            is_clockwise,
            insertion: Insertion::Feed,
            finishes: false,
            width: MAX_WIDTH * 2.0 * tool_radius,
            tool_radius,
        };
        let finish = Pocket {
            step: if finish_step > 0.0 { finish_step } else { step },
            feed: if finish_feed > 0.0 { finish_feed } else { feed },
            finishes: true,
            ..rough
        };
        let (first, then) = match variant {
            2 => (finish, None),
            _ => (rough, finishes.then_some(finish)),
        };
        Ok(Parts { first, then })
    }
}
