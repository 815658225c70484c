//! What a subscriber saw of the setpoints: how many came, and how many did not.

use glidepath_link::Setpoint;

/// Counts of a subscriber.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Reception {
    /// Setpoints received.
    pub received: u64,
    /// Setpoints that were published and did not arrive: gaps in their numbers.
    pub lost: u64,
    /// Changes to another life of the interpolator.
    pub restarts: u64,
    last: Option<(u64, u64)>,
}

impl Reception {
    /// Counts a setpoint.
    pub const fn count(&mut self, setpoint: &Setpoint) {
        self.received += 1;
        match self.last {
            Some((life, number)) if life == setpoint.boot_id => {
                self.lost += setpoint.number.saturating_sub(number.saturating_add(1));
            }
            Some(_) => self.restarts += 1,
            None => {}
        }
        self.last = Some((setpoint.boot_id, setpoint.number));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_loss_and_another_life_is_not() {
        let mut reception = Reception::default();
        for (boot_id, number) in [(7, 5), (7, 6), (7, 9), (8, 0), (8, 1)] {
            let setpoint = Setpoint {
                boot_id,
                number,
                ..bytemuck::Zeroable::zeroed()
            };
            reception.count(&setpoint);
        }
        assert_eq!(
            (reception.received, reception.lost, reception.restarts),
            (5, 2, 1)
        );
    }
}
