//! What setpoints tell around an abort of whether the tool is in a thread.

use crate::config::MachineConfig;
use glidepath_link::{Ipc, LinkConfig, Setpoint, Subscriber, Transport as _};
use glidepath_program::FrameFlags;
use glidepath_realtime::{Clock as _, Monotonic};

/// Hears setpoints, from before an abort until the machine rests. They have room for so many that are not taken: older
/// ones make room for later ones, so they are taken all the time.
pub(super) struct ThreadWatch {
    /// `None` where they cannot be heard.
    setpoints: Option<Box<dyn Subscriber<Setpoint>>>,
    /// Since when they are heard, ns of the host's steady clock. The last one before is heard, too.
    since_ns: u64,
    /// The number of the last one.
    last: Option<u64>,
    was_in_pass: bool,
    has_missed: bool,
}

impl ThreadWatch {
    /// Hears those of an instance from now on.
    pub(super) fn start(link: &LinkConfig, config: &MachineConfig) -> Self {
        let setpoints = Ipc::connect(link).and_then(|link| link.setpoint_source());
        // Where the spindle is an axis, taps are moves like others.
        let is_axis = config.spindle.is_some_and(|spindle| spindle.axis.is_some());
        Self {
            was_in_pass: is_axis,
            ..Self::of(setpoints.ok(), Monotonic.now_ns())
        }
    }

    const fn of(setpoints: Option<Box<dyn Subscriber<Setpoint>>>, since_ns: u64) -> Self {
        Self {
            setpoints,
            since_ns,
            last: None,
            was_in_pass: false,
            has_missed: false,
        }
    }

    /// Takes those that have come.
    pub(super) fn look(&mut self) {
        let Some(setpoints) = &mut self.setpoints else {
            return;
        };
        loop {
            match setpoints.take() {
                Ok(Some(setpoint)) => {
                    self.has_missed |= match self.last.replace(setpoint.number) {
                        Some(last) => setpoint.number != last + 1,
                        None => setpoint.scheduled_ns > self.since_ns,
                    };
                    self.was_in_pass |= setpoint.has(FrameFlags::SYNC);
                }
                Ok(None) => return,
                Err(_) => {
                    self.has_missed = true;
                    return;
                }
            }
        }
    }

    /// Whether the tool may be in a thread, which a lift would tear out: in a pass that follows the spindle, or anywhere
    /// in a program where the spindle is an axis. Of what was not heard nobody knows.
    pub(super) fn may_be_in_thread(&mut self) -> bool {
        self.look();
        self.was_in_pass || self.has_missed || self.last.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable as _;
    use glidepath_link::{Capacity, InProcess};

    const PASS: u32 = FrameFlags::SYNC.0;

    /// Whether the tool is taken to be in a thread behind setpoints with these flags, of which four have room, and which
    /// are looked at after each, or at the end.
    fn may_be(flags: &[u32], looks: bool) -> bool {
        let link = InProcess::new(Capacity {
            setpoints: 4,
            ..Capacity::default()
        });
        let mut sink = link.setpoint_sink().unwrap();
        let mut watch = ThreadWatch::of(link.setpoint_source().ok(), 7_000);
        for (number, flags) in (7..).zip(flags) {
            let setpoint = Setpoint {
                number,
                scheduled_ns: 1000 * number,
                flags: *flags,
                ..Setpoint::zeroed()
            };
            sink.publish(&setpoint).unwrap();
            if looks {
                watch.look();
            }
        }
        watch.may_be_in_thread()
    }

    #[test]
    fn a_pass_is_known_for_as_long_as_the_abort_takes() {
        let mut flags = [0; 40];
        for looks in [false, true] {
            assert!(!may_be(&flags[..4], looks));
            assert!(may_be(&[0, PASS, 0], looks));
        }
        assert!(!may_be(&flags, true));
        flags[1] = PASS;
        assert!(may_be(&flags, true), "and rests for long then");
    }

    #[test]
    fn what_was_not_heard_may_have_been_a_pass() {
        assert!(may_be(&[], true));
        assert!(may_be(&[0; 40], false), "the first ones were overwritten");
        assert!(ThreadWatch::of(None, 0).may_be_in_thread());
    }
}
