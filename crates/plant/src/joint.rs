//! A simulated joint with its drive.
//!
//! The drive follows its demand with a lag of first order, x′ = (d − x) / τ, so that it is v·τ behind
//! at the speed v; and it does not begin to move before the demand is further away than stiction
//! holds. Its count begins wherever it stood when it was switched on, until it has found its home.

use glidepath_link::servo::JointState;

/// The homing of a drive by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HomeSettings {
    /// Where the switch closes, mm or degrees from the middle of the machine; it stays closed beyond.
    pub switch: f64,
    /// How fast it goes there, mm/s or °/s, positive.
    pub velocity: f64,
    /// What the count is at the switch.
    pub position: f64,
}

/// A home switch that the controller looks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SwitchSettings {
    /// Where its cam begins and ends, mm or degrees from the middle of the machine.
    pub cam: (f64, f64),
    /// How long its contact bounces after each change, ns.
    pub bounce_ns: u64,
}

/// A joint. By default it is exact, at rest in the middle, and knows where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointSettings {
    /// Where it stands at the start, mm or degrees from the middle of the machine.
    pub start: f64,
    /// What its drive counts there.
    pub count: f64,
    /// Lag, s; 0 for none.
    pub lag_t: f64,
    /// How far the demand has to be away for the joint to begin to move, mm or degrees.
    pub stiction: f64,
    /// How long the drive takes to have power, ns.
    pub power_up_ns: u64,
    /// Where the limit switches close.
    pub limits: (f64, f64),
    /// How it finds its home; `None` for an absolute encoder, which knows.
    pub home: Option<HomeSettings>,
    /// The switch by which the controller finds its home.
    pub switch: Option<SwitchSettings>,
    /// Index pulses of its encoder: how far they are from each other, and where one is.
    pub index: Option<(f64, f64)>,
    /// How long its drive takes to be ready for the index pulse that it is told to keep, ns.
    pub index_ready_ns: u64,
}

impl Default for JointSettings {
    fn default() -> Self {
        Self {
            start: 0.0,
            count: 0.0,
            lag_t: 0.0,
            stiction: 0.0,
            power_up_ns: 50_000_000,
            limits: (f64::NEG_INFINITY, f64::INFINITY),
            home: None,
            switch: None,
            index: None,
            index_ready_ns: 20_000_000,
        }
    }
}

/// What a drive does that was told to keep the next index pulse.
#[derive(Debug, Clone, Copy, Default)]
struct KeptPulse {
    /// For how long it was told to, ns.
    told_ns: u64,
    /// The count at the first pulse since it is ready.
    at: Option<f64>,
}

impl KeptPulse {
    /// Whether the drive is ready for it by now.
    const fn is_ready(&self, settings: &JointSettings) -> bool {
        self.told_ns > settings.index_ready_ns
    }
}

fn is_on_cam(settings: &JointSettings, place: f64) -> bool {
    let cam = settings.switch.map(|switch| switch.cam);
    cam.is_some_and(|(low, high)| (low..=high).contains(&place))
}

/// What finding a home takes at least, ns, also where the joint stands there: a drive leaves the
/// switch and comes back to it.
const SEARCH_NS: u64 = 50_000_000;
/// Slower than this a joint sticks, mm/s or °/s.
const STICKING_V: f64 = 0.01;

/// The state of a simulated joint.
#[derive(Debug, Clone)]
pub(crate) struct Joint {
    settings: JointSettings,
    /// From the middle of the machine, which nobody but the switches knows.
    place: f64,
    velocity: f64,
    /// What is added to the place to have the count.
    offset: f64,
    /// How long it was asked to have power, ns.
    asked_ns: u64,
    is_homed: bool,
    is_homing: bool,
    was_asked_home: bool,
    /// For how long it has looked for its home.
    homing_ns: u64,
    pub(crate) fault_code: u32,
    pub(crate) is_stuck: bool,
    pub(crate) has_power_source: bool,
    /// The contact of its switch is dead (false) or stuck (true), whatever the cam does.
    pub(crate) contact: Option<bool>,
    was_on_cam: bool,
    bounces_ns: u64,
    is_closed: bool,
    /// Index pulses so far, and the count at the last one.
    pub(crate) index: (u64, f64),
    /// Its drive is told to keep the next one.
    kept: Option<KeptPulse>,
}

