//! The codes of a block: G and M numbers, sorted into their modal groups.
//!
//! A block may have one code of each group. G numbers are kept times ten, so that G59.3 is 593.

use glidepath_geometry::Plane;
use glidepath_program::PathMode;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::setup::m_codes::MCodes;
use crate::syntax::frame_codes::{FrameCode, TiltCode};
use crate::syntax::modes::{
    ArcFeed, CannedCycle, CutterRadius, Distance, FeedMode, LatheCycle, Motion, NonModal, Pockets,
    Probe, Retract, Side, SpindleMode, Spline, Stop, ToolLength, Units,
};
use crate::syntax::number::code_number;
use crate::syntax::refused::{refused_g, refused_m, unknown_g, unknown_m};

/// A code and where it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Coded<T> {
    pub(crate) code: T,
    pub(crate) span: SourceSpan,
}

/// The index of no coordinate system: its zero is that of the machine.
pub(crate) const NO_SYSTEM: usize = usize::MAX;

/// Most M words of a block of SINUMERIK's.
pub(crate) const MOST_M: u8 = 5;

/// The codes of one block, by modal group.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Codes {
    pub(crate) non_modal: Option<Coded<NonModal>>,
    /// `None` inside is G80.
    pub(crate) motion: Option<Coded<Option<Motion>>>,
    pub(crate) plane: Option<Coded<Plane>>,
    pub(crate) distance: Option<Coded<Distance>>,
    pub(crate) arc_distance: Option<Coded<Distance>>,
    pub(crate) feed_mode: Option<Coded<FeedMode>>,
    pub(crate) units: Option<Coded<Units>>,
    /// G70 and G71 of Mach3 beside G90.1 or G91.1: inches and millimetres, which have to be in force already.
    pub(crate) units_of_mach: Option<Coded<Units>>,
    /// F counts millimetres whatever the unit is (G70, G71 of SINUMERIK).
    pub(crate) feeds_in_mm: bool,
    pub(crate) cutter_radius: Option<Coded<CutterRadius>>,
    pub(crate) tool_length: Option<Coded<ToolLength>>,
    pub(crate) retract: Option<Coded<Retract>>,
    pub(crate) spindle_mode: Option<Coded<SpindleMode>>,
    /// True for G7: X words are diameters.
    pub(crate) diameter: Option<Coded<bool>>,
    /// DIAM90 of SINUMERIK: X words are diameters where they are absolute.
    pub(crate) diameter_by_distance: Option<Coded<()>>,
    /// Index of the coordinate system, from 0 for G54; [`NO_SYSTEM`] is none (SINUMERIK's G500).
    pub(crate) system: Option<Coded<usize>>,
    /// The tolerance of G64 comes from its P word.
    pub(crate) path_mode: Option<Coded<PathMode>>,
    pub(crate) tool_change: Option<Coded<u32>>,
    pub(crate) spindle: Option<Coded<u32>>,
    pub(crate) coolant: Option<Coded<u32>>,
    /// M7 and M8 in one block, of which `coolant` is the first.
    pub(crate) both_coolants: bool,
    pub(crate) overrides: Option<Coded<u32>>,
    /// M70 to M73.
    pub(crate) saved_state: Option<Coded<u32>>,
    pub(crate) stop: Option<Coded<Stop>>,
    /// M19.
    pub(crate) orient: Option<Coded<u32>>,
    /// M62 to M68.
    pub(crate) input_output: Option<Coded<u32>>,
    /// M82 and M83 of printers; true: E words are relative.
    pub(crate) extruder: Option<Coded<bool>>,
    /// G60 and G61 of printers: true where the place is kept.
    pub(crate) kept_place: Option<Coded<bool>>,
    /// An M code that the machine's builder declared.
    pub(crate) user: Option<Coded<u32>>,
    /// Those of the same block that follow it (SINUMERIK), zero where there are none.
    pub(crate) more_of_user: [u16; MOST_M as usize - 1],
    /// M words of the block, where their number has an end (SINUMERIK).
    pub(crate) m_words: u8,
    /// An M code of printers that takes the words of its block.
    pub(crate) function: Option<Coded<u32>>,
    /// M29 of FANUC.
    pub(crate) rigid_tapping: Option<Coded<u32>>,
    /// The number of FANUC's last M code.
    pub(crate) last_m: Option<u32>,
    /// M23 and M24 of FANUC's lathes: true where threads of G92 have no way out at their end.
    pub(crate) thread_end: Option<Coded<bool>>,
    /// The motion is that of this block alone: what was the mode stays it (G31, G60, G76 of FANUC).
    pub(crate) is_once: bool,
    /// The motion of this block ends at rest (G9 of FANUC and SINUMERIK).
    pub(crate) exact_stop: Option<Coded<()>>,
    /// A code that moves nothing and gives no place another name, ten times its number.
    pub(crate) read_over: Option<Coded<u32>>,
    /// G16 and G15 of FANUC: true where a radius and an angle are meant.
    pub(crate) polar_mode: Option<Coded<bool>>,
    /// G45 to G48 of FANUC: how often the offset of D makes each way of the block longer.
    pub(crate) lengthening: Option<Coded<i8>>,
    /// G50, G51, G50.1, G51.1, G68 and G69 of FANUC, G100 and G101 of Haas.
    pub(crate) frame: Option<Coded<FrameCode>>,
    /// Whether G50, and G69, stand beside that: a block may end all that is in force.
    pub(crate) frame_ends: [bool; 2],
    /// True for G43.4 of FANUC and TRAORI: the axes follow the tip of the tool; false for TRAFOOF.
    pub(crate) tip: Option<Coded<bool>>,
    /// CFC, CFIN and CFTCP of SINUMERIK.
    pub(crate) arc_feed: Option<Coded<ArcFeed>>,
    /// ORIVECT and ORIAXES of SINUMERIK: true where the tool turns on great circles.
    pub(crate) turns_on_circles: Option<Coded<bool>>,
    /// M428 to M430 of LinuxCNC's five-axis machines: which kinematics.
    pub(crate) kinematics: Option<Coded<u32>>,
    /// G43.5 of FANUC: I, J and K of straight moves are the direction of the tool.
    pub(crate) tip_by_vector: bool,
    /// G68.2 and G53.1 of FANUC.
    pub(crate) tilt: Option<Coded<TiltCode>>,
    /// G254 and G255 of Haas: true where the zero goes with the table.
    pub(crate) dynamic: Option<Coded<bool>>,
    /// G54.1 of FANUC and G154 of Haas, whose number is P; G110 to G129 of Haas with theirs.
    pub(crate) extended_system: Option<Coded<Option<u32>>>,
}

