//! The state that a machine keeps over a restart.

use serde::{Deserialize, Serialize};

/// Axes: X Y Z A B C U V W.
pub const AXES: usize = 9;
/// Coordinate systems: G54 … G59, G59.1 … G59.3.
pub const SYSTEMS: usize = 9;

/// A coordinate system.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct System {
    /// Machine coordinates of its zero: mm, degrees.
    pub origin: [f64; AXES],
    /// How far X and Y are turned about the Z axis, degrees.
    pub rotation_deg: f64,
}

/// An edge of a tool as a program has changed it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tool {
    /// The tool's number.
    pub number: u32,
    /// The edge: 1 is the first one, which is the tool where a language knows no edges.
    #[serde(default = "first", skip_serializing_if = "is_first")]
    pub edge: u32,
    /// Length offsets, mm and degrees.
    pub offset: [f64; AXES],
    /// Diameter, mm.
    pub diameter_mm: f64,
    /// Orientation of a turning tool, 0 to 9.
    pub orientation: u8,
}

/// The edge of tools that have one.
const fn first() -> u32 {
    1
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde hands a reference on"
)]
const fn is_first(edge: &u32) -> bool {
    *edge == first()
}

/// A numbered parameter of programs that outlasts a restart.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variable {
    /// Its number.
    pub number: u32,
    /// What is in it.
    pub value: f64,
}

/// Coordinates that are set up on a machine: mm, degrees, machine coordinates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Offsets {
    /// Number of the coordinate system in force, 1 (G54) to 9 (G59.3).
    pub active: u8,
    /// Machine position of G28.
    pub g28: [f64; AXES],
    /// Machine position of G30.
    pub g30: [f64; AXES],
    /// The offset of G92 that G92.3 puts in force. It never is by itself.
    pub g92: [f64; AXES],
    /// G54 … G59.3.
    pub systems: [System; SYSTEMS],
}

/// The place where the machine was last known to rest. For people: no position is taken from it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rest {
    /// Machine position, mm and degrees.
    pub position: [f64; AXES],
    /// False from when a program begins to move the machine until it has come to its end.
    pub clean: bool,
}

/// A program that has begun, and has not come to its end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnderWay {
    /// The fingerprint of its text.
    #[serde(with = "crate::text::hexadecimal")]
    pub program: u64,
    /// What it began with: what the rest of it has to be read with.
    pub offsets: Offsets,
    /// The edges of tools it began with that programs had changed before.
    #[serde(default)]
    pub tools: Vec<Tool>,
    /// The parameters it began with.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variables: Vec<Variable>,
    /// How many times its tolerance it may use.
    #[serde(default = "once", skip_serializing_if = "is_once")]
    pub tolerance_ratio: f64,
}

/// How many times its tolerance a program may use, as jobs ask for it.
const RATIOS: core::ops::RangeInclusive<f64> = 0.1..=10.0;

/// A run with the tolerance as it is.
const fn once() -> f64 {
    1.0
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde hands a reference on"
)]
const fn is_once(ratio: &f64) -> bool {
    ratio.to_bits() == once().to_bits()
}

/// Everything that is kept.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PersistentState {
    /// The fingerprint of the axes and the mechanism the coordinates belong to.
    #[serde(with = "crate::text::hexadecimal")]
    pub configuration: u64,
    /// Tool in the spindle at the last rest; 0: none. For people: it is not put into force.
    pub spindle_tool: u32,
    /// The fingerprint of the tool table's file that `tools` were changed in; 0: none.
    #[serde(with = "crate::text::hexadecimal")]
    pub tool_table: u64,
    /// Coordinates.
    pub offsets: Offsets,
    /// Where the machine rested last.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest: Option<Rest>,
    /// The program that has begun.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub under_way: Option<UnderWay>,
    /// The edges of tools that programs changed.
    #[serde(default)]
    pub tools: Vec<Tool>,
    /// The parameters of programs that outlast a restart, of those that something was assigned to.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variables: Vec<Variable>,
}

impl Default for Offsets {
    /// Everything at machine zero, in G54.
    fn default() -> Self {
        Self {
            active: 1,
            g28: [0.0; AXES],
            g30: [0.0; AXES],
            g92: [0.0; AXES],
            systems: [System::default(); SYSTEMS],
        }
    }
}

/// How far anything may be from zero, mm or degrees: beyond every axis. A double resolves a tenth of
/// a micrometre there, and no sum of such numbers is infinite.
const FARTHEST: f64 = 1e9;

/// Whether a number says where something is.
fn is_place(number: f64) -> bool {
    number.abs() <= FARTHEST
}

impl Offsets {
    /// What is no state of a machine, in words.
    fn fault(&self) -> Option<String> {
        let system = |system: &System| system.origin.into_iter().chain([system.rotation_deg]);
        let numbers = self.systems.iter().flat_map(system);
        let others = [self.g28, self.g30, self.g92].into_iter().flatten();
        if !numbers.chain(others).all(is_place) {
            return Some("a coordinate is no number, or beyond 1e9".to_owned());
        }
        if !(1..=9).contains(&self.active) {
            return Some(format!("there is no coordinate system {}", self.active));
        }
        None
    }
}

impl PersistentState {
    /// What is no state of a machine, in words.
    pub(crate) fn fault(&self) -> Option<String> {
        let under_way = self.under_way.as_ref();
        let tools = self.tools.iter();
        let mut tools = tools.chain(under_way.iter().flat_map(|program| &program.tools));
        let is_number = |tool: &Tool| {
            let mut numbers = tool.offset.into_iter().chain([tool.diameter_mm]);
            numbers.all(is_place)
        };
        if !tools.all(is_number) {
            return Some("a tool's offset is no number, or beyond 1e9".to_owned());
        }
        let begun = under_way.iter().flat_map(|program| &program.variables);
        let mut variables = self.variables.iter().chain(begun);
        if !variables.all(|variable| variable.value.is_finite()) {
            return Some("a parameter is no number".to_owned());
        }
        let rest = self.rest.iter().flat_map(|rest| rest.position);
        if !rest.into_iter().all(is_place) {
            return Some("the position of the last rest is no number, or beyond 1e9".to_owned());
        }
        let ratio = under_way.map_or_else(once, |program| program.tolerance_ratio);
        if !RATIOS.contains(&ratio) {
            return Some(
                "the program that has begun uses less than .1 or more than 10 times its tolerance"
                    .to_owned(),
            );
        }
        let begun = under_way.and_then(|program| program.offsets.fault());
        self.offsets.fault().or(begun)
    }
}
