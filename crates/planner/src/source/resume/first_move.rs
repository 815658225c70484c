//! The first move of the rest: it begins where the machine stands.

use glidepath_geometry::AxisVector;
use glidepath_program::{Item, ItemKind, PathMode};

use super::remainder::Remainder;
use super::remaining_segment::remaining_segment;
use super::search::{MachineSearch, Standpoint};
use crate::run::error::RunError;
use crate::run::nearness::{ROUNDING_MM, distance};
use crate::run::resume_error::ResumeError;
use crate::source::item_source::{ItemSource, Supply};

/// Items in front of the first move that are looked at.
const LOOK_AHEAD: usize = 64;

impl<S: ItemSource> Remainder<S> {
    /// Leaves out so many items that are executed already.
    pub(super) fn pass(&mut self, count: usize) {
        for passed in self.ahead.drain(..count) {
            self.outputs.take(&passed);
        }
        self.first_block += u32::try_from(count).unwrap_or(u32::MAX);
    }

    /// Has a move begin where the machine stands on it. Returns whether nothing is left of it.
    pub(super) fn begin_move(&mut self, index: usize, found: &Standpoint) -> bool {
        let Some(ItemKind::Move { segment, mode, .. }) =
            self.ahead.get_mut(index).map(|item| &mut item.kind)
        else {
            return false;
        };
        *segment = remaining_segment(segment, &self.point.position, found.part);
        if found.distance_mm > ROUNDING_MM {
            *mode = PathMode::ExactStop;
        }
        distance(&(segment.end() - segment.start())) <= 0.0 && found.part > 0.5
    }

    /// Has the first move behind events and dwells begin where the machine stands. One that is on that move already has
    /// passed them. `place` is where the program is in front of them, if that is known.
    pub(super) fn meet_machine(
        &mut self,
        place: Option<AxisVector>,
        tolerance_mm: f64,
    ) -> Result<(), RunError> {
        let stands = self.point.position;
        let Some((index, way)) = self.first_move() else {
            let away = place.map_or_else(AxisVector::zeros, |place| stands - place);
            if distance(&away) > tolerance_mm + ROUNDING_MM {
                return Err(self.point.off_path(0, Some(away)));
            }
            self.stands = (away.amax() > 0.0).then_some(stands);
            return Ok(());
        };
        let ItemKind::Move { segment, rate, .. } = way.kind else {
            return Ok(());
        };
        if segment.start() == stands {
            return Ok(());
        }
        if rate.is_synchronised() {
            return Err(ResumeError::InThread { line: way.line }.into());
        }
        let mut search = MachineSearch::new(self.point, tolerance_mm);
        search.look_at(&way);
        let Some(found) = search.best else {
            return Err(self.point.off_path(way.line, search.away()));
        };
        // At an event at rest it would have stood, and told so: rounding alone puts it behind one that is to come.
        let is_at_rest =
            |item: &Item| matches!(item.kind, ItemKind::Event(event) if event.is_at_rest());
        let stands_before = self.ahead.iter().take(index).any(is_at_rest);
        if found.part > 0.0 && !stands_before {
            self.pass(index);
            if self.begin_move(0, &found) {
                self.pass(1);
            }
        } else {
            self.begin_move(index, &found);
        }
        Ok(())
    }

    /// The first move that is known, and its place in what was read. What is asked in front of it is asked again first.
    fn first_move(&mut self) -> Option<(usize, Item)> {
        let is_move = |item: &Item| matches!(item.kind, ItemKind::Move { .. });
        loop {
            if let Some(index) = self.ahead.iter().position(is_move) {
                return Some((index, self.ahead[index]));
            }
            if self.last.is_some() || self.ahead.len() >= LOOK_AHEAD {
                return None;
            }
            match self.source.next_item() {
                Supply::Item(item) => self.ahead.push_back(item),
                Supply::Pending => return None,
                last @ (Supply::Probe | Supply::End | Supply::Refused(_)) => self.last = Some(last),
            }
        }
    }

    /// Nothing goes on in the middle of a pass: the angle at which it began is not known any more.
    pub(super) fn refuse_thread(&self) -> Result<(), RunError> {
        match self.ahead.front() {
            Some(Item {
                kind: ItemKind::Move { rate, .. },
                line,
                ..
            }) if rate.is_synchronised() => Err(ResumeError::InThread { line: *line }.into()),
            _ => Ok(()),
        }
    }
}
