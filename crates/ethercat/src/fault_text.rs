//! Error codes of drives in words (IEC 61800-7-201, error codes of 0x603F).

/// What a code means. Manufacturers use the groups of the standard, and numbers of their own in
/// them.
#[must_use]
pub fn text(code: u16) -> String {
    let words = match code {
        0x2310..=0x231f => "continuous over-current",
        0x2320..=0x233f => "short circuit or earth leakage",
        0x3130..=0x313f => "a mains phase is missing",
        0x3210..=0x321f => "DC link over-voltage: a braking resistor is missing or too small",
        0x3220..=0x322f => "DC link under-voltage: is the main supply on?",
        0x4210 | 0x4310 => "over-temperature of the drive",
        0x5112..=0x5114 => "control supply is too low",
        0x5441 | 0x5442 => "a safety input (STO) is open",
        0x6320 => "a parameter is wrong",
        0x7121 => "the motor is blocked",
        0x7305..=0x7307 => "encoder error",
        0x7122 | 0x7300..=0x730f => "sensor error",
        0x7380..=0x738f => "encoder error: its battery, its cable",
        0x7500..=0x750f => "communication error: the bus was lost",
        0x8100..=0x81ff => "communication error",
        0x8611 => "following error: blocked, too heavy, or the window is too small",
        0x8612 => "reference limit: a software limit of the drive",
        0x8700..=0x870f => "synchronisation error: setpoints did not come in time with SYNC0",
        _ => match code >> 12 {
            0x2 => "current",
            0x3 => "voltage",
            0x4 => "temperature",
            0x5 => "hardware of the drive",
            0x6 => "software of the drive",
            0x7 => "a module beside the drive",
            0x8 => "monitoring",
            _ => "see the drive's manual",
        },
    };
    format!("{code:#06x}, {words}")
}
