//! Protocol Buffers on the wire, as far as records of numbers need them.
//!
//! Source: "Protocol Buffers: Encoding", <https://protobuf.dev/programming-guides/encoding/>.

/// Bytes that are no message.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a message is broken")]
pub struct Malformed;

/// A field as it is on the wire.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Wire<'a> {
    Varint(u64),
    Fixed64([u8; 8]),
    Bytes(&'a [u8]),
    Fixed32,
}

const VARINT: u32 = 0;
const FIXED64: u32 = 1;
const BYTES: u32 = 2;
const FIXED32: u32 = 5;

#[allow(clippy::cast_possible_truncation, reason = "seven bits at a time")]
pub(crate) fn varint(mut value: u64, out: &mut Vec<u8>) {
    while value >= 0x80 {
        out.push(value as u8 | 0x80);
        value >>= 7;
    }
    out.push(value as u8);
}

fn key(number: u32, wire: u32, out: &mut Vec<u8>) {
    varint(u64::from(number << 3 | wire), out);
}

pub(crate) fn put_varint(number: u32, value: u64, out: &mut Vec<u8>) {
    key(number, VARINT, out);
    varint(value, out);
}

pub(crate) fn put_fixed64(number: u32, value: [u8; 8], out: &mut Vec<u8>) {
    key(number, FIXED64, out);
    out.extend_from_slice(&value);
}

pub(crate) fn put_bytes(number: u32, value: &[u8], out: &mut Vec<u8>) {
    key(number, BYTES, out);
    varint(value.len() as u64, out);
    out.extend_from_slice(value);
}

/// The fields of a message.
pub(crate) struct Fields<'a>(pub(crate) &'a [u8]);

impl<'a> Fields<'a> {
    /// The next field and its number; `None` at the end.
    pub(crate) fn next(&mut self) -> Result<Option<(u32, Wire<'a>)>, Malformed> {
        if self.0.is_empty() {
            return Ok(None);
        }
        let key = u32::try_from(self.varint()?).map_err(|_| Malformed)?;
        let wire = match key & 7 {
            VARINT => Wire::Varint(self.varint()?),
            FIXED64 => {
                let bytes = self.take(8)?;
                Wire::Fixed64(bytes.try_into().map_err(|_| Malformed)?)
            }
            BYTES => {
                let length = usize::try_from(self.varint()?).map_err(|_| Malformed)?;
                Wire::Bytes(self.take(length)?)
            }
            FIXED32 => {
                self.take(4)?;
                Wire::Fixed32
            }
            _ => return Err(Malformed),
        };
        Ok(Some((key >> 3, wire)))
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], Malformed> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(Malformed)?;
        self.0 = rest;
        Ok(taken)
    }

    fn varint(&mut self) -> Result<u64, Malformed> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let (first, rest) = self.0.split_first().ok_or(Malformed)?;
            self.0 = rest;
            value |= u64::from(first & 0x7f) << shift;
            if *first < 0x80 {
                return Ok(value);
            }
        }
        Err(Malformed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_read_as_they_were_written() {
        let mut out = Vec::new();
        put_varint(1, 300, &mut out);
        assert_eq!(out, [8, 0xac, 2], "the example of the specification");
        put_fixed64(200, 1.5_f64.to_le_bytes(), &mut out);
        put_bytes(3, b"text", &mut out);
        put_varint(4, u64::MAX, &mut out);
        let mut fields = Fields(&out);
        let expected = [
            (1, Wire::Varint(300)),
            (200, Wire::Fixed64(1.5_f64.to_le_bytes())),
            (3, Wire::Bytes(b"text")),
            (4, Wire::Varint(u64::MAX)),
        ];
        for field in expected {
            assert_eq!(fields.next(), Ok(Some(field)));
        }
        assert_eq!(fields.next(), Ok(None));
        for end in 1..out.len() {
            // Cut anywhere, it is no longer whole, but between two fields.
            let mut fields = Fields(&out[..end]);
            let read = core::iter::from_fn(|| fields.next().transpose());
            let whole: Vec<_> = read.map_while(Result::ok).collect();
            assert_eq!(whole, expected[..whole.len()]);
            assert!(whole.len() < expected.len());
        }
        assert_eq!(Fields(&[0xff; 11]).next(), Err(Malformed));
        assert_eq!(Fields(&[0x0b]).next(), Err(Malformed));
    }
}
