//! The distributed clocks: one time for all devices, and SYNC0 at the same moments.
//!
//! The first device with a clock is the reference. A broadcast write has every device note when it
//! came by, on the way out and on the way back. From that follow what each clock is off, and how much
//! later than the reference a device sees a frame: see [`tree`].
//!
//! The time of all is that of the host when the broadcast was under way: CLOCK_MONOTONIC, from which
//! the reference then drifts away.

use super::bus_time::BusTime;
use super::tree::{self, Crooked, Seen};
use crate::device::{ClockKind, Device};
use crate::error::BusError;
use crate::exchange::{Exchange, station};
use crate::frame::{Address, Command};
use crate::registers::{
    FEATURES, LATCHED_TIME, PORT_TIMES, SYNC_ACTIVATION, SYNC_START, SYNC0_CYCLE, SYSTEM_TIME,
    TIME_DELAY, TIME_DIFFERENCE, TIME_OFFSET,
};
use crate::wire::Wire;

const ACTION: &str = "about its clock";
/// Differences that count as none, ns.
const NEAR_NS: u32 = 1_000;
/// How long the clocks may take, s.
const PATIENCE_S: u64 = 10;
/// Between two distributions of the time.
const POLL_NS: u64 = 1_000_000;
/// Distributions between two looks at the differences.
const ROUND: u32 = 50;
/// From the activation of SYNC0 to the first one, ns.
const START_NS: u64 = 100_000_000;

/// Bits of the features: it says that it has a clock, and that this has 64 bits.
const SAYS_CLOCK: u16 = 1 << 2;
const SAYS_64_BITS: u16 = 1 << 3;

/// What a device has of a clock. Features that say "a clock of 64 bits" are those of terminals and
/// couplers, too, which only note when frames come by: what counts is what answers.
pub(super) fn kind<W: Wire>(bus: &mut Exchange<'_, W>, nth: usize) -> Result<ClockKind, BusError> {
    let features = u16::from_le_bytes(bus.read(nth, FEATURES, ACTION)?);
    if features & SAYS_CLOCK == 0 || !bus.has(nth, PORT_TIMES, 4, ACTION)? {
        return Ok(ClockKind::None);
    }
    let is_clock = bus.has(nth, SYSTEM_TIME, 4, ACTION)?;
    Ok(match (is_clock, features & SAYS_64_BITS != 0) {
        (false, _) => ClockKind::ReceiveTimes,
        (true, false) => ClockKind::Bits32,
        (true, true) => ClockKind::Bits64,
    })
}

/// Writes offsets and delays of all clocks.
pub(super) fn set<W: Wire>(bus: &mut Exchange<'_, W>, devices: &[Device]) -> Result<(), BusError> {
    let Some(reference) = reference(devices) else {
        return Ok(());
    };
    // A lost frame would have some clocks latch and others not: the last one counts for all.
    let mut zero = [0; 4];
    let asked = bus.ask(Command::Bwr, Address::all(PORT_TIMES), &mut zero, 5)?;
    let (_, at_ns) = asked.ok_or(BusError::Nobody)?;
    let mut seen = Vec::with_capacity(devices.len());
    for device in devices {
        seen.push(see(bus, device)?);
    }
    let delays = tree::delays(&seen).map_err(|crooked| told(crooked, devices))?;
    let delay = |nth: usize| delays.get(nth).copied().flatten().unwrap_or(0);
    for device in devices.iter().filter(|device| device.clock.is_clock()) {
        let nth = device.position;
        let delay = delay(nth).saturating_sub(delay(reference));
        let latched = u64::from_le_bytes(bus.read(nth, LATCHED_TIME, ACTION)?);
        let offset = (at_ns + u64::from(delay)).wrapping_sub(latched);
        write_time(bus, device, TIME_OFFSET, offset)?;
        bus.write(nth, TIME_DELAY, &delay.to_le_bytes(), ACTION)?;
    }
    Ok(())
}

/// Writes a time or an offset, as far as the clock of a device goes.
fn write_time<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    register: u16,
    time_ns: u64,
) -> Result<(), BusError> {
    let bytes = time_ns.to_le_bytes();
    let (told, _) = bytes.split_at(device.clock.bytes());
    bus.write(device.position, register, told, ACTION)
}

