//! Lines of a program, read in constant memory.
//!
//! A line ends with LF, CR LF, or a CR by itself. A UTF-8 byte order mark at the very start is
//! dropped. Of a line longer than [`MAX_LINE_BYTES`] only that much is kept; the rest is skipped, up
//! to [`MOST_SKIPPED`] bytes: what has no line end by then is no program.
//!
//! ```text
//!  buffer  …G1 X1.5␊G1 X1.6 Y2␊G1 X
//!                   └─ line ─┘ └ what follows: completed from the reader when it is wanted
//! ```

use std::io::{BufRead, ErrorKind};
use std::ops::Range;

use memchr::memchr2;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::foreign::foreign;

/// Longest line accepted, bytes without the line end.
pub const MAX_LINE_BYTES: usize = 64 * 1024;

/// Longest line whose end is looked for, bytes.
const MOST_SKIPPED: usize = 16 << 20;

/// Most bytes taken from the reader at a time.
const MOST_TAKEN: usize = 64 * 1024;

const UTF8_MARK: &[u8] = &[0xef, 0xbb, 0xbf];
const UTF16_LE_MARK: &[u8] = &[0xff, 0xfe];
const UTF16_BE_MARK: &[u8] = &[0xfe, 0xff];

/// A program cut into lines.
#[derive(Debug)]
pub(crate) struct LineSource<R> {
    reader: R,
    /// Text that was read, at most the longest line and what was taken after it.
    buffer: Vec<u8>,
    /// The line read last.
    line: Range<usize>,
    /// Where the next one starts.
    next: usize,
    number: u32,
    /// The last line ended with a CR, and nothing behind it was seen yet: an LF belongs to it.
    after_cr: bool,
}

impl<R: BufRead> LineSource<R> {
    pub(crate) const fn new(reader: R) -> Self {
        Self {
            reader,
            buffer: Vec::new(),
            line: 0..0,
            next: 0,
            number: 0,
            after_cr: false,
        }
    }

    /// Text of the line read last, without its end.
    pub(crate) fn text(&self) -> &[u8] {
        self.buffer.get(self.line.clone()).unwrap_or_default()
    }

    /// What follows the line read last, as far as it is in the buffer: with its end, a whole line
    /// may be passed.
    #[inline]
    pub(crate) fn ahead(&self) -> &[u8] {
        self.buffer.get(self.next..).unwrap_or_default()
    }

    /// True if the end of the next line, of that length, is [`LineSource::ahead`] with a byte
    /// behind it.
    #[inline]
    pub(crate) fn is_complete(&self, length: usize) -> bool {
        length <= MAX_LINE_BYTES && self.ahead().len() > length + 1
    }

    /// Reads the next line, of that length, if its end is [`LineSource::ahead`] with a byte behind
    /// it; false if not.
    #[inline]
    pub(crate) fn pass(&mut self, length: usize) -> bool {
        if !self.is_complete(length) {
            return false;
        }
        let crlf = self.ahead().get(length..length + 2) == Some(b"\r\n");
        self.line = self.next..self.next + length;
        self.next += length + 1 + usize::from(crlf);
        self.number = self.number.saturating_add(1);
        true
    }

    /// Number of the line read last, from 1; 0 before the first.
    pub(crate) const fn number(&self) -> u32 {
        self.number
    }

    /// Whether a whole line is there to be read, of a reader that has nothing for now where it gives nothing.
    pub(crate) fn has_line(&mut self) -> Outcome<bool> {
        loop {
            let ahead = self.ahead();
            if memchr2(b'\n', b'\r', ahead).is_some() || ahead.len() > MAX_LINE_BYTES {
                return Ok(true);
            }
            if !self.take()? {
                return Ok(false);
            }
        }
    }

    /// Reads the next line; false at the end of the input.
    pub(crate) fn advance(&mut self) -> Outcome<bool> {
        // The end of most lines is in the buffer.
        if let Some(length) = memchr2(b'\n', b'\r', self.ahead())
            && self.pass(length)
        {
            return Ok(true);
        }
        self.complete()
    }

    /// The same for a line whose end has to be read, or is the last byte that was.
    #[cold]
    fn complete(&mut self) -> Outcome<bool> {
        self.buffer.drain(..self.next.min(self.buffer.len()));
        (self.line, self.next) = (0..0, 0);
        let first = self.number == 0;
        let (mut searched, mut any, mut excess) = (0, false, false);
        let mut skipped = 0;
        let end = loop {
            if self.after_cr && !self.buffer.is_empty() {
                self.after_cr = false;
                if self.buffer.first() == Some(&b'\n') {
                    self.buffer.remove(0);
                }
            }
            any |= !self.buffer.is_empty();
            let new = self.buffer.get(searched..).unwrap_or_default();
            if let Some(at) = memchr2(b'\n', b'\r', new) {
                break Some(searched + at);
            }
            if self.buffer.len() > MAX_LINE_BYTES {
                excess = true;
                skipped += self.buffer.len() - MAX_LINE_BYTES;
                self.buffer.truncate(MAX_LINE_BYTES);
                if skipped > MOST_SKIPPED {
                    self.number = self.number.saturating_add(1);
                    return Err(endless());
                }
            }
            searched = self.buffer.len();
            self.line = 0..searched;
            if !self.take()? {
                break None;
            }
        };
        if !any {
            return Ok(false);
        }
        let length = end.unwrap_or(self.buffer.len());
        excess |= length > MAX_LINE_BYTES;
        self.line = 0..length.min(MAX_LINE_BYTES);
        self.next = self.buffer.len().min(length + 1);
        if self.buffer.get(length) == Some(&b'\r') {
            match self.buffer.get(self.next) {
                None => self.after_cr = true,
                Some(b'\n') => self.next += 1,
                Some(_) => {}
            }
        }
        self.number = self.number.saturating_add(1);
        if first {
            self.start_of_text()?;
        }
        if excess { Err(too_long()) } else { Ok(true) }
    }

