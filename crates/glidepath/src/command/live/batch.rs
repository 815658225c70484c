//! A batch of setpoints on its way to the page, as `page/ring.js` reads it.

use crate::config::MachineConfig;
use glidepath_link::Setpoint;

/// Setpoints that wait at most: half a minute at 1 ms. Then the oldest are dropped, and the page sees
/// the gap.
const MOST: usize = 32_768;

/// Setpoints of some hundredths of a second.
#[derive(Debug)]
pub(super) struct Batch {
    axes: Vec<usize>,
    count: u32,
    rows: Vec<u8>,
}

impl Batch {
    pub(super) fn new(config: &MachineConfig) -> Self {
        let axes = config.axis_names();
        Self {
            axes: axes.into_iter().map(|axis| axis.index()).collect(),
            count: 0,
            rows: Vec::new(),
        }
    }

    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        reason = "counts are exact below 2^53; speeds are shown"
    )]
    pub(super) fn push(&mut self, setpoint: &Setpoint) {
        if self.count as usize >= MOST {
            (self.count, self.rows) = (0, Vec::new());
        }
        self.count += 1;
        let rows = &mut self.rows;
        rows.extend_from_slice(&(setpoint.number as f64).to_le_bytes());
        rows.extend_from_slice(&(setpoint.tick as f64).to_le_bytes());
        rows.extend_from_slice(&setpoint.line.to_le_bytes());
        rows.extend_from_slice(&setpoint.state.to_le_bytes());
        rows.extend_from_slice(&(setpoint.feed_v as f32).to_le_bytes());
        rows.extend_from_slice(&(setpoint.effective_override as f32).to_le_bytes());
        rows.extend_from_slice(&(setpoint.lateness_ns as f32 * 1e-3).to_le_bytes());
        rows.extend_from_slice(&[0; 4]);
        for axis in &self.axes {
            let position = setpoint.position.get(*axis).copied().unwrap_or(0.0);
            rows.extend_from_slice(&position.to_le_bytes());
        }
    }

    /// What came since the last call; nothing if nothing did.
    pub(super) fn bytes(&mut self) -> Option<Vec<u8>> {
        if self.count == 0 {
            return None;
        }
        let axes = u32::try_from(self.axes.len()).unwrap_or(0);
        let mut bytes = Vec::with_capacity(self.rows.len() + 8);
        bytes.extend_from_slice(&self.count.to_le_bytes());
        bytes.extend_from_slice(&axes.to_le_bytes());
        bytes.append(&mut self.rows);
        self.count = 0;
        Some(bytes)
    }
}
