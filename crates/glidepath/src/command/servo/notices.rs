//! The notices of a servo while it runs.

use crate::cli::InstanceArgs;
use crate::command::session;
use crate::config::MachineConfig;
use crate::output;
use glidepath_link::Setpoint;
use glidepath_link::Subscriber;
use glidepath_link::servo::Servo;
use std::time::{Duration, Instant};

/// How long it waits for the first setpoint before it says so.
const NOTICE_AFTER: Duration = Duration::from_secs(1);

/// The notices of a servo, and what was said already.
#[derive(Debug)]
pub(super) struct Notices {
    waits_from: Instant,
    has_said_that_it_waits: bool,
    has_said_that_it_receives: bool,
    /// Own stops that were told.
    stops: u64,
    /// Why the servo stopped by itself first.
    first_stop: Option<String>,
}

impl Notices {
    /// `is_quiet` is for a servo that nobody watches.
    pub(super) fn new(is_quiet: bool) -> Self {
        Self {
            waits_from: Instant::now(),
            has_said_that_it_waits: is_quiet,
            has_said_that_it_receives: is_quiet,
            stops: 0,
            first_stop: None,
        }
    }

    /// Says what is new. Gives why the servo has stopped by itself, the first time.
    pub(super) fn look<S: Subscriber<Setpoint>>(
        &mut self,
        servo: &Servo<S>,
        instance: &InstanceArgs,
        config: &MachineConfig,
    ) -> Option<&str> {
        let waits = !self.has_said_that_it_waits && servo.counts().received == 0;
        if waits && self.waits_from.elapsed() > NOTICE_AFTER {
            self.has_said_that_it_waits = true;
            let instance = session::instance(instance, config);
            output::note(&format!(
                "servo: waiting for setpoints of the instance \"{instance}\", which `glidepath \
                 interpolator` gives"
            ));
        }
        if !self.has_said_that_it_receives && servo.counts().received > 0 {
            self.has_said_that_it_receives = true;
            output::note("servo: ready: it receives setpoints");
        }
        if let Some(why) = servo.stopped()
            && servo.counts().stops > self.stops
        {
            self.stops = servo.counts().stops;
            let why = why.to_string();
            output::note(&format!("servo: stopped by itself: {why}"));
            if self.first_stop.is_none() {
                return Some(self.first_stop.insert(why));
            }
        }
        None
    }
}
