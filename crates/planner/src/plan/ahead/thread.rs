//! The planning thread.

use std::io;
use std::thread::{Builder, scope};

use super::queue::{FrameQueue, Work};
use crate::plan::pipeline::Pipeline;
use crate::plan::step::Step;
use crate::source::item_source::ItemSource;

/// Plans ahead of `work`, which takes the frames from the queue, until that returns. The queue has
/// so much `capacity` and gives such a `head_start` ([`FrameQueue::new`]).
///
/// # Errors
/// The thread cannot be started.
pub(crate) fn planned_ahead<S: ItemSource + Send, R>(
    pipeline: &mut Pipeline<S>,
    (capacity, head_start): (usize, usize),
    work: impl FnOnce(&FrameQueue) -> R,
) -> io::Result<R> {
    let queue = FrameQueue::new(capacity, head_start);
    scope(|scope| {
        let _closing = OnDrop(|| queue.close());
        let planning = Builder::new().name("planning".to_owned());
        planning.spawn_scoped(scope, || plan(pipeline, &queue))?;
        Ok(work(&queue))
    })
}

fn plan<S: ItemSource>(pipeline: &mut Pipeline<S>, queue: &FrameQueue) {
    // Should this thread die, nobody waits for it; the scope hands its panic on.
    let _died = OnDrop(|| queue.died());
    pipeline.keep_history();
    loop {
        match queue.next_work(pipeline.remembers_enough()) {
            Work::Stop => return,
            Work::Replan {
                given,
                wanted,
                told,
            } => pipeline.replan(given, wanted, told),
            Work::Plan { given, is_dry } => {
                pipeline.forget_before(given);
                pipeline.let_rest(is_dry);
                match pipeline.step() {
                    Ok(Step::Frame) => queue.add(pipeline.frame(), pipeline.statistics()),
                    Ok(Step::Item) => {}
                    Ok(Step::Pending) => queue.pending(!pipeline.goes_on()),
                    Ok(Step::End) => queue.end(Ok(())),
                    Err(refusal) => queue.end(Err(refusal)),
                }
            }
        }
    }
}

/// Does something at the end, also if that is a panic.
struct OnDrop<F: Fn()>(F);

impl<F: Fn()> Drop for OnDrop<F> {
    fn drop(&mut self) {
        (self.0)();
    }
}
