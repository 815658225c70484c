//! The reader of recordings, whole or cut short.

use crate::begun::{BEGUN, Begun, EPOCH, SET_UP};
use crate::origin::{CONFIGURATION, FACTS, Origin, PROGRAM};
use crate::protobuf::Malformed;
use crate::table::Message;
use glidepath_link::{Setpoint, Status};
use mcap::records::Record;
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{McapError, parse_record};
use std::collections::BTreeMap;
use std::io::{self, Read};
use std::sync::Arc;

/// Longest part of a file that is believed: a program of some ten million lines.
const MOST_BYTES: usize = 1 << 30;

/// Bytes that room is made for before they are there.
const MOST_AT_ONCE: usize = 1 << 20;

/// Longest program that a recording may have, so that it can be read again: the part of the file that
/// it is has a name and a time, too.
pub const MOST_PROGRAM_BYTES: u64 = MOST_BYTES as u64 - 4096;

/// The reason why a recording cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// It is none, or broken.
    #[error("it is no recording, or broken: {0}")]
    Format(McapError),
    /// A message is not what its topic says.
    #[error("a message on {topic}: {cause}")]
    Message {
        /// The topic.
        topic: &'static str,
        /// What is wrong.
        cause: Malformed,
    },
    /// It was not written by Glidepath.
    #[error("it was not recorded by Glidepath")]
    Foreign,
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] io::Error),
}

/// An entry of a recording, in the order in which it came.
#[allow(
    clippy::large_enum_variant,
    reason = "nearly every entry is a setpoint, and they are read one by one"
)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Entry {
    /// A setpoint.
    Setpoint(Setpoint),
    /// A status.
    Status(Status),
}

#[derive(Debug, Clone, Copy)]
enum Topic {
    Setpoint,
    Status,
}

/// A recording as it is read.
pub struct Reader<R> {
    from: R,
    reader: LinearReader,
    heading: Heading,
    first: Option<Entry>,
    is_cut: bool,
    is_over: bool,
}

impl<R> core::fmt::Debug for Reader<R> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Reader")
            .field("is_cut", &self.is_cut)
            .finish_non_exhaustive()
    }
}

impl<R: Read> Reader<R> {
    /// Opens a recording, as far as its first entry.
    ///
    /// # Errors
    ///
    /// It is none, or cannot be read.
    pub fn new(from: R) -> Result<Self, ReadError> {
        let options = LinearReaderOptions::default()
            .with_skip_end_magic(true)
            .with_validate_chunk_crcs(true)
            .with_record_length_limit(MOST_BYTES);
        let mut reader = Self {
            from,
            reader: LinearReader::new_with_options(options),
            heading: Heading::default(),
            first: None,
            is_cut: false,
            is_over: false,
        };
        reader.first = reader.advance()?;
        if reader.heading.origin.facts.is_empty() {
            return Err(ReadError::Foreign);
        }
        Ok(reader)
    }

    /// The origin of the recording.
    #[must_use]
    pub const fn origin(&self) -> &Origin {
        &self.heading.origin
    }

    /// The beginning of the first program whose beginning is in it, once its first setpoint is
    /// read; those of others are passed over.
    #[must_use]
    pub fn begun(&self) -> Option<&Begun> {
        self.heading.begun.as_ref()
    }

    /// Whether it was found to be cut short, once all of it is read.
    #[must_use]
    pub const fn is_cut(&self) -> bool {
        self.is_cut
    }

    /// The next entry; `None` at the end, or where the recording was cut.
    ///
    /// # Errors
    ///
    /// It is broken.
    pub fn next_entry(&mut self) -> Result<Option<Entry>, ReadError> {
        match self.first.take() {
            Some(entry) => Ok(Some(entry)),
            None => self.advance(),
        }
    }

