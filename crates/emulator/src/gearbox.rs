//! A gearbox between the motor of a spindle and the spindle, switched by the outputs of a terminal, which tells by
//! its inputs what is in.

use crate::device::Device;

/// A gear of a gearbox.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearPins {
    /// Turns of the motor in a turn of the spindle, negative where it turns the other way.
    pub ratio: f64,
    /// The output that puts it in: device, and bit of its outputs.
    pub output: (usize, usize),
    /// The input that says that it is in: device, and bit of its inputs.
    pub input: (usize, usize),
}

/// A gearbox.
#[derive(Debug, Clone, PartialEq)]
pub struct Gearbox {
    /// The drive of the spindle: device, and axis of it.
    pub spindle: (usize, usize),
    /// Its gears.
    pub gears: Vec<GearPins>,
    /// The one that is in when it is switched on, from 0; `None` for none.
    pub first: Option<usize>,
    /// How long it takes to change, ns.
    pub change_ns: u64,
    /// The teeth do not find their gaps, and break, where the motor turns faster than this, rev/s.
    pub most_v: f64,
    /// A gear comes in where the motor turns, and not where it stands.
    pub needs_motion: bool,
}

/// A gearbox at work.
#[derive(Debug, Clone)]
pub(crate) struct GearboxAtWork {
    gearbox: Gearbox,
    present: Option<usize>,
    /// The gear that is on its way, and since when, ns.
    coming: Option<(usize, u64)>,
    /// When it was looked at last, ns, and how far the motor had turned then.
    seen: Option<(u64, f64)>,
    /// How far the spindle has turned, revolutions.
    revolutions: f64,
    is_stuck: bool,
    /// Gears that were changed while the motor turned too fast.
    broken: u32,
}

impl GearboxAtWork {
    pub(crate) const fn new(gearbox: Gearbox) -> Self {
        Self {
            present: gearbox.first,
            gearbox,
            coming: None,
            seen: None,
            revolutions: 0.0,
            is_stuck: false,
            broken: 0,
        }
    }

    /// Whether it is on the spindle of a drive.
    pub(crate) fn is_of(&self, spindle: (usize, usize)) -> bool {
        self.gearbox.spindle == spindle
    }

    /// How far the spindle has turned, revolutions.
    pub(crate) const fn revolutions(&self) -> f64 {
        self.revolutions
    }

    /// No gear comes in any more, or they do again.
    pub(crate) const fn stick(&mut self, is_stuck: bool) {
        self.is_stuck = is_stuck;
    }

    /// The gear that is in comes out by itself, and none comes in any more.
    pub(crate) const fn fall_out(&mut self) {
        (self.present, self.is_stuck) = (None, true);
    }

    pub(crate) const fn broken(&self) -> u32 {
        self.broken
    }

    /// Looks at the motor and at what is put in, and tells what is in.
    #[allow(clippy::cast_precision_loss, reason = "a period")]
    pub(crate) fn watch(&mut self, devices: &mut [Device], now_ns: u64) {
        let (device, axis) = self.gearbox.spindle;
        let drive = devices
            .get(device)
            .and_then(|device| device.drives.get(axis));
        let Some(turned) = drive.and_then(|drive| drive.revolutions(now_ns)) else {
            return;
        };
        let (last_ns, before) = self.seen.unwrap_or((now_ns, turned));
        if now_ns > last_ns || self.seen.is_none() {
            self.seen = Some((now_ns, turned));
        }
        let since_t = now_ns.saturating_sub(last_ns) as f64 * 1e-9;
        let motor_v = if since_t > 0.0 {
            (turned - before) / since_t
        } else {
            0.0
        };
        if let Some(gear) = self.present.and_then(|nth| self.gearbox.gears.get(nth)) {
            self.revolutions += (turned - before) / gear.ratio;
        }
        if since_t > 0.0 {
            self.change(devices, (now_ns, motor_v));
        }
        for (nth, gear) in self.gearbox.gears.iter().enumerate() {
            let (device, bit) = gear.input;
            if let Some(device) = devices.get_mut(device) {
                let is_in = self.present == Some(nth);
                device.change_inputs(|pins| pins.set_bit(bit, is_in));
            }
        }
    }

    /// Changes the gear as outputs have it.
    fn change(&mut self, devices: &[Device], (now_ns, motor_v): (u64, f64)) {
        let is_on = |(device, bit): (usize, usize)| {
            let outputs = devices
                .get(device)
                .map_or(&[][..], |device| &device.pins.outputs);
            outputs
                .get(bit / 8)
                .is_some_and(|byte| byte >> (bit % 8) & 1 == 1)
        };
        let gears = self.gearbox.gears.iter().enumerate();
        let mut on = gears
            .filter(|(_, gear)| is_on(gear.output))
            .map(|(nth, _)| nth);
        // Without an output, or with two, it stays where it is.
        let (Some(wanted), None) = (on.next(), on.next()) else {
            self.coming = None;
            return;
        };
        if self.present == Some(wanted) {
            self.coming = None;
            return;
        }
        let since_ns = match self.coming {
            Some((coming, since_ns)) if coming == wanted => since_ns,
            _ => now_ns,
        };
        self.coming = Some((wanted, since_ns));
        if self.present.take().is_some() && motor_v.abs() > self.gearbox.most_v {
            self.broken += 1;
        }
        let turns = motor_v.abs() > 0.01;
        if self.is_stuck || (self.gearbox.needs_motion && !turns) {
            return;
        }
        if now_ns.saturating_sub(since_ns) >= self.gearbox.change_ns {
            self.broken += u32::from(motor_v.abs() > self.gearbox.most_v);
            (self.present, self.coming) = (Some(wanted), None);
        }
    }
}
