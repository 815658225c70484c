//! What a block may change, offsets apart.

use glidepath_geometry::AxisVector;

use crate::execute::state::coolant::Coolant;
use crate::execute::state::fanuc_modal::FanucModal;
use crate::execute::state::modal::Modal;
use crate::execute::state::probe_result::ProbeResult;
use crate::execute::state::spindle::Spindle;
use crate::execute::state::sticky_words::CycleSeries;
use crate::execute::state::thread_setup::ThreadSetup;
use crate::syntax::modes::Side;

/// The part of the state a block may change, offsets apart.
#[derive(Debug, Clone, Copy)]
pub(crate) struct State {
    pub(crate) modal: Modal,
    /// Where the program has brought the machine, machine coordinates. With cutter radius
    /// compensation that is the programmed contour, not the tool.
    pub(crate) position: AxisVector,
    /// End of the last segment made. Within [`crate::execute::motion::settled::MIN_MOVE`] of
    /// `position`, unless cutter radius compensation is on or was just turned off.
    pub(crate) path_end: AxisVector,
    pub(crate) spindle: Spindle,
    pub(crate) coolant: Coolant,
    /// M49: the operator is to have no overrides.
    pub(crate) overrides_off: bool,
    /// Tool number of the last T word.
    pub(crate) selected_tool: u32,
    /// Tool number in the spindle; 0: none.
    pub(crate) tool: u32,
    pub(crate) cycles: CycleSeries,
    pub(crate) probe: ProbeResult,
    /// Value of the input M66 read last.
    pub(crate) input: f64,
    /// E words of printers are relative.
    pub(crate) extruder_relative: bool,
    /// G41 or G42 is in force, be it with a radius of zero.
    pub(crate) on_contour: bool,
    /// Which of the two, the last time.
    pub(crate) contour_side: Side,
    /// Cutter radius compensation was turned off and no move has been made since.
    pub(crate) leaving_contour: bool,
    /// The way from the end of the last move to the control point that continues it smoothly, mm;
    /// `None` if that move was no G5.
    pub(crate) cubic_tail: Option<[f64; 2]>,
    /// Where the last pass of a thread ended.
    pub(crate) thread_end: Option<AxisVector>,
    /// The radius of all corners (RNDM), mm; 0: they stay.
    pub(crate) rounds_mm: f64,
    /// The edge of the tool in force (D of SINUMERIK); `None`: none was chosen.
    pub(crate) edge: Option<u32>,
    /// Modes of FANUC alone.
    pub(crate) fanuc: FanucModal,
    /// The program says that the axes follow the tip of the tool (G43.4, TRAORI).
    pub(crate) tip_follows: bool,
    /// What the first block of FANUC's G76 said.
    pub(crate) thread_setup: Option<ThreadSetup>,
}
