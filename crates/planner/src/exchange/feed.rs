//! The client of a listening planner: streams the items of any source, as another program would.
//!
//! Requests go out in rounds of as many as the link lets be unanswered. What a round's answers do
//! not accept, because the planner has no room, goes out again in the next.
//!
//! The source is read in a thread of its own: however long it takes to its next item, the planner sees that its client
//! lives, and the caller can end it. A caller that ends a stream has the motion aborted, and is told how the stream
//! ended.

mod error;
mod feeder;
mod reader;
mod wait;

pub use error::FeedError;

use std::time::Instant;

use glidepath_gcode::ReadingWatch;
use glidepath_geometry::AxisVector;
use glidepath_link::{LinkError, Record as _, StreamItem, Transport};

use crate::run::control::Control;
use crate::run::refusal::Refusal;
use crate::source::item_source::ItemSource;
use feeder::{Feeder, PATIENCE};
use reader::Reader;
use wait::{POLL, pause};

/// Who wants a stream.
pub struct Feeding<'f> {
    /// When it was asked for, ns of the host's steady clock. A stop of the machine after that ends the stream, whenever
    /// its planner hears of it.
    pub asked_ns: u64,
    /// Has the interpolator abort the motion: called when the stop flag is set while the stream is open.
    pub abort: &'f mut dyn FnMut(),
}

impl std::fmt::Debug for Feeding<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Feeding")
            .field("asked_ns", &self.asked_ns)
            .finish_non_exhaustive()
    }
}

/// The result of a stream.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Fed {
    /// Items accepted.
    pub items: u64,
    /// Lines read.
    pub lines: u64,
}

/// Streams a program to a listening planner and waits until it is executed. The stream is opened first: while the program
/// is read it is a job that everybody sees, and nobody else moves the machine. `make_source` opens the program for a
/// machine at the given position, in a thread of its own, and gives the watch to whatever reads it: by that the reading is
/// ended. Nothing is streamed if it refuses.
///
/// # Errors
/// [`FeedError`]. If the source fails midway, the stream ends after the last good item, and that is
/// executed before the error is returned.
pub fn feed<S: ItemSource>(
    transport: &dyn Transport,
    feeding: &mut Feeding<'_>,
    make_source: impl FnOnce(AxisVector, ReadingWatch) -> Result<S, Refusal> + Send,
    control: &mut Control<'_>,
) -> Result<Fed, FeedError> {
    must_be_there(transport, control)?;
    let mut feeder = Feeder::new(transport, feeding.asked_ns)?;
    let fed = feeder
        .open(control)
        .and_then(|position| read_and_stream(&mut feeder, position, make_source, control));
    match fed {
        Err(FeedError::Interrupted) => Err(feeder.call_off(feeding.abort, control)),
        fed => fed,
    }
}

/// From the opening of the program to the end of its motion.
fn read_and_stream<S: ItemSource>(
    feeder: &mut Feeder,
    position: AxisVector,
    make_source: impl FnOnce(AxisVector, ReadingWatch) -> Result<S, Refusal> + Send,
    control: &mut Control<'_>,
) -> Result<Fed, FeedError> {
    let watch = ReadingWatch::default();
    std::thread::scope(|scope| {
        let reading = watch.clone();
        let reader = Reader::spawn(scope, watch.clone(), move || make_source(position, reading));
        let fed = match reader {
            Ok(mut reader) => stream(feeder, &mut reader, control),
            Err(error) => Err(Refusal::from(error).into()),
        };
        // Whoever reads may be far from the next item.
        watch.end();
        fed
    })
}

/// From the opened stream to the end of its motion.
fn stream(
    feeder: &mut Feeder,
    reader: &mut Reader,
    control: &mut Control<'_>,
) -> Result<Fed, FeedError> {
    match feeder.wait_for(reader, control) {
        Err(FeedError::Refused(refusal)) => {
            feeder.give_up(control);
            return Err(refusal.into());
        }
        opened => opened?,
    }
    let refusal = match feeder.stream(reader, control) {
        Err(error @ FeedError::RefusedByPlanner { .. }) => {
            // What was accepted is executed; better to say at once that there is no more.
            feeder.give_up(control);
            return Err(error);
        }
        result => result?,
    };
    let items = feeder.items();
    feeder.deliver(StreamItem::End, control)?;
    feeder.wait_until_executed(control)?;
    match refusal {
        None => Ok(Fed {
            items,
            lines: reader.lines_read(),
        }),
        Some(refusal) => Err(refusal.into()),
    }
}

/// Waits for a machine that says where it stands.
fn must_be_there(transport: &dyn Transport, control: &mut Control<'_>) -> Result<(), FeedError> {
    let mut status = transport.status_source()?;
    let began = Instant::now();
    while began.elapsed() < PATIENCE {
        if let Some(status) = status.take()? {
            status.check().map_err(LinkError::from)?;
            return Ok(());
        }
        pause(POLL, control)?;
    }
    Err(FeedError::MachineLost)
}
