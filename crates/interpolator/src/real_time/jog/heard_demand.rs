//! A demand that is heard: whether it is followed, and where it leads.

use super::holder::Heard;
use super::jog_motion::Goal;
use super::{Jog, JogContext};
use crate::shared::message::jog_demand::Demand;
use glidepath_geometry::AxisVector;
use glidepath_link::JogMode;

impl Jog {
    /// Takes a demand. Returns whether a jog begins with it.
    pub(crate) fn hear(&mut self, demand: &Demand, around: &JogContext) -> bool {
        let turned = self.wheel.turn(demand, around.now_ns);
        let is_wheel = matches!(demand.mode, JogMode::Wheel | JogMode::WheelVelocity);
        if is_wheel && turned.amax() <= 0.0 {
            return false; // It stands. How long it has stood is looked at elsewhere.
        }
        let is_outdated = demand.is_outdated || demand.behind_stops < self.stops;
        if is_outdated && demand.wants_motion() {
            return false;
        }
        let was_active = self.is_active();
        let may_start = around.may_start && !was_active;
        match self.holder.hear(demand, around.now_ns, may_start) {
            Heard::Nothing => return false,
            Heard::LetGo => {
                self.let_go();
                return false;
            }
            Heard::Alive if !is_wheel => return false,
            Heard::Alive | Heard::New => {}
        }
        if !was_active {
            self.begin(around);
        }
        self.blocked = false;
        self.follow(demand, &turned, &around.position);
        !was_active
    }

    /// Makes a demand the one that is followed.
    fn follow(&mut self, demand: &Demand, turned: &AxisVector, published: &AxisVector) {
        let before = self.demand.replace(*demand).map(|before| before.mode);
        self.goal = match demand.mode {
            // How fast a wheel turns is looked at in every tick.
            JogMode::None | JogMode::WheelVelocity => Goal::Stop,
            JogMode::Continuous => Goal::Speeds(demand.value),
            JogMode::Incremental => {
                // Steps add up: one that comes on the way to the place of the last counts from there.
                let target = match self.goal {
                    Goal::Place(place) if before == Some(JogMode::Incremental) => place,
                    _ => {
                        let rest = self.jog_motion.stop().end();
                        rest.zip_zip_map(published, &demand.value, |rest, now, step| {
                            if step == 0.0 { rest } else { now }
                        })
                    }
                };
                // An axis goes to the end of its travel, and keeps no other from going on.
                let travel = self.travel(published);
                Goal::Place(travel.nearest(&(target + demand.value)))
            }
            JogMode::Wheel => {
                let from = match self.goal {
                    Goal::Place(place) if before == Some(JogMode::Wheel) => place,
                    _ => self.jog_motion.stop().end(),
                };
                let place = (from + turned).sup(&(published - self.ahead));
                let travel = self.travel(published);
                Goal::Place(travel.nearest(&place.inf(&(published + self.ahead))))
            }
        };
    }
}
