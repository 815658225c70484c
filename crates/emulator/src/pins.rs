//! The pins of a device that is no drive: what its outputs are, and what is at its inputs.

/// A change of outputs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputRecord {
    /// When it was, by the clock of the host, ns.
    pub at_ns: u64,
    /// The outputs from then on, bytes in the order of the windows.
    pub outputs: Vec<u8>,
}

/// Pins, as they are.
#[derive(Debug, Clone, Default)]
pub(crate) struct Pins {
    pub(crate) outputs: Vec<u8>,
    pub(crate) inputs: Vec<u8>,
    /// Changes of the outputs, if they are wanted.
    pub(crate) records: Option<Vec<OutputRecord>>,
}

impl Pins {
    /// Outputs become these.
    pub(crate) fn put(&mut self, outputs: Vec<u8>, at_ns: u64) {
        if self.outputs == outputs {
            return;
        }
        self.outputs = outputs;
        if let Some(records) = &mut self.records {
            records.push(OutputRecord {
                at_ns,
                outputs: self.outputs.clone(),
            });
        }
    }

    /// Something comes to inputs: bytes from one on.
    pub(crate) fn set_inputs(&mut self, from: usize, bytes: &[u8]) {
        let end = from + bytes.len();
        if self.inputs.len() < end {
            self.inputs.resize(end, 0);
        }
        self.inputs[from..end].copy_from_slice(bytes);
    }

    /// One input becomes high or low.
    pub(crate) fn set_bit(&mut self, bit: usize, is_high: bool) {
        let before = self.inputs.get(bit / 8).copied().unwrap_or(0);
        let mask = 1 << (bit % 8);
        let byte = if is_high {
            before | mask
        } else {
            before & !mask
        };
        self.set_inputs(bit / 8, &[byte]);
    }
}
