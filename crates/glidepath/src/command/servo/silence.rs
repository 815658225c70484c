//! The setpoints that stayed away until the joints stopped by themselves, as feedback tells it.

use glidepath_link::servo::{OwnStop, Servo, ServoSettings};
use glidepath_link::{Feedback, Loss, Setpoint, Subscriber};

/// The silence by which the joints stopped.
#[derive(Debug, Clone, Copy)]
pub(super) struct Silence {
    /// How long setpoints may stay away, s.
    patience_t: f64,
    /// Own stops so far.
    stops: u64,
    /// The life of the interpolator that was silent last.
    of: Option<u64>,
}

impl Silence {
    #[allow(clippy::cast_precision_loss, reason = "some milliseconds")]
    pub(super) const fn new(settings: &ServoSettings) -> Self {
        Self {
            patience_t: settings.patience_ns as f64 * 1e-9,
            stops: 0,
            of: None,
        }
    }

    /// Looks whether the joints have stopped.
    pub(super) fn look<S: Subscriber<Setpoint>>(&mut self, servo: &Servo<S>) {
        let stops = servo.counts().stops;
        if stops > self.stops {
            self.stops = stops;
            self.of = servo.last().map(|last| last.boot_id);
        }
    }

    /// Tells that to the one that was silent, until the position is taken over anew. Another one has lost
    /// nothing.
    pub(super) fn tell<S: Subscriber<Setpoint>>(&self, servo: &Servo<S>, feedback: &mut Feedback) {
        if self.is_told(servo) {
            self.put(feedback);
        }
    }

    /// Whether that is to be told now.
    pub(super) fn is_told<S: Subscriber<Setpoint>>(&self, servo: &Servo<S>) -> bool {
        let is_same = servo.last().map(|last| last.boot_id) == self.of;
        is_same && matches!(servo.stopped(), Some(OwnStop::Silence))
    }

    /// Puts it into feedback.
    pub(super) const fn put(&self, feedback: &mut Feedback) {
        feedback.loss = Loss::Setpoints.code();
        feedback.loss_value = self.patience_t;
    }
}
