//! The codes that turn compensation on and off, and the check of what is not possible while it is
//! on.

use glidepath_geometry::Plane;
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::block_words::radius_word;
use crate::execute::compensation::path::{Compensated, Compensation, MAX_HELD};
use crate::execute::interpreter::Interpreter;
use crate::setup::tool_table::MAX_TOOL;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{CutterRadius, LatheCycle, Motion, NonModal, Side};
use crate::syntax::word_check::{missing, whole};

/// What the controls make of G41 and G42 while one of them is on.
#[cold]
fn on_already(
    dialect: Dialect,
    is_haas: bool,
    is_same: bool,
    span: SourceSpan,
) -> Box<BlockDiagnostic> {
    let why = match dialect {
        Dialect::Fanuc if is_same && is_haas => {
            "what a Haas makes of the same code again is not known"
        }
        Dialect::Fanuc if is_same => {
            "on a FANUC the same code again puts the tool at right angles to the move before, which is not made here"
        }
        Dialect::Fanuc if is_haas => "a Haas wants G40 before the other side",
        Dialect::Fanuc => "a FANUC crosses to the other side at the corner, which is not made here",
        Dialect::Siemens if is_same => {
            "whether the tool begins anew on the same side at the corner or along the next move differs from control to control"
        }
        Dialect::Siemens => {
            "whether the tool goes to the new side at the corner or along the next move differs from control to control"
        }
        Dialect::LinuxCnc | Dialect::Marlin => {
            "where the tool is would not be clear if its side or radius changed"
        }
    };
    let message = "cutter radius compensation is on already";
    BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
        .because(why)
        .help("write G40 and a move in between")
}

impl Interpreter {
    /// G40, G41, G42, G41.1, G42.1.
    pub(crate) fn cutter_radius(
        &mut self,
        block: &Block,
        coded: Coded<CutterRadius>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let span = coded.span;
        let (side, diameter, orientation) = match coded.code {
            CutterRadius::Off => {
                self.end_compensation(out)?;
                self.state.on_contour = false;
                return Ok(());
            }
            CutterRadius::FromTable(side) => {
                let letter = if radius_word(block).has(b'H') {
                    b'H'
                } else {
                    b'D'
                };
                if block.dialect == Dialect::Fanuc {
                    let (diameter, orientation) = self.fanuc_radius(block, letter, span)?;
                    let cutter = (side, 0.5 * diameter, orientation);
                    return self.begin_compensation(block, span, cutter, out);
                }
                let tool = match block.dialect {
                    Dialect::Siemens => self.tool_of_edge(block, span)?,
                    _ => self.named_tool(block, letter, span)?,
                };
                (side, tool.diameter_mm, tool.orientation)
            }
            CutterRadius::FromWord(side) => {
                let diameter = block
                    .get(b'D')
                    .ok_or_else(|| missing(span, "G41.1", "D", "the tool's diameter"))?;
                let orientation = whole(block, b'L', 9)?.unwrap_or(0);
                let orientation = u8::try_from(orientation).unwrap_or_default();
                (side, diameter * self.state.modal.units.mm(), orientation)
            }
        };
        self.begin_compensation(block, span, (side, 0.5 * diameter, orientation), out)
    }

    /// Diameter with its wear, and orientation, of the tool that D or H names; without a word that
    /// of the last D.
    fn fanuc_radius(&self, block: &Block, letter: u8, span: SourceSpan) -> Outcome<(f64, u8)> {
        let last = Some(self.state.fanuc.radius_offset).filter(|number| *number > 0);
        let number = whole(block, letter, MAX_TOOL)?
            .or(last)
            .ok_or_else(|| missing(span, "G41 or G42", "D", "whose radius"))?;
        let named = block.get(letter).map(|_| block.span(letter));
        let tool = self.tool_of(number, named.unwrap_or(span))?;
        let wear_mm = 2.0 * self.state.offsets.fanuc.wear(number).radius_mm;
        Ok((tool.diameter_mm + wear_mm, tool.orientation))
    }

