//! The state in which a program begins: that of LinuxCNC's start-up, on the machine of the options.
//!
//! Where other controls begin otherwise is in [`power_on`](crate::execute::power_on).

use glidepath_geometry::AxisVector;

use crate::execute::motion::tip_map::TipMap;
use crate::execute::state::coolant::Coolant;
use crate::execute::state::extruder::ExtruderMode;
use crate::execute::state::fanuc_modal::FanucModal;
use crate::execute::state::modal::Modal;
use crate::execute::state::offsets::Offsets;
use crate::execute::state::open::Open;
use crate::execute::state::pole::Pole;
use crate::execute::state::probe_result::ProbeResult;
use crate::execute::state::program_state::State;
use crate::execute::state::shared::Shared;
use crate::execute::state::spindle::Spindle;
use crate::execute::state::sticky_words::CycleSeries;
use crate::execute::state::untraversed::Untraversed;
use crate::setup::options::Options;
use crate::syntax::modes::{ArcFeed, Side};

impl State {
    /// What is in force where a program begins.
    pub(crate) fn at_start(options: &Options) -> Self {
        let axes_end = options.start;
        let tip = options.first_tip();
        let map = TipMap::new(options.five_axis, tip);
        let start = map.map_or(axes_end, |map| map.place(&axes_end));
        Self {
            modal: Modal::new(options.default_feed_mm_min),
            position: start,
            path_end: start,
            spindle: Spindle {
                chooses_gear: options.gears.are_by_speed(),
                ..Spindle::default()
            },
            coolant: Coolant::default(),
            overrides_off: false,
            selected_tool: 0,
            tool: 0,
            tool_before: (0, AxisVector::zeros(), None),
            cycles: CycleSeries::default(),
            probe: ProbeResult::default(),
            input: 0.0,
            extruder: ExtruderMode::default(),
            gcode_offset: [0.0; 3],
            on_contour: false,
            arc_feed: ArcFeed::default(),
            contour_side: Side::Left,
            leaving_contour: false,
            cubic_tail: None,
            thread_end: None,
            rounds_mm: 0.0,
            corner_feed: None,
            diameter_by_distance: false,
            pole: Pole::default(),
            feeds_in_mm: false,
            edge: None,
            fanuc: FanucModal::default(),
            tip,
            turns_on_circles: false,
            tilted: None,
            contour_plane: None,
            untraversed: Untraversed::default(),
            thread_setup: None,
            offsets: Shared::new(Offsets::of(&options.offsets)),
            tools: options.tools.clone(),
            changes: 0,
            open: Open::default(),
            saved_states: Shared::default(),
            firmware: options.firmware,
            kept_by_printer: Shared::default(),
            tangent: None,
            axes_end,
            is_mapped: map.is_some(),
            input_wait: None,
            search: None,
        }
    }
}
