//! The reader thread, which reads a program and cuts it into parts.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel};

use glidepath_geometry::AxisVector;
use glidepath_motion::parts::{Cutter, Placed};
use glidepath_program::{Item, Settings};

use super::bounds::Bounds;
use super::message::{Batch, Gone, Part, PlanPiece};
use crate::plan::blocks::Blocks;
use crate::run::refusal::Refusal;
use crate::source::item_source::{ItemSource, Supply};

/// Items that are handed over together.
const BATCH: usize = 64;

/// The outcome of reading.
#[derive(Debug, Default)]
pub(super) struct ReadEnd {
    /// Why the program ended early.
    pub(super) refusal: Option<Refusal>,
    /// Lines of text read.
    pub(super) lines: u64,
}

/// The outlets for parts.
#[derive(Debug)]
pub(super) struct Outlets {
    /// To whoever has time.
    pub(super) workers: Sender<Part>,
    /// To the caller, in order.
    pub(super) plans: SyncSender<Receiver<PlanPiece>>,
    pub(super) bounds: Arc<Bounds>,
}

/// Items on their way to the workers.
struct Handing {
    outlets: Outlets,
    /// Parts begun.
    parts: u64,
    /// The part at hand.
    open: Sender<Batch>,
    batch: Vec<Item>,
}

impl Handing {
    fn new(outlets: Outlets, start: AxisVector) -> Result<Self, Gone> {
        let open = begin(&outlets, 0, start)?;
        Ok(Self {
            outlets,
            parts: 1,
            open,
            batch: Vec::with_capacity(BATCH),
        })
    }

    fn put(&mut self, placed: Placed, lines: u64) -> Result<(), Gone> {
        if let Some(start) = placed.begins {
            self.end(false, lines)?;
            self.open = begin(&self.outlets, self.parts, start)?;
            self.parts += 1;
        }
        self.batch.push(placed.item);
        if self.batch.len() >= BATCH {
            self.hand_over(lines)?;
        }
        Ok(())
    }

    fn hand_over(&mut self, lines: u64) -> Result<(), Gone> {
        let items = std::mem::replace(&mut self.batch, Vec::with_capacity(BATCH));
        if !self.outlets.bounds.add_items(items.len()) {
            return Err(Gone);
        }
        self.send(Batch::Items { items, lines })
    }

    /// Ends the part at hand.
    fn end(&mut self, is_last: bool, lines: u64) -> Result<(), Gone> {
        self.hand_over(lines)?;
        self.send(Batch::End { is_last })
    }

    fn send(&self, batch: Batch) -> Result<(), Gone> {
        self.open.send(batch).map_err(|_| Gone)
    }
}

/// Begins a part: whoever takes it gets its items by what is returned.
fn begin(outlets: &Outlets, number: u64, start: AxisVector) -> Result<Sender<Batch>, Gone> {
    let (open, items) = channel();
    let (plan, planned) = channel();
    let part = Part {
        number,
        start,
        items,
        plan,
    };
    outlets.plans.send(planned).map_err(|_| Gone)?;
    outlets.workers.send(part).map_err(|_| Gone)?;
    Ok(open)
}

/// Reads a source to its end; `None` if nobody wants the plan any more.
pub(super) fn read<S: ItemSource>(
    source: S,
    settings: &Settings,
    start: AxisVector,
    outlets: Outlets,
) -> Option<ReadEnd> {
    hand_all(source, settings, start, outlets).ok()
}

fn hand_all<S: ItemSource>(
    mut source: S,
    settings: &Settings,
    start: AxisVector,
    outlets: Outlets,
) -> Result<ReadEnd, Gone> {
    let mut handing = Handing::new(outlets, start)?;
    let (mut cutter, mut blocks) = (Cutter::new(settings, start), Blocks::whole());
    let mut placed = Vec::new();
    let refusal = loop {
        let mut item = match source.next_item() {
            Supply::Item(item) => item,
            Supply::Pending => {
                std::thread::yield_now();
                continue;
            }
            // Nobody answers who only plans: sources that ask are not read here.
            Supply::Probe | Supply::End => break None,
            Supply::Refused(refusal) => break Some(refusal),
        };
        blocks.number(&mut item);
        if let Err(error) = cutter.take(item, &mut placed) {
            source.unplannable(&error);
            break Some(error.into());
        }
        let lines = source.lines_read();
        for placed in placed.drain(..) {
            handing.put(placed, lines)?;
        }
    };
    cutter.finish(&mut placed);
    let lines = source.lines_read();
    for placed in placed {
        handing.put(placed, lines)?;
    }
    handing.end(true, lines)?;
    Ok(ReadEnd { refusal, lines })
}
