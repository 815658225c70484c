//! The process data of a drive in the memory of its device.

use crate::dictionary::{
    AxisObjects, DIGITAL_INPUTS, Dictionary, MODE, Mapped, OBJECT_STEP, Object, PROBE_FUNCTION, own,
};
use crate::drive_io::{Inputs, Outputs};
use crate::memory::Memory;
use crate::position_loop::OffsetAccess;
use crate::touch_probe::TouchProbe;

/// What the master has written for an axis; what is no demand goes to the objects.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "objects have the size of their type"
)]
pub(crate) fn outputs(
    memory: &Memory,
    mapped: &[Mapped],
    objects: &mut Dictionary,
    axis: u16,
) -> Outputs {
    let start = memory.sync_manager(2).start;
    // What was written as a parameter, unless it is mapped.
    let own_objects = AxisObjects { all: objects, axis };
    let mut outputs = Outputs {
        mode: own_objects.value(MODE) as u8 as i8,
        probe: own_objects.value(PROBE_FUNCTION) as u16,
        ..Outputs::default()
    };
    for object in mapped {
        let value = memory.number(start + object.offset, object.length.into());
        match own(object.index) {
            (of, 0x6040) if of == axis => outputs.control = value as u16,
            (of, 0x607a) if of == axis => outputs.target = value as u32 as i32,
            (of, 0x6060) if of == axis => outputs.mode = value as u8 as i8,
            (of, 0x60ff) if of == axis => outputs.velocity = value as u32 as i32,
            (of, 0x6042) if of == axis => outputs.speed_rpm = value as u16 as i16,
            (of, 0x60b1) if of == axis => outputs.velocity_offset = value as u32 as i32,
            (of, 0x60b2) if of == axis => outputs.torque_offset = value as u16 as i16,
            (of, 0x60b8) if of == axis => outputs.probe = value as u16,
            (_, 0x6040 | 0x607a | 0x6060 | 0x60ff | 0x6042 | 0x60b1 | 0x60b2 | 0x60b8) => {}
            _ => objects.set((object.index, object.sub), value as u32),
        }
    }
    outputs
}

/// What the master will read of an axis.
pub(crate) fn put_inputs(memory: &mut Memory, mapped: &[Mapped], inputs: Inputs, axis: u16) {
    let start = memory.sync_manager(3).start;
    for object in mapped {
        let at = start + object.offset;
        let (of, index) = own(object.index);
        match index {
            _ if of != axis => {}
            0x6041 => memory.put(at, &inputs.status.to_le_bytes()),
            0x6064 => memory.put(at, &inputs.actual.to_le_bytes()),
            0x6061 => memory.put(at, &inputs.mode.to_le_bytes()),
            0x603f => memory.put(at, &inputs.fault.to_le_bytes()),
            0x606c => memory.put(at, &inputs.velocity.to_le_bytes()),
            0x6044 => memory.put(at, &inputs.speed_rpm.to_le_bytes()),
            0x6077 => memory.put(at, &inputs.torque.to_le_bytes()),
            0x60fd => memory.put(at, &inputs.digital.to_le_bytes()),
            0x60b9 => memory.put(at, &inputs.probe.0.to_le_bytes()),
            0x60ba..=0x60bd => {
                let nth = usize::from(index - 0x60ba);
                memory.put(at, &inputs.probe.1[nth / 2][nth % 2].to_le_bytes());
            }
            _ => {}
        }
    }
}

/// Whether an entry of a map is no object of a touch probe and no offset, or one that can be mapped.
pub(crate) fn is_mappable(
    (probe, offsets): (Option<TouchProbe>, OffsetAccess),
    entry: u32,
) -> bool {
    let (_, index) = own(u16::try_from(entry >> 16).unwrap_or(0));
    let is_of_probe = matches!(index, 0x60b8..=0x60bd);
    let is_offset = matches!(index, 0x60b1 | 0x60b2);
    if is_offset {
        return offsets == OffsetAccess::Mapped;
    }
    !is_of_probe || probe.is_some_and(|probe| probe.is_mappable)
}

/// Whether a touch probe does not take what an object is to be.
pub(crate) fn is_refused(probe: Option<TouchProbe>, object: Object, value: u32) -> bool {
    let is_function = (own(object.0).1, object.1) == PROBE_FUNCTION;
    is_function && probe.is_some_and(|probe| probe.refuses(value))
}

/// What the touch probe and the inputs of an axis have come to, as objects.
#[allow(clippy::cast_sign_loss, reason = "the bits of a number with a sign")]
pub(crate) fn put_objects(objects: &mut Dictionary, inputs: &Inputs, axis: u16) {
    let first = OBJECT_STEP * axis;
    let (status, places) = inputs.probe;
    objects.set((DIGITAL_INPUTS.0 + first, 0), inputs.digital);
    objects.set((0x60b9 + first, 0), status.into());
    for (index, place) in (0x60ba..).zip(places.as_flattened()) {
        objects.set((index + first, 0), *place as u32);
    }
}

/// A datagram of the logical address space passes: what its windows show is read and written.
/// `takes_outputs` if writing is allowed. Returns whether anything was read, and written.
pub(crate) fn exchange(
    memory: &mut Memory,
    at: u32,
    data: &mut [u8],
    (reads, writes): (bool, bool),
    takes_outputs: bool,
) -> (bool, bool) {
    let sent = data.to_vec();
    let (mut was_read, mut was_written) = (false, false);
    let windows: Vec<_> = memory.fmmus().collect();
    let end = at + u32::try_from(data.len()).unwrap_or(0);
    for window in windows {
        let low = at.max(window.logical);
        let high = end.min(window.logical + u32::from(window.length));
        if low >= high {
            continue;
        }
        let into = u16::try_from(low - window.logical).unwrap_or(u16::MAX);
        let physical = window.physical.saturating_add(into);
        let part = (low - at) as usize..(high - at) as usize;
        if writes && window.writes && takes_outputs {
            memory.put(physical, &sent[part.clone()]);
            was_written = true;
        }
        if reads
            && window.reads
            && let Some(bytes) = memory.get(physical, part.len())
        {
            data[part].copy_from_slice(bytes);
            was_read = true;
        }
    }
    (was_read, was_written)
}
