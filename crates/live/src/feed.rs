//! The feed of messages to every page that is open.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Messages that are remembered for a page that comes later: a minute, at twenty a second.
const REMEMBERED: usize = 1200;
/// Messages that a page may be behind; one that is further behind loses the oldest of them.
const MOST_BEHIND: u64 = 8;

/// One message as it is on the wire: length of what follows the first four bytes, kind, payload.
#[derive(Debug, Clone)]
pub struct Message(Arc<[u8]>);

impl Message {
    /// A message of a kind.
    #[must_use]
    pub fn new(kind: u8, payload: &[u8]) -> Self {
        // What is told at once is far below 4 GB.
        let length = u32::try_from(payload.len() + 1).unwrap_or(u32::MAX);
        let mut bytes = Vec::with_capacity(payload.len() + 5);
        bytes.extend_from_slice(&length.to_le_bytes());
        bytes.push(kind);
        bytes.extend_from_slice(payload);
        Self(bytes.into())
    }

    /// What is sent while nothing happens.
    pub(crate) fn silence() -> Self {
        Self::new(0, &[])
    }

    pub(crate) fn bytes(&self) -> &[u8] {
        &self.0
    }
}

#[derive(Debug, Default)]
struct Kept {
    messages: VecDeque<Message>,
    /// Number of the next message.
    next: u64,
    is_over: bool,
}

/// The messages to all pages. It is shared by being cloned.
#[derive(Debug, Clone, Default)]
pub struct Feed(Arc<(Mutex<Kept>, Condvar)>);

impl Feed {
    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.0.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Tells all pages.
    pub fn push(&self, message: Message) {
        let mut kept = self.kept();
        kept.messages.push_back(message);
        kept.next += 1;
        if kept.messages.len() > REMEMBERED {
            kept.messages.pop_front();
        }
        drop(kept);
        self.0.1.notify_all();
    }

    /// Forgets what was told: a page that comes later does not hear of it.
    pub fn forget(&self) {
        self.kept().messages.clear();
    }

    /// Nothing more will be told.
    pub(crate) fn end(&self) {
        self.kept().is_over = true;
        self.0.1.notify_all();
    }

    /// What a page has not heard yet that has heard all before number `from`, and the number after
    /// it; waits for `patience` at most. `None` at the end.
    pub(crate) fn after(&self, from: u64, patience: Duration) -> Option<(Vec<Message>, u64)> {
        let kept = self.kept();
        let is_waiting = |kept: &mut Kept| kept.next <= from && !kept.is_over;
        let waited = self.0.1.wait_timeout_while(kept, patience, is_waiting);
        let (kept, _) = waited.unwrap_or_else(PoisonError::into_inner);
        if kept.is_over {
            return None;
        }
        let first = kept.next - kept.messages.len() as u64;
        // A page that comes hears all that is remembered.
        let is_late = from > 0 && kept.next - from.min(kept.next) > MOST_BEHIND;
        let begin = if is_late {
            kept.next - MOST_BEHIND / 2
        } else {
            from
        };
        let skipped = usize::try_from(begin.saturating_sub(first)).unwrap_or(usize::MAX);
        let messages = kept.messages.iter().skip(skipped).cloned().collect();
        Some((messages, kept.next))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(messages: &[Message]) -> Vec<u8> {
        messages.iter().map(|message| message.bytes()[4]).collect()
    }

    #[test]
    fn a_page_hears_what_is_remembered_and_then_what_is_new() {
        let feed = Feed::default();
        (1..4).for_each(|kind| feed.push(Message::new(kind, b"x")));
        let (heard, next) = feed.after(0, Duration::ZERO).unwrap();
        assert_eq!((kinds(&heard), next), (vec![1, 2, 3], 3));
        assert!(feed.after(next, Duration::ZERO).unwrap().0.is_empty());
        feed.push(Message::new(4, b""));
        assert_eq!(kinds(&feed.after(next, Duration::ZERO).unwrap().0), [4]);
    }

    #[test]
    fn a_slow_page_loses_the_oldest() {
        let feed = Feed::default();
        feed.push(Message::new(0, b""));
        let (_, next) = feed.after(0, Duration::ZERO).unwrap();
        (1..100).for_each(|kind| feed.push(Message::new(kind, b"")));
        let (heard, next) = feed.after(next, Duration::ZERO).unwrap();
        assert_eq!((kinds(&heard), next), (vec![96, 97, 98, 99], 100));
    }

    #[test]
    fn memory_is_bounded_and_the_end_is_told() {
        let feed = Feed::default();
        (0..5000).for_each(|_| feed.push(Message::silence()));
        assert_eq!(feed.after(0, Duration::ZERO).unwrap().0.len(), REMEMBERED);
        feed.end();
        assert!(feed.after(5000, Duration::from_secs(60)).is_none());
    }
}
