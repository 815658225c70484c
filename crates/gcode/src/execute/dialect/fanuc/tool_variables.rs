//! The variables of tool offsets, as the control divides their memory.
//!
//! | mills | memory A | memory C | Haas, and C with V15 |
//! |---|---|---|---|
//! | `#2001` … | length | wear of the length | length |
//! | `#2201` … | – | length | its wear |
//! | `#2401` …, `#2601` … | – | – | refused: radius or diameter by setting 40 |
//! | `#10001` …, `#11001` … | – | wear of the length, length | – |
//! | `#12001` …, `#13001` … | – | wear of the radius, radius | – |
//!
//! | lathes | memory A | memory C | Haas |
//! |---|---|---|---|
//! | `#2001` …, `#2101` …, `#2201` … | X, Z, radius | their wear | X, Z, radius |
//! | `#2301` … | direction of the tip | the same | the same |
//! | `#2701` …, `#2801` …, `#2901` … | – | X, Z, radius | their wear |
//! | `#10001` …, `#11001` …, `#12001` … | – | wear of X, Z, radius | – |
//! | `#13001` … | – | direction of the tip | – |
//! | `#15001` …, `#16001` …, `#17001` … | – | X, Z, radius | – |
//!
//! X of a lathe is a diameter, as in its words.

use crate::execute::dialect::fanuc::lathe_offsets::in_table;
use crate::execute::interpreter::Interpreter;
use crate::setup::fanuc::OffsetMemory;

/// Offsets of a lathe that have variables with four digits: wear and what stands alone, geometry.
const LATHE_WEAR: u32 = 64;
const LATHE_GEOMETRY: u32 = 49;
/// Offsets of a Haas lathe.
const HAAS_LATHE: u32 = 50;

/// The direction of a tip: a whole number from 0 to 9.
pub(super) fn direction(value: f64) -> Option<u8> {
    (0..=9).find(|it| (f64::from(*it) - value).abs() < 1e-9)
}

/// A part of a tool's offsets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ToolPart {
    Length,
    LengthWear,
    /// Length with its wear: memory A.
    LengthAll,
    Radius,
    RadiusWear,
    /// Along X of a lathe, a diameter.
    Across,
    AcrossWear,
    /// The direction of the tip of a lathe's tool, in the control's numbers.
    Direction,
}

/// Why the radius of a tool is not known on a Haas' mill.
pub(super) const OF_SETTING_40: &str =
    "setting 40 of the control says which of them it is, and that is not known here";

/// True for the radius of a tool, or its wear, on a Haas' mill: #2401, #2601 and on.
pub(super) const fn is_of_setting_40(number: u32) -> bool {
    matches!(number, 2401..=2800)
}

/// True for the numbers of tool offsets in any of the memories.
pub(super) const fn is_of_tools(number: u32) -> bool {
    matches!(number, 2001..=2999 | 10_001..=13_999)
}

