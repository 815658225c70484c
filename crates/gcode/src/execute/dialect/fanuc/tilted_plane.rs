//! G68.2, G53.1, G69; Haas' G254 and G255.
//!
//! | | |
//! |---|---|
//! | `G68.2 X Y Z I J K` | a plane whose zero is X, Y, Z: turned by I about Z, by J about the new X, by K about the new Z |
//! | `G68.2 P1 …` | turned by I about X, by J about Y, by K about Z, each of the work |
//! | `G68.2 P2 …`, `P3 …` | a plane of several blocks ([`super::plane_of_blocks`]) |
//! | `G53.1` | the rotary axes turn until the tool stands along the normal; P1: with the greater angle of the tilting axis, P2: with the smaller one |
//! | `G254` | the zero of the program goes with the table to where the rotary axes have brought it; the directions stay the machine's |

use glidepath_geometry::AxisVector;
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::tilted_plane::Branch;
use crate::execute::state::frame::Frame;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::frame_codes::TiltCode;
use crate::syntax::word_check::whole;

impl Interpreter {
    /// G68.2.
    pub(crate) fn fanuc_tilt(&mut self, block: &Block) -> Outcome<()> {
        let Some(Coded {
            code: TiltCode::Plane,
            span,
        }) = block.codes.tilt
        else {
            return Ok(());
        };
        let form = whole(block, b'P', 9)?.unwrap_or(0);
        if matches!(form, 2 | 3) {
            return self.plane_of_blocks(block, form, span);
        }
        self.check_plane_complete(span)?;
        let words = self.axis_values(block)?;
        if let Some((axis, _)) = block.axes().find(|(axis, _)| axis.index() >= 3) {
            let message = format!("{axis} in G68.2");
            let fault =
                BlockDiagnostic::new(DiagnosticCode::UnusedWord, block.axis_span(axis), message);
            return Err(fault
                .because("X, Y and Z are the zero of the plane, I, J and K its angles")
                .help("move the axis in a block before it"));
        }
        let [i, j, k] = [b'I', b'J', b'K'].map(|letter| block.get(letter).unwrap_or(0.0));
        let about = |axis: usize, angle: f64| {
            let mut degrees = [0.0; 3];
            degrees[axis] = angle;
            Frame::turned(degrees)
        };
        let turned = match form {
            0 => about(2, i).with(&about(0, j)).with(&about(2, k)),
            1 => about(2, k).with(&about(1, j)).with(&about(0, i)),
            _ => {
                let message = format!("G68.2 P{form} is not supported");
                let fault =
                    BlockDiagnostic::new(DiagnosticCode::NotSupported, block.span(b'P'), message);
                return Err(fault
                    .because("a plane by projected angles is not made")
                    .help("write its zero and the angles I, J and K, or three points (P2)"));
            }
        };
        let mut zero = AxisVector::zeros();
        for axis in 0..3 {
            zero[axis] = words[axis].unwrap_or(0.0);
        }
        self.begin_tilt(Frame::shifted(zero).with(&turned), span)
    }

    /// G53.1.
    pub(crate) fn fanuc_align(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(Coded {
            code: TiltCode::Align,
            span,
        }) = block.codes.tilt
        else {
            return Ok(());
        };
        let branch = match whole(block, b'P', 9)? {
            None | Some(0) => Branch::Nearest,
            Some(1) => Branch::HighTilt,
            Some(2) => Branch::LowTilt,
            Some(which) => {
                let message = format!("G53.1 P{which} is not supported");
                let fault =
                    BlockDiagnostic::new(DiagnosticCode::NotSupported, block.span(b'P'), message);
                return Err(fault
                    .because("P1 is the way with the greater angle of the tilting axis, P2 the other one")
                    .help("write P0, P1 or P2"));
            }
        };
        self.align_tool(block, (branch, span), out)
    }

    /// G254 and G255.
    pub(crate) fn dynamic_offset(&mut self, coded: Coded<bool>) -> Outcome<()> {
        self.state.offsets.fanuc.dynamic = None;
        if !coded.code {
            return Ok(());
        }
        let refuse = |message: &str, reason: &str, help: &str| {
            Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
                    .because(reason)
                    .help(help),
            )
        };
        if self.options.five_axis.is_none() {
            return refuse(
                "G254 is not supported by this machine",
                "its kinematics have no rotary axes that turn the table",
                "configure `kinematics = \"five-axis\"`",
            );
        }
        if self.state.tip.follows() || self.state.offsets.frame.is_in_force() {
            return refuse(
                "G254 with the tip of the tool followed, or within a frame",
                "it counts in the directions of the machine's own axes",
                "end what is in force before it: G49 behind G234, G69",
            );
        }
        let Some(map) = self.tip_map() else {
            return Ok(());
        };
        let mut zero = *self.axes_place();
        for axis in 0..3 {
            zero[axis] = self.state.offsets.origin(axis) - self.state.offsets.tool[axis];
        }
        let mut way = map.place(&zero) - zero;
        for axis in 3..way.len() {
            way[axis] = 0.0;
        }
        self.state.offsets.fanuc.dynamic = Some(way);
        Ok(())
    }

    /// Refuses rotary words while the zero of the program stands for one position of the table.
    pub(crate) fn check_dynamic_offset(&self, block: &Block) -> Outcome<()> {
        if self.state.offsets.fanuc.dynamic.is_none() {
            return Ok(());
        }
        let Some((axis, _)) = block.axes().find(|(axis, _)| axis.is_rotary()) else {
            return Ok(());
        };
        let message = format!("{axis} moves while G254 is in force");
        let fault =
            BlockDiagnostic::new(DiagnosticCode::NotSupported, block.axis_span(axis), message);
        Err(fault
            .because("the zero of the program is that of the table where G254 stood")
            .help("write G255 before the move, and G254 behind it"))
    }
}