    fn advance(&mut self) -> Result<Option<Entry>, ReadError> {
        while !self.is_over {
            let Some(event) = self.reader.next_event() else {
                // A whole one says where its messages end.
                self.is_cut = true;
                self.is_over = true;
                break;
            };
            match event {
                Ok(LinearReadEvent::ReadRequest(count)) => {
                    // A length is believed as far as there are bytes: else a file of no length at
                    // all would take all of the memory.
                    let place = self.reader.insert(count.min(MOST_AT_ONCE));
                    let got = self.from.read(place)?;
                    self.reader.notify_read(got);
                }
                Ok(LinearReadEvent::Record { data, opcode }) => {
                    let record = parse_record(opcode, data).map_err(ReadError::Format)?;
                    let taken = self.heading.take(record)?;
                    match taken {
                        Taken::Entry(entry) => return Ok(Some(entry)),
                        Taken::End => self.is_over = true,
                        Taken::Nothing => {}
                    }
                }
                // The recorder was killed, or the disk was full: what is there is good.
                Err(McapError::UnexpectedEof | McapError::UnexpectedEoc) => {
                    self.is_cut = true;
                    self.is_over = true;
                }
                Err(error) => return Err(ReadError::Format(error)),
            }
        }
        Ok(None)
    }
}

#[allow(clippy::large_enum_variant, reason = "it lives for a moment")]
enum Taken {
    Entry(Entry),
    End,
    Nothing,
}

/// What is in a recording beside its entries.
#[derive(Default)]
struct Heading {
    origin: Origin,
    topics: BTreeMap<u16, Topic>,
    begun: Option<Begun>,
    /// The attachments that the first program's texts are in: their names, with those of their entries.
    texts: Vec<(String, String)>,
}

impl Heading {
    fn take(&mut self, record: Record<'_>) -> Result<Taken, ReadError> {
        match record {
            Record::Metadata(metadata) if metadata.name == FACTS => {
                self.origin.facts = metadata.metadata;
            }
            Record::Metadata(metadata) if metadata.name == BEGUN => self.begins(metadata.metadata),
            Record::Attachment { header, data, .. } => match header.name.as_str() {
                CONFIGURATION => {
                    self.origin.configuration = String::from_utf8_lossy(&data).into_owned();
                }
                PROGRAM => self.origin.program = Some(data.into_owned()),
                name => self.text(name, &data),
            },
            Record::Channel(channel) => {
                let topic = match channel.topic.as_str() {
                    "/setpoint" => Some(Topic::Setpoint),
                    "/status" => Some(Topic::Status),
                    _ => None,
                };
                if let Some(topic) = topic {
                    self.topics.insert(channel.id, topic);
                }
            }
            Record::Message { header, data } => {
                let entry = match self.topics.get(&header.channel_id) {
                    Some(Topic::Setpoint) => Entry::Setpoint(message("/setpoint", &data)?),
                    Some(Topic::Status) => Entry::Status(message("/status", &data)?),
                    None => return Ok(Taken::Nothing),
                };
                return Ok(Taken::Entry(entry));
            }
            Record::DataEnd(_) | Record::Footer(_) => return Ok(Taken::End),
            _ => {}
        }
        Ok(Taken::Nothing)
    }

    fn begins(&mut self, mut entries: BTreeMap<String, String>) {
        if self.begun.is_some() {
            return;
        }
        let mut entry = |name: &str| entries.remove(name).unwrap_or_default();
        self.begun = Some(Begun {
            epoch: entry(EPOCH).parse().unwrap_or(0),
            set_up: entry(SET_UP),
            ..Begun::default()
        });
        self.texts = entries.into_iter().map(|(of, name)| (name, of)).collect();
    }

    fn text(&mut self, name: &str, data: &[u8]) {
        let Some(begun) = &mut self.begun else {
            return;
        };
        let text: Arc<[u8]> = data.into();
        for (_, of) in self.texts.iter().filter(|(wanted, _)| wanted == name) {
            begun.take(of, &text);
        }
    }
}

fn message<M: Message + bytemuck::Zeroable>(
    topic: &'static str,
    data: &[u8],
) -> Result<M, ReadError> {
    let mut message = M::zeroed();
    message
        .read(data)
        .map_err(|cause| ReadError::Message { topic, cause })?;
    Ok(message)
}
