//! The intake of a sender's bytes, as lines and real-time characters.
//!
//! A line ends with LF, CR, or both. Real-time characters are taken out wherever they stand, also in comments:
//! a stop must not depend on a parenthesis. Other bytes above 0x7F are dropped (bCNC sends overrides as UTF-8,
//! 0xC2 before each), and so are telnet's negotiations.

use crate::real_time::RealTime;

/// Longest line, bytes without its end.
pub(crate) const MOST_LINE: usize = 256;

/// Telnet: what follows is a command.
const IAC: u8 = 0xff;

/// A line or a real-time character that was heard.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Heard {
    RealTime(RealTime),
    Line(Line),
}

/// A whole line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Line {
    pub(crate) text: String,
    /// What of the sender's room it takes, bytes, with one for its end.
    pub(crate) bytes: usize,
    pub(crate) is_too_long: bool,
    /// When it was sent at the earliest, ns of the clock of [`Session::ask_at`](crate::Session::ask_at).
    pub(crate) asked_ns: u64,
    /// Its reader stood still before it was heard.
    pub(crate) is_late: bool,
    /// It is a question that was answered before its turn, but for its `ok`.
    pub(crate) is_told: bool,
}

/// Where telnet is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Telnet {
    #[default]
    Nothing,
    Command,
    Option,
}

/// Takes bytes one at a time.
#[derive(Debug, Default)]
pub(crate) struct Intake {
    text: Vec<u8>,
    bytes: usize,
    after_cr: bool,
    telnet: Telnet,
}

impl Intake {
    /// What comes of one more byte.
    pub(crate) fn take(&mut self, byte: u8) -> Option<Heard> {
        match core::mem::take(&mut self.telnet) {
            Telnet::Command if (251..=254).contains(&byte) => {
                self.telnet = Telnet::Option;
                return None;
            }
            Telnet::Option => return None,
            Telnet::Command | Telnet::Nothing => {}
        }
        if byte == IAC {
            self.telnet = Telnet::Command;
            return None;
        }
        if let Some(real_time) = RealTime::of(byte) {
            return Some(Heard::RealTime(real_time));
        }
        let after_cr = core::mem::take(&mut self.after_cr);
        match byte {
            b'\n' if after_cr => None,
            b'\n' | b'\r' => {
                self.after_cr = byte == b'\r';
                Some(Heard::Line(self.end_line()))
            }
            0x80.. => None,
            _ => {
                self.bytes += 1;
                if self.text.len() <= MOST_LINE {
                    self.text.push(byte);
                }
                None
            }
        }
    }

    fn end_line(&mut self) -> Line {
        let text = core::mem::take(&mut self.text);
        let bytes = core::mem::take(&mut self.bytes);
        Line {
            is_too_long: text.len() > MOST_LINE,
            text: String::from_utf8(text).unwrap_or_default(),
            bytes: bytes + 1,
            asked_ns: 0,
            is_late: false,
            is_told: false,
        }
    }

    /// Bytes of the line that has not ended; of one that is too long no more than are kept.
    pub(crate) fn open_bytes(&self) -> usize {
        self.text.len()
    }

    /// Forgets the line that has not ended. What follows a CR still belongs to it.
    pub(crate) fn drop_open_line(&mut self) {
        self.text.clear();
        self.bytes = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::real_time::Change;

    fn heard(bytes: &[u8]) -> Vec<Heard> {
        let mut intake = Intake::default();
        bytes.iter().filter_map(|byte| intake.take(*byte)).collect()
    }

    fn lines(bytes: &[u8]) -> Vec<String> {
        let line = |heard| match heard {
            Heard::Line(line) => Some(line.text),
            Heard::RealTime(_) => None,
        };
        heard(bytes).into_iter().filter_map(line).collect()
    }

    #[test]
    fn lf_cr_and_both_end_one_line() {
        assert_eq!(lines(b"a\nb\rc\r\nd\n\n\r\n"), ["a", "b", "c", "d", "", ""]);
    }

    #[test]
    fn real_time_characters_leave_the_stream_also_in_comments() {
        let found = heard(b"G1(st?op!)X\x181\n");
        let real_time = |heard: &Heard| matches!(heard, Heard::RealTime(_));
        assert_eq!(found.iter().filter(|heard| real_time(heard)).count(), 3);
        assert_eq!(lines(b"G1(st?op!)X\x181\n"), ["G1(stop)X1"]);
    }

    #[test]
    fn bytes_of_utf8_and_telnet_are_dropped() {
        let found = heard(b"\xc2\x91\xff\xfb\x18\xff!");
        assert_eq!(
            found,
            [
                Heard::RealTime(RealTime::Feed(Change::By(10))),
                Heard::RealTime(RealTime::Hold)
            ]
        );
    }

    #[test]
    fn a_line_without_end_is_kept_in_bounds_and_told() {
        let mut intake = Intake::default();
        for _ in 0..100_000 {
            assert_eq!(intake.take(b'x'), None);
        }
        assert!(intake.open_bytes() <= MOST_LINE + 1);
        let Some(Heard::Line(line)) = intake.take(b'\n') else {
            panic!("no line");
        };
        assert!(line.is_too_long && line.bytes == 100_001);
        let longest = [b'x'; MOST_LINE];
        let found = heard(&[&longest[..], b"\n"].concat());
        assert!(matches!(&found[..], [Heard::Line(line)] if !line.is_too_long));
    }
}
