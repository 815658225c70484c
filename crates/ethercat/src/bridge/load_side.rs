//! The second encoder of a joint, at a terminal: where the joint is by it, and how far it is from what the drive counts.
//!
//! The drive goes on counting what it is led by. Where the joint is where the encoder says, that is what the drive's
//! counts are told to mean for as long as it has no power; from then on both are compared.

use crate::axis::Axis;
use crate::terminal::{EncoderUse, JointEncoderSettings};

/// The second encoder of a joint.
#[derive(Debug)]
pub(super) struct LoadSide {
    settings: JointEncoderSettings,
    /// Where the joint is when its drive counts zero, by the file.
    drive_offset: f64,
    /// What is added to what the encoder says, once it is known.
    base: Option<f64>,
    was_homed: bool,
    /// How far the encoder is from the drive, mm or degrees.
    apart: f64,
}

impl LoadSide {
    pub(super) const fn new(settings: JointEncoderSettings, drive_offset: f64) -> Self {
        Self {
            settings,
            drive_offset,
            base: None,
            was_homed: false,
            apart: 0.0,
        }
    }

    /// The drive counts anew, maybe elsewhere.
    pub(super) const fn begin(&mut self, axis: &mut Axis) {
        axis.settings.home_offset = self.drive_offset;
        (self.base, self.apart) = (None, 0.0);
        self.was_homed = axis.is_homed();
    }

    /// Takes what the encoder and the drive say; gives where the joint is. The drive's word counts while the encoder is
    /// not heard.
    pub(super) fn sample(&mut self, said: Option<f64>, axis: &mut Axis, counts: i64) -> f64 {
        let is_homed = axis.is_homed();
        if is_homed && !core::mem::replace(&mut self.was_homed, is_homed) {
            // It counts from its home now.
            axis.settings.home_offset = self.drive_offset;
            self.base = None;
        }
        self.was_homed = is_homed;
        let of_drive = axis.settings.place(counts);
        let Some(said) = said else {
            return of_drive;
        };
        let base = match self.settings.home_offset {
            Some(_) => 0.0,
            None => *self.base.get_or_insert(of_drive - said),
        };
        let place = said + base;
        self.apart = place - of_drive;
        match self.settings.used {
            EncoderUse::Watch => of_drive,
            EncoderUse::Position => {
                if !axis.is_led() {
                    axis.settings.home_offset += self.apart;
                    self.apart = 0.0;
                }
                place
            }
        }
    }

    /// How far both are apart, if that is more than they may be.
    pub(super) fn beyond(&self) -> Option<f64> {
        (self.apart.abs() > self.settings.apart).then_some(self.apart)
    }

    /// Whether it stays so without power.
    pub(super) fn stays(&self) -> bool {
        self.settings.used == EncoderUse::Watch
    }
}
