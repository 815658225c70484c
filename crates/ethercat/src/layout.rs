//! Where each object is in the process data of a drive.

use crate::device::Device;
use crate::entry::{Entry, bits};
use crate::probe::TouchProbe;
use crate::settings::DriveSettings;
use crate::turns::Round;

const CONTROL: Wanted = Wanted(0x6040, 16, "0x6040 (controlword)");
const TARGET: Wanted = Wanted(0x607a, 32, "0x607A (target position)");
const MODE: Wanted = Wanted(0x6060, 8, "0x6060 (mode)");
const STATUS: Wanted = Wanted(0x6041, 16, "0x6041 (statusword)");
const ACTUAL: Wanted = Wanted(0x6064, 32, "0x6064 (actual position)");
const SHOWN_MODE: Wanted = Wanted(0x6061, 8, "0x6061 (mode in force)");
const FAULT: Wanted = Wanted(0x603f, 16, "0x603F (error code)");

const VELOCITY_OFFSET: Wanted = Wanted(0x60b1, 32, "0x60B1 (velocity offset)");
const TORQUE_OFFSET: Wanted = Wanted(0x60b2, 16, "0x60B2 (torque offset)");
const DIGITAL: Wanted = Wanted(0x60fd, 32, "0x60FD (digital inputs)");
const PROBE_FUNCTION: Wanted = Wanted(0x60b8, 16, "0x60B8 (touch probe)");
const PROBE_STATUS: Wanted = Wanted(0x60b9, 16, "0x60B9 (touch probe status)");

/// An object: index, bits, and what it is called.
#[derive(Debug, Clone, Copy)]
struct Wanted(u16, u32, &'static str);

/// What is mapped in one way, as an axis sees it: `own` is where it has an object.
#[derive(Clone, Copy)]
struct Mapped<'e> {
    entries: &'e [Entry],
    own: &'e dyn Fn(u16) -> u16,
}

impl Mapped<'_> {
    /// Where an object begins, bytes; `None` if it is not mapped, with another size, or inside a byte.
    fn place(self, wanted: Wanted) -> Option<usize> {
        let own = (self.own)(wanted.0);
        let nth = self
            .entries
            .iter()
            .position(|entry| (entry.index, entry.sub, entry.bits) == (own, 0, wanted.1))?;
        let bits = bits(&self.entries[..nth]);
        bits.is_multiple_of(8).then_some(bits as usize / 8)
    }

    fn place_or_name(self, wanted: Wanted) -> Result<usize, &'static str> {
        self.place(wanted).ok_or(wanted.2)
    }
}

/// The layout of the process data of an axis, in that of its device.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Layout {
    pub(crate) control: usize,
    pub(crate) target: usize,
    /// Where the mode is; `None` if it is not mapped, and was set as a parameter.
    pub(crate) mode: Option<usize>,
    /// Where what is told beside the target is; `None` if it is not to be told.
    pub(crate) velocity_offset: Option<usize>,
    pub(crate) torque_offset: Option<usize>,
    pub(crate) status: usize,
    pub(crate) actual: usize,
    pub(crate) shown_mode: Option<usize>,
    pub(crate) fault: Option<usize>,
    pub(crate) digital: Option<usize>,
    /// The range of its counter, if that goes round.
    pub(crate) round: Option<Round>,
    /// Its touch probe, if it has one that is used.
    pub(crate) probe: Option<ProbeAccess>,
}

/// The touch probe of an axis: where its objects are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ProbeAccess {
    pub(crate) probe: TouchProbe,
    /// Which axis of its device it is.
    pub(crate) axis: u16,
    /// 0x60B8 as it was.
    pub(crate) before: u16,
    /// Where 0x60B8 is in the process data, bytes; `None` if it is written by the mailbox.
    pub(crate) function: Option<usize>,
    /// Where what it answers is; `None` if it is asked by the mailbox.
    pub(crate) places: Option<ProbePlaces>,
}

/// The places of what a touch probe answers, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ProbePlaces {
    pub(crate) status: usize,
    pub(crate) kept: [usize; 2],
}

