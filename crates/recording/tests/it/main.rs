//! Tests of recordings as their readers find them: whole, cut anywhere, and in another language.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stderr,
    missing_docs,
    reason = "a test that fails may panic, and says what it skips"
)]

use bytemuck::Zeroable as _;
use glidepath_link::{Setpoint, Status, Text};
use glidepath_recording::{Entry, MAGIC, Origin, Reader, Recorder};
use std::fmt::Write as _;
use std::io::{Cursor, Write as _};
use std::process::{Command, Stdio};

fn origin() -> Origin {
    let mut origin = Origin {
        configuration: "[axis.X]\n".to_owned(),
        program: Some(b"G1 X1 F100\nM2\n".to_vec()),
        ..Origin::default()
    };
    origin.tell("instance", "test");
    origin.tell_clocks(1_700_000_000_000_000_000, 5_000);
    origin
}

/// A setpoint that has a number in every field.
fn setpoint(number: u64) -> Setpoint {
    let mut setpoint = Setpoint::zeroed();
    setpoint.number = number;
    setpoint.tick = number + 3;
    setpoint.scheduled_ns = 4_000_000 * number;
    setpoint.apply_ns = setpoint.scheduled_ns + 4_000_000;
    setpoint.line = u32::try_from(number).unwrap() * 7;
    #[allow(clippy::cast_precision_loss, reason = "small numbers")]
    let t = number as f64;
    for (axis, position) in (1..).zip(&mut setpoint.position) {
        // Numbers with all their bits in use.
        *position = (t * 0.1 + f64::from(axis)).sin() * 123.456;
    }
    setpoint.position[8] = -0.0;
    setpoint
}

/// Bytes, whose reader makes no more room for than a megabyte at a time.
struct Frugal<'b>(&'b [u8]);

impl std::io::Read for Frugal<'_> {
    fn read(&mut self, place: &mut [u8]) -> std::io::Result<usize> {
        assert!(place.len() <= 1 << 20, "room for {} bytes", place.len());
        std::io::Read::read(&mut self.0, place)
    }
}

/// What a file says of a length is no reason to take so much memory, and what is long is read all the
/// same.
#[test]
fn a_length_is_believed_as_far_as_there_are_bytes() {
    let mut bytes = MAGIC.to_vec();
    bytes.push(1);
    bytes.extend_from_slice(&((1_u64 << 30) - 1).to_le_bytes());
    bytes.extend_from_slice(b"short");
    assert!(Reader::new(Frugal(&bytes)).is_err());
    let mut origin = origin();
    origin.program = Some(b"G1 X1 F100\n".repeat(400_000));
    let mut recorder = Recorder::new(Cursor::new(Vec::new()), &origin).unwrap();
    recorder.setpoint(&setpoint(0)).unwrap();
    let bytes = recorder.finish().unwrap().into_inner();
    let reader = Reader::new(Frugal(&bytes)).unwrap();
    assert_eq!(reader.origin().program, origin.program);
}

/// A disk with little room.
struct Little(Cursor<Vec<u8>>);

