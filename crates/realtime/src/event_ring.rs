//! The ring of events from a real-time thread to one that may write logs.
//!
//! A single-producer single-consumer ring of fixed capacity. The writer never waits: what does not
//! fit is dropped and counted, and the reader learns how many were lost.

use core::sync::atomic::{AtomicU64, Ordering};
use heapless::spsc::{Consumer, Producer, Queue};

/// Storage of a ring for up to `N − 1` events.
#[derive(Debug)]
pub struct Events<E, const N: usize> {
    queue: Queue<E, N>,
    dropped: AtomicU64,
}

impl<E, const N: usize> Default for Events<E, N> {
    fn default() -> Self {
        Self {
            queue: Queue::new(),
            dropped: AtomicU64::new(0),
        }
    }
}

/// The two ends of a ring, one for each thread.
pub const fn event_ring<E: Copy, const N: usize>(
    events: &mut Events<E, N>,
) -> (EventWriter<'_, E>, EventReader<'_, E>) {
    let Events { queue, dropped } = events;
    let dropped: &AtomicU64 = dropped;
    let (producer, consumer) = queue.split_const();
    (
        EventWriter { producer, dropped },
        EventReader {
            consumer,
            dropped,
            reported: 0,
        },
    )
}

/// The real-time end.
pub struct EventWriter<'a, E> {
    producer: Producer<'a, E>,
    dropped: &'a AtomicU64,
}

impl<E: Copy> EventWriter<'_, E> {
    /// Appends an event, or counts it as dropped if the ring is full.
    pub fn write(&mut self, event: E) {
        if self.producer.enqueue(event).is_err() {
            self.dropped.fetch_add(1, Ordering::Relaxed);
        }
    }
}

/// The logging end.
pub struct EventReader<'a, E> {
    consumer: Consumer<'a, E>,
    dropped: &'a AtomicU64,
    reported: u64,
}

impl<E: Copy> EventReader<'_, E> {
    /// The oldest event not yet read.
    pub fn read(&mut self) -> Option<E> {
        self.consumer.dequeue()
    }

    /// Events lost since the last call.
    pub fn newly_dropped(&mut self) -> u64 {
        let total = self.dropped.load(Ordering::Relaxed);
        let new = total - self.reported;
        self.reported = total;
        new
    }
}

impl<E> core::fmt::Debug for EventWriter<'_, E> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("EventWriter")
            .field("len", &self.producer.len())
            .finish_non_exhaustive()
    }
}

impl<E> core::fmt::Debug for EventReader<'_, E> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("EventReader")
            .field("len", &self.consumer.len())
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_is_dropped_and_counted() {
        let mut events = Events::<u32, 4>::default();
        let (mut writer, mut reader) = event_ring(&mut events);
        for event in 0..5 {
            writer.write(event);
        }
        assert_eq!(reader.newly_dropped(), 2);
        assert_eq!(reader.newly_dropped(), 0);
        assert_eq!(
            std::iter::from_fn(|| reader.read()).collect::<Vec<_>>(),
            [0, 1, 2]
        );
        writer.write(9);
        assert_eq!(reader.read(), Some(9));
    }
}