impl ProbeAccess {
    /// The same where it is in the process data, as far as it is mapped.
    pub(crate) fn find(
        mut self,
        (outputs, inputs): (&[Entry], &[Entry]),
        own: &dyn Fn(u16) -> u16,
    ) -> Self {
        let mapped = |entries| Mapped { entries, own };
        let (outputs, inputs) = (mapped(outputs), mapped(inputs));
        let kept = self
            .probe
            .places()
            .map(|index| inputs.place(Wanted(index, 32, "what it keeps")));
        let places = (inputs.place(PROBE_STATUS), kept);
        self.function = outputs.place(PROBE_FUNCTION);
        self.places = match places {
            (Some(status), [Some(rising), Some(falling)]) => Some(ProbePlaces {
                status,
                kept: [rising, falling],
            }),
            _ => None,
        };
        self
    }
}

/// What has to be mapped of a drive beside what every one needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Needs {
    /// The mode has to be switched and seen.
    pub(crate) switches_mode: bool,
    /// Its digital inputs are read.
    pub(crate) has_inputs: bool,
    /// The velocity and the torque of the motion are told.
    pub(crate) offsets: [bool; 2],
}

impl Needs {
    pub(crate) fn of(drive: &DriveSettings) -> Self {
        Self {
            switches_mode: drive.homing.is_some(),
            has_inputs: drive.has_inputs,
            offsets: drive.feed_forward.map_or([false; 2], |told| {
                [told.velocity_units.is_some(), told.torque.is_some()]
            }),
        }
    }
}

impl Layout {
    /// The layout of what is mapped, or the object that is missing or not where a byte begins. `own`
    /// is where the axis has an object.
    pub(crate) fn of(
        outputs: &[Entry],
        inputs: &[Entry],
        own: &dyn Fn(u16) -> u16,
        needs: Needs,
    ) -> Result<Self, &'static str> {
        let mapped = |entries| Mapped { entries, own };
        let (outputs, inputs) = (mapped(outputs), mapped(inputs));
        if needs.switches_mode {
            outputs.place_or_name(MODE)?;
            inputs.place_or_name(SHOWN_MODE)?;
        }
        if needs.has_inputs {
            inputs.place_or_name(DIGITAL)?;
        }
        let [velocity_offset, torque_offset] = needs.offsets;
        let offset =
            |is_needed: bool, wanted| is_needed.then(|| outputs.place_or_name(wanted)).transpose();
        Ok(Self {
            velocity_offset: offset(velocity_offset, VELOCITY_OFFSET)?,
            torque_offset: offset(torque_offset, TORQUE_OFFSET)?,
            control: outputs.place_or_name(CONTROL)?,
            target: outputs.place_or_name(TARGET)?,
            mode: outputs.place(MODE),
            status: inputs.place_or_name(STATUS)?,
            actual: inputs.place_or_name(ACTUAL)?,
            shown_mode: inputs.place(SHOWN_MODE),
            fault: inputs.place(FAULT),
            digital: inputs.place(DIGITAL),
            round: None,
            probe: None,
        })
    }
}

/// A device with one or several drives, in the image of all: the outputs of all devices, then the
/// inputs of all.
#[derive(Debug, Clone)]
pub(crate) struct DriveDevice {
    pub(crate) device: Device,
    /// What is sent in every cycle beside what is led: 0, or what the device has.
    pub(crate) rest: Vec<u8>,
    /// Bytes of the inputs.
    pub(crate) input_bytes: usize,
    /// Where its outputs are among those of all, bytes.
    pub(crate) outputs_at: usize,
    /// Where its inputs are among those of all, bytes.
    pub(crate) inputs_at: usize,
}

/// An axis of such a device: a drive, as the settings have it.
#[derive(Debug, Clone)]
pub(crate) struct LedAxis {
    /// Which device it is of.
    pub(crate) device: usize,
    pub(crate) layout: Layout,
}

/// All drives, in the order of the settings, and their devices.
#[derive(Debug, Clone, Default)]
pub(crate) struct Drives {
    pub(crate) devices: Vec<DriveDevice>,
    pub(crate) axes: Vec<LedAxis>,
}

impl Drives {
    /// Adds a device behind the others.
    pub(crate) fn add(&mut self, device: Device, rest: Vec<u8>, input_bytes: usize) {
        let (outputs_at, inputs_at) = self.sizes();
        self.devices.push(DriveDevice {
            device,
            rest,
            input_bytes,
            outputs_at,
            inputs_at,
        });
    }

