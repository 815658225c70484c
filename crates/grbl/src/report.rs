//! The status report, and when it has the fields that it does not always have.

use std::fmt::Write as _;

use crate::numbers::{Units, plain};
use crate::state::State;
use crate::{AXES, MachineView, Spindle};

/// Blocks of the planner that senders are told of.
pub(crate) const BLOCKS: u32 = 15;

/// Bits of `$10`: machine coordinates, and the room for lines.
pub(crate) const MACHINE_POSITION: u32 = 1;
pub(crate) const BUFFER: u32 = 2;

/// What a report tells beside the machine.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beside<'a> {
    pub(crate) state: State,
    pub(crate) axes: &'a [usize],
    pub(crate) units: Units,
    /// `$10`.
    pub(crate) mask: u32,
    pub(crate) free_blocks: u32,
    pub(crate) free_bytes: usize,
    /// 0 for none.
    pub(crate) line: u64,
    pub(crate) overrides: [i32; 3],
    /// With every field.
    pub(crate) is_full: bool,
}

/// Writes reports, and remembers what the last ones had.
#[derive(Debug, Default)]
pub(crate) struct Reporter {
    /// Reports until the zero is told again.
    zero_in: u32,
    overrides_in: u32,
    told_zero: Option<[f64; AXES]>,
    told: Option<([i32; 3], Spindle, bool, bool)>,
}

impl Reporter {
    /// The zero comes in the next report, overrides behind it.
    pub(crate) fn begin_anew(&mut self) {
        *self = Self::default();
    }

    pub(crate) fn report(&mut self, machine: &MachineView, beside: &Beside<'_>) -> String {
        let units = beside.units;
        let mut text = format!("<{}", beside.state);
        let shown = if beside.mask & MACHINE_POSITION == 0 {
            let mut shown = machine.position;
            for (place, zero) in shown.iter_mut().zip(&machine.zero) {
                *place -= zero;
            }
            ("WPos", shown)
        } else {
            ("MPos", machine.position)
        };
        write_field(&mut text, shown.0, &units.vector(&shown.1, beside.axes));
        if beside.mask & BUFFER != 0 || beside.is_full {
            let room = format!("{},{}", beside.free_blocks, beside.free_bytes);
            write_field(&mut text, "Bf", &room);
        }
        if beside.line > 0 {
            write_field(&mut text, "Ln", &beside.line.to_string());
        }
        let feed = units.feed(machine.feed_v);
        let speed = plain(machine.spindle_rpm, 0);
        write_field(&mut text, "FS", &format!("{feed},{speed}"));
        if !machine.pins.is_empty() {
            write_field(&mut text, "Pn", &machine.pins);
        }
        let zero = units.vector(&machine.zero, beside.axes);
        let zero_is_due = self.zero_is_due(machine, beside.state);
        if zero_is_due || beside.is_full {
            write_field(&mut text, "WCO", &zero);
        }
        if (!zero_is_due && self.overrides_are_due(machine, beside)) || beside.is_full {
            let [feed, rapid, spindle] = beside.overrides;
            write_field(&mut text, "Ov", &format!("{feed},{rapid},{spindle}"));
            let accessories = accessories(machine);
            if !accessories.is_empty() {
                write_field(&mut text, "A", &accessories);
            }
        }
        text.push('>');
        text
    }

    fn zero_is_due(&mut self, machine: &MachineView, state: State) -> bool {
        let is_new = self.told_zero != Some(machine.zero);
        if !is_new && self.zero_in > 0 {
            self.zero_in -= 1;
            return false;
        }
        self.told_zero = Some(machine.zero);
        self.zero_in = if state.is_busy() { 29 } else { 9 };
        true
    }

    fn overrides_are_due(&mut self, machine: &MachineView, beside: &Beside<'_>) -> bool {
        let now = (
            beside.overrides,
            machine.spindle,
            machine.flood,
            machine.mist,
        );
        if self.told == Some(now) && self.overrides_in > 0 {
            self.overrides_in -= 1;
            return false;
        }
        self.told = Some(now);
        self.overrides_in = if beside.state.is_busy() { 19 } else { 9 };
        true
    }
}

fn write_field(text: &mut String, name: &str, value: &str) {
    // Writing to a string does not fail.
    let _written = write!(text, "|{name}:{value}");
}

fn accessories(machine: &MachineView) -> String {
    let turning = match machine.spindle {
        Spindle::Off => "",
        Spindle::Clockwise => "S",
        Spindle::Counterclockwise => "C",
    };
    let flood = if machine.flood { "F" } else { "" };
    let mist = if machine.mist { "M" } else { "" };
    format!("{turning}{flood}{mist}")
}

#[cfg(test)]
mod tests {
    use super::*;

    const BESIDE: Beside<'_> = Beside {
        state: State::Idle,
        axes: &[0, 1, 2],
        units: Units::Millimetre,
        mask: 3,
        free_blocks: 15,
        free_bytes: 128,
        line: 0,
        overrides: [100; 3],
        is_full: false,
    };

    #[test]
    fn the_zero_comes_first_and_when_it_changes_and_overrides_never_beside_it() {
        let mut reporter = Reporter::default();
        let mut machine = MachineView::default();
        let first = reporter.report(&machine, &BESIDE);
        assert_eq!(
            first,
            "<Idle|MPos:0.000,0.000,0.000|Bf:15,128|FS:0,0|WCO:0.000,0.000,0.000>"
        );
        let second = reporter.report(&machine, &BESIDE);
        assert!(second.ends_with("|Ov:100,100,100>"), "{second}");
        assert!(reporter.report(&machine, &BESIDE).ends_with("|FS:0,0>"));
        machine.zero[1] = 2.5;
        let moved = reporter.report(&machine, &BESIDE);
        assert!(moved.ends_with("|WCO:0.000,2.500,0.000>"), "{moved}");
        let turned = Beside {
            overrides: [110, 100, 100],
            ..BESIDE
        };
        let changed = reporter.report(&machine, &turned);
        assert!(changed.ends_with("|Ov:110,100,100>"), "{changed}");
        let reports: Vec<String> = (0..40)
            .map(|_| reporter.report(&machine, &turned))
            .collect();
        let with = |field: &str| reports.iter().filter(|it| it.contains(field)).count();
        assert!(with("WCO") >= 3 && with("Ov") >= 3, "{reports:?}");
        assert!(
            !reports
                .iter()
                .any(|it| it.contains("WCO") && it.contains("Ov"))
        );
    }

    #[test]
    fn work_positions_are_those_of_the_machine_less_the_zero() {
        let mut machine = MachineView::default();
        (machine.position[0], machine.zero[0]) = (25.4, 50.8);
        let inches = Beside {
            units: Units::Inch,
            mask: 0,
            ..BESIDE
        };
        let report = Reporter::default().report(&machine, &inches);
        assert!(report.starts_with("<Idle|WPos:-1.0000,0.0000,0.0000|FS:0,0|WCO:2.0000"));
    }
}