/// Which part of which tool a variable is; `None`: none of a tool.
pub(super) fn tool_variable(
    number: u32,
    memory: OffsetMemory,
    is_lathe: bool,
) -> Option<(ToolPart, u32)> {
    if !matches!(number, 2001..=2999 | 10_001..=17_999) {
        return None;
    }
    use ToolPart::{
        Across, AcrossWear, Direction, Length, LengthAll, LengthWear, Radius, RadiusWear,
    };
    // First number, how many, what.
    let of_lathe_c = [
        (2000, LATHE_WEAR, AcrossWear),
        (2100, LATHE_WEAR, LengthWear),
        (2200, LATHE_WEAR, RadiusWear),
        (2300, LATHE_WEAR, Direction),
        (2700, LATHE_GEOMETRY, Across),
        (2800, LATHE_GEOMETRY, Length),
        (2900, LATHE_WEAR, Radius),
        (10_000, 999, AcrossWear),
        (11_000, 999, LengthWear),
        (12_000, 999, RadiusWear),
        (13_000, 999, Direction),
        (15_000, 999, Across),
        (16_000, 999, Length),
        (17_000, 999, Radius),
    ];
    let of_lathe_haas = [
        (2000, HAAS_LATHE, Across),
        (2100, HAAS_LATHE, Length),
        (2200, HAAS_LATHE, Radius),
        (2300, HAAS_LATHE, Direction),
        (2700, HAAS_LATHE, AcrossWear),
        (2800, HAAS_LATHE, LengthWear),
        (2900, HAAS_LATHE, RadiusWear),
    ];
    let of_lathe_a = [
        (2000, LATHE_WEAR, Across),
        (2100, LATHE_WEAR, Length),
        (2200, LATHE_WEAR, Radius),
        (2300, LATHE_WEAR, Direction),
    ];
    let of_mill_c = [
        (2000, 200, LengthWear),
        (2200, 200, Length),
        (10_000, 999, LengthWear),
        (11_000, 999, Length),
        (12_000, 999, RadiusWear),
        (13_000, 999, Radius),
    ];
    let of_mill_haas = [(2000, 200, Length), (2200, 200, LengthWear)];
    let parts: &[(u32, u32, ToolPart)] = match (is_lathe, memory) {
        (_, OffsetMemory::Unsaid) => &[],
        (false, OffsetMemory::A) => &[(2000, 200, LengthAll)],
        (false, OffsetMemory::C) => &of_mill_c,
        (false, OffsetMemory::Haas) => &of_mill_haas,
        (true, OffsetMemory::A) => &of_lathe_a,
        (true, OffsetMemory::C) => &of_lathe_c,
        (true, OffsetMemory::Haas) => &of_lathe_haas,
    };
    parts.iter().find_map(|(first, most, part)| {
        let tool = number.checked_sub(*first)?;
        (1..=*most).contains(&tool).then_some((*part, tool))
    })
}

impl Interpreter {
    /// A part of a tool's offsets, mm or the number of a direction.
    pub(super) fn tool_part(&self, part: ToolPart, number: u32) -> f64 {
        let tool = self
            .state
            .tools
            .as_ref()
            .and_then(|tools| tools.get(number));
        let tool = tool.copied().unwrap_or_default();
        let wear = self.state.offsets.fanuc.wear(number);
        match part {
            ToolPart::Length => tool.offset[2],
            ToolPart::LengthWear => wear.length_mm,
            ToolPart::LengthAll => tool.offset[2] + wear.length_mm,
            ToolPart::Radius => 0.5 * tool.diameter_mm,
            ToolPart::RadiusWear => wear.radius_mm,
            ToolPart::Across => 2.0 * tool.offset[0],
            ToolPart::AcrossWear => 2.0 * wear.x_mm,
            ToolPart::Direction => f64::from(in_table(tool.orientation)),
        }
    }

    /// Sets a part of a tool's offsets: a length in the units of the program, `mm` each, or a direction,
    /// which is known to be one.
    pub(super) fn set_tool_part(&mut self, part: ToolPart, number: u32, value: f64, mm: f64) {
        let value_mm = value * mm;
        match part {
            ToolPart::Length | ToolPart::LengthAll => self.set_tool_value(number, |tool| {
                tool.offset[2] = value_mm;
            }),
            ToolPart::Radius => self.set_tool_value(number, |tool| {
                tool.diameter_mm = 2.0 * value_mm;
            }),
            ToolPart::Across => self.set_tool_value(number, |tool| {
                tool.offset[0] = 0.5 * value_mm;
            }),
            ToolPart::Direction => {
                let direction = direction(value).unwrap_or(0);
                self.set_tool_value(number, |tool| tool.orientation = in_table(direction));
            }
            ToolPart::LengthWear => {
                self.state
                    .offsets
                    .fanuc
                    .wear
                    .entry(number)
                    .or_default()
                    .length_mm = value_mm;
            }
            ToolPart::RadiusWear => {
                self.state
                    .offsets
                    .fanuc
                    .wear
                    .entry(number)
                    .or_default()
                    .radius_mm = value_mm;
            }
            ToolPart::AcrossWear => {
                self.state
                    .offsets
                    .fanuc
                    .wear
                    .entry(number)
                    .or_default()
                    .x_mm = 0.5 * value_mm;
            }
        }
        self.state.changes = self.state.changes.saturating_add(1);
    }
}
