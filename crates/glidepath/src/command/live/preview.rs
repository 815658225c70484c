//! The preview of a program of the folder before it runs: its text, its path, how long it takes,
//! and what is wrong with it. One at a time, the one that was asked for last.

use super::planned::{self, Planned, Reading};
use super::shown::Shown;
use crate::command::forecast::Forecast;
use crate::config::MachineConfig;
use serde_json::Value;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

/// The program that is looked at.
pub(super) struct Preview {
    config: MachineConfig,
    shown: Arc<Shown>,
    looked_at: Mutex<Option<LookedAt>>,
}

/// A file as it was when it was looked at.
#[derive(Debug, Clone, PartialEq)]
struct Stamp {
    name: String,
    bytes: u64,
    changed: Option<SystemTime>,
    /// What is kept of the machine: a plan is of the offsets and tools that it was made with.
    set_up: u64,
}

struct LookedAt {
    stamp: Stamp,
    forecast: Option<Forecast>,
    _reading: Option<Reading>,
}

impl Preview {
    pub(super) fn new(config: &MachineConfig) -> Self {
        Self {
            config: config.clone(),
            shown: Arc::new(Shown::new(Value::Null)),
            looked_at: Mutex::default(),
        }
    }

    /// Where numbers and lines of it are.
    pub(super) const fn shown(&self) -> &Arc<Shown> {
        &self.shown
    }

    /// What is known of a program so far. `set_up` counts the changes of what is kept.
    pub(super) fn object(&self, file: &Path, name: &str, set_up: u64) -> Value {
        let about = file.metadata().ok();
        let stamp = Stamp {
            name: name.to_owned(),
            bytes: about.as_ref().map_or(0, std::fs::Metadata::len),
            changed: about.and_then(|about| about.modified().ok()),
            set_up,
        };
        let mut looked_at = self
            .looked_at
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if looked_at.as_ref().is_none_or(|it| it.stamp != stamp) {
            let before = looked_at.replace(self.look_at(file, stamp));
            // It ends in its own time: it may be reading a long text.
            std::thread::spawn(move || drop(before));
        }
        let forecast = looked_at.as_ref().and_then(|it| it.forecast.as_ref());
        let (planned_t, so_far_t) = forecast.map_or((None, 0.0), |forecast| {
            (forecast.planned_t(), forecast.so_far_t())
        });
        drop(looked_at);
        let mut object = self.shown.object();
        object["seconds"] = planned_t.into();
        object["planned_so_far_s"] = so_far_t.into();
        object
    }

    fn look_at(&self, file: &Path, stamp: Stamp) -> LookedAt {
        let board = self.shown.begin(Some(&stamp.name));
        let planned = Planned::new(&self.config, board.clone());
        let forecast = match Forecast::start(file, &self.config, None, planned) {
            Ok(forecast) => forecast,
            Err(failure) => {
                board.trouble(&failure.to_string());
                return LookedAt {
                    stamp,
                    forecast: None,
                    _reading: None,
                };
            }
        };
        board.text(forecast.lines());
        let reading = planned::read(file, &self.config, board);
        LookedAt {
            stamp,
            forecast: Some(forecast),
            _reading: Some(reading),
        }
    }
}
