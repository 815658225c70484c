//! The fixture of a mill that is moved by hand.

use super::bench::{Bench, config};
use super::homing::SWITCH;
use crate::shared::config::Config;
use crate::shared::m_code_waits::{AnswerSource, MCodeWait, MCodeWaits};
use core::time::Duration;
use glidepath_link::{Command, JogDemand, JogMode, MachineState};
use glidepath_plant::{JointSettings, SwitchSettings};

/// A machine whose first joint is brought home by the controller, and that waits for its tools.
pub(super) fn settings() -> Config {
    let tool_change = MCodeWait {
        first: 6,
        last: 6,
        answer: AnswerSource::Acknowledgement,
        within: Some(Duration::from_secs(1)),
        is_late: false,
    };
    let mut settings = Config {
        m_code_waits: MCodeWaits::new(&[tool_change]).unwrap(),
        ..config(false)
    };
    settings.feedback.as_mut().unwrap().joints[0].homing = Some(SWITCH);
    settings
}

/// A mill whose first joint is brought home by the controller; its client jogs.
pub(super) struct Machine {
    pub(super) bench: Bench,
    demand: JogDemand,
}

impl Machine {
    pub(super) fn new() -> Self {
        let others = JointSettings::default();
        let first = JointSettings {
            start: 2.0,
            count: 300.0,
            switch: Some(SwitchSettings {
                cam: (-18.0, -10.0),
                bounce_ns: 3_000_000,
            }),
            ..others
        };
        Self::with(settings(), &[first, others, others])
    }

    /// The same with other drives.
    pub(super) fn with(settings: Config, joints: &[JointSettings]) -> Self {
        let demand = JogDemand {
            client: 3,
            mask: 0b111,
            mode: JogMode::Continuous.code(),
            ..bytemuck::Zeroable::zeroed()
        };
        Self {
            bench: Bench::new(settings, joints),
            demand,
        }
    }

    /// A key is pressed, or still is.
    pub(super) fn press(&mut self, velocity: [f64; 3], is_new: bool) {
        self.demand.number += u64::from(is_new);
        self.demand.value[..3].copy_from_slice(&velocity);
        self.demand.sent_ns = self.bench.now_ns();
        self.bench.jog(&self.demand);
    }

    pub(super) fn let_go(&mut self) {
        self.demand.mode = JogMode::None.code();
        self.press([0.0; 3], true);
        self.demand.mode = JogMode::Continuous.code();
    }

    /// So many ticks, with a key that stays pressed where one is.
    pub(super) fn run(&mut self, ticks: usize, pressed: Option<[f64; 3]>) {
        for _ in 0..ticks {
            if let Some(velocity) = pressed {
                self.press(velocity, false);
            }
            self.bench.tick();
        }
    }

    /// Presses a key for so many ticks.
    pub(super) fn jog(&mut self, velocity: [f64; 3], ticks: usize) {
        for tick in 0..ticks {
            self.press(velocity, tick == 0);
            self.bench.tick();
        }
    }

    pub(super) fn home(&mut self) {
        self.bench.command(Command::Home(1)).unwrap();
        assert!(self.bench.run_to(MachineState::Homing, 3));
        assert!(self.bench.run_to(MachineState::Idle, 4_000));
    }
}
