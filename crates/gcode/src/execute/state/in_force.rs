//! The state in force behind a program, for the next one to begin with.

use std::sync::Arc;

use glidepath_geometry::AxisVector;
use serde::{Deserialize, Serialize};

use crate::execute::motion::position_offsets::PositionOffsets;
use crate::execute::parameters::Parameters;
use crate::execute::state::coolant::Coolant;
use crate::execute::state::modal::Modal;
use crate::execute::state::offsets::Offsets;
use crate::execute::state::program_state::State;
use crate::execute::state::shared::Shared;
use crate::execute::state::words_in_force::words_in_force;
use crate::setup::tool_table::ToolTable;
use crate::setup::work_offsets::WorkOffsets;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::Motion;

/// All that is in force behind a block: modes, feed, spindle, tool, offsets, parameters. Where the
/// machine stands is no part of it. Clones are the same; it equals nothing but them.
///
/// As text (serde) it is for programs that are read again elsewhere. Numbers of parameters may be NaN, which stands for
/// FANUC's null, so the format has to have that; TOML does.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct InForce(pub(crate) Arc<InForceParts>);

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(from = "Written", into = "Written")]
pub(crate) struct InForceParts {
    /// The language of what left it.
    pub(crate) dialect: Dialect,
    /// It was one of FANUC's lathes; those of SINUMERIK are told by the machine.
    pub(crate) is_lathe: bool,
    /// It was typed: what the next line, or program, begins with is what was typed, and not what a control begins with.
    pub(crate) is_typed: bool,
    pub(crate) state: State,
    pub(crate) parameters: Parameters,
}

/// The same as text.
#[derive(Serialize, Deserialize)]
struct Written {
    #[serde(default)]
    dialect: Dialect,
    #[serde(default)]
    is_lathe: bool,
    #[serde(default)]
    is_typed: bool,
    state: State,
    offsets: Offsets,
    tools: Option<Arc<ToolTable>>,
    parameters: Parameters,
}

impl From<InForceParts> for Written {
    fn from(parts: InForceParts) -> Self {
        let InForceParts {
            dialect,
            is_lathe,
            is_typed,
            state,
            parameters,
        } = parts;
        Self {
            dialect,
            is_lathe,
            is_typed,
            offsets: Offsets::clone(&state.offsets),
            tools: state.tools.clone(),
            state,
            parameters,
        }
    }
}

impl From<Written> for InForceParts {
    fn from(written: Written) -> Self {
        let Written {
            dialect,
            is_lathe,
            is_typed,
            state,
            offsets,
            tools,
            parameters,
        } = written;
        Self {
            dialect,
            is_lathe,
            is_typed,
            state: State {
                offsets: Shared::new(offsets),
                tools,
                ..state
            },
            parameters,
        }
    }
}

impl PartialEq for InForce {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl InForce {
    /// Coordinate systems, reference positions and the offset of G92.
    #[must_use]
    pub fn work_offsets(&self) -> WorkOffsets {
        self.0.state.offsets.set_up()
    }

    /// The program's zero in machine coordinates, with all offsets, that of the tool, too.
    #[must_use]
    pub fn zero(&self) -> AxisVector {
        self.0.state.offsets.to_machine(AxisVector::zeros())
    }

    /// The offsets in force beside the coordinate system.
    #[must_use]
    pub fn position_offsets(&self) -> PositionOffsets {
        let state = &self.0.state;
        PositionOffsets {
            tool: state.offsets.tool,
            shift: state.offsets.shift,
            tip: state.tip,
        }
    }

    /// The codes and words in force, as a line would say them: see [`crate::Program::words_in_force`].
    #[must_use]
    pub fn words(&self) -> String {
        words_in_force(&self.0.state)
    }

    /// The same, for a machine at which the last M6 was not done: the tool before is in the spindle, and
    /// its offset (G43) is in force.
    #[must_use]
    pub fn before_tool_change(&self) -> Self {
        let mut parts = self.0.as_ref().clone();
        let (tool, offset, edge) = parts.state.tool_before;
        (parts.state.tool, parts.state.edge) = (tool, edge);
        parts.state.offsets.tool = offset;
        Self(Arc::new(parts))
    }

    /// The same, for a machine at which spindle or coolant was stopped since by something else than a program: an
    /// abort, a fault, the loss of power.
    #[must_use]
    pub fn with_stopped(&self, spindle: bool, coolant: bool) -> Self {
        let state = &self.0.state;
        let stops_spindle = spindle && state.spindle.turning.is_some();
        let stops_coolant = coolant && state.coolant != Coolant::default();
        if !stops_spindle && !stops_coolant {
            return self.clone();
        }
        let mut parts = self.0.as_ref().clone();
        if stops_spindle {
            parts.state.spindle.turning = None;
        }
        if stops_coolant {
            parts.state.coolant = Coolant::default();
        }
        Self(Arc::new(parts))
    }

    /// The same behind a reset as that of grbl (`gc_init`), on a machine where programs begin with `begin`: its modes, its
    /// feed and its coordinate system, G0, spindle and coolant off, no offset of G92 and none of the tool. What is of the
    /// machine stays: coordinate systems and reference positions, which `begin` has too, the tool in the spindle and its
    /// table, parameters, what the probe has found.
    #[must_use]
    pub fn reset_to(&self, begin: &Self) -> Self {
        let (own, first) = (&self.0.state, &begin.0.state);
        let mut offsets = first.offsets.clone();
        offsets.tool = AxisVector::zeros();
        offsets.shift = AxisVector::zeros();
        offsets.saved_shift = own.offsets.saved_shift;
        offsets.fanuc.external = own.offsets.fanuc.external;
        offsets
            .fanuc
            .extended
            .clone_from(&own.offsets.fanuc.extended);
        offsets.fanuc.wear.clone_from(&own.offsets.fanuc.wear);
        let state = State {
            modal: Modal {
                motion: Some(Motion::Rapid),
                ..first.modal
            },
            selected_tool: own.selected_tool,
            tool: own.tool,
            probe: own.probe,
            input: own.input,
            tools: own.tools.clone().or_else(|| first.tools.clone()),
            offsets,
            ..first.clone()
        };
        let parts = InForceParts {
            state,
            parameters: self.0.parameters.clone(),
            ..begin.0.as_ref().clone()
        };
        Self(Arc::new(parts))
    }

    /// The same, with spindle and coolant as they were before.
    #[must_use]
    pub fn turning_as(&self, before: &Self) -> Self {
        let mut parts = self.0.as_ref().clone();
        parts.state.spindle = before.0.state.spindle;
        parts.state.coolant = before.0.state.coolant;
        Self(Arc::new(parts))
    }

    /// The tool in the spindle; 0: none.
    #[must_use]
    pub fn tool(&self) -> u32 {
        self.0.state.tool
    }

    /// The tool table with what G10 has made of it.
    #[must_use]
    pub fn tools(&self) -> Option<&Arc<ToolTable>> {
        self.0.state.tools.as_ref()
    }
}
