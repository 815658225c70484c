//! What a program reads of the control by names with `$`.
//!
//! | | |
//! |---|---|
//! | `$P_EP[X]`, `$AA_IW[X]` | where the program has gone to, in its coordinates; with DIAMON and DIAM90 X is a diameter, in G91 too |
//! | `$AA_IM[X]` | the same in the machine's |
//! | `$P_UIFR[1,X,TR]`, `[1,Z,RT]`; `$P_IFRAME[X,TR]`, `$P_UIFRNUM` | a coordinate system; the one in force |
//! | `$P_PFRAME[X,TR]`, `[Z,RT]`, `[X,SC]`, `[X,MI]` | the frame of the program |
//! | `$TC_DP3[1,2]` to `$TC_DP6[1,2]` | lengths and radius of an edge of a tool; with flat D numbers `$TC_DP3[5]` of an offset |
//! | `$P_TOOLNO`, `$P_TOOL`, `$P_TOOLR`, `$P_TOOLL[1]` | tool in the spindle, the edge in force, its radius, its lengths |
//! | `$P_F`, `$P_S` | feed, speed of the spindle |
//! | `$P_GG[6]`, `[8]`, `[14]` | which code of a group is in force: plane, coordinate system, distances |
//! | `$P_SEARCH`, `$P_SIM`, `$P_ISTEST`, `$P_DRYRUN` | 0: the program is executed |
//!
//! Lengths are in millimetres; with G700 they are in inches, with G70 not.

use glidepath_geometry::{Axis, Plane};

use crate::execute::dialect::siemens::system_data::{EdgePart, edge_part, system_number};
use crate::execute::interpreter::Interpreter;
use crate::execute::scope::{coordinate, in_units};
use crate::setup::tool_table::Tool;
use crate::syntax::dialect::siemens::system_index::Index;
use crate::syntax::modes::{Distance, FeedMode};

impl Interpreter {
    /// The value of a variable of the control; `None`: it is not known.
    pub(crate) fn siemens_value(&self, name: &[u8], index: &[Index]) -> Option<f64> {
        let modal = &self.state.modal;
        let axis = match index {
            [Index::Axis(axis)] => Some(*axis),
            _ => None,
        };
        let is_diameter = axis == Some(Axis::X) && self.counts_diameters();
        Some(match (name, index) {
            (b"$P_EP" | b"$AA_IW", _) => {
                let share = if is_diameter { 2.0 } else { 1.0 };
                let program = self.state.offsets.to_program(self.state.position);
                share * self.in_variable_units(program, axis?)
            }
            // The machine's places have no diameters in the control's manual, nor are they said to be radii.
            (b"$AA_IM", _) if is_diameter => return None,
            (b"$AA_IM", _) => self.in_variable_units(self.state.position, axis?),
            // Asked for where a line is rewritten; no program can name these.
            (b"DIAM90", _) => f64::from(u8::from(self.state.diameter_by_distance)),
            (b"LATHE", []) => f64::from(u8::from(self.options.is_lathe())),
            (b"H", []) => f64::from(u8::from(self.options.siemens.reads_over_h)),
            (b"COUNTED", [Index::Axis(axis)]) => self.counted_from(axis.index())?,
            (b"AP", _) => self.state.pole.degrees.unwrap_or(0.0),
            (b"RP", _) => self.state.pole.radius_mm.unwrap_or(0.0) / modal.units.mm(),
            (b"$P_TOOLNO", []) => f64::from(self.state.tool),
            (b"$P_TOOL", []) => f64::from(self.state.edge.unwrap_or(0)),
            (b"$P_TOOLR", []) => {
                self.edge_value(self.edge_in_force().unwrap_or_default(), EdgePart::Radius)?
            }
            (b"$P_TOOLL", [Index::Value(which)]) => {
                let name: &[u8] = match which {
                    1.0 => b"$TC_DP3",
                    2.0 => b"$TC_DP4",
                    3.0 => b"$TC_DP5",
                    _ => return None,
                };
                let part = edge_part(name, self.options.is_lathe())?;
                self.edge_value(self.edge_in_force().unwrap_or_default(), part)?
            }
            (b"$P_F", []) => {
                let per_second = match modal.feed_mode {
                    FeedMode::PerMinute => 60.0,
                    FeedMode::PerRevolution => 1.0,
                    FeedMode::InverseTime => return None,
                };
                modal.feed?.linear_v * per_second / self.feed_unit_mm()
            }
            (b"$P_S", []) if !self.state.spindle.follows_tool() => self.state.spindle.speed,
            (b"$P_SEARCH" | b"$P_SIM" | b"$P_ISTEST" | b"$P_DRYRUN", []) => 0.0,
            (b"$P_GG", [Index::Value(group)]) => self.code_of_group(*group)?,
            (b"$P_UIFR", [Index::Value(number), Index::Axis(axis), Index::Word(part)]) => {
                let system = self.kept_system(system_number(*number)?);
                match part.as_slice() {
                    b"TR" => self.in_variable_units(system.origin, *axis),
                    b"RT" if *axis == Axis::Z => system.rotation_deg,
                    b"RT" | b"FI" | b"MI" => 0.0,
                    _ => return None,
                }
            }
            (b"$P_PFRAME", [Index::Axis(axis), Index::Word(part)]) => {
                self.program_frame_value(*axis, part)?
            }
            (b"$P_UIFRNUM", []) => self.code_of_group(8.0)? - 1.0,
            (b"$P_IFRAME", [Index::Axis(axis), Index::Word(part)]) => {
                let system = self.state.offsets.system();
                match part.as_slice() {
                    b"TR" => self.in_variable_units(system.origin, *axis),
                    b"RT" if *axis == Axis::Z => system.rotation_deg,
                    b"RT" | b"FI" | b"MI" => 0.0,
                    _ => return None,
                }
            }
            (name, index) => {
                let part = edge_part(name, self.options.is_lathe())?;
                let tools = self.state.tools.as_ref()?;
                let (tool, edge) = self.edge_of(index)?;
                self.edge_value(*tools.edge(tool, edge)?, part)?
            }
        })
    }

    /// The coordinate that increments of an axis count from; `None`: it is not known.
    fn counted_from(&self, axis: usize) -> Option<f64> {
        let untraversed = &self.state.untraversed;
        let is_clear = untraversed.is_unclear.get(axis) == Some(&false);
        is_clear.then(|| coordinate(self, axis) + in_units(self, untraversed.way, axis))
    }

    fn edge_value(&self, tool: Tool, part: EdgePart) -> Option<f64> {
        let mm = self.variable_unit_mm();
        Some(match part {
            EdgePart::Kind => return None,
            EdgePart::Length(axis) => tool.offset[axis] / mm,
            EdgePart::Radius => 0.5 * tool.diameter_mm / mm,
        })
    }

    /// The number within its group of the code that is in force.
    fn code_of_group(&self, group: f64) -> Option<f64> {
        let modal = &self.state.modal;
        let offsets = &self.state.offsets;
        Some(match group {
            6.0 => match modal.plane {
                Plane::Xy => 1.0,
                Plane::Zx => 2.0,
                Plane::Yz => 3.0,
                Plane::Uv | Plane::Wu | Plane::Vw => return None,
            },
            // G500 is the first, G54 the second.
            8.0 => match offsets.fanuc.active {
                None => f64::from(u32::try_from(offsets.active).ok()?) + 2.0,
                Some(0) => 1.0,
                Some(_) => return None,
            },
            14.0 => match modal.distance {
                Distance::Absolute => 1.0,
                Distance::Incremental => 2.0,
            },
            _ => return None,
        })
    }
}