impl Codes {
    /// Adds a G word; `value` is its number.
    pub(crate) fn add_g(&mut self, value: f64, span: SourceSpan) -> Outcome<()> {
        let tenths = code_number(value * 10.0).ok_or_else(|| unknown_g(value, span))?;
        match tenths {
            0 => self.set_motion(Some(Motion::Rapid), span),
            10 => self.set_motion(Some(Motion::Linear), span),
            20 => self.set_motion(Some(Motion::ArcClockwise), span),
            30 => self.set_motion(Some(Motion::ArcCounterclockwise), span),
            50..=53 | 62 => self.set_motion(Some(Motion::Spline(spline(tenths))), span),
            800 => self.set_motion(None, span),
            40 | 100 | 280 | 281 | 300 | 301 | 520 | 530 | 920..=923 => {
                set(&mut self.non_modal, non_modal(tenths), span)
            }
            170 => set(&mut self.plane, Plane::Xy, span),
            180 => set(&mut self.plane, Plane::Zx, span),
            190 => set(&mut self.plane, Plane::Yz, span),
            171 => set(&mut self.plane, Plane::Uv, span),
            181 => set(&mut self.plane, Plane::Wu, span),
            191 => set(&mut self.plane, Plane::Vw, span),
            200 => set(&mut self.units, Units::Inch, span),
            210 => set(&mut self.units, Units::Millimetre, span),
            330 => self.set_motion(Some(Motion::Thread), span),
            331 => self.set_motion(Some(Motion::RigidTap), span),
            760 => self.set_motion(Some(Motion::ThreadCycle), span),
            382..=385 => self.set_motion(Some(Motion::Probe(probe(tenths))), span),
            400 | 410 | 411 | 420 | 421 => {
                set(&mut self.cutter_radius, cutter_radius(tenths), span)
            }
            430 => set(&mut self.tool_length, ToolLength::FromTable, span),
            431 => set(&mut self.tool_length, ToolLength::FromWords, span),
            432 => set(&mut self.tool_length, ToolLength::Add, span),
            490 => set(&mut self.tool_length, ToolLength::Cancel, span),
            540 | 550 | 560 | 570 | 580 | 590 | 591..=593 => {
                set(&mut self.system, system_index(tenths), span)
            }
            610 => set(&mut self.path_mode, PathMode::ExactPath, span),
            611 => set(&mut self.path_mode, PathMode::ExactStop, span),
            640 => set(
                &mut self.path_mode,
                PathMode::Continuous { tolerance_mm: None },
                span,
            ),
            70 | 80 => set(&mut self.diameter, tenths == 70, span),
            730 | 740 | 810..=860 | 890 if tenths % 10 == 0 => {
                self.set_motion(Some(Motion::Cycle(cycle(tenths))), span)
            }
            700 | 710..=712 | 720..=722 => {
                self.set_motion(Some(Motion::Lathe(lathe_cycle(tenths))), span)
            }
            900 => set(&mut self.distance, Distance::Absolute, span),
            910 => set(&mut self.distance, Distance::Incremental, span),
            901 => set(&mut self.arc_distance, Distance::Absolute, span),
            911 => set(&mut self.arc_distance, Distance::Incremental, span),
            930 => set(&mut self.feed_mode, FeedMode::InverseTime, span),
            940 => set(&mut self.feed_mode, FeedMode::PerMinute, span),
            950 => set(&mut self.feed_mode, FeedMode::PerRevolution, span),
            960 => set(&mut self.spindle_mode, SpindleMode::SurfaceSpeed, span),
            970 => set(&mut self.spindle_mode, SpindleMode::Revolutions, span),
            980 => set(&mut self.retract, Retract::Initial, span),
            990 => set(&mut self.retract, Retract::RPlane, span),
            _ => Err(refused_g(tenths, value, span)),
        }
    }

