//! Whoever sees a plan as it is made.

use crate::command::text_lines::TextLines;
use glidepath_gcode::Lacking;
use glidepath_program::{Frame, Item};

/// A spectator, who sees the plan as it is made.
pub(in crate::command) trait Spectator: Send {
    /// What the program should say and does not, before its first item.
    fn lacks(&mut self, lacks: Lacking) {
        let _ = lacks;
    }

    /// The text of the program, before anything else; without a line where it is too long.
    fn text(&mut self, lines: &TextLines) {
        let _ = lines;
    }

    /// The next item of the program.
    fn item(&mut self, item: &Item) {
        let _ = item;
    }

    /// The next frame of the plan.
    fn frame(&mut self, frame: &Frame) {
        let _ = frame;
    }

    /// The plan is whole, or ends here for the reason given.
    fn end(&mut self, trouble: Option<&str>) {
        let _ = trouble;
    }
}

/// Nobody.
impl Spectator for () {}