    /// Bytes of the outputs and of the inputs of all.
    pub(crate) fn sizes(&self) -> (usize, usize) {
        let outputs = self.devices.iter().map(|device| device.rest.len()).sum();
        let inputs = self.devices.iter().map(|device| device.input_bytes).sum();
        (outputs, inputs)
    }

    /// The device of each axis.
    pub(crate) fn of_axes(&self) -> impl Iterator<Item = &Device> {
        let devices = &self.devices;
        self.axes
            .iter()
            .filter_map(|axis| devices.get(axis.device))
            .map(|device| &device.device)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::*;

    fn entries(entries: &[u32]) -> Vec<Entry> {
        entries.iter().copied().map(Entry::new).collect()
    }

    /// A device with one axis.
    const fn own(index: u16) -> u16 {
        index
    }

    #[test]
    fn an_axis_finds_its_own_objects() {
        let outputs = entries(&[0x6040_0010, 0x607a_0020, 0x6840_0010, 0x687a_0020]);
        let inputs = entries(&[0x6841_0010, 0x6864_0020, 0x6041_0010, 0x6064_0020]);
        let second = |index| index + 0x800;
        let layout = Layout::of(&outputs, &inputs, &second, Needs::default()).unwrap();
        let seen = (layout.control, layout.target, layout.status, layout.actual);
        assert_eq!(seen, (6, 8, 0, 2));
        assert!(outputs.iter().all(|entry| entry.is_led()));
        assert!(!inputs.iter().any(|entry| entry.is_led()));
    }

    #[test]
    fn objects_are_found_where_they_are_mapped() {
        // As an Omron G5 has it.
        let outputs = entries(&[0x6040_0010, 0x607a_0020, 0x60b8_0010, 0x60fe_0120]);
        let inputs = entries(&[0x603f_0010, 0x6041_0010, 0x6064_0020, 0x60fd_0020]);
        let layout = Layout::of(&outputs, &inputs, &own, Needs::default()).unwrap();
        assert_eq!((layout.control, layout.target, layout.mode), (0, 2, None));
        let seen = (layout.fault, layout.status, layout.actual);
        assert_eq!(seen, (Some(0), 2, 4));
        let switches_mode = Needs {
            switches_mode: true,
            ..Needs::default()
        };
        let has_inputs = Needs {
            has_inputs: true,
            ..Needs::default()
        };
        let refused = Layout::of(&outputs, &inputs, &own, switches_mode);
        assert_eq!(refused, Err("0x6060 (mode)"));
        assert_eq!(layout.digital, Some(8));
        let refused = Layout::of(&outputs, &inputs[..3], &own, has_inputs);
        assert_eq!(refused, Err("0x60FD (digital inputs)"));
    }

    #[test]
    fn offsets_are_found_where_they_are_to_be_told_alone() {
        let outputs = entries(&[0x6040_0010, 0x607a_0020, 0x60b1_0020, 0x60b2_0010]);
        let inputs = entries(&[0x6041_0010, 0x6064_0020]);
        let of = |outputs: &[Entry], offsets| {
            let needs = Needs {
                offsets,
                ..Needs::default()
            };
            let layout = Layout::of(outputs, &inputs, &own, needs)?;
            Ok::<_, &'static str>((layout.velocity_offset, layout.torque_offset))
        };
        assert_eq!(of(&outputs, [false, false]), Ok((None, None)));
        assert_eq!(of(&outputs, [true, false]), Ok((Some(6), None)));
        assert_eq!(of(&outputs, [true, true]), Ok((Some(6), Some(10))));
        let refused = of(&outputs[..3], [true, true]);
        assert_eq!(refused, Err("0x60B2 (torque offset)"));
    }

    #[test]
    fn what_is_inside_a_byte_or_of_another_size_does_not_count() {
        let outputs = entries(&[0x0000_0004, 0x6040_0010, 0x0000_0004, 0x607a_0020]);
        let inputs = entries(&[0x6041_0010, 0x6064_0010]);
        let refused = Layout::of(&outputs, &inputs, &own, Needs::default());
        assert_eq!(refused, Err("0x6040 (controlword)"));
        let refused = Layout::of(
            &entries(&[0x6040_0010, 0x607a_0020]),
            &inputs,
            &own,
            Needs::default(),
        );
        assert_eq!(refused, Err("0x6064 (actual position)"));
    }
}
