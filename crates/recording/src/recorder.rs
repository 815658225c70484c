//! The writer of recordings.

use crate::begun::{BEGUN, Begun, EPOCH, SET_UP, attachment_of};
use crate::origin::{CONFIGURATION, FACTS, Origin, PROGRAM};
use crate::table::Message;
use glidepath_link::{Setpoint, Status};
use mcap::records::{MessageHeader, Metadata};
use mcap::{Attachment, Compression, McapError, McapResult, WriteOptions, Writer};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Seek, Write};

/// A recording as it grows.
pub struct Recorder<W: Write + Seek> {
    writer: Writer<W>,
    channels: [u16; 2],
    ahead_ns: u64,
    message: Vec<u8>,
    written: u64,
    /// The texts that were attached.
    attached: BTreeSet<String>,
}

impl<W: Write + Seek> core::fmt::Debug for Recorder<W> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Recorder")
            .field("written", &self.written)
            .finish_non_exhaustive()
    }
}

impl<W: Write + Seek> Recorder<W> {
    /// Begins a recording.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn new(writer: W, origin: &Origin) -> io::Result<Self> {
        Self::begin(writer, origin).map_err(of_writer)
    }

    fn begin(writer: W, origin: &Origin) -> McapResult<Self> {
        let mut writer = WriteOptions::new()
            .profile("glidepath")
            .compression(Some(Compression::Lz4))
            .create(writer)?;
        writer.write_metadata(&Metadata {
            name: FACTS.to_owned(),
            metadata: origin.facts.clone(),
        })?;
        let configuration = origin.configuration.as_bytes();
        writer.attach(&attachment(
            CONFIGURATION,
            "application/toml",
            configuration,
        ))?;
        if let Some(program) = &origin.program {
            writer.attach(&attachment(PROGRAM, "text/plain", program))?;
        }
        let channels = [
            channel::<Setpoint, W>(&mut writer, "/setpoint")?,
            channel::<Status, W>(&mut writer, "/status")?,
        ];
        let mut recorder = Self {
            writer,
            channels,
            ahead_ns: origin.ahead_ns(),
            message: Vec::new(),
            written: 0,
            attached: BTreeSet::new(),
        };
        recorder.writer.flush()?;
        Ok(recorder)
    }

    /// Adds a setpoint, unchecked: a recording shows what was there.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn setpoint(&mut self, setpoint: &Setpoint) -> io::Result<()> {
        #[allow(
            clippy::cast_possible_truncation,
            reason = "the format numbers modulo 2^32"
        )]
        let sequence = setpoint.number as u32;
        let times = [setpoint.scheduled_ns, setpoint.apply_ns];
        self.add(0, sequence, times, |message| setpoint.put(message))
    }

    /// Adds a status, unchecked.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn status(&mut self, status: &Status) -> io::Result<()> {
        let times = [status.updated_ns; 2];
        self.add(1, 0, times, |message| status.put(message))
    }

    /// Adds what a program began with, in front of its first setpoint.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn begun(&mut self, begun: &Begun) -> io::Result<()> {
        self.add_begun(begun).map_err(of_writer)
    }

    fn add_begun(&mut self, begun: &Begun) -> McapResult<()> {
        let mut entries = BTreeMap::from([
            (EPOCH.to_owned(), begun.epoch.to_string()),
            (SET_UP.to_owned(), begun.set_up.clone()),
        ]);
        entries.extend(
            begun
                .texts()
                .map(|(entry, text)| (entry, attachment_of(text))),
        );
        self.writer.write_metadata(&Metadata {
            name: BEGUN.to_owned(),
            metadata: entries,
        })?;
        for (_, text) in begun.texts() {
            let name = attachment_of(text);
            if !self.attached.contains(&name) {
                self.writer.attach(&attachment(&name, "text/plain", text))?;
                self.attached.insert(name);
            }
        }
        Ok(())
    }

    fn add(
        &mut self,
        channel: usize,
        sequence: u32,
        times_ns: [u64; 2],
        put: impl FnOnce(&mut Vec<u8>),
    ) -> io::Result<()> {
        self.message.clear();
        put(&mut self.message);
        let [log_time, publish_time] = times_ns.map(|ns| ns.saturating_add(self.ahead_ns));
        let header = MessageHeader {
            channel_id: self.channels.get(channel).copied().unwrap_or_default(),
            sequence,
            log_time,
            publish_time,
        };
        self.written += 1;
        self.writer
            .write_to_known_channel(&header, &self.message)
            .map_err(of_writer)
    }

    /// Hands over to the writer what is in memory: whatever happens to this process, it is there.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn flush(&mut self) -> io::Result<()> {
        self.writer.flush().map_err(of_writer)
    }

    /// Messages written.
    #[must_use]
    pub const fn written(&self) -> u64 {
        self.written
    }

    /// Ends the recording; gives the writer back.
    ///
    /// # Errors
    ///
    /// The writer's.
    pub fn finish(mut self) -> io::Result<W> {
        self.writer.finish().map_err(of_writer)?;
        Ok(self.writer.into_inner())
    }
}

/// What the writer said, where it said something: what can be done about it follows from that.
fn of_writer(error: McapError) -> io::Error {
    match error {
        McapError::Io(error) => error,
        error => io::Error::other(error),
    }
}

fn attachment<'d>(name: &str, media_type: &str, data: &'d [u8]) -> Attachment<'d> {
    Attachment {
        log_time: 0,
        create_time: 0,
        name: name.to_owned(),
        media_type: media_type.to_owned(),
        data: Cow::Borrowed(data),
    }
}

fn channel<M: Message, W: Write + Seek>(writer: &mut Writer<W>, topic: &str) -> McapResult<u16> {
    let schema = writer.add_schema(M::NAME, "protobuf", &M::description())?;
    writer.add_channel(schema, topic, "protobuf", &BTreeMap::new())
}
