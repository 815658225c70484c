//! First lines for the touch probes of drives: comments, in the table of each drive that has one.
//!
//! All drives have a probe or none, and the probe is an input of the file, too: number 0, which the first digital
//! input of a terminal is given.

use super::found::{Found, FoundProbe};
use core::fmt::Write as _;

/// What is the same for all drives.
#[derive(Debug)]
pub(super) struct ProbeLines {
    /// The first joint whose drive has none.
    lacks: Option<usize>,
    /// The joint whose drive is to tell the input, where no terminal has one.
    tells_input: Option<usize>,
    has_terminal_input: bool,
}

impl ProbeLines {
    /// Those of what was found.
    pub(super) fn of(found: &[Found]) -> Self {
        let drives = found.iter().filter(|item| item.is_drive());
        let probe = |item: &Found, axis: u16| item.probes.get(usize::from(axis)).copied();
        let probes = drives.flat_map(|item| (0..item.axes).map(move |axis| probe(item, axis)));
        let probes: Vec<FoundProbe> = probes.map(Option::unwrap_or_default).collect();
        let is_input = |item: &&Found| !item.is_drive() && super::tables::has_input(&item.windows);
        let has_terminal_input = found.iter().any(|item| is_input(&item));
        let tells = probes.iter().position(|probe| probe.has_inputs);
        Self {
            lacks: probes.iter().position(|probe| unit(*probe).is_none()),
            tells_input: tells.filter(|_| !has_terminal_input),
            has_terminal_input,
        }
    }

    /// Adds those of a drive.
    pub(super) fn write(&self, text: &mut String, joint: usize, probe: FoundProbe) {
        let Some(unit) = unit(probe) else {
            return;
        };
        let _ = writeln!(
            text,
            "# For joints that [home.J{joint}] of the machine brings home with index = \"drive\" (the zero impulse of \
             its encoder):\n\
             # index = {unit}"
        );
        if let Some(lacks) = self.lacks {
            let _ = writeln!(
                text,
                "# It has a touch probe (0x60B8), which is of use if every drive has one: that of J{lacks} lacks the \
                 objects."
            );
            return;
        }
        let more = if unit == 1 { "" } else { ", unit = 2" };
        let source = if probe.has_sources {
            "; source = its input by the manual (0x60D0)"
        } else {
            ""
        };
        let _ = writeln!(
            text,
            "# Its touch probe (0x60B8), of all drives or of none; 0 is `input` of the machine's [probe], and of an \
             input below{source}:\n\
             # probe = {{ number = 0{more} }}"
        );
        if self.tells_input == Some(joint) {
            text.push_str(
                "# That input, if it is one of its own (0x60FD), with the bit that its manual says:\n\
                 # inputs = [{ bit = 16, number = 0 }]\n",
            );
        } else if self.tells_input.is_none() && !self.has_terminal_input && joint == 0 {
            text.push_str(
                "# No device that was found tells such an input, and the probe needs one.\n",
            );
        }
    }
}

/// The first unit that it has.
fn unit(probe: FoundProbe) -> Option<usize> {
    let nth = probe.units.iter().position(|has| *has)?;
    Some(nth + 1)
}
