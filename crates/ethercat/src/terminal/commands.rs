//! The commands to spindle, coolant and outputs, at the times at which they are meant.
//!
//! They come twice. The events of setpoints say what happens and when, and are taken up when the
//! drives have come to that time. The auxiliary record says what all of them have come to: it is there
//! for who came late or lost one, and counts where it has said something else for a while in which
//! there were no events.

use super::signal::is_of_spindle;
use glidepath_link::{Auxiliary, EventRecord, Setpoint};
use glidepath_program::Event;
use std::collections::VecDeque;

/// Events that wait for their time. Where there are more, the oldest does not.
const MOST: usize = 1024;
/// How long the record has to say something else than the events until it counts, ns.
const SETTLED_NS: u64 = 100_000_000;

/// The commands at one time.
#[derive(Debug)]
pub(crate) struct Commands {
    /// What is commanded now.
    now: Auxiliary,
    /// What is still to come: when, and what.
    due: VecDeque<(u64, Event)>,
    /// The record, if it was not looked at to the end.
    heard: Option<Auxiliary>,
    /// Since when nothing has changed, ns.
    since_ns: u64,
}

impl Commands {
    /// Nothing was said yet. It allocates here, and never again.
    pub(crate) fn new() -> Self {
        Self {
            now: Auxiliary::default(),
            due: VecDeque::with_capacity(MOST),
            heard: None,
            since_ns: 0,
        }
    }

    /// What is commanded now.
    pub(crate) const fn now(&self) -> &Auxiliary {
        &self.now
    }

    /// Whether the spindle is to turn otherwise, and the time of that has not come.
    pub(crate) fn has_due_of_spindle(&self) -> bool {
        self.due.iter().any(|(_, event)| is_of_spindle(*event))
    }

    /// Another interpolator has other outputs, and none of them is on.
    fn meet(&mut self, boot_id: u64) {
        if self.now.boot_id != boot_id {
            self.due.clear();
            self.now = Auxiliary {
                boot_id,
                ..Auxiliary::default()
            };
        }
    }

    /// A setpoint has come.
    pub(crate) fn note(&mut self, setpoint: &Setpoint) {
        self.meet(setpoint.boot_id);
        for record in setpoint.events() {
            if let Ok(event) = record.event() {
                if self.due.len() == MOST
                    && let Some((_, first)) = self.due.pop_front()
                {
                    self.now.take(first);
                }
                self.due.push_back((at_ns(setpoint, record), event));
            }
        }
    }

    /// The record has come.
    pub(crate) fn hear(&mut self, record: &Auxiliary, now_ns: u64) {
        // The operator's hand has no place in the motion, and is obeyed at once.
        if self.now.boot_id == 0 || self.now.boot_id == record.boot_id {
            self.now.spindle_override = record.spindle_override;
        }
        (self.heard, self.since_ns) = (Some(*record), now_ns);
    }

    /// Takes up what happens until `meant_ns`, and tells each event. Returns whether the record was
    /// taken over.
    pub(crate) fn advance(
        &mut self,
        now_ns: u64,
        meant_ns: u64,
        tell: &mut dyn FnMut(Event),
    ) -> bool {
        while let Some((_, event)) = self.due.front().filter(|(at, _)| *at <= meant_ns) {
            let event = *event;
            self.due.pop_front();
            self.since_ns = now_ns;
            self.now.take(event);
            tell(event);
        }
        let has_settled = now_ns.saturating_sub(self.since_ns) > SETTLED_NS;
        if !(has_settled && self.due.is_empty()) {
            return false;
        }
        // The record of an interpolator that is dead says what it wanted last.
        let own = self.now.boot_id;
        match self.heard.take() {
            Some(record) if own == 0 || own == record.boot_id => {
                self.now = record;
                true
            }
            _ => false,
        }
    }
}

/// When an event is meant, ns.
fn at_ns(setpoint: &Setpoint, record: &EventRecord) -> u64 {
    setpoint.scheduled_ns + u64::from(record.offset_ns)
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable as _;

    const MS: u64 = 1_000_000;

    fn setpoint(boot_id: u64, tick: u64, events: &[(u32, bool, u32)]) -> Setpoint {
        let mut setpoint = Setpoint {
            boot_id,
            scheduled_ns: tick * 4 * MS,
            apply_ns: (tick + 1) * 4 * MS,
            ..Setpoint::zeroed()
        };
        for (number, on, offset_ns) in events {
            let event = Event::DigitalOutput {
                number: *number,
                on: *on,
            };
            assert!(setpoint.tell(EventRecord::new(event, *offset_ns)));
        }
        setpoint
    }

    fn on_at(commands: &mut Commands, now_ns: u64, meant_ns: u64) -> u64 {
        commands.advance(now_ns, meant_ns, &mut |_| {});
        commands.now().digital_out
    }

    #[test]
    fn events_are_taken_up_at_their_own_times() {
        let mut commands = Commands::new();
        commands.note(&setpoint(
            7,
            10,
            &[(3, true, 1_000_000), (3, false, 2_500_000)],
        ));
        assert_eq!(on_at(&mut commands, 50 * MS, 41 * MS - 1), 0);
        assert_eq!(on_at(&mut commands, 50 * MS, 41 * MS), 8);
        assert_eq!(on_at(&mut commands, 52 * MS, 43 * MS), 0);
        // Another interpolator has nothing on, and what the one before wanted does not come.
        commands.note(&setpoint(7, 11, &[(3, true, 0), (4, true, 3_000_000)]));
        assert_eq!(on_at(&mut commands, 53 * MS, 45 * MS), 8);
        commands.note(&setpoint(8, 12, &[]));
        assert_eq!(on_at(&mut commands, 54 * MS, 60 * MS), 0);
    }

    #[test]
    fn the_record_counts_where_events_were_lost_or_came_before() {
        let mut commands = Commands::new();
        let mut record = Auxiliary {
            boot_id: 7,
            digital_out: 5,
            ..Auxiliary::default()
        };
        commands.hear(&record, 0);
        assert_eq!(on_at(&mut commands, 100 * MS, 0), 0);
        assert_eq!(on_at(&mut commands, 101 * MS, 0), 5);
        // It is there before the event is due, which is not to come early for that.
        commands.note(&setpoint(7, 100, &[(1, true, 0)]));
        record.digital_out = 7;
        commands.hear(&record, 200 * MS);
        assert_eq!(on_at(&mut commands, 350 * MS, 399 * MS), 5);
        assert_eq!(on_at(&mut commands, 351 * MS, 400 * MS), 7);
        // One that is older than the last event does not undo it.
        commands.note(&setpoint(7, 101, &[(1, false, 0)]));
        assert_eq!(on_at(&mut commands, 352 * MS, 404 * MS), 5);
        record.digital_out = 5;
        commands.hear(&record, 353 * MS);
        assert_eq!(on_at(&mut commands, 500 * MS, 500 * MS), 5);
        // An event that never came.
        record.digital_out = 0;
        commands.hear(&record, 510 * MS);
        assert_eq!(on_at(&mut commands, 600 * MS, 600 * MS), 5);
        assert_eq!(on_at(&mut commands, 611 * MS, 611 * MS), 0);
        // A record of another life is no news of this one.
        record = Auxiliary {
            boot_id: 6,
            digital_out: 1,
            ..Auxiliary::default()
        };
        commands.hear(&record, 700 * MS);
        assert_eq!(on_at(&mut commands, 900 * MS, 900 * MS), 0);
    }
}
