//! The change of a gear, as the drive of the spindle is led through it.

use super::super::gear_settings::Gear;
use super::super::gearbox::{GearCycle, GearTrouble};
use super::{Phase, SpindleCycle, SpindleDrive, SpindleLoss};
use crate::event::Event;

impl SpindleDrive {
    /// Has the gear come in that is commanded. Returns whether it is in, so that the spindle may turn.
    pub(super) fn change_gear(
        &mut self,
        cycle: &SpindleCycle,
        tell: &mut dyn FnMut(Event),
    ) -> bool {
        let may_shift = self.may_shift(cycle);
        let Some(gearbox) = &mut self.gearbox else {
            return true;
        };
        let before = gearbox.present();
        let trouble = gearbox.step(GearCycle {
            now_ns: cycle.now_ns,
            inputs: cycle.inputs,
            commanded: cycle.gear,
            is_asked: cycle.is_gear_asked,
            may_shift,
            is_to_turn: cycle.wanted_rpm != 0.0,
        });
        let (present, is_in) = (gearbox.present(), gearbox.is_in());
        if present != before
            && let Some(gear) = gearbox.settings().of(present).copied()
        {
            self.turn_in(&gear);
        }
        let is_known = matches!(self.phase, Phase::Failed | Phase::Resetting(_));
        if let Some(trouble) = trouble.filter(|_| self.is_present && !is_known) {
            let (gear, event) = match trouble {
                GearTrouble::NotIn(gear) => (gear, Event::GearNotIn(gear)),
                GearTrouble::Lost(gear) => (gear, Event::GearLost(gear)),
                GearTrouble::Unknown => (0, Event::GearUnknown),
            };
            self.fail(SpindleLoss::Gear(gear));
            tell(event);
        }
        is_in
    }

    /// Whether the motor is to turn to and fro until a gear is in. Where nobody is to be obeyed it stands.
    pub(super) fn swings(&self, cycle: &SpindleCycle) -> bool {
        let gearbox = self.gearbox.as_ref();
        let is_to_swing = gearbox
            .is_some_and(|gearbox| gearbox.settings().swing.is_some() && gearbox.is_awaited());
        is_to_swing && !cycle.is_safe
    }

    /// Whether the spindle is as it has to be where gears are changed.
    fn may_shift(&self, cycle: &SpindleCycle) -> bool {
        let gearbox = self.gearbox.as_ref();
        let has_swing = gearbox.is_some_and(|gearbox| gearbox.settings().swing.is_some());
        let is_so = match self.phase {
            Phase::Shifting => has_swing,
            Phase::Off => !has_swing && self.wanted_rpm == 0.0 && self.has_settled(),
            _ => false,
        };
        is_so && cycle.is_present && !cycle.is_safe
    }

    /// A gear is in: its speeds are those of the spindle from here on.
    fn turn_in(&mut self, gear: &Gear) {
        self.present = self.wired.settings.in_gear(gear);
        self.actual_rpm = self.present.rpm(self.said.actual);
        self.told_rpm = self.actual_rpm;
    }
}
