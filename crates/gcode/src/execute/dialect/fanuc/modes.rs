//! The codes in force, by group, as `#4001` and on show them.
//!
//! | | mills | lathes |
//! |---|---|---|
//! | `#4001` | G0 to G3, G33 | the same, G32, the cycles of one pass |
//! | `#4002` | plane | G96, G97 |
//! | `#4003` | G90, G91 | the same in systems B and C |
//! | `#4005` | feed | feed: G98, G99, or G94, G95 |
//! | `#4006`, `#4007` | units, radius of the tool | the same |
//! | `#4008` | length of the tool | – |
//! | `#4009`, `#4010` | cycle, G98 and G99 | –, cycle |
//! | `#4011` | scale | G98 and G99 of systems B and C |
//! | `#4012`, `#4014` | macro, coordinate system | the same |
//! | `#4013`, `#4015` | G96 and G97, path | – |
//! | `#4016` | turn | plane |
//! | `#4017`, `#4022` | polar, mirror image | – |

use glidepath_geometry::Plane;
use glidepath_program::PathMode;

use crate::execute::interpreter::Interpreter;
use crate::execute::state::modal::Modal;
use crate::execute::state::mode_codes::cycle_number;
use crate::setup::fanuc::FanucControl;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{
    CannedCycle, Distance, FeedMode, Motion, Retract, Side, Turning, Units,
};

fn one_of(first: bool, yes: f64, no: f64) -> f64 {
    if first { yes } else { no }
}

impl Interpreter {
    /// The number of the code in force in a modal group.
    pub(super) fn mode(&self, group: u32) -> Option<f64> {
        let control = self.options.fanuc_control();
        if control == FanucControl::Mill {
            self.mode_of_mill(group)
        } else {
            self.mode_of_lathe(group, control)
        }
    }

    fn mode_of_mill(&self, group: u32) -> Option<f64> {
        let modal = &self.state.modal;
        let frames = &self.state.offsets.fanuc.frames;
        Some(match group {
            1 => mill_motion(self.motion_beside_cycles()),
            2 => self.plane_code(),
            4 => 23.0,
            5 => match modal.feed_mode {
                FeedMode::InverseTime => 93.0,
                FeedMode::PerMinute => 94.0,
                FeedMode::PerRevolution => 95.0,
            },
            8 => match self.state.fanuc.length_sign {
                None => 49.0,
                Some(sign) => one_of(sign < 0.0, 44.0, 43.0),
            },
            9 => cycle_code(modal),
            10 => self.retract_code(),
            11 => one_of(frames.scale.is_some(), 51.0, 50.0),
            13 => self.speed_code(),
            15 => match modal.path_mode {
                PathMode::Continuous { .. } => 64.0,
                _ => 61.0,
            },
            16 => one_of(frames.turn.is_some(), 68.0, 69.0),
            17 => one_of(self.state.fanuc.polar.is_some(), 16.0, 15.0),
            22 => one_of(frames.mirror.iter().any(Option::is_some), 51.1, 50.1),
            _ => return self.mode_of_both(group),
        })
    }

    fn mode_of_lathe(&self, group: u32, control: FanucControl) -> Option<f64> {
        let is_a = control == FanucControl::LatheA;
        Some(match group {
            1 => lathe_motion(self.motion_beside_cycles(), control),
            2 => self.speed_code(),
            3 | 11 if is_a => return None,
            5 => match self.state.modal.feed_mode {
                FeedMode::PerRevolution => one_of(is_a, 99.0, 95.0),
                _ => one_of(is_a, 98.0, 94.0),
            },
            10 => match self.state.modal.motion {
                Some(Motion::Cycle(CannedCycle::TapLeft)) => 184.0,
                _ => cycle_code(&self.state.modal),
            },
            11 => self.retract_code(),
            16 => self.plane_code(),
            _ => return self.mode_of_both(group),
        })
    }

    /// Groups that mills and lathes have.
    fn mode_of_both(&self, group: u32) -> Option<f64> {
        let modal = &self.state.modal;
        Some(match group {
            3 => one_of(modal.distance == Distance::Absolute, 90.0, 91.0),
            6 => match (modal.units, self.options.fanuc_control()) {
                (units, FanucControl::LatheC) => one_of(units == Units::Inch, 70.0, 71.0),
                (units, _) => one_of(units == Units::Inch, 20.0, 21.0),
            },
            7 if !self.state.on_contour => 40.0,
            7 => match self.state.contour_side {
                Side::Left => 41.0,
                Side::Right => 42.0,
            },
            12 => one_of(self.state.fanuc.calls_macro, 66.0, 67.0),
            14 => match self.state.offsets.fanuc.active {
                Some(_) => 54.1,
                None => f64::from(u8::try_from(self.state.offsets.active).unwrap_or(0)) + 54.0,
            },
            _ => return None,
        })
    }

    /// The motion mode that a code leaves. FANUC's cycles are a group of their own: behind G80 the
    /// code from before them is in force.
    pub(crate) fn mode_behind(&mut self, block: &Block, code: Option<Motion>) -> Option<Motion> {
        if block.dialect != Dialect::Fanuc {
            return code;
        }
        // Plain lines change the mode without coming here: what is in force now is asked for.
        let beside = self.motion_beside_cycles();
        match code {
            Some(Motion::Cycle(_)) => self.state.fanuc.before_cycles = beside,
            Some(_) => {}
            None => return Some(beside),
        }
        code
    }

    /// The code of group 1, which drilling cycles leave as it was.
    pub(crate) fn motion_beside_cycles(&self) -> Motion {
        match self.state.modal.motion {
            Some(Motion::Cycle(_)) | None => self.state.fanuc.before_cycles,
            Some(motion) => motion,
        }
    }

    fn plane_code(&self) -> f64 {
        match self.state.modal.plane {
            Plane::Zx | Plane::Wu => 18.0,
            Plane::Yz | Plane::Vw => 19.0,
            Plane::Xy | Plane::Uv => 17.0,
        }
    }

    fn retract_code(&self) -> f64 {
        one_of(self.state.modal.retract == Retract::Initial, 98.0, 99.0)
    }

    fn speed_code(&self) -> f64 {
        one_of(self.state.spindle.surface.is_some(), 96.0, 97.0)
    }
}

const fn mill_motion(motion: Motion) -> f64 {
    match motion {
        Motion::Linear => 1.0,
        Motion::ArcClockwise => 2.0,
        Motion::ArcCounterclockwise => 3.0,
        Motion::Thread => 33.0,
        _ => 0.0,
    }
}

const fn lathe_motion(motion: Motion, control: FanucControl) -> f64 {
    let [turn, thread, face] = match control {
        FanucControl::LatheB => [77.0, 78.0, 79.0],
        FanucControl::LatheC => [20.0, 21.0, 24.0],
        FanucControl::LatheA | FanucControl::Mill => [90.0, 92.0, 94.0],
    };
    match motion {
        Motion::Thread => match control {
            FanucControl::LatheA => 32.0,
            _ => 33.0,
        },
        Motion::Turning(Turning::Turn) => turn,
        Motion::Turning(Turning::Thread) => thread,
        Motion::Turning(Turning::Face) => face,
        motion => mill_motion(motion),
    }
}

fn cycle_code(modal: &Modal) -> f64 {
    match modal.motion {
        Some(Motion::Cycle(cycle)) => f64::from(cycle_number(cycle)),
        _ => 80.0,
    }
}