/// What a device shows of its ports. Those that are closed are not even asked.
fn see<W: Wire>(bus: &mut Exchange<'_, W>, device: &Device) -> Result<Seen, BusError> {
    let mut times = [0; 4];
    if device.clock.notes_times() {
        let places = (PORT_TIMES..).step_by(4).zip(&mut times);
        for ((register, time), _) in places.zip(device.open_ports).filter(|(_, open)| *open) {
            *time = u32::from_le_bytes(bus.read(device.position, register, ACTION)?);
        }
    }
    Ok(Seen {
        open: device.open_ports,
        times: device.clock.notes_times().then_some(times),
        has_clock: device.clock.is_clock(),
    })
}

fn told(crooked: Crooked, devices: &[Device]) -> BusError {
    let (nth, what) = match crooked {
        Crooked::Loose(nth) => (
            nth,
            "no device before it has a cable left that could lead here: a cable is loose, or IN and \
             OUT of a device are swapped",
        ),
        Crooked::Swapped(nth) => (
            nth,
            "frames do not come in by its IN port: swap the cables of its IN and OUT",
        ),
        Crooked::Blind(nth) => (
            nth,
            "it joins several cables and does not note when frames come by, so that the clocks of the \
             drives behind it cannot be set: put the drives before it",
        ),
    };
    BusError::Unfit {
        device: nth,
        name: devices
            .get(nth)
            .map(|device| device.name.clone())
            .unwrap_or_default(),
        what: what.to_owned(),
    }
}

/// The device whose clock is everybody's.
pub(super) fn reference(devices: &[Device]) -> Option<usize> {
    devices.iter().position(|device| device.clock.is_clock())
}

/// Distributes the time of the reference until all clocks agree. Returns that time, as it is then.
pub(super) fn settle<W: Wire>(
    bus: &mut Exchange<'_, W>,
    devices: &[Device],
    reference: usize,
) -> Result<BusTime, BusError> {
    let now_ns = bus.wire.now_ns();
    let until_ns = now_ns + PATIENCE_S * 1_000_000_000;
    // The clocks were set by that of the host, a moment ago.
    let kind = devices.get(reference).map(|device| device.clock);
    let mut time = BusTime::new(kind.unwrap_or_default(), now_ns);
    loop {
        for _ in 0..ROUND {
            let mut bytes = [0; 8];
            let address = Address::station(station(reference), SYSTEM_TIME);
            bus.one(Command::Frmw, address, &mut bytes, reference, ACTION)?;
            time.hear(bytes);
            let next_ns = bus.wire.now_ns() + POLL_NS;
            bus.wire.sleep_until(next_ns);
        }
        let mut worst_ns = 0;
        let followers = devices.iter().filter(|device| device.clock.is_clock());
        for device in followers.filter(|device| device.position != reference) {
            let bytes = bus.read(device.position, TIME_DIFFERENCE, ACTION)?;
            // Sign and magnitude.
            worst_ns = worst_ns.max(u32::from_le_bytes(bytes) & 0x7fff_ffff);
        }
        if worst_ns < NEAR_NS {
            return Ok(time);
        }
        if bus.wire.now_ns() > until_ns {
            return Err(BusError::Clocks {
                worst_ns,
                waited_s: PATIENCE_S,
            });
        }
    }
}

/// Starts SYNC0 of these devices; returns when the first one is, by the time of the bus.
pub(super) fn start_sync<W: Wire>(
    bus: &mut Exchange<'_, W>,
    devices: &[&Device],
    bus_time_ns: u64,
    period_ns: u64,
) -> Result<u64, BusError> {
    // Activating takes a few frames for each drive.
    let ahead_ns = START_NS + 20_000_000 * devices.len() as u64;
    let start_ns = (bus_time_ns + ahead_ns).next_multiple_of(period_ns.max(1));
    let cycle = u32::try_from(period_ns).unwrap_or(u32::MAX);
    for device in devices {
        let nth = device.position;
        bus.write(nth, SYNC_ACTIVATION, &[0], ACTION)?;
        write_time(bus, device, SYNC_START, start_ns)?;
        bus.write(nth, SYNC0_CYCLE, &cycle.to_le_bytes(), ACTION)?;
        bus.write(nth, SYNC_ACTIVATION, &[3], ACTION)?;
    }
    Ok(start_ns)
}
