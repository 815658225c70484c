//! The facts of the machine's set-up that the planner's service knows, for `$#` and `$G`.

use crate::numbers::Units;
use crate::{AXES, LETTERS};

/// The set-up of the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Facts {
    /// Modes behind the last line that was read, as words: `G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0`.
    pub modes: String,
    /// Machine coordinates of the zero of G54 … G59.3.
    pub systems: [[f64; AXES]; 9],
    /// The places of G28 and G30.
    pub references: [[f64; AXES]; 2],
    /// The offset of G92.
    pub shift: [f64; AXES],
    /// The offset of the tool.
    pub tool: [f64; AXES],
    /// Where the probe found what it looked for, or where it gave up; machine coordinates.
    pub probe: [f64; AXES],
    /// Whether it found it.
    pub probe_made: bool,
    /// How often it has looked.
    pub probes: u32,
}

impl Default for Facts {
    fn default() -> Self {
        Self {
            modes: "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0".to_owned(),
            systems: [[0.0; AXES]; 9],
            references: [[0.0; AXES]; 2],
            shift: [0.0; AXES],
            tool: [0.0; AXES],
            probe: [0.0; AXES],
            probe_made: false,
            probes: 0,
        }
    }
}

impl Facts {
    /// What `$#` tells.
    pub(crate) fn lines(&self, units: Units, axes: &[usize]) -> Vec<String> {
        let names = [
            "G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3",
        ];
        let systems = names.iter().zip(&self.systems);
        let places = ["G28", "G30"].iter().zip(&self.references);
        let named = systems
            .chain(places)
            .chain(core::iter::once((&"G92", &self.shift)));
        let mut lines: Vec<String> = named
            .map(|(name, at)| format!("[{name}:{}]", units.vector(at, axes)))
            .collect();
        let z = LETTERS.iter().position(|letter| *letter == 'Z');
        let length = z.and_then(|z| self.tool.get(z)).copied();
        let length = units.place(length.unwrap_or_default(), true);
        lines.push(format!("[TLO:{length}]"));
        lines.push(self.probe_line(units, axes));
        lines
    }

    /// What the probe has found.
    pub(crate) fn probe_line(&self, units: Units, axes: &[usize]) -> String {
        let at = units.vector(&self.probe, axes);
        format!("[PRB:{at}:{}]", u8::from(self.probe_made))
    }
}
