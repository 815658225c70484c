//! The events of the period that ends with a frame, each with its time.

use crate::Event;

/// Most events of a period.
pub const EVENTS_MOST: usize = 16;

/// An event, and when it happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimedEvent {
    /// What happens.
    pub event: Event,
    /// Program time since the frame before, ns, up to a period.
    pub offset_ns: u32,
}

/// The events of the period that ends with a frame, in order.
///
/// An event at rest is the last of them, and happens at the end of the period; those before it do not
/// stop the motion.
#[derive(Clone, Copy, PartialEq)]
pub struct FrameEvents {
    count: usize,
    /// Those that are not used are all alike.
    events: [TimedEvent; EVENTS_MOST],
}

impl FrameEvents {
    /// Nothing happens.
    pub const NONE: Self = Self {
        count: 0,
        events: [TimedEvent {
            event: Event::OptionalStop,
            offset_ns: 0,
        }; EVENTS_MOST],
    };

    /// One event.
    #[must_use]
    pub const fn one(event: Event, offset_ns: u32) -> Self {
        let mut events = Self::NONE;
        events.events[0] = TimedEvent { event, offset_ns };
        events.count = 1;
        events
    }

    /// Appends an event, no earlier than those before; false, and nothing is changed, if there is no
    /// room for it.
    pub fn push(&mut self, event: Event, offset_ns: u32) -> bool {
        let slot = self.events.get_mut(self.count);
        let has_room = slot.is_some();
        if let Some(slot) = slot {
            *slot = TimedEvent { event, offset_ns };
            self.count += 1;
        }
        has_room
    }

    /// All of them.
    #[must_use]
    pub fn as_slice(&self) -> &[TimedEvent] {
        self.events.get(..self.count).unwrap_or_default()
    }

    /// True if nothing happens.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The event at rest, if there is one.
    #[must_use]
    pub fn at_rest(&self) -> Option<Event> {
        let last = self.as_slice().last()?;
        Some(last.event).filter(Event::is_at_rest)
    }
}

impl core::fmt::Debug for FrameEvents {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_list().entries(self.as_slice()).finish()
    }
}
