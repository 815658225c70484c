//! All that a block may change: a block that is refused gives it back as a whole.
//!
//! It is copied in front of every block that may be refused, so what is large in it is [`Shared`] with the copy.

use std::sync::Arc;

use glidepath_geometry::AxisVector;
use serde::{Deserialize, Serialize};

use crate::execute::auxiliary::input_wait::InputWait;
use crate::execute::state::contour_plane::ContourPlane;
use crate::execute::state::coolant::Coolant;
use crate::execute::state::extruder::ExtruderMode;
use crate::execute::state::fanuc_modal::FanucModal;
use crate::execute::state::modal::{Feed, Modal};
use crate::execute::state::offsets::Offsets;
use crate::execute::state::open::Open;
use crate::execute::state::pole::Pole;
use crate::execute::state::printer::KeptByPrinter;
use crate::execute::state::probe_result::{ProbeResult, Search};
use crate::execute::state::saved_states::SavedStates;
use crate::execute::state::shared::Shared;
use crate::execute::state::spindle::Spindle;
use crate::execute::state::sticky_words::CycleSeries;
use crate::execute::state::thread_setup::ThreadSetup;
use crate::execute::state::tip::{Tilt, Tip};
use crate::execute::state::untraversed::Untraversed;
use crate::setup::firmware::Firmware;
use crate::setup::tool_table::ToolTable;
use crate::syntax::modes::{ArcFeed, Side};

/// All that a block may change.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct State {
    pub(crate) modal: Modal,
    /// Where the program has brought the machine, machine coordinates. With cutter radius
    /// compensation that is the programmed contour, not the tool.
    #[serde(skip)]
    pub(crate) position: AxisVector,
    /// End of the last segment made. Within [`crate::execute::motion::settled::MIN_MOVE`] of
    /// `position`, unless cutter radius compensation is on or was just turned off.
    #[serde(skip)]
    pub(crate) path_end: AxisVector,
    pub(crate) spindle: Spindle,
    pub(crate) coolant: Coolant,
    /// M49: the operator is to have no overrides.
    pub(crate) overrides_off: bool,
    /// Tool number of the last T word.
    pub(crate) selected_tool: u32,
    /// Tool number in the spindle; 0: none.
    pub(crate) tool: u32,
    /// The tool before the last M6, with the offset (G43) and the edge that were in force there.
    #[serde(skip)]
    pub(crate) tool_before: (u32, AxisVector, Option<u32>),
    pub(crate) cycles: CycleSeries,
    pub(crate) probe: ProbeResult,
    /// Value of the input M66 read last.
    pub(crate) input: f64,
    /// Whether E words of printers are relative.
    pub(crate) extruder: ExtruderMode,
    /// What SET_GCODE_OFFSET of Klipper has set, mm.
    pub(crate) gcode_offset: [f64; 3],
    /// G41 or G42 is in force, be it with a radius of zero.
    pub(crate) on_contour: bool,
    /// What F counts on arcs beside it.
    #[serde(default)]
    pub(crate) arc_feed: ArcFeed,
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
    #[serde(skip)]
    pub(crate) rounds_mm: f64,
    /// The feed of broken corners (FRCM of SINUMERIK); `None`: that of the path.
    #[serde(skip)]
    pub(crate) corner_feed: Option<Feed>,
    /// X words are diameters where they are absolute (DIAM90 of SINUMERIK).
    #[serde(skip)]
    pub(crate) diameter_by_distance: bool,
    /// The pole of polar coordinates (G110 to G112 of SINUMERIK).
    #[serde(skip)]
    pub(crate) pole: Pole,
    /// F counts millimetres whatever the unit of lengths is (G70 and G71 of SINUMERIK).
    #[serde(skip)]
    pub(crate) feeds_in_mm: bool,
    /// The edge of the tool in force (D of SINUMERIK); 0: none, `None`: nothing was said of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) edge: Option<u32>,
    /// Modes of FANUC alone.
    #[serde(skip)]
    pub(crate) fanuc: FanucModal,
    /// What X, Y and Z are of, on a machine with five axes.
    #[serde(skip)]
    pub(crate) tip: Tip,
    /// The tool turns on great circles where its tip is followed (ORIVECT of SINUMERIK).
    #[serde(skip)]
    pub(crate) turns_on_circles: bool,
    /// The program has tilted the plane.
    #[serde(skip)]
    pub(crate) tilted: Option<Tilt>,
    /// Coordinates are those of this plane of the work for as long as the contour is one of it.
    #[serde(skip)]
    pub(crate) contour_plane: Option<ContourPlane>,
    /// What new frames and tool lengths of SINUMERIK have shifted, and no move has gone yet.
    #[serde(skip)]
    pub(crate) untraversed: Untraversed,
    /// What the first block of FANUC's G76 said.
    pub(crate) thread_setup: Option<ThreadSetup>,
    #[serde(skip)]
    pub(crate) offsets: Shared<Offsets>,
    /// The tool table, with what G10 has made of it.
    #[serde(skip)]
    pub(crate) tools: Option<Arc<ToolTable>>,
    /// Blocks that changed coordinate systems, reference positions, the offset of G92 or tools.
    #[serde(skip)]
    pub(crate) changes: u64,
    #[serde(skip)]
    pub(crate) open: Open,
    #[serde(skip)]
    pub(crate) saved_states: Shared<SavedStates>,
    /// The firmware of the printer, as far as it is known: the program's own words may say it.
    #[serde(skip)]
    pub(crate) firmware: Option<Firmware>,
    /// Places and states that a printer's program keeps.
    #[serde(skip)]
    pub(crate) kept_by_printer: Shared<KeptByPrinter>,
    /// The direction in which the last move ended, for a block with CT.
    #[serde(skip)]
    pub(crate) tangent: Option<AxisVector>,
    /// Where the axes stand behind the last move, where places of the program are not the axes.
    #[serde(skip)]
    pub(crate) axes_end: AxisVector,
    /// They are not.
    #[serde(skip)]
    pub(crate) is_mapped: bool,
    /// What the M66 executed last waits for.
    #[serde(skip)]
    pub(crate) input_wait: Option<InputWait>,
    /// The probing move executed last, as long as it is not known how it ended.
    #[serde(skip)]
    pub(crate) search: Option<Search>,
}

impl State {
    /// What does not outlast a program is gone.
    pub(crate) fn end_with_program(&mut self) {
        (self.on_contour, self.leaving_contour, self.cubic_tail) = (false, false, None);
        self.open = Open::default();
        self.saved_states = Shared::default();
        self.kept_by_printer = Shared::default();
        (self.tangent, self.input_wait, self.search) = (None, None, None);
    }
}
