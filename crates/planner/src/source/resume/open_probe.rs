//! The probing move at which a program was left: what is left of it is gone on with.

use std::collections::VecDeque;

use glidepath_gcode::Probed;
use glidepath_geometry::Segment;
use glidepath_program::{Item, ItemKind, PathMode};

use super::remainder::Remainder;
use super::remaining_segment::remaining_segment;
use super::search::MachineSearch;
use crate::run::error::RunError;
use crate::run::nearness::{ROUNDING_MM, distance};
use crate::source::input_arbiter::InputResult;
use crate::source::item_source::{ItemSource, Settled, Supply};

impl<S: ItemSource> Remainder<S> {
    /// Goes on behind the event that begins a search, with what is left of its move, or behind it.
    pub(super) fn go_on_looking(&mut self, event: Item, tolerance_mm: f64) -> Result<(), RunError> {
        let way = match self.source.next_item() {
            Supply::Item(item) => item,
            Supply::Refused(refusal) => return Err(refusal.into()),
            Supply::Pending | Supply::Probe | Supply::End => {
                return Err(self.point.off_path(event.line, None));
            }
        };
        let mut search = MachineSearch::new(self.point, tolerance_mm);
        search.look_at(&way);
        let (ItemKind::Move { segment, rate, .. }, Some(found)) = (way.kind, search.best) else {
            return Err(self.point.off_path(way.line, search.away()));
        };
        let to = |segment| Item {
            kind: ItemKind::Move {
                segment,
                rate,
                mode: PathMode::ExactStop,
            },
            ..way
        };
        let stands = self.point.position;
        let is_at_end = distance(&(segment.end() - stands)) <= ROUNDING_MM;
        // It was found, or everything was looked through, before the program was told.
        let nothing = is_at_end.then_some(Probed {
            contact: None,
            was_so: false,
            stands,
        });
        let known = self.point.found.or(nothing).map(InputResult::Probe);
        match self.source.settle(known)? {
            Settled::Answered(InputResult::Probe(Probed { stands: then, .. })) => {
                let away = stands - then;
                let away_mm = distance(&away);
                if away_mm > tolerance_mm + ROUNDING_MM {
                    return Err(self.point.off_path(way.line, Some(away)));
                }
                if away_mm > 0.0 {
                    self.ahead = VecDeque::from([to(Segment::line(stands, then))]);
                } else {
                    self.first_block += 1;
                }
            }
            _ => {
                let rest = remaining_segment(&segment, &stands, found.part);
                self.ahead = VecDeque::from([event, to(rest)]);
                self.first_block = self.first_block.saturating_sub(1).max(1);
            }
        }
        Ok(())
    }
}