    /// Reads on; false at the end of the input.
    fn take(&mut self) -> Outcome<bool> {
        loop {
            match self.reader.fill_buf() {
                Ok(chunk) => {
                    let taken = chunk.get(..MOST_TAKEN).unwrap_or(chunk);
                    self.buffer.extend_from_slice(taken);
                    let length = taken.len();
                    self.reader.consume(length);
                    return Ok(length > 0);
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => {
                    self.number = self.number.saturating_add(1);
                    return Err(read_failed(&error));
                }
            }
        }
    }

    /// Drops a UTF-8 byte order mark; refuses UTF-16, and what is of another kind altogether.
    fn start_of_text(&mut self) -> Outcome<()> {
        if self.text().starts_with(UTF8_MARK) {
            self.line.start += UTF8_MARK.len();
            return Ok(());
        }
        let text = self.text();
        let marked = text.starts_with(UTF16_LE_MARK) || text.starts_with(UTF16_BE_MARK);
        let head = text.get(..2).unwrap_or_default();
        let unmarked = head.contains(&0) && head.iter().any(u8::is_ascii_graphic);
        if marked || unmarked {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::WrongEncoding,
                SourceSpan::new(0, 2),
                "the file is UTF-16 text",
            )
            .because("a program is read as ASCII or UTF-8; here every second byte is no text")
            .help("save the file as plain text (ASCII or UTF-8)"));
        }
        match foreign(self.text(), self.ahead()) {
            None => Ok(()),
            Some(fault) => Err(fault),
        }
    }
}

fn too_long() -> Box<BlockDiagnostic> {
    let span = SourceSpan::new(MAX_LINE_BYTES, MAX_LINE_BYTES + 1);
    let message = format!("the line is longer than {MAX_LINE_BYTES} bytes");
    BlockDiagnostic::new(DiagnosticCode::LineTooLong, span, message)
        .because("a line is one block, and a block has each word once")
        .help("split the line into blocks, or check that the file is a program")
}

fn endless() -> Box<BlockDiagnostic> {
    let message = format!("no line end within {MOST_SKIPPED} bytes");
    let span = SourceSpan::new(0, 1);
    BlockDiagnostic::new(DiagnosticCode::EndlessLine, span, message)
        .because("a program is lines of text; nothing behind this place is read")
        .help("check that the file is a program")
}

fn read_failed(error: &std::io::Error) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::ReadFailed,
        SourceSpan::default(),
        format!("cannot read the program: {error}"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{BufReader, Cursor};

    fn lines(bytes: &[u8], buffer: usize) -> Vec<Result<String, DiagnosticCode>> {
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
        assert_eq!(
            lines(b"\xff\xfeG\0", 8),
            [Err(DiagnosticCode::WrongEncoding)]
        );
        assert_eq!(lines(b"\0G\x001", 8), [Err(DiagnosticCode::WrongEncoding)]);
    }

    #[test]
    fn keeps_a_bounded_part_of_a_long_line() {
        let mut bytes = vec![b'x'; 3 * MAX_LINE_BYTES];
        bytes.extend_from_slice(b"\nok\n");
        let mut source = LineSource::new(Cursor::new(bytes));
        assert!(
            source
                .advance()
                .is_err_and(|f| f.code == DiagnosticCode::LineTooLong)
        );
        assert_eq!(source.text().len(), MAX_LINE_BYTES);
        assert_eq!(source.advance(), Ok(true));
        assert_eq!((source.text(), source.number()), (b"ok".as_slice(), 2));
    }

    #[test]
    fn a_line_without_end_is_given_up() {
        let mut source = LineSource::new(BufReader::new(std::io::repeat(b'G')));
        let found = source.advance();
        assert!(found.is_err_and(|f| f.code == DiagnosticCode::EndlessLine && f.code.is_fatal()));
        assert!(source.buffer.len() <= MAX_LINE_BYTES + MOST_TAKEN);
    }

    #[test]
    fn a_line_of_the_largest_length_passes() {
        let bytes = vec![b' '; MAX_LINE_BYTES];
        assert_eq!(lines(&bytes, 100).len(), 1);
        assert!(lines(&bytes, 100)[0].is_ok());
    }
}