impl Joint {
    pub(crate) fn new(settings: &JointSettings) -> Self {
        Self {
            settings: *settings,
            place: settings.start,
            velocity: 0.0,
            offset: settings.count - settings.start,
            asked_ns: 0,
            is_homed: settings.home.is_none(),
            is_homing: false,
            was_asked_home: false,
            homing_ns: 0,
            fault_code: 0,
            is_stuck: false,
            has_power_source: true,
            contact: None,
            was_on_cam: is_on_cam(settings, settings.start),
            bounces_ns: 0,
            is_closed: is_on_cam(settings, settings.start),
            index: (0, 0.0),
            kept: None,
        }
    }

    pub(crate) fn position(&self) -> f64 {
        self.place + self.offset
    }

    pub(crate) const fn velocity(&self) -> f64 {
        self.velocity
    }

    pub(crate) const fn is_homed(&self) -> bool {
        self.is_homed
    }

    pub(crate) const fn is_homing(&self) -> bool {
        self.is_homing
    }

    pub(crate) fn is_enabled(&self) -> bool {
        self.asked_ns > self.settings.power_up_ns
    }

    pub(crate) fn limits(&self) -> (bool, bool) {
        let (low, high) = self.settings.limits;
        (self.place <= low, self.place >= high)
    }

    pub(crate) fn has_index(&self) -> bool {
        self.settings.index.is_some()
    }

    /// Whether its drive is to keep where the next index pulse is, in a step.
    pub(crate) fn keep_index(&mut self, is_told: bool, step_ns: u64) {
        if !is_told || !self.has_index() {
            self.kept = None;
            return;
        }
        self.kept.get_or_insert_default().told_ns += step_ns;
    }

    /// Whether its drive is ready for the index pulse, and where that was.
    pub(crate) fn kept_index(&self) -> (bool, Option<f64>) {
        let ready = self.kept.filter(|kept| kept.is_ready(&self.settings));
        (ready.is_some(), ready.and_then(|kept| kept.at))
    }

    /// What its contact does after a step, and whether an index pulse was passed in it.
    fn feel(&mut self, before: f64, step_ns: u64) {
        let is_on_cam = is_on_cam(&self.settings, self.place);
        if is_on_cam != core::mem::replace(&mut self.was_on_cam, is_on_cam) {
            self.bounces_ns = self.settings.switch.map_or(0, |switch| switch.bounce_ns);
            self.is_closed = is_on_cam;
        } else if self.bounces_ns > 0 {
            self.is_closed = !self.is_closed;
        } else {
            self.is_closed = is_on_cam;
        }
        self.bounces_ns = self.bounces_ns.saturating_sub(step_ns);
        if let Some((pitch, at)) = self.settings.index {
            let turn = |place: f64| ((place - at) / pitch).floor();
            let (from, to) = (turn(before), turn(self.place));
            if (from - to).abs() > 0.5 {
                let pulse = at + pitch * from.max(to);
                let counted = pulse + self.offset;
                self.index = (self.index.0 + 1, counted);
                let kept = self.kept.as_mut();
                if let Some(kept) = kept.filter(|kept| kept.is_ready(&self.settings)) {
                    kept.at.get_or_insert(counted);
                }
            }
        }
    }

    pub(crate) fn is_at_home_switch(&self) -> bool {
        if self.settings.switch.is_some() {
            return self.contact.unwrap_or(self.is_closed);
        }
        self.settings.home.is_some_and(|home| {
            if home.switch < 0.0 {
                self.place <= home.switch
            } else {
                self.place >= home.switch
            }
        })
    }

