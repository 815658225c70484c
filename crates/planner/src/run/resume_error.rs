//! The errors of a resumption: why a program cannot be taken up again.

use core::fmt::{Display, Formatter, Result as FmtResult};
use glidepath_geometry::{Axis, AxisVector};
use thiserror::Error;

use super::nearness::{ROUNDING_MM, distance};

/// The reason why a program cannot be taken up again. Nothing has moved.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ResumeError {
    /// The interpolator has not executed any program since it was started.
    #[error("no program was under way: run it from its beginning, without --resume")]
    NothingToResume,
    /// What was executed last came to its end.
    #[error("what was executed last came to its end: there is nothing to resume")]
    Completed,
    /// The program that is under way goes back along its path.
    #[error(
        "the program under way goes back along its path: let it go on (`glidepath forward`), or end \
         it (`glidepath abort`)"
    )]
    GoesBack,
    /// The program is not the one that was under way, or was edited since.
    #[error(
        "this is not the program that was under way, or it was edited since; only the same text can \
         be resumed"
    )]
    OtherProgram,
    /// The program was begun at a line, and left on the way there.
    #[error("the program was left on the way to {}", Beginning(*.line))]
    OnTheWay {
        /// The line.
        line: u32,
    },
    /// The program was left in a pass of a thread.
    #[error(
        "the program was left in the thread of line {line}: retract the tool, and run it from that \
         line or an earlier one (--from-line)"
    )]
    InThread {
        /// The line.
        line: u32,
    },
    /// Another tool is in the spindle than the program has put there.
    #[error(
        "the program was left with {} in the spindle, and now there is {}: put that back as programs of \
         this machine do, in LinuxCNC's words by `glidepath mdi 'T{expected} M6'`",
        ToolName(*.expected), ToolName(*.tool)
    )]
    OtherTool {
        /// The tool in the spindle, 0 for none.
        tool: u32,
        /// The one that the program has put there, 0 for none.
        expected: u32,
    },
    /// The machine does not stand where the program says.
    #[error(
        "the machine does not stand on this program's path at block {block} (line {line}){}",
        WayBack(*.away)
    )]
    OffPath {
        /// The block.
        block: u32,
        /// Its line, 0 if the program ends before.
        line: u32,
        /// From where the program was left to the machine, mm or degrees; `None` if no point of the program
        /// comes into question.
        away: Option<AxisVector>,
    },
}

/// A tool, for people.
struct ToolName(u32);

impl Display for ToolName {
    fn fmt(&self, f: &mut Formatter<'_>) -> FmtResult {
        match self.0 {
            0 => f.write_str("no tool"),
            tool => write!(f, "T{tool}"),
        }
    }
}

/// How far the machine is from where the program was left, and what leads back.
struct WayBack(Option<AxisVector>);

impl Display for WayBack {
    fn fmt(&self, f: &mut Formatter<'_>) -> FmtResult {
        let Some(away) = self.0 else {
            return f.write_str(
                ", and no point there comes into question: another configuration was used",
            );
        };
        let axes = Axis::ALL.into_iter().zip(away.iter());
        let moved = || axes.clone().filter(|(_, away)| away.abs() > ROUNDING_MM);
        let far = distance(&away);
        write!(f, ": it is {far:.4} mm away from where that was left (")?;
        for (k, (axis, away)) in moved().enumerate() {
            let space = if k == 0 { "" } else { " " };
            write!(f, "{space}{axis}{away:+.4}")?;
        }
        f.write_str(
            "). It was moved, as a jog, a superposition, or `lift` of [jog] after an abort does, or another \
             configuration was used. \
             Where nothing is in the way, ",
        )?;
        // Down to the work comes last, up from it first.
        let is_down = |axis: Axis, away: f64| axis == Axis::Z && away > 0.0;
        let is_up = |axis: Axis, away: f64| axis == Axis::Z && away <= 0.0;
        let ups = moved().filter(|&(axis, away)| is_up(axis, *away));
        let across = moved().filter(|&(axis, _)| axis != Axis::Z);
        let downs = moved().filter(|&(axis, away)| is_down(axis, *away));
        let jog = |axes: &mut dyn Iterator<Item = (Axis, &f64)>| {
            let words = axes.map(|(axis, away)| format!(" {axis}{}", (-away * 1e6).round() / 1e6));
            Some(words.collect::<String>()).filter(|words| !words.is_empty())
        };
        let jogs = [jog(&mut { ups }), jog(&mut { across }), jog(&mut { downs })];
        let jogs = jogs.iter().flatten();
        let commands: Vec<String> = jogs
            .map(|words| format!("`glidepath jog{words}`"))
            .collect();
        let verb = if commands.len() > 1 { "lead" } else { "leads" };
        write!(f, "{} {verb} back", commands.join(", and then "))
    }
}

/// The line that a program was to begin with, which is not known before the way there has begun.
struct Beginning(u32);

impl Display for Beginning {
    fn fmt(&self, f: &mut Formatter<'_>) -> FmtResult {
        match self.0 {
            0 => f.write_str(
                "the line that it was to begin with: run it from that line again (--from-line)",
            ),
            line => write!(
                f,
                "line {line}, where it was to begin: run it from that line again (--from-line {line})"
            ),
        }
    }
}
