//! Planes that a program tilts (FANUC's G68.2 and G53.1, SINUMERIK's CYCLE800), and the direction of
//! the tool by its vector (A3, B3, C3).
//!
//! A tilted plane is a frame on the work. The rotary axes turn, with the linear ones at rest, until the
//! tool stands along its normal; from there on the tip is followed, so that the program's coordinates
//! are those of the plane whatever the machine's tables and heads are. The length of the tool counts
//! along the tool.

use glidepath_geometry::{AXES, Axis, AxisVector};
use glidepath_kinematics::FiveAxis;
use glidepath_program::Item;
use nalgebra::Vector3;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::Pace;
use crate::execute::state::frame::Frame;
use crate::execute::state::tip::Tilt;
use crate::syntax::block::Block;
use crate::syntax::modes::Distance;
use crate::syntax::named_word::Named;

/// Which of the two ways to stand along a direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Branch {
    /// The one with the smaller turns.
    Nearest,
    /// The one with the smaller angle of the tilting axis.
    LowTilt,
    /// The one with the greater angle of the tilting axis.
    HighTilt,
}

/// Directions that differ by less are the same.
const SAME: f64 = 1e-9;

impl Interpreter {
    fn five_axis(&self, span: SourceSpan, what: &str) -> Outcome<FiveAxis> {
        self.options.five_axis.ok_or_else(|| {
            let message = format!("{what} is not supported by this machine");
            BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because("its kinematics have no rotary axes that turn the tool or the table")
                .help("configure `kinematics = \"five-axis\"`, or let the CAM system write the positions of the axes")
        })
    }