    /// Somebody moves it, with the power off.
    pub(crate) fn push(&mut self, distance: f64) {
        self.place += distance;
    }

    /// A step of `step_t` seconds. `enable` and `home` as the setpoint says; without a demand a
    /// drive with power holds its place.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a step of milliseconds"
    )]
    pub(crate) fn step(
        &mut self,
        step_t: f64,
        enable: bool,
        home: bool,
        demand: Option<JointState>,
    ) {
        let may_have_power = enable && self.fault_code == 0 && self.has_power_source;
        self.asked_ns = if may_have_power {
            self.asked_ns + (step_t * 1e9) as u64
        } else {
            0
        };
        let before = self.place;
        if self.is_enabled() && !self.is_stuck {
            let begins_homing = home && !self.was_asked_home;
            self.was_asked_home = home;
            if begins_homing && self.settings.home.is_some() {
                (self.is_homing, self.is_homed) = (true, false);
                self.homing_ns = 0;
            }
            self.is_homing &= home;
            // What is found is not gone away from before the position was taken over.
            if self.is_homing {
                self.go_home(step_t);
            } else if let Some(demand) = demand.filter(|_| !home) {
                self.go_to(step_t, demand.position - self.offset);
            }
        } else {
            (self.is_homing, self.was_asked_home) = (false, false);
        }
        self.velocity = (self.place - before) / step_t;
        self.feel(before, (step_t * 1e9) as u64);
    }

    fn go_to(&mut self, step_t: f64, target: f64) {
        let away = target - self.place;
        let sticks = self.velocity.abs() < STICKING_V && away.abs() < self.settings.stiction;
        if sticks {
            return;
        }
        self.place = if self.settings.lag_t > 0.0 {
            target - away * (-step_t / self.settings.lag_t).exp()
        } else {
            target
        };
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a step of milliseconds"
    )]
    fn go_home(&mut self, step_t: f64) {
        let Some(home) = self.settings.home else {
            return;
        };
        self.homing_ns += (step_t * 1e9) as u64;
        let away = home.switch - self.place;
        let way = home.velocity * step_t;
        if away.abs() > way {
            self.place += way.copysign(away);
            return;
        }
        self.place = home.switch;
        if self.homing_ns < SEARCH_NS {
            return;
        }
        self.offset = home.position - home.switch;
        (self.is_homed, self.is_homing) = (true, false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drive_keeps_the_first_index_pulse_since_it_is_ready() {
        let mut joint = Joint::new(&JointSettings {
            count: 100.0,
            power_up_ns: 0,
            index: Some((4.0, 0.7)),
            index_ready_ns: 20_000_000,
            ..JointSettings::default()
        });
        let mut told = Vec::new();
        for step in 0..12 {
            // 0.5 mm in 10 ms, and told to keep it from the fourth step on.
            let demand = JointState {
                position: 100.0 + 0.5 * f64::from(step),
                ..JointState::default()
            };
            joint.keep_index(step >= 4, 10_000_000);
            joint.step(0.01, true, false, Some(demand));
            told.push(joint.kept_index());
        }
        // One at 0.7 before it is told, the next one at 4.7, and ready behind 20 ms.
        assert!(told[..6].iter().all(|told| *told == (false, None)));
        assert!(
            told[6..10].iter().all(|told| *told == (true, None)),
            "{told:?}"
        );
        assert!(
            told[10..].iter().all(|told| *told == (true, Some(104.7))),
            "{told:?}"
        );
        // That it keeps, whatever comes behind it, until it is not told to any more.
        for step in 12..30 {
            let demand = JointState {
                position: 100.0 + 0.5 * f64::from(step),
                ..JointState::default()
            };
            joint.keep_index(true, 10_000_000);
            joint.step(0.01, true, false, Some(demand));
        }
        assert_eq!(joint.kept_index(), (true, Some(104.7)));
        joint.keep_index(false, 10_000_000);
        assert_eq!(joint.kept_index(), (false, None));
    }
}
