//! A motion for the interpolator to work on: a curve of short lines in all axes, run again and
//! again.

use super::beat::Load;
use crate::config::MachineConfig;
use core::f64::consts::TAU;
use core::fmt::Write as _;
use glidepath_geometry::AxisVector;
use glidepath_interpolator::{Config, Stepped};
use glidepath_link::{MachineState, SetpointFrame};
use glidepath_planner::{Output, Pipeline, ProgramSource, Refusal};

/// Half the way an axis goes, mm or degrees, where its travel allows.
const AMPLITUDE: f64 = 10.0;
/// Lines of one turn.
const LINES: u32 = 120;
/// Turns of the first axis; the k-th makes k times as many.
const TURNS: u32 = 3;
/// Frames given in one period: more than one, so that the interpolator has some ahead.
const FRAMES_PER_TICK: usize = 4;

/// A planned motion from rest to rest at the same place.
#[derive(Debug)]
pub struct LoadMotion {
    frames: Vec<SetpointFrame>,
    config: Config,
}

impl LoadMotion {
    /// Plans it for a machine; `interpolator` is what its interpolator is started with.
    ///
    /// # Errors
    /// The planner refuses the program.
    pub fn plan(machine: &MachineConfig, interpolator: Config) -> Result<Self, Refusal> {
        let home = machine.home();
        let program = program(machine);
        let source = ProgramSource::new(program.as_bytes(), machine.program_options(home));
        let mut pipeline = Pipeline::new(source, machine.settings(), home)
            .with_joints(machine.limited_mechanism());
        let mut frames = Vec::new();
        loop {
            match pipeline.advance()? {
                Output::Frame(frame) => {
                    let period_ns = machine.period_ns();
                    frames.push(SetpointFrame::from_frame(&frame, 0, period_ns));
                }
                Output::End => break,
                Output::Item(_) | Output::Pending => {}
            }
        }
        Ok(Self {
            frames,
            config: interpolator,
        })
    }

    pub(super) const fn config(&self) -> &Config {
        &self.config
    }

    pub(super) const fn player<'m, 'i, 's>(
        &'m self,
        interpolator: &'i mut Stepped<'s>,
    ) -> Player<'m, 'i, 's> {
        Player {
            interpolator,
            frames: self.frames.as_slice(),
            next: 0,
            epoch: 1,
        }
    }
}

/// The program: within the travel, from home to home.
fn program(machine: &MachineConfig) -> String {
    let home: AxisVector = machine.home();
    let mut text = String::from("G21 G90 G94\n");
    let feed = machine.path.default_feed.unwrap_or(6_000.0);
    for line in 0..=LINES * TURNS {
        let turn = f64::from(line) / f64::from(LINES) * TAU;
        let _ = write!(text, "G1 F{feed}");
        for (k, axis) in (1_u32..).zip(&machine.axes) {
            let at = home[axis.axis.index()];
            let (low, high) = axis.travel.unwrap_or((at - AMPLITUDE, at + AMPLITUDE));
            let half = AMPLITUDE.min((high - low) / 2.0);
            let middle = at.clamp(low + half, high - half);
            // A little inside, so that rounding in the text does not leave the travel.
            let position = (0.999 * half).mul_add((f64::from(k) * turn).sin(), middle);
            let _ = write!(text, " {}{position:.6}", axis.axis);
        }
        text.push('\n');
    }
    text.push_str("G1");
    for axis in &machine.axes {
        let _ = write!(text, " {}{:.6}", axis.axis, home[axis.axis.index()]);
    }
    text.push_str("\nM2\n");
    text
}

/// Gives an interpolator the frames and ticks it. Does not allocate.
#[derive(Debug)]
pub(super) struct Player<'m, 'i, 's> {
    interpolator: &'i mut Stepped<'s>,
    frames: &'m [SetpointFrame],
    next: usize,
    epoch: u64,
}

impl Load for Player<'_, '_, '_> {
    /// One period, as the real-time thread does it.
    fn work(&mut self) -> bool {
        let state = self.interpolator.tick().state();
        if self.next == self.frames.len() && matches!(state, Ok(MachineState::Idle)) {
            // The motion is over: the same again.
            self.next = 0;
            self.epoch += 1;
        }
        matches!(state, Ok(MachineState::Running))
    }

    /// Frames into the ring, as the ports thread puts them there.
    fn supply(&mut self) {
        for _ in 0..FRAMES_PER_TICK {
            let Some(frame) = self.frames.get(self.next) else {
                break;
            };
            let frame = SetpointFrame {
                epoch: self.epoch,
                ..*frame
            };
            if !self.interpolator.offer(&frame) {
                break;
            }
            self.next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config;
    use glidepath_interpolator::stepped;

    #[test]
    fn the_motion_runs_again_and_again() {
        let machine = config::load(None).unwrap();
        let interpolator = Config {
            start_position: machine.home(),
            ..Config::new(machine.limits(), machine.period_ns())
        };
        let motion = LoadMotion::plan(&machine, interpolator).unwrap();
        let once = motion.frames.len();
        assert!(once > 250, "{once} frames: less than a second");
        stepped(motion.config(), |interpolator| {
            let mut player = motion.player(interpolator);
            let ticks = 4 * once;
            let mut moving = 0;
            for _ in 0..ticks {
                player.supply();
                moving += usize::from(player.work());
            }
            assert!(player.epoch >= 3, "only {} epochs", player.epoch);
            assert!(moving * 10 > ticks * 9, "{moving} of {ticks} ticks moved");
        });
    }
}
