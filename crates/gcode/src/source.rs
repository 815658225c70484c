//! Lines of a program, read in constant memory.
//!
//! A line ends with LF, CR LF, or a CR by itself. A UTF-8 byte order mark at the very start is
//! dropped. Of a line longer than [`MAX_LINE_BYTES`] only that much is kept; the rest is skipped.

use std::io::BufRead;

use crate::diagnostic::{Code, Fault, Outcome, Span};

/// Longest line accepted, bytes without the line end.
pub const MAX_LINE_BYTES: usize = 64 * 1024;

const UTF8_MARK: &[u8] = &[0xef, 0xbb, 0xbf];
const UTF16_LE_MARK: &[u8] = &[0xff, 0xfe];
const UTF16_BE_MARK: &[u8] = &[0xfe, 0xff];

/// A program cut into lines.
#[derive(Debug)]
pub(crate) struct LineSource<R> {
    reader: R,
    text: Vec<u8>,
    number: u32,
    /// The last line ended with a CR: an LF that follows belongs to it.
    after_cr: bool,
}

impl<R: BufRead> LineSource<R> {
    pub(crate) const fn new(reader: R) -> Self {
        Self {
            reader,
            text: Vec::new(),
            number: 0,
            after_cr: false,
        }
    }

    /// Text of the line read last, without its end.
    pub(crate) fn text(&self) -> &[u8] {
        &self.text
    }

    /// Number of the line read last, from 1; 0 before the first.
    pub(crate) const fn number(&self) -> u32 {
        self.number
    }

    /// Reads the next line; false at the end of the input.
    pub(crate) fn advance(&mut self) -> Outcome<bool> {
        self.text.clear();
        let first = self.number == 0;
        let mut any = false;
        let mut excess = false;
        loop {
            let chunk = match self.reader.fill_buf() {
                Ok(chunk) => chunk,
                Err(e) if e.kind() == std::io::ErrorKind::Interrupted => continue,
                Err(error) => {
                    self.number = self.number.saturating_add(1);
                    return Err(read_failed(&error));
                }
            };
            if chunk.is_empty() {
                break;
            }
            if self.after_cr {
                self.after_cr = false;
                if chunk.first() == Some(&b'\n') {
                    self.reader.consume(1);
                    continue;
                }
            }
            any = true;
            let end = chunk.iter().position(|&b| b == b'\n' || b == b'\r');
            let part = chunk.get(..end.unwrap_or(chunk.len())).unwrap_or_default();
            let room = MAX_LINE_BYTES - self.text.len();
            excess |= part.len() > room;
            self.text
                .extend_from_slice(part.get(..room).unwrap_or(part));
            if let Some(end) = end {
                self.after_cr = chunk.get(end) == Some(&b'\r');
                self.reader.consume(end + 1);
                break;
            }
            let used = chunk.len();
            self.reader.consume(used);
        }
        if !any {
            return Ok(false);
        }
        self.number = self.number.saturating_add(1);
        if first {
            self.start_of_text()?;
        }
        if excess { Err(too_long()) } else { Ok(true) }
    }

    /// Drops a UTF-8 byte order mark; refuses UTF-16.
    fn start_of_text(&mut self) -> Outcome<()> {
        if self.text.starts_with(UTF8_MARK) {
            self.text.drain(..UTF8_MARK.len());
            return Ok(());
        }
        let marked = self.text.starts_with(UTF16_LE_MARK) || self.text.starts_with(UTF16_BE_MARK);
        let head = self.text.get(..2).unwrap_or_default();
        let unmarked = head.contains(&0) && head.iter().any(u8::is_ascii_graphic);
        if marked || unmarked {
            return Err(Fault::new(
                Code::WrongEncoding,
                Span::new(0, 2),
                "the file is UTF-16 text",
            )
            .because("a program is read as ASCII or UTF-8; here every second byte is no text")
            .help("save the file as plain text (ASCII or UTF-8)"));
        }
        Ok(())
    }
}

fn too_long() -> Box<Fault> {
    let span = Span::new(MAX_LINE_BYTES, MAX_LINE_BYTES + 1);
    let message = format!("the line is longer than {MAX_LINE_BYTES} bytes");
    Fault::new(Code::LineTooLong, span, message)
        .because("a line is one block, and a block has each word once")
        .help("split the line into blocks, or check that the file is a program")
}

fn read_failed(error: &std::io::Error) -> Box<Fault> {
    Fault::new(
        Code::ReadFailed,
        Span::default(),
        format!("cannot read the program: {error}"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{BufReader, Cursor};

    fn lines(bytes: &[u8], buffer: usize) -> Vec<Result<String, Code>> {
        let mut source = LineSource::new(BufReader::with_capacity(buffer, Cursor::new(bytes)));
        let mut all = Vec::new();
        loop {
            match source.advance() {
                Ok(true) => all.push(Ok(String::from_utf8_lossy(source.text()).into_owned())),
                Ok(false) => return all,
                Err(fault) => all.push(Err(fault.code)),
            }
        }
    }

    #[test]
    fn every_line_end_counts_once_at_any_buffer_size() {
        for buffer in 1..9 {
            let found = lines(b"a\r\nb\nc\rd\r\r\n\ne", buffer);
            let expected = ["a", "b", "c", "d", "", "", "e"];
            assert_eq!(
                found,
                expected.map(|s| Ok(s.to_owned())),
                "buffer of {buffer}"
            );
        }
    }

    #[test]
    fn a_final_line_end_makes_no_extra_line() {
        assert_eq!(lines(b"a\n", 4).len(), 1);
        assert_eq!(lines(b"a\r\n", 2).len(), 1);
        assert_eq!(lines(b"", 2).len(), 0);
    }

    #[test]
    fn drops_a_byte_order_mark_and_refuses_utf16() {
        assert_eq!(lines(b"\xef\xbb\xbfG0\n", 2), [Ok("G0".to_owned())]);
        assert_eq!(lines(b"\xff\xfeG\0", 8), [Err(Code::WrongEncoding)]);
        assert_eq!(lines(b"\0G\x001", 8), [Err(Code::WrongEncoding)]);
    }

    #[test]
    fn keeps_a_bounded_part_of_a_long_line() {
        let mut bytes = vec![b'x'; 3 * MAX_LINE_BYTES];
        bytes.extend_from_slice(b"\nok\n");
        let mut source = LineSource::new(Cursor::new(bytes));
        assert!(source.advance().is_err_and(|f| f.code == Code::LineTooLong));
        assert_eq!(source.text().len(), MAX_LINE_BYTES);
        assert_eq!(source.advance(), Ok(true));
        assert_eq!((source.text(), source.number()), (b"ok".as_slice(), 2));
    }

    #[test]
    fn a_line_of_the_largest_length_passes() {
        let bytes = vec![b' '; MAX_LINE_BYTES];
        assert_eq!(lines(&bytes, 100).len(), 1);
        assert!(lines(&bytes, 100)[0].is_ok());
    }
}
