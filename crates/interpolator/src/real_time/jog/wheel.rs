//! A handwheel: what it counts, as a place or as a velocity.

use crate::shared::message::jog_demand::Demand;
use glidepath_geometry::AxisVector;
use glidepath_link::JogMode;

/// The wheel that was heard of last.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wheel {
    client: Option<u64>,
    /// What it had counted.
    counts: AxisVector,
    heard_ns: u64,
    /// When it turned last, and how fast, mm/s.
    turned_ns: u64,
    speed: AxisVector,
    quiet_ns: u64,
}

impl Wheel {
    /// A wheel that gives a velocity stands if it counts nothing for `quiet_ns`.
    pub(crate) fn new(quiet_ns: u64) -> Self {
        Self {
            client: None,
            counts: AxisVector::zeros(),
            heard_ns: 0,
            turned_ns: 0,
            speed: AxisVector::zeros(),
            quiet_ns,
        }
    }

    /// How far it turned since it was heard of last, mm: nothing the first time. To be asked for
    /// every demand, followed or not, so that what was turned meanwhile is not made up for later.
    /// A demand that says it was sent later than now was not: a wrong stamp must not make the
    /// counts after it look as if they came all at once.
    #[allow(
        clippy::cast_precision_loss,
        reason = "times between demands are short"
    )]
    pub(crate) fn turn(&mut self, demand: &Demand, now_ns: u64) -> AxisVector {
        let sent_ns = demand.sent_ns.min(now_ns);
        if !matches!(demand.mode, JogMode::Wheel | JogMode::WheelVelocity) {
            self.client = None;
            return AxisVector::zeros();
        }
        let is_known = self.client == Some(demand.client);
        let turned = if is_known {
            (demand.value - self.counts) * demand.scale
        } else {
            AxisVector::zeros()
        };
        if turned.amax() > 0.0 {
            // After a pause the first counts say little about the velocity: as if they were made
            // within the time after which it stands.
            let since_ns = sent_ns.saturating_sub(self.heard_ns);
            let since_ns = since_ns.clamp(1_000_000, self.quiet_ns.max(1_000_000));
            self.speed = turned * (1e9 / since_ns as f64);
            self.turned_ns = sent_ns;
        }
        if !is_known || sent_ns > self.heard_ns {
            self.heard_ns = sent_ns;
        }
        (self.client, self.counts) = (Some(demand.client), demand.value);
        turned
    }

    /// How fast it turns, mm/s.
    pub(crate) fn speed(&self, now_ns: u64) -> AxisVector {
        if now_ns >= self.turned_ns.saturating_add(self.quiet_ns) {
            return AxisVector::zeros();
        }
        self.speed
    }
}
