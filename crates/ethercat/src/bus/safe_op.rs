//! The bus in SAFE-OP: inputs come, outputs do not yet count.

use super::bus_time::BusTime;
use super::op::{Op, Reception};
use super::others::Others;
use super::state::{self, OP};
use crate::bus_clock::BusClock;
use crate::device::Device;
use crate::device_state::DeviceState;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::image::{Inputs, Outputs};
use crate::layout::Drives;
use crate::registers::AL_CONTROL;
use crate::settings::BusSettings;
use crate::wire::Wire;

/// How long the devices may take to OP.
const PATIENCE_NS: u64 = 10_000_000_000;

/// A bus that gives inputs.
#[derive(Debug)]
pub struct SafeOp<'w, W> {
    bus: Exchange<'w, W>,
    drives: Drives,
    others: Others,
    /// Whose clock it is, and what time.
    reference: (usize, BusTime),
    start_ns: u64,
}

impl<'w, W: Wire> SafeOp<'w, W> {
    pub(super) fn new(
        bus: Exchange<'w, W>,
        (drives, others): (Drives, Others),
        reference: (usize, BusTime),
        start_ns: u64,
    ) -> Self {
        Self {
            bus,
            drives,
            others,
            reference,
            start_ns,
        }
    }

    /// Brings the devices to OP while cycles are exchanged whose targets are where the drives stand, and
    /// whose outputs are at rest.
    ///
    /// # Errors
    ///
    /// A device does not go there.
    pub fn into_op(self, settings: &BusSettings) -> Result<Op<'w, W>, BusError> {
        let now_ns = self.bus.wire.now_ns();
        let clock = BusClock::new(settings, self.start_ns, now_ns);
        let op = Op::new(
            self.bus,
            self.drives.clone(),
            self.others.clone(),
            self.reference,
        );
        // As states are told: those of all drives, then those of all others.
        let devices: Vec<&Device> = self.drives.of_axes().chain(&self.others.devices).collect();
        let mut start = Start {
            inputs: vec![Inputs::default(); self.drives.axes.len()],
            outputs: vec![Outputs::default(); self.drives.axes.len()],
            op,
            clock,
        };
        // The clock is known before a drive counts on being served in time.
        let until_ns = self.start_ns.max(now_ns) + PATIENCE_NS;
        while !start.clock.is_settled() {
            start.cycle()?;
            if start.op.wire().now_ns() > until_ns {
                return Err(devices.first().map_or(BusError::Nobody, |device| {
                    refusal(device, start.op.states().first())
                }));
            }
        }
        start.request(&devices)?;
        let until_ns = start.op.wire().now_ns() + PATIENCE_NS;
        loop {
            start.cycle()?;
            let states = start.op.states();
            if states.iter().all(|state| state.is_in_op()) {
                start.op.take_over(start.clock);
                return Ok(start.op);
            }
            let failed = states.iter().position(|state| state.has_error);
            let late = states.iter().position(|state| state.state != OP);
            let is_late = start.op.wire().now_ns() > until_ns;
            if let Some(nth) = failed.or(late.filter(|_| is_late)) {
                return Err(refusal(devices[nth], start.op.states().get(nth)));
            }
        }
    }
}

fn refusal(device: &Device, state: Option<&DeviceState>) -> BusError {
    BusError::State {
        device: device.position,
        name: device.name.clone(),
        wanted: state::name(OP),
        code: state.map_or(0, |state| state.code),
    }
}

/// Cycles that lead nowhere: targets are where the drives stand.
struct Start<'w, W> {
    op: Op<'w, W>,
    clock: BusClock,
    inputs: Vec<Inputs>,
    outputs: Vec<Outputs>,
}

impl<W: Wire> Start<'_, W> {
    fn cycle(&mut self) -> Result<(), BusError> {
        let failed = |action| move |source| BusError::Wire { action, source };
        let beat = self.clock.next(self.op.wire().now_ns());
        self.op.wire().sleep_until(beat.send_ns);
        self.op.send(&self.outputs).map_err(failed("sending"))?;
        let reception = self.op.receive(beat.give_up_ns, &mut self.inputs);
        if let Reception::Good(times) = reception.map_err(failed("receiving"))? {
            self.clock.hear(times);
            for (output, input) in self.outputs.iter_mut().zip(&self.inputs) {
                *output = Outputs::standing(input);
            }
        }
        Ok(())
    }

    fn request(&mut self, devices: &[&Device]) -> Result<(), BusError> {
        let mut bus = Exchange::new(self.op.wire());
        for device in devices {
            let action = "to a change of its state";
            bus.write(device.position, AL_CONTROL, &[OP, 0], action)?;
        }
        Ok(())
    }
}