    /// G70 and G71 beside G90.1 or G91.1 are no cycles, which would have words of their own: posts for Mach3 write
    /// inches and millimetres so.
    pub(crate) fn take_units_of_mach(&mut self) {
        let Some(Coded { code, span }) = self.motion.filter(|_| self.arc_distance.is_some()) else {
            return;
        };
        let units = match code {
            Some(Motion::Lathe(LatheCycle::Finish)) => Units::Inch,
            Some(Motion::Lathe(LatheCycle::Turn(Pockets::Cut))) => Units::Millimetre,
            _ => return,
        };
        self.motion = None;
        self.units_of_mach = Some(Coded { code: units, span });
    }

    /// True if the block has any code.
    pub(crate) const fn any(&self) -> bool {
        self.non_modal.is_some()
            || self.motion.is_some()
            || self.plane.is_some()
            || self.distance.is_some()
            || self.arc_distance.is_some()
            || self.feed_mode.is_some()
            || self.units.is_some()
            || self.cutter_radius.is_some()
            || self.tool_length.is_some()
            || self.retract.is_some()
            || self.spindle_mode.is_some()
            || self.diameter.is_some()
            || self.diameter_by_distance.is_some()
            || self.arc_feed.is_some()
            || self.turns_on_circles.is_some()
            || self.system.is_some()
            || self.path_mode.is_some()
            || self.tool_change.is_some()
            || self.spindle.is_some()
            || self.coolant.is_some()
            || self.overrides.is_some()
            || self.stop.is_some()
            || self.orient.is_some()
            || self.input_output.is_some()
            || self.saved_state.is_some()
            || self.user.is_some()
            || self.kinematics.is_some()
            || self.rigid_tapping.is_some()
            || self.exact_stop.is_some()
            || self.read_over.is_some()
            || self.polar_mode.is_some()
            || self.lengthening.is_some()
            || self.frame.is_some()
            || self.tip.is_some()
            || self.tilt.is_some()
            || self.kept_place.is_some()
            || self.dynamic.is_some()
            || self.extended_system.is_some()
            || self.extruder.is_some()
            || self.function.is_some()
            || self.thread_end.is_some()
    }

    /// G80 may stand beside another motion code, as in the first line of many programs; that
    /// code then is the mode.
    pub(super) fn set_motion(&mut self, motion: Option<Motion>, span: SourceSpan) -> Outcome<()> {
        match (self.motion, motion) {
            (Some(Coded { code: Some(_), .. }), None) => Ok(()),
            (Some(Coded { code: None, .. }), Some(_)) => {
                self.motion = Some(Coded { code: motion, span });
                Ok(())
            }
            _ => set(&mut self.motion, motion, span),
        }
    }

