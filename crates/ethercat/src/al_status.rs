//! AL status codes in words (ETG.1020, table of AL status codes).

/// What a code means, and where to look.
#[must_use]
pub fn text(code: u16) -> String {
    let words = match code {
        0x0000 => "it says no reason; look at its display",
        0x0001 => "unspecified error",
        0x0011 => "invalid change of state",
        0x0012 => "unknown state",
        0x0014 => "no valid firmware",
        0x0016 => "invalid mailbox configuration",
        0x0017 => "invalid configuration of the sync managers",
        0x0018 => "no valid inputs",
        0x0019 => "no valid outputs",
        0x001a => "synchronisation error: setpoints do not come in time with SYNC0",
        0x001b => "watchdog: no outputs came for too long; a cable, or the host was busy",
        0x001d => "invalid output configuration: the drive wants other objects mapped",
        0x001e => "invalid input configuration: the drive wants other objects mapped",
        0x0024 => "invalid input mapping",
        0x0025 => "invalid output mapping",
        0x002c => "fatal synchronisation error: SYNC0 was lost",
        0x002d => "no SYNC signal was received",
        0x0030 => "invalid DC SYNC configuration: the drive wants another cycle time",
        0x0032 => "PLL error: the drive cannot lock to SYNC0; try a longer bus period",
        0x0035 => "invalid SYNC cycle time: try a bus period of 1, 2 or 4 ms",
        0x0036 => "invalid SYNC0 cycle time",
        _ => "see the drive's manual",
    };
    format!("AL status {code:#06x}, {words}")
}
