//! Words of FANUC that stand for others: on a lathe R, C, I, K and A of G1 for those behind a comma, behind
//! G43.5 I, J and K for the direction of the tool.

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::setup::machine::Machine;
use crate::syntax::block::{Block, CornerKind, CornerWord};
use crate::syntax::modes::Motion;
use crate::syntax::named_word::Named;

impl Block {
    /// Takes R, C, I and K of a straight move for `,R` and `,C`, and A for `,A`, where the machine has
    /// no axis of that letter. The sign of a corner says which way the next move goes, which that
    /// move says itself.
    pub(crate) fn take_words_of_lathes(
        &mut self,
        motion: Option<Motion>,
        machine: Machine,
    ) -> Outcome<()> {
        if motion != Some(Motion::Linear) || self.codes.non_modal.is_some() {
            return Ok(());
        }
        let corners = [
            (b'R', CornerKind::Round, true),
            (b'C', CornerKind::Chamfer, !machine.has(Axis::C)),
            (b'I', CornerKind::Chamfer, true),
            (b'K', CornerKind::Chamfer, true),
        ];
        for (letter, kind, is_free) in corners {
            if !is_free || self.corner.is_some() {
                continue;
            }
            if let Some((value, span)) = self.take(letter) {
                self.corner = Some(CornerWord {
                    kind,
                    value: value.abs() * self.length_in_count(letter),
                    has_no_point: false,
                    span,
                });
            }
        }
        if !machine.has(Axis::A)
            && let Some((degrees, span)) = self.take(b'A')
        {
            self.named.add(Named::LineAngle, degrees, span)?;
        }
        Ok(())
    }

    /// Takes I, J and K of a straight move for the direction of the tool.
    pub(crate) fn take_vector(&mut self, motion: Option<Motion>) -> Outcome<()> {
        if !matches!(motion, Some(Motion::Rapid | Motion::Linear)) {
            return Ok(());
        }
        for (axis, letter) in [b'I', b'J', b'K'].into_iter().enumerate() {
            if let Some((value, span)) = self.take(letter) {
                self.named.add(Named::Vector(axis), value, span)?;
            }
        }
        Ok(())
    }
}