    fn begin_compensation(
        &mut self,
        block: &Block,
        span: SourceSpan,
        (side, radius, orientation): (Side, f64, u8),
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if self.state.on_contour {
            let is_haas = self.options.fanuc.is_haas();
            let is_same = self.state.contour_side == side;
            return Err(on_already(block.dialect, is_haas, is_same, span));
        }
        let follows = self.options.five_axis.is_some() && self.state.tip.follows();
        if block.dialect == Dialect::Fanuc && follows && self.state.tilted.is_none() {
            let message = "cutter radius compensation while the tip of the tool is followed";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
                    .because("the side of the cutter would turn with the rotary axes")
                    .help("write G49 before it, or a tilted plane: G68.2 and G53.1"),
            );
        }
        let plane = self.state.modal.plane;
        if !matches!(plane, Plane::Xy | Plane::Zx) {
            let message = "cutter radius compensation outside G17 and G18";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
                    .because("it is made in the XY and the ZX plane")
                    .help("write G17 or G18"),
            );
        }
        if plane != Plane::Zx && block.get(b'L').is_some_and(|l| l != 0.0) {
            let message = "a tool orientation outside G18";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::CutterRadius,
                block.span(b'L'),
                message,
            )
            .because("only turning tools have one")
            .help("remove L, or write G18"));
        }
        if plane == Plane::Zx && self.state.offsets.is_rotated() {
            let message = "cutter radius compensation in G18 in a rotated coordinate system";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
                    .because("the plane of the contour would be no plane of the machine")
                    .help("set the rotation of the coordinate system to zero"),
            );
        }
        self.state.contour_side = side;
        if self.is_in_tilted_plane(plane) {
            self.enter_contour_plane(block, out)?;
        }
        let image = self.state.offsets.plane(plane);
        let Some(image) = image.filter(|image| image.plane == plane) else {
            let message = "cutter radius compensation in a frame that tilts its plane";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
                    .because("it is made in the XY and the ZX plane of the machine")
                    .help("turn the coordinates about the axis normal to the plane only"),
            );
        };
        let side = match side {
            Side::Left if image.is_mirrored => Side::Right,
            Side::Right if image.is_mirrored => Side::Left,
            side => side,
        };
        self.state.on_contour = true;
        if radius != 0.0 {
            let tool = self.state.path_end;
            let is_fanuc = block.dialect == Dialect::Fanuc;
            let enters_beside_next = is_fanuc || block.dialect == Dialect::Siemens;
            self.state.open.compensation = Some(
                Compensation::new(plane, side, radius, orientation, tool)
                    .entering_beside_next(enters_beside_next)
                    .with_corners_of_lines(is_fanuc && self.options.fanuc.has_corners_of_lines()),
            );
        }
        Ok(())
    }

    /// Gives out the moves held back; the tool stays where it is.
    pub(crate) fn end_compensation(&mut self, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(mut compensation) = self.state.open.compensation.take() else {
            return self.leave_contour_plane(out);
        };
        let from = out.len();
        compensation.flush(out);
        self.state.leaving_contour = compensation.is_entered();
        self.check_given(None, out.get(from..).unwrap_or_default())?;
        self.state.path_end = compensation.tool();
        self.leave_contour_plane(out)
    }

    /// What is in force, if any.
    pub(crate) fn compensated(&self) -> Option<Compensated> {
        self.state.on_contour.then(|| Compensated {
            of: self
                .state
                .open
                .compensation
                .as_ref()
                .map(Compensation::side_and_tip),
        })
    }

    /// Refuses what is not possible while compensation is on.
    pub(crate) fn check_compensated(&self, block: &Block) -> Outcome<()> {
        if !self.state.on_contour
            || matches!(
                block.codes.cutter_radius,
                Some(Coded {
                    code: CutterRadius::Off,
                    ..
                })
            )
        {
            return Ok(());
        }
        let codes = &block.codes;
        let non_modal = codes.non_modal.filter(|non_modal| {
            !matches!(
                non_modal.code,
                NonModal::Dwell | NonModal::SetReference(_) | NonModal::SetPole(_)
            )
        });
        let motion = codes.motion.filter(|motion| match motion.code {
            Some(Motion::Lathe(cycle)) => cycle != LatheCycle::Finish,
            code => matches!(
                code,
                Some(
                    Motion::Cycle(_)
                        | Motion::Probe(_)
                        | Motion::Thread
                        | Motion::RigidTap
                        | Motion::TapIn
                        | Motion::TapOut
                        | Motion::ThreadCycle
                )
            ),
        });
        let plane = codes
            .plane
            .filter(|plane| plane.code != self.state.modal.plane);
        let refused = [
            non_modal.map(|c| (c.span, "changing coordinates or going to references")),
            motion.map(|c| (c.span, "a cycle, a thread or a probing move")),
            plane.map(|c| (c.span, "another plane")),
            codes.system.map(|c| (c.span, "another coordinate system")),
            codes.tool_length.map(|c| (c.span, "another tool length")),
            codes.tool_change.map(|c| (c.span, "a tool change")),
            self.other_edge(block)
                .map(|span| (span, "another edge of the tool")),
            codes
                .diameter
                .map(|c| (c.span, "changing the diameter mode")),
        ];
        if let Some((span, what)) = refused.into_iter().flatten().next() {
            let message = format!("{what} with cutter radius compensation on");
            return Err(BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
                .because("the tool stands beside the programmed point, at a place that depends on the next move")
                .help("write G40 and a move before it"));
        }
        if self
            .state
            .open
            .compensation
            .as_ref()
            .is_some_and(Compensation::is_overfull)
        {
            let message = format!("more than {} blocks without a move in the plane", MAX_HELD);
            return Err(BlockDiagnostic::new(
                DiagnosticCode::CutterRadius,
                SourceSpan::default(),
                message,
            )
            .because("with cutter radius compensation on they wait for the next move in the plane")
            .help("write G40 before them"));
        }
        Ok(())
    }
}
