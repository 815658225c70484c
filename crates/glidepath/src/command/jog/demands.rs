//! The demands of one client.

use glidepath_geometry::AXES;
use glidepath_link::{JogDemand, JogMode, LinkError, Publisher, Status};
use glidepath_realtime::{Clock as _, Monotonic};

/// One demand of a client, to be known again.
#[derive(Debug, Clone, Copy)]
pub(in crate::command) struct Asked {
    client: u64,
    number: u64,
}

impl Asked {
    #[cfg(test)]
    pub(in crate::command) const fn of(client: u64, number: u64) -> Self {
        Self { client, number }
    }

    /// Whether one from `first` to this one moves the axes, or was the last that did.
    pub(in crate::command) fn is_one_since(&self, first: &Self, status: &Status) -> bool {
        status.jog_client == self.client
            && (first.number..=self.number).contains(&status.jog_number)
    }

    /// Whether it moves the axes, or was the last that did.
    pub(in crate::command) const fn is_followed(&self, status: &Status) -> bool {
        status.jog_client == self.client && status.jog_number == self.number
    }
}

/// What a client demands, and its way to the interpolator.
pub(in crate::command) struct Demands {
    port: Box<dyn Publisher<JogDemand>>,
    demand: JogDemand,
}

impl Demands {
    /// A client that demands nothing yet.
    pub(in crate::command) fn new(port: Box<dyn Publisher<JogDemand>>) -> Self {
        // No two processes live at the same time with the same number, and none begins with the
        // number of one before at the same nanosecond.
        let client = (u64::from(std::process::id()) << 40) ^ Monotonic.now_ns();
        let demand = JogDemand {
            client,
            ..nothing()
        };
        Self { port, demand }
    }

    /// Demands something new, that was asked for at this time.
    pub(in crate::command) fn ask(
        &mut self,
        asked_ns: u64,
        mode: JogMode,
        value: [f64; AXES],
        most_v: f64,
        by_joint: bool,
    ) -> Result<(), LinkError> {
        let mask = (0..AXES).filter(|axis| value.get(*axis).is_some_and(|v| *v != 0.0));
        self.demand.mask = mask.fold(0, |mask, axis| mask | 1 << axis);
        self.demand.number += 1;
        self.demand.asked_ns = asked_ns;
        self.demand.mode = mode.code();
        self.demand.value = value;
        self.demand.velocity_v = most_v;
        self.demand.by_joint = by_joint.into();
        self.again()
    }

    /// What was asked for last.
    pub(in crate::command) const fn asked(&self) -> Asked {
        Asked {
            client: self.demand.client,
            number: self.demand.number,
        }
    }

    /// Says that the client lives, and wants what it wanted.
    pub(in crate::command) fn again(&mut self) -> Result<(), LinkError> {
        self.demand.sent_ns = Monotonic.now_ns();
        self.port.publish(&self.demand)
    }

    /// Lets go.
    pub(in crate::command) fn let_go(&mut self) -> Result<(), LinkError> {
        self.ask(Monotonic.now_ns(), JogMode::None, [0.0; AXES], 0.0, false)
    }
}

/// A demand with nothing in it.
const fn nothing() -> JogDemand {
    JogDemand {
        client: 0,
        number: 0,
        sent_ns: 0,
        asked_ns: 0,
        mode: 0,
        mask: 0,
        by_joint: 0,
        reserved: 0,
        velocity_v: 0.0,
        scale: 0.0,
        value: [0.0; AXES],
    }
}
