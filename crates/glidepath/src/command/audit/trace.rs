//! The setpoints of a recording or of a CSV file, one after the other.

use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::file_error::FileError;
use crate::program_file::ProgramFile;
use bytemuck::Zeroable as _;
use glidepath_geometry::Axis;
use glidepath_link::{MachineState, Setpoint};
use glidepath_recording::{Begun, Entry, MAGIC, Origin, Reader};
use std::fs::File;
use std::io::{self, BufRead as _, BufReader, Read as _, Seek as _};
use std::path::PathBuf;

/// A file with setpoints in it.
pub(super) enum Trace {
    /// A recording.
    Recording(Box<Reader<BufReader<File>>>, PathBuf),
    /// Comma-separated values.
    Csv(Box<Csv>),
}

/// More than the longest row, of nine axes and as many joints.
const MOST_ROW_BYTES: u64 = 1 << 14;

/// The states of a machine that does not know where it is.
pub(super) const LOST: [MachineState; 2] = [MachineState::Homing, MachineState::NotHomed];

/// Rows of setpoints as `plan`, `run` and `servo` write them.
pub(super) struct Csv {
    rows: BufReader<File>,
    path: PathBuf,
    /// The axis and the quantity of each column behind the first six.
    columns: Vec<Option<(Axis, usize)>>,
    period_ns: u64,
    row: u64,
    /// The first frame of the program, by the tick at which it was, or would have been; none before the motion.
    begun_at: Option<u64>,
    /// Whether a row at rest came before the motion: that was the first frame.
    has_rested: bool,
    /// Whether program time has gone with the clock so far: rows do not say how far it is in a hold.
    is_steady: bool,
}

impl Trace {
    pub(super) fn open(file: &ProgramFile, config: &MachineConfig) -> Result<Self, Failure> {
        let path = file.name();
        let mut head = Vec::new();
        let mut file = File::open(file.path()).map_err(FileError::open(path))?;
        let read = (&file).take(8).read_to_end(&mut head);
        let read = read.and_then(|_| file.rewind());
        read.map_err(FileError::open(path))?;
        if head == MAGIC {
            let reader = Reader::new(BufReader::with_capacity(1 << 18, file))
                .map_err(|error| Failure::recording(path, error))?;
            return Ok(Self::Recording(Box::new(reader), path.to_owned()));
        }
        let mut rows = BufReader::new(file);
        let header = next_row(&mut rows).map_err(FileError::open(path))?;
        let header = header.unwrap_or_default();
        let mut names = header.split(',');
        let first = ["tick", "time_s", "line", "state", "feed_mm_s", "path_mm"];
        if !first.iter().all(|name| names.next() == Some(name)) {
            let reason = "it is neither a recording nor a CSV file of setpoints";
            let error = io::Error::new(io::ErrorKind::InvalidData, reason);
            return Err(FileError::open(path)(error).into());
        }
        let column = |name: &str| {
            let (quantity, axis) = name.split_once('_')?;
            let quantity = ["pos", "vel", "acc"]
                .iter()
                .position(|of| *of == quantity)?;
            let axis = Axis::ALL
                .into_iter()
                .find(|known| known.to_string() == axis)?;
            Some((axis, quantity))
        };
        Ok(Self::Csv(Box::new(Csv {
            rows,
            path: path.to_owned(),
            columns: names.map(column).collect(),
            period_ns: config.period_ns(),
            row: 1,
            begun_at: None,
            has_rested: false,
            is_steady: true,
        })))
    }

    /// What it is of, if it says so.
    pub(super) const fn origin(&self) -> Option<&Origin> {
        match self {
            Self::Recording(reader, _) => Some(reader.origin()),
            Self::Csv(_) => None,
        }
    }

    /// What the first program began with that begins in it, for which entries are read and passed over.
    pub(super) fn begun(&mut self) -> Result<Option<&Begun>, Failure> {
        let Self::Recording(reader, path) = self else {
            return Ok(None);
        };
        let failed = |error| Failure::recording(path, error);
        while reader.begun().is_none() && reader.next_entry().map_err(failed)?.is_some() {}
        Ok(reader.begun())
    }

