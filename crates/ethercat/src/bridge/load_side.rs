//! The second encoder of a joint, at a terminal: where the joint is by it, and how far it is from what the drive counts.
//!
//! The drive goes on counting what it is led by. Where the joint is where the encoder says, that is what the drive's
//! counts are told to mean for as long as it has no power; from then on both are compared.
//!
//! A load that slips on a motor at rest is where the encoder says. An encoder that stands while the motor turns, or that
//! is elsewhere from one sample to the next, is not believed: the joint gets no power until the process ends. A new life
//! of the bus takes nothing of that back.

use crate::axis::Axis;
use crate::event::Event;
use crate::terminal::{EncoderUse, JointEncoderSettings};

/// What has happened since a joint lost its power.
#[derive(Debug)]
struct WithoutPower {
    /// Where its drive was then, mm or degrees from its zero.
    drive_at: f64,
    /// How far the load has gone from the drive since.
    slipped: f64,
    is_told: bool,
}

/// The second encoder of a joint.
#[derive(Debug)]
pub(super) struct LoadSide {
    settings: JointEncoderSettings,
    /// Where the joint is when its drive counts zero, by the file.
    drive_offset: f64,
    /// How far the joint moves in a period at most, mm or degrees.
    most: f64,
    /// What is added to what the encoder says, once it is known.
    base: Option<f64>,
    /// What it said last, and how many samples were without it since.
    said: Option<f64>,
    unheard: u32,
    was_homed: bool,
    was_homing: bool,
    /// How far the encoder is from the drive, mm or degrees.
    apart: f64,
    /// How far it was when one of both was not to be believed any more: no power in this process.
    held: Option<f64>,
    without_power: Option<WithoutPower>,
    told: Option<Event>,
}

impl LoadSide {
    /// Beside a drive whose joint is at `drive_offset` when it counts zero, and moves by `most` in a period at most.
    pub(super) const fn new(settings: JointEncoderSettings, drive_offset: f64, most: f64) -> Self {
        Self {
            settings,
            drive_offset,
            most,
            base: None,
            said: None,
            unheard: 0,
            was_homed: false,
            was_homing: false,
            apart: 0.0,
            held: None,
            without_power: None,
            told: None,
        }
    }

    /// The drive counts anew, maybe elsewhere.
    pub(super) fn begin(&mut self, axis: &mut Axis) {
        if self.stays() && self.is_beyond() {
            self.held = Some(self.apart);
        }
        if axis.settings.homing.is_some() {
            // What its load slipped by ends with its home.
            axis.settings.home_offset = self.drive_offset;
        }
        (self.base, self.said, self.apart) = (None, None, 0.0);
        (self.without_power, self.was_homing) = (None, false);
        self.was_homed = axis.is_homed();
    }

    /// Takes what the encoder and the drive say; gives where the joint is. The drive's word counts while the encoder is
    /// not heard.
    pub(super) fn sample(&mut self, said: Option<f64>, axis: &mut Axis, counts: i64) -> f64 {
        self.look_at_home(axis);
        let of_drive = axis.settings.place(counts);
        let Some(said) = said else {
            self.unheard = self.unheard.saturating_add(1);
            return of_drive;
        };
        let base = match self.settings.home_offset {
            Some(_) => 0.0,
            None => *self.base.get_or_insert(of_drive - said),
        };
        let place = said + base;
        self.apart = place - of_drive;
        let most = self.settings.apart + self.most * f64::from(self.unheard.saturating_add(1));
        self.unheard = 0;
        let before = self.said.replace(said);
        let is_compared = axis.is_led() && !axis.is_homing();
        if self.stays() && self.is_beyond() && (is_compared || self.held.is_some()) {
            self.held = Some(self.apart);
        }
        if axis.is_led() {
            self.without_power = None;
        } else if self.settings.used == EncoderUse::Position {
            if let Some(before) = before {
                let has_jumped = (said - before).abs() > most;
                self.slip(axis, of_drive, has_jumped);
            }
            axis.settings.home_offset += self.apart;
            self.apart = 0.0;
        }
        match self.settings.used {
            EncoderUse::Watch => of_drive,
            EncoderUse::Position => place,
        }
    }

    /// Where the drive has found its home, or may have left off in the middle, the encoder counts from there.
    fn look_at_home(&mut self, axis: &mut Axis) {
        let (is_homed, is_homing) = (axis.is_homed(), axis.is_homing());
        if is_homed && !self.was_homed {
            axis.settings.home_offset = self.drive_offset;
            self.base = None;
        } else if self.was_homing && !is_homing {
            self.base = None;
        }
        (self.was_homed, self.was_homing) = (is_homed, is_homing);
    }

    /// Adds what is apart to what has slipped without power.
    fn slip(&mut self, axis: &mut Axis, of_drive: f64, has_jumped: bool) {
        let drive_at = of_drive - axis.settings.home_offset;
        let without_power = self.without_power.get_or_insert(WithoutPower {
            drive_at,
            slipped: 0.0,
            is_told: false,
        });
        without_power.slipped += self.apart;
        let slipped = without_power.slipped;
        if slipped.abs() <= self.settings.apart {
            return;
        }
        // Nothing slips back as its motor turns on: the encoder does not count, or the motor's does and should not.
        let turned = drive_at - without_power.drive_at;
        let stands = turned.abs() > self.settings.apart && turned * slipped < 0.0;
        let was_held = self.held.is_some();
        if was_held || has_jumped || stands {
            self.held = Some(slipped);
        }
        let was_told = core::mem::replace(&mut without_power.is_told, true);
        if !was_told || self.held.is_some() != was_held {
            let joint = axis.settings.joint;
            self.told = Some(Event::LoadSlipped(joint, slipped, self.held.is_some()));
        }
        axis.lose_home();
    }

    /// What there is to tell.
    pub(super) const fn take_event(&mut self) -> Option<Event> {
        self.told.take()
    }

    /// How far the joint is from where the drive's counts say, if it is where the encoder says.
    pub(super) fn added(&self) -> f64 {
        match self.settings.used {
            EncoderUse::Watch => 0.0,
            EncoderUse::Position => self.apart,
        }
    }

    /// How far both are apart, if that is more than they may be, and whether it stays so until the process ends.
    pub(super) fn beyond(&self) -> Option<(f64, bool)> {
        let held = self.held.map(|apart| (apart, true));
        held.or_else(|| self.is_beyond().then_some((self.apart, self.stays())))
    }

    const fn is_beyond(&self) -> bool {
        self.apart.abs() > self.settings.apart
    }

    fn stays(&self) -> bool {
        self.settings.used == EncoderUse::Watch
    }
}

#[cfg(test)]
mod tests;
