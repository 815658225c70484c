//! The words of `drives.toml`: objects, and what outputs obey.

use glidepath_ethercat::{MOST_GEARS, Quantity, Signal};

/// Outputs of programs of each kind.
const OUTPUTS: u32 = 64;
/// What can be given.
pub(super) const SIGNALS: &str = "give \"output 0\" to \"output 63\", \"spindle.on\", \"spindle.forward\", \
                       \"spindle.reverse\", \"spindle.orient\", \"spindle.gear 1\" to \"spindle.gear 5\", \
                       \"coolant.mist\" or \"coolant.flood\"";
pub(super) const QUANTITIES: &str =
    "give \"analog 0\" to \"analog 63\", \"spindle.speed\" or \"spindle.velocity\"";
pub(super) const OBJECT: &str =
    "give index and subindex, both hexadecimal as in manuals: \"0x6000:01\"";

/// An object as manuals write it: index and subindex, both hexadecimal.
pub(super) fn object(text: &str) -> Option<(u16, u8)> {
    let (index, sub) = text.split_once(':')?;
    let index = index
        .strip_prefix("0x")
        .or_else(|| index.strip_prefix("0X"))?;
    let is_hex = |text: &str| text.bytes().all(|byte| byte.is_ascii_hexdigit());
    if !(is_hex(index) && is_hex(sub)) {
        return None;
    }
    Some((
        u16::from_str_radix(index, 16).ok()?,
        u8::from_str_radix(sub, 16).ok()?,
    ))
}

/// The number behind a word.
fn numbered(text: &str, word: &str) -> Option<u32> {
    let number = text.strip_prefix(word)?.strip_prefix(' ')?;
    let is_plain = number.bytes().all(|byte| byte.is_ascii_digit());
    let number = number.parse().ok().filter(|_| is_plain)?;
    (number < OUTPUTS).then_some(number)
}

pub(super) fn signal(text: &str) -> Option<Signal> {
    Some(match text {
        "spindle.on" => Signal::SpindleOn,
        "spindle.forward" => Signal::SpindleForward,
        "spindle.reverse" => Signal::SpindleReverse,
        "spindle.orient" => Signal::SpindleOrient,
        "coolant.mist" => Signal::Mist,
        "coolant.flood" => Signal::Flood,
        text => match numbered(text, "spindle.gear") {
            Some(gear) if gear == 0 || gear as usize > MOST_GEARS => return None,
            Some(gear) => Signal::SpindleGear(gear),
            None => Signal::Output(numbered(text, "output")?),
        },
    })
}

pub(super) fn quantity(text: &str) -> Option<Quantity> {
    Some(match text {
        "spindle.speed" => Quantity::SpindleSpeed,
        "spindle.velocity" => Quantity::SpindleVelocity,
        text => Quantity::Output(numbered(text, "analog")?),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_are_hexadecimal_as_in_manuals() {
        assert_eq!(object("0x6000:11"), Some((0x6000, 0x11)));
        assert_eq!(object("0X60FE:1"), Some((0x60fe, 1)));
        for wrong in [
            "6000:01",
            "0x6000",
            "0x6000:100",
            "0x16000:1",
            "0x60 0:1",
            "0x:",
            "0x6000:+1",
        ] {
            assert_eq!(object(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn outputs_of_programs_have_numbers() {
        assert_eq!(signal("output 63"), Some(Signal::Output(63)));
        assert_eq!(signal("spindle.gear 5"), Some(Signal::SpindleGear(5)));
        assert_eq!(quantity("analog 0"), Some(Quantity::Output(0)));
        for wrong in [
            "output 64",
            "spindle.gear 0",
            "spindle.gear 6",
            "output",
            "output -1",
            "output +1",
            "output  1",
            "analog 1",
        ] {
            assert_eq!(signal(wrong), None, "{wrong}");
        }
        assert_eq!(quantity("spindle.on"), None);
    }
}
