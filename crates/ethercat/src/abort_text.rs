//! SDO abort codes in words.

/// What an abort code means (ETG.1000.6, table of SDO abort codes).
#[must_use]
pub fn text(code: u32) -> String {
    let words = match code {
        0x0503_0000 => "toggle bit not changed",
        0x0504_0000 => "time is out",
        0x0504_0001 => "unknown command",
        0x0601_0000 => "it cannot be accessed like that now",
        0x0601_0001 => "it cannot be read",
        0x0601_0002 => "it cannot be written",
        0x0602_0000 => "there is no such object",
        0x0604_0041 => "it cannot be mapped",
        0x0604_0042 => "more is mapped than fits",
        0x0607_0010 | 0x0607_0012 | 0x0607_0013 => "it has another length",
        0x0609_0011 => "there is no such subindex",
        0x0609_0030..=0x0609_0032 => "the value is out of range",
        0x0800_0020..=0x0800_0022 => "not in the present state",
        _ => "see the drive's manual",
    };
    format!("abort code {code:#010x}, {words}")
}
