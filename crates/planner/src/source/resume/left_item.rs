//! The item at which a program was left: whether it is done, and where the rest begins on it.

use glidepath_geometry::AxisVector;
use glidepath_program::{Event, ItemKind};

use super::remainder::Remainder;
use super::search::MachineSearch;
use crate::run::error::RunError;
use crate::source::item_source::{ItemSource, Settled};

impl<S: ItemSource> Remainder<S> {
    /// Drops what lies before the point.
    pub(super) fn cut(
        &mut self,
        search: MachineSearch,
        place: Option<AxisVector>,
    ) -> Result<(), RunError> {
        let tolerance_mm = search.tolerance_mm();
        let line = self.ahead.front().map_or(0, |item| item.line);
        match self.ahead.front().map(|item| item.kind) {
            // A dwell begins again; an event has happened, unless it is not answered yet.
            Some(ItemKind::Dwell(_)) => return self.meet_machine(place, tolerance_mm),
            Some(ItemKind::Event(event)) => {
                if self.is_open(event)? {
                    self.tell_again(event);
                    return self.meet_machine(place, tolerance_mm);
                }
                let told = self.ahead.pop_front();
                told.iter().for_each(|item| self.outputs.take(item));
                self.first_block += 1;
                self.meet_machine(place, tolerance_mm)?;
                return self.refuse_thread();
            }
            Some(ItemKind::Move { .. }) | None => {}
        }
        let Some(found) = search.best else {
            return Err(self.point.off_path(line, search.away()));
        };
        self.pass(found.item);
        if self.begin_move(0, &found) {
            self.pass(1);
        }
        self.refuse_thread()
    }

    /// Whether an event, at which the program was left, is not done. A wait for an input is, as soon as the
    /// program has its answer.
    fn is_open(&mut self, event: Event) -> Result<bool, RunError> {
        Ok(match event {
            Event::MCode(66) => self.source.settle(None)? == Settled::Open,
            _ => self.point.unanswered,
        })
    }

    /// Puts in front of an event, with which the rest begins, what belongs to it.
    fn tell_again(&mut self, event: Event) {
        let mut items = self.codes.again(event);
        let count = u32::try_from(items.len()).unwrap_or(u32::MAX);
        self.first_block = self.first_block.saturating_sub(count).max(1);
        items.append(&mut self.ahead);
        self.ahead = items;
    }
}