    /// Adds an M word.
    pub(crate) fn add_m(&mut self, value: f64, span: SourceSpan, declared: &MCodes) -> Outcome<()> {
        let Some(number) = code_number(value) else {
            return Err(unknown_m(value, span));
        };
        match number {
            0 | 60 => set(&mut self.stop, Stop::Program(number), span),
            1 => set(&mut self.stop, Stop::Optional, span),
            2 | 30 => set(&mut self.stop, Stop::End, span),
            3..=5 => set(&mut self.spindle, number, span),
            6 | 61 => set(&mut self.tool_change, number, span),
            7..=9 => set(&mut self.coolant, number, span),
            48..=53 => set(&mut self.overrides, number, span),
            70..=73 => set(&mut self.saved_state, number, span),
            19 => set(&mut self.orient, number, span),
            62..=68 => set(&mut self.input_output, number, span),
            _ if declared.contains(number) => set(&mut self.user, number, span),
            428..=430 => set(&mut self.kinematics, number, span),
            _ => Err(refused_m(number, value, span)),
        }
    }
}

const fn cycle(tenths: u32) -> CannedCycle {
    match tenths {
        730 => CannedCycle::ChipBreak,
        740 => CannedCycle::TapLeft,
        820 => CannedCycle::DrillDwell,
        830 => CannedCycle::Peck,
        840 => CannedCycle::TapRight,
        850 => CannedCycle::Bore,
        860 => CannedCycle::BoreStop,
        890 => CannedCycle::BoreDwell,
        _ => CannedCycle::Drill,
    }
}

const fn lathe_cycle(tenths: u32) -> LatheCycle {
    let pockets = match tenths % 10 {
        0 => Pockets::Cut,
        1 => Pockets::LeftOut,
        _ => Pockets::Only,
    };
    match tenths / 10 {
        70 => LatheCycle::Finish,
        71 => LatheCycle::Turn(pockets),
        _ => LatheCycle::Face(pockets),
    }
}

const fn spline(tenths: u32) -> Spline {
    match tenths {
        50 => Spline::Cubic,
        51 => Spline::Quadratic,
        52 => Spline::Weighted,
        53 => Spline::EndWeighted,
        _ => Spline::Knotted,
    }
}

const fn probe(tenths: u32) -> Probe {
    Probe {
        toward: matches!(tenths, 382 | 383),
        must: matches!(tenths, 382 | 384),
    }
}

const fn cutter_radius(tenths: u32) -> CutterRadius {
    match tenths {
        410 => CutterRadius::FromTable(Side::Left),
        411 => CutterRadius::FromWord(Side::Left),
        420 => CutterRadius::FromTable(Side::Right),
        421 => CutterRadius::FromWord(Side::Right),
        _ => CutterRadius::Off,
    }
}

const fn non_modal(tenths: u32) -> NonModal {
    match tenths {
        40 => NonModal::Dwell,
        100 => NonModal::SetData,
        280 => NonModal::GoToReference(0),
        281 => NonModal::SetReference(0),
        300 => NonModal::GoToReference(1),
        301 => NonModal::SetReference(1),
        520 => NonModal::LocalOffset,
        530 => NonModal::MachineCoordinates,
        920 => NonModal::SetOffset,
        921 => NonModal::ClearOffset,
        922 => NonModal::SuspendOffset,
        _ => NonModal::RestoreOffset,
    }
}

/// Index of G54 … G59, G59.1 … G59.3.
const fn system_index(tenths: u32) -> usize {
    match tenths {
        540 => 0,
        550 => 1,
        560 => 2,
        570 => 3,
        580 => 4,
        590 => 5,
        591 => 6,
        592 => 7,
        _ => 8,
    }
}

pub(super) fn set<T>(slot: &mut Option<Coded<T>>, code: T, span: SourceSpan) -> Outcome<()> {
    if let Some(first) = slot {
        let column = first.span.start + 1;
        let message = format!("a second code of the modal group of the one at column {column}");
        return Err(
            BlockDiagnostic::new(DiagnosticCode::ModalGroupConflict, span, message)
                .because("codes of one modal group exclude each other, so a block has one at most")
                .help("remove one of them, or write two blocks"),
        );
    }
    *slot = Some(Coded { code, span });
    Ok(())
}

#[cfg(test)]
mod tests;