    /// Refuses a tilted plane where it cannot begin.
    pub(crate) fn check_may_tilt(&self, span: SourceSpan) -> Outcome<()> {
        self.five_axis(span, "a tilted work plane")?;
        let refuse = |message: &str, reason: &str, help: &str| {
            Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because(reason)
                    .help(help),
            )
        };
        if self.state.tilted.is_some() {
            return refuse(
                "a tilted plane within a tilted plane",
                "its words would count in a plane that is tilted already",
                "end the first one by G69, or by CYCLE800()",
            );
        }
        if self.state.tip.follows() || self.state.offsets.frame.is_in_force() {
            return refuse(
                "a tilted plane with the tip of the tool followed, or within a frame",
                "the plane is one of the work's coordinates as they are",
                "end what is in force before it: G49 or TRAFOOF, G69, TRANS",
            );
        }
        if self.state.on_contour || self.state.leaving_contour {
            return refuse(
                "a tilted plane with cutter radius compensation on",
                "the tool stands beside the programmed point, at a place that depends on the next move",
                "write G40 and a move before it",
            );
        }
        Ok(())
    }

    /// A tilted plane begins; the tool does not stand along its normal yet, unless it does so already.
    pub(crate) fn begin_tilt(&mut self, frame: Frame, span: SourceSpan) -> Outcome<()> {
        self.check_may_tilt(span)?;
        self.state.offsets.tilted = frame;
        self.state.offsets.frame = frame;
        self.state.tilted = Some(Tilt::Waits);
        if self.stands_along(&self.normal_of_plane()) {
            self.state.tilted = Some(Tilt::Stands);
            self.let_tip_follow(true);
        }
        Ok(())
    }

    /// The tilted plane ends; the axes stay where they are.
    pub(crate) fn end_tilt(&mut self) {
        let was_tilted = self.state.tilted.take().is_some();
        if !was_tilted && !self.state.offsets.tilted.is_in_force() {
            return;
        }
        self.state.offsets.tilted = Frame::default();
        self.state.offsets.frame = self.state.offsets.fanuc.frames.frame();
        if was_tilted {
            self.let_tip_follow(false);
        }
    }

    /// Refuses moves in a plane along whose normal the tool does not stand yet.
    pub(crate) fn check_tilt(&self, block: &Block) -> Outcome<()> {
        if self.state.tilted != Some(Tilt::Waits) {
            return Ok(());
        }
        let message = "a move in a tilted plane before the tool stands along its normal";
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, block.motion_span(), message)
                .because(
                    "the coordinates of the plane are reached when the rotary axes have turned",
                )
                .help("write G53.1 behind G68.2"),
        )
    }

    /// Turns the rotary axes until the tool stands along the normal of the tilted plane.
    pub(crate) fn align_tool(
        &mut self,
        block: &Block,
        (branch, span): (Branch, SourceSpan),
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let machine = self.five_axis(span, "a tilted work plane")?;
        if self.state.tilted.is_none() {
            let message = "G53.1 without a tilted plane";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("it turns the tool along the normal of the plane that G68.2 gave")
                    .help("write G68.2 before it"),
            );
        }
        if self.state.on_contour || self.state.leaving_contour {
            let message = "the tool turns with cutter radius compensation on";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
                    .because("it stands beside the programmed point")
                    .help("write G40 and a move before it"),
            );
        }
        let normal = self.normal_of_plane();
        let place = *self.axes_place();
        let near = [place[machine.tilt_axis().index()], place[Axis::C.index()]];
        let in_travel = |axis: Axis, angle: f64| {
            let travel = self.options.machine.travel(axis);
            travel.is_none_or(|travel| (travel.min - SAME..=travel.max + SAME).contains(&angle))
        };
        let branches = machine.branches_deg(&normal, near[1]);
        let is_too_low = branches.is_none();
        let mut reached: Vec<(f64, f64)> = branches
            .into_iter()
            .flatten()
            .filter(|(tilt, rotary)| {
                in_travel(machine.tilt_axis(), *tilt) && in_travel(Axis::C, *rotary)
            })
            .collect();
        let far =
            |(tilt, rotary): &(f64, f64)| (tilt - near[0]).abs().max((rotary - near[1]).abs());
        reached.sort_by(|a, b| match branch {
            Branch::Nearest => far(a).total_cmp(&far(b)),
            Branch::LowTilt => a.0.total_cmp(&b.0),
            Branch::HighTilt => b.0.total_cmp(&a.0),
        });
        let Some((tilt, rotary)) = reached.first().copied() else {
            let message = "a tilted plane whose normal the tool cannot stand along";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::SoftLimit, span, message)
                    .because(if is_too_low {
                        "the tilt axis is skewed, and does not lean the tool so far"
                    } else {
                        "both ways to turn the rotary axes are outside of their travel"
                    })
                    .help("set the work up in another way"),
            );
        };
        let was_waiting = self.state.tilted == Some(Tilt::Waits);
        if !was_waiting {
            self.let_tip_follow(false);
        }
        let mut target = self.state.position;
        target[machine.tilt_axis().index()] = tilt;
        target[Axis::C.index()] = rotary;
        self.straight(block, target, Pace::Rapid, out)?;
        self.map_moves(block, out)?;
        self.state.tilted = Some(Tilt::Stands);
        self.let_tip_follow(true);
        Ok(())
    }

    /// The normal of the plane, on the work.
    pub(super) fn normal_of_plane(&self) -> Vector3<f64> {
        let mut up = AxisVector::zeros();
        up[2] = 1.0;
        let turned = self.state.offsets.turn(up);
        Vector3::new(turned[0], turned[1], turned[2])
    }

    /// True where the tool stands along a direction.
    pub(super) fn stands_along(&self, direction: &Vector3<f64>) -> bool {
        let Some(machine) = self.options.five_axis else {
            return false;
        };
        let place = self.axes_place();
        let tool = machine.tool_axis(place[machine.tilt_axis().index()], place[Axis::C.index()]);
        (tool - direction.normalize()).norm() < SAME
    }

    /// The angles of the rotary axes for A3, B3, C3: the direction of the tool in the program's
    /// coordinates, of any length.
    pub(crate) fn resolve_vector(
        &self,
        block: &Block,
        values: &mut [Option<f64>; AXES],
    ) -> Outcome<()> {
        let found = [0, 1, 2].map(|axis| block.named.find(Named::Vector(axis)));
        let Some(first) = found.into_iter().flatten().next() else {
            return Ok(());
        };
        let machine = self.five_axis(first.span, "a direction of the tool")?;
        let refuse = |message: &str, reason: &str, help: &str| {
            Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, first.span, message)
                    .because(reason)
                    .help(help),
            )
        };
        if !self.state.tip.follows() {
            return refuse(
                "a direction of the tool without TRAORI",
                "the rotary axes take it where the tip of the tool is followed",
                "write TRAORI before it",
            );
        }
        let (tilt, rotary) = (machine.tilt_axis().index(), Axis::C.index());
        if values[tilt].is_some() || values[rotary].is_some() {
            return refuse(
                "a direction of the tool beside angles",
                "A3, B3 and C3 stand for the rotary axes",
                "write one or the other",
            );
        }
        let mut way = AxisVector::zeros();
        for (axis, word) in found.into_iter().enumerate() {
            way[axis] = word.map_or(0.0, |word| word.value);
        }
        let turned = self.state.offsets.turn(way);
        let direction = Vector3::new(turned[0], turned[1], turned[2]);
        if direction.norm() < SAME {
            return refuse(
                "a direction of the tool that is none",
                "A3, B3 and C3 together have a length",
                "write the vector from the tip to the spindle",
            );
        }
        let here = *self.axes_place();
        let near = (here[tilt], here[rotary]);
        let by_pole = self.angles_by_pole(machine, &direction, near);
        let Some(angles) = by_pole.or_else(|| machine.angles_deg(&direction, near)) else {
            return refuse(
                "a direction that the tool cannot stand along",
                "the tilt axis is skewed, and does not lean the tool so far",
                "set the work up in another way",
            );
        };
        let base = |axis: usize| match self.state.modal.distance {
            Distance::Absolute => self.state.offsets.origin(axis),
            Distance::Incremental => here[axis],
        };
        values[tilt] = Some(angles.0 - base(tilt));
        values[rotary] = Some(angles.1 - base(rotary));
        Ok(())
    }
}