    /// Whether it tells at which program time a setpoint was.
    pub(super) const fn has_program_time(&self) -> bool {
        matches!(self, Self::Recording(..))
    }

    /// Whether it was found to be cut short, once all of it is read.
    pub(super) const fn is_cut(&self) -> bool {
        match self {
            Self::Recording(reader, _) => reader.is_cut(),
            Self::Csv(_) => false,
        }
    }

    /// What comes next.
    pub(super) fn next_entry(&mut self) -> Result<Option<Entry>, Failure> {
        match self {
            Self::Recording(reader, path) => reader
                .next_entry()
                .map_err(|error| Failure::recording(path, error)),
            Self::Csv(csv) => csv.next_setpoint(),
        }
    }
}

/// The next row; of a file that is none of ours, it may have no end.
fn next_row(rows: &mut BufReader<File>) -> io::Result<Option<String>> {
    let mut row = Vec::new();
    rows.by_ref()
        .take(MOST_ROW_BYTES)
        .read_until(b'\n', &mut row)?;
    if row.is_empty() {
        return Ok(None);
    }
    let text = row.strip_suffix(b"\n").unwrap_or(&row);
    Ok(Some(String::from_utf8_lossy(text).trim_end().to_owned()))
}

impl Csv {
    fn next_setpoint(&mut self) -> Result<Option<Entry>, Failure> {
        let row = next_row(&mut self.rows).map_err(FileError::open(&self.path))?;
        let Some(row) = row else {
            return Ok(None);
        };
        self.row += 1;
        let setpoint = self.setpoint(&row).ok_or_else(|| {
            let reason = format!("row {} is no setpoint: {row}", self.row);
            FileError::open(&self.path)(io::Error::new(io::ErrorKind::InvalidData, reason))
        })?;
        Ok(Some(Entry::Setpoint(setpoint)))
    }

    fn setpoint(&mut self, row: &str) -> Option<Setpoint> {
        let mut values = row.split(',');
        let mut setpoint = Setpoint::zeroed();
        setpoint.tick = values.next()?.parse().ok()?;
        values.next()?.parse::<f64>().ok()?;
        setpoint.line = values.next()?.parse().ok()?;
        let state = self.state(values.next()?, setpoint.tick);
        setpoint.state = state.code();
        setpoint.feed_v = values.next()?.parse().ok()?;
        setpoint.path_s = values.next()?.parse().ok()?;
        // Rows have no numbers and no times of their own: the tick stands for both.
        setpoint.number = setpoint.tick;
        setpoint.sequence = setpoint
            .tick
            .saturating_sub(self.begun_at.unwrap_or(setpoint.tick));
        setpoint.fraction = if self.is_steady { 0.0 } else { 0.5 };
        setpoint.scheduled_ns = setpoint.tick.wrapping_mul(self.period_ns);
        setpoint.apply_ns = setpoint.scheduled_ns.wrapping_add(self.period_ns);
        // What moves before a machine knows where it is, is of no program.
        setpoint.epoch = u64::from(!LOST.contains(&state));
        setpoint.effective_override = 1.0;
        for column in &self.columns {
            let value = values.next()?;
            let Some((axis, quantity)) = column else {
                continue;
            };
            let value: f64 = value.parse().ok()?;
            let of = match quantity {
                0 => &mut setpoint.position,
                1 => &mut setpoint.velocity,
                _ => &mut setpoint.acceleration,
            };
            *of.get_mut(axis.index())? = value;
        }
        values.next().is_none().then_some(setpoint)
    }

    /// The state of a row. A run rests while its first frames are planned, whatever that is called.
    fn state(&mut self, name: &str, tick: u64) -> MachineState {
        if let Some(lost) = LOST.into_iter().find(|state| state.name() == name) {
            self.has_rested |= self.begun_at.is_none();
            return lost;
        }
        let runs = name == "running";
        if self.begun_at.is_none() {
            if !runs {
                self.has_rested = true;
                return MachineState::Idle;
            }
            self.begun_at = Some(tick.saturating_sub(self.has_rested.into()));
        }
        if name == "idle" {
            return MachineState::Idle;
        }
        self.is_steady &= runs;
        MachineState::Running
    }
}