impl std::io::Write for Little {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        if self.0.get_ref().len() > 20_000 {
            return Err(std::io::ErrorKind::StorageFull.into());
        }
        self.0.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl std::io::Seek for Little {
    fn seek(&mut self, to: std::io::SeekFrom) -> std::io::Result<u64> {
        self.0.seek(to)
    }
}

#[test]
fn a_full_disk_is_told_as_one() {
    let mut recorder = Recorder::new(Little(Cursor::new(Vec::new())), &origin()).unwrap();
    let failed = (0..100_000).find_map(|number| {
        let recorded = recorder.setpoint(&setpoint(number));
        recorded.and_then(|()| recorder.flush()).err()
    });
    assert_eq!(failed.unwrap().kind(), std::io::ErrorKind::StorageFull);
}

fn recorded(count: u64) -> Vec<u8> {
    let mut recorder = Recorder::new(Cursor::new(Vec::new()), &origin()).unwrap();
    for number in 0..count {
        recorder.setpoint(&setpoint(number)).unwrap();
        if number % 50 == 0 {
            let mut status = Status::zeroed();
            status.updated_ns = number;
            status.last_event = Text::new("größer");
            recorder.status(&status).unwrap();
        }
        if number % 250 == 249 {
            recorder.flush().unwrap();
        }
    }
    recorder.finish().unwrap().into_inner()
}

/// Its setpoints, checked, and whether it was cut.
fn read(bytes: &[u8]) -> (u64, bool) {
    let mut reader = Reader::new(bytes).unwrap();
    assert_eq!(reader.origin(), &origin());
    let mut count = 0;
    while let Some(entry) = reader.next_entry().unwrap() {
        match entry {
            Entry::Setpoint(read) => {
                let expected = setpoint(count);
                assert_eq!(bytemuck::bytes_of(&read), bytemuck::bytes_of(&expected));
                count += 1;
            }
            Entry::Status(status) => assert_eq!(status.last_event.as_str(), "größer"),
        }
    }
    (count, reader.is_cut())
}

#[test]
fn a_recording_is_read_to_the_bit() {
    let bytes = recorded(2000);
    assert_eq!(bytes[..8], MAGIC);
    assert_eq!(read(&bytes), (2000, false));
}

#[test]
fn a_recording_that_was_cut_anywhere_is_good_up_to_its_last_flush() {
    let mut ends = Vec::new();
    let mut recorder = Recorder::new(Cursor::new(Vec::new()), &origin()).unwrap();
    for number in 0..1000 {
        recorder.setpoint(&setpoint(number)).unwrap();
        if number % 100 == 99 {
            recorder.flush().unwrap();
            // What is in the file is known only at its end: by its length at every flush.
            ends.push(number + 1);
        }
    }
    let bytes = recorder.finish().unwrap().into_inner();
    let begun = bytes.len() / 20;
    let mut most = 0;
    for end in (begun..bytes.len()).step_by(97) {
        let (count, is_cut) = read(&bytes[..end]);
        assert!(count >= most, "more bytes, and fewer setpoints");
        // Whole chunks, and what can be read of the one that was cut.
        let whole = ends.iter().filter(|end| **end <= count).count();
        assert!(is_cut || count == 1000, "{end}: {count}");
        assert!(whole * 100 <= 1000);
        most = count;
    }
    assert_eq!(most, 1000);
}

#[test]
fn what_is_no_recording_is_refused() {
    for bytes in [&b""[..], b"tick,time_s\n", &MAGIC] {
        assert!(Reader::new(bytes).is_err());
    }
    // A flipped bit is found wherever it changes what is read: not in what lies between chunks.
    let good = recorded(500);
    let places = (2..18).map(|part| good.len() * part / 20);
    let found = places.filter(|place| {
        let mut bytes = good.clone();
        bytes[*place] ^= 0x10;
        is_found_broken(&bytes)
    });
    assert!(found.count() >= 12);
}

/// Whether something is found to be broken.
fn is_found_broken(bytes: &[u8]) -> bool {
    // Its first chunk is read when it is opened.
    let Ok(mut reader) = Reader::new(bytes) else {
        return true;
    };
    loop {
        match reader.next_entry() {
            Ok(Some(_)) => {}
            Ok(None) => return false,
            Err(_) => return true,
        }
    }
}

/// A recording may have been damaged on its way, or on purpose: whatever its bytes, reading it ends,
/// without a panic. `GLIDEPATH_DAMAGES=100000` does it more often.
#[test]
fn a_damaged_recording_is_read_to_its_end_or_refused() {
    let rounds = std::env::var("GLIDEPATH_DAMAGES").ok();
    let rounds: u64 = rounds.and_then(|text| text.parse().ok()).unwrap_or(500);
    let whole = recorded(60);
    let mut seed = 1_u64;
    let mut next = move |below: usize| {
        // Knuth's generator; its upper bits are good enough to choose by.
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(seed >> 33).unwrap() % below
    };
    let mut refused = 0;
    for _ in 0..rounds {
        let mut bytes = whole.clone();
        for _ in 0..=next(4) {
            let place = next(bytes.len());
            bytes[place] = u8::try_from(next(256)).unwrap();
        }
        if next(4) == 0 {
            bytes.truncate(next(bytes.len()));
        }
        let read = Reader::new(bytes.as_slice()).and_then(|mut reader| {
            let mut count = 0;
            while reader.next_entry()?.is_some() {
                count += 1;
            }
            Ok(count)
        });
        refused += u64::from(read.is_err());
    }
    assert!(
        refused > rounds / 4,
        "damages are found: {refused} of {rounds}"
    );
}

/// Reads with Python's reader, and prints every position as hexadecimal digits.
const PYTHON: &str = "\
import sys
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
reader = make_reader(open(sys.argv[1], 'rb'), decoder_factories=[DecoderFactory()])
for schema, channel, message, proto in reader.iter_decoded_messages(topics=['/setpoint']):
    print(message.sequence, message.log_time, proto.line, *(x.hex() for x in proto.position))
assert [a.name for a in reader.iter_attachments()] == ['configuration.toml', 'program.ngc']
assert dict((m.name, m.metadata['instance']) for m in reader.iter_metadata()) == {'glidepath': 'test'}
";

#[test]
fn python_reads_the_same_bits() {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(&recorded(300)).unwrap();
    let there = Command::new("python3")
        .args(["-c", "import mcap, mcap_protobuf"])
        .stderr(Stdio::null())
        .status();
    if !there.is_ok_and(|status| status.success()) {
        glidepath_testing::skip(
            "recordings read by Python",
            "its mcap and mcap-protobuf-support are not installed",
        );
        return;
    }
    let output = Command::new("python3")
        .args(["-c", PYTHON])
        .arg(file.path())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(text.lines().count(), 300);
    for (number, line) in (0..).zip(text.lines()) {
        let setpoint = setpoint(number);
        let log_time = 1_700_000_000_000_000_000 - 5_000 + setpoint.scheduled_ns;
        let mut expected = format!("{number} {log_time} {}", setpoint.line);
        for position in setpoint.position {
            let _ = write!(expected, " {}", hex(position));
        }
        assert_eq!(line, expected);
    }
}

/// A number as Python's `float.hex` writes it.
fn hex(value: f64) -> String {
    let bits = value.to_bits();
    let sign = if bits >> 63 == 1 { "-" } else { "" };
    let (exponent, mantissa) = (bits >> 52 & 0x7ff, bits & ((1 << 52) - 1));
    match (exponent, mantissa) {
        (0, 0) => format!("{sign}0x0.0p+0"),
        (exponent, mantissa) => {
            let exponent = i64::try_from(exponent).unwrap() - 1023;
            format!("{sign}0x1.{mantissa:013x}p{exponent:+}")
        }
    }
}

/// `GLIDEPATH_BLESS=1 cargo test -p glidepath-recording` writes the file.
#[test]
fn the_file_of_messages_is_what_the_code_says() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/glidepath.proto");
    if std::env::var_os("GLIDEPATH_BLESS").is_some() {
        std::fs::write(path, glidepath_recording::proto()).unwrap();
    }
    assert_eq!(
        std::fs::read_to_string(path).unwrap(),
        glidepath_recording::proto()
    );
}
