//! The run of an interpolator, until it is told to stop.

use crate::ports::turn::Ports;
use crate::process::loops::{
    RunError, enter_ports, enter_real_time, first_look_ns, guard, hand_over, lead_ns, real_time,
};
use crate::real_time::queue_level::least_horizon;
use crate::real_time::tick::Interpolator;
use crate::shared::config::Config;
use crate::shared::message::{Inputs, LOG_EVENTS, LogEvent, Rings, TickReport};
use core::sync::atomic::{AtomicBool, Ordering};
use glidepath_link::{LinkError, MachineState, PERIOD_NS_MAX, Status, Transport};
use glidepath_realtime::{Clock, DeadlineTimer, Events, Grants, Monotonic, event_ring};
use heapless::spsc::Producer;
use std::sync::mpsc;
use std::time::{SystemTime, UNIX_EPOCH};

/// From the end of the preparations to the first tick.
const LEAD_NS: u64 = 5_000_000;
/// How long the motion may take to come to rest at the end.
const FAREWELL_NS: u64 = 5_000_000_000;

/// Runs an interpolator until `stop` is set; then the motion comes to rest on the path, and the
/// last status is returned. So it does where nobody finds the interpolator any more, which is an error.
///
/// The calling thread becomes the ports thread: it makes the ports with `transport`, serves them,
/// and passes lines for the log to `log`. A second thread is the real-time thread.
///
/// # Errors
/// The real-time thread could not be set up, or a port could not be made. Nothing has moved then.
/// Later failures stop the motion and are in the status; [`LinkError::Removed`] ends the interpolator, too.
pub fn run(
    config: &Config,
    transport: impl FnOnce() -> Result<Box<dyn Transport>, LinkError>,
    stop: &AtomicBool,
    log: &mut dyn FnMut(&str),
) -> Result<Status, RunError> {
    validate(config)?;
    let boot_id = boot_id();
    let mut rings = Rings::default();
    let mut events = Box::<Events<LogEvent, LOG_EVENTS>>::default();
    let ((mut inputs, mut reports), ends) = rings.split();
    let (writer, reader) = event_ring(&mut events);
    let interpolator = Interpolator::new(config, boot_id, writer);
    let mut ports = Ports::new(config, boot_id, transport()?, ends, reader, log)?;
    let ended = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let (tell, told) = mpsc::channel();
        let ended = &ended;
        let thread = std::thread::Builder::new()
            .name("glidepath-rt".to_owned())
            .spawn_scoped(scope, move || {
                real_time_thread(
                    config,
                    interpolator,
                    &mut inputs,
                    &mut reports,
                    &tell,
                    ended,
                )
            })
            .map_err(|_| RunError::Thread("real-time"))?;
        if let Ok((origin_ns, grants)) = told.recv() {
            let lives = || !thread.is_finished();
            // Also if this thread panics, in a transport whose memory was overwritten: nobody gets
            // setpoints any more, and a process that lives on for nothing cannot be restarted.
            let _end = SetOnDrop(ended);
            serve(config, &mut ports, origin_ns, &grants, stop, &lives);
        }
        thread.join().map_err(|_| RunError::Thread("real-time"))??;
        match ports.removed() {
            Some(path) => Err(LinkError::Removed { path: path.clone() }.into()),
            None => Ok(*ports.status()),
        }
    })
}

struct SetOnDrop<'a>(&'a AtomicBool);

impl Drop for SetOnDrop<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// The real-time thread from its set-up to its end. It tells the origin of the grid and what it was
/// granted, or drops `tell` if it cannot go on.
fn real_time_thread(
    config: &Config,
    mut interpolator: Interpolator<'_>,
    inputs: &mut Inputs<'_>,
    reports: &mut Producer<'_, TickReport>,
    tell: &mpsc::Sender<(u64, Grants)>,
    ended: &AtomicBool,
) -> Result<(), RunError> {
    let entered = enter_real_time(config)?;
    let origin_ns = Monotonic.now_ns() + LEAD_NS;
    if tell.send((origin_ns, entered.grants)).is_err() {
        return Ok(());
    }
    let mut timer = DeadlineTimer::new(Monotonic, origin_ns, config.period_ns)
        .with_lead(lead_ns(config.period_ns));
    guard(config)?;
    real_time(&mut interpolator, inputs, reports, &mut timer, ended);
    if config.forbid_system_calls {
        sleep_on(&mut timer);
    }
    Ok(())
}

/// A guarded thread cannot end, because ending takes system calls: it sleeps until the process
/// ends.
fn sleep_on(timer: &mut DeadlineTimer<Monotonic>) -> ! {
    loop {
        timer.wait();
    }
}

/// Serves the ports on the grid until `stop` is set, or nobody finds this process any more, and the motion has come to
/// rest; or until the real-time thread lives no more: then nothing commands the drives, and that is said at once.
fn serve(
    config: &Config,
    ports: &mut Ports<'_>,
    origin_ns: u64,
    grants: &Grants,
    stop: &AtomicBool,
    lives: &dyn Fn() -> bool,
) {
    enter_ports(config);
    ports.granted(grants, config.real_time.mode);
    let (period_ns, now) = (config.period_ns, || Monotonic.now_ns());
    let origin_ns = origin_ns + first_look_ns(period_ns);
    let mut timer = DeadlineTimer::new(Monotonic, origin_ns, period_ns);
    let mut turn = |ports: &mut Ports<'_>| {
        let first_look = timer.wait();
        hand_over(&mut Monotonic, &first_look, period_ns, || {
            ports.hand_over(&now)
        });
        ports.turn(&now);
        now()
    };
    while !stop.load(Ordering::Relaxed) && ports.removed().is_none() {
        let now_ns = turn(ports);
        if !lives() {
            ports.real_time_died(now_ns);
            return;
        }
    }
    ports.abort();
    let until_ns = now() + FAREWELL_NS;
    loop {
        // The order is carried out at the next tick: look at the state after that.
        let now_ns = turn(ports);
        let rests = matches!(
            ports.state(),
            Some(
                MachineState::Idle
                    | MachineState::Faulted
                    | MachineState::Off
                    | MachineState::NotHomed
            ) | None
        );
        if rests || now_ns > until_ns {
            ports.farewell(now_ns);
            return;
        }
    }
}

fn validate(config: &Config) -> Result<(), RunError> {
    let what = "period_ns";
    if !(1..=PERIOD_NS_MAX).contains(&config.period_ns) {
        let value = config.period_ns;
        return Err(RunError::Config {
            what,
            value,
            allowed: "1 to 1000000000 ns are allowed",
        });
    }
    let least_frames = least_horizon(config);
    if config.horizon_frames < least_frames {
        return Err(RunError::Horizon {
            horizon_frames: config.horizon_frames,
            least_frames,
        });
    }
    Ok(())
}

/// A number that no other life of an interpolator has.
#[expect(clippy::disallowed_methods, reason = "a number that need not grow")]
fn boot_id() -> u64 {
    let since = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap_or_default();
    let ns = u64::try_from(since.as_nanos()).unwrap_or(u64::MAX);
    (ns ^ u64::from(std::process::id()).rotate_right(16)).max(1)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]

    use super::*;
    use crate::testing::{Rig, mill};
    use glidepath_link::{Capacity, EndOfEpoch, FaultCause, InProcess};
    use glidepath_realtime::{Mode, Request, enter};

    #[test]
    fn a_real_time_thread_that_died_is_told_and_ends_the_service() {
        let Rig {
            ends,
            mut interpolator,
            mut inputs,
            mut reports,
            config,
            ..
        } = Rig::mill();
        let transport = InProcess::new(Capacity::default());
        let mut seen = transport.status_source().unwrap();
        let events = Box::leak(Box::<Events<LogEvent, LOG_EVENTS>>::default());
        let (_writer, reader) = event_ring(events);
        let mut lines = Vec::new();
        let mut log = |line: &str| lines.push(line.to_owned());
        let mut ports =
            Ports::new(&config, 1, Box::new(transport), ends, reader, &mut log).unwrap();
        let mut report = TickReport::blank();
        let due = glidepath_realtime::Wake {
            tick: 1,
            scheduled_ns: config.period_ns,
            woke_ns: config.period_ns,
            missed: 0,
        };
        interpolator.prepare(&due, &mut inputs, &mut report);
        reports.enqueue(report).unwrap();
        let grants = enter(&Request::default(), Mode::BestEffort).unwrap().grants;
        let (stop, now_ns) = (AtomicBool::new(false), Monotonic.now_ns());
        serve(&config, &mut ports, now_ns, &grants, &stop, &|| false);
        let status = seen.take().unwrap().unwrap();
        assert_eq!(status.fault(), Ok(Some(FaultCause::RealTime)));
        assert_eq!(status.state(), Ok(MachineState::Faulted));
        assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::None));
        assert!(status.last_error.as_str().contains("real-time thread died"));
    }

    #[test]
    fn a_setpoint_is_out_before_the_turn_and_the_response_is_when() {
        let Rig {
            ends,
            mut interpolator,
            mut inputs,
            mut reports,
            config,
            ..
        } = Rig::mill();
        let transport = InProcess::new(Capacity::default());
        let mut setpoints = transport.setpoint_source().unwrap();
        let events = Box::leak(Box::<Events<LogEvent, LOG_EVENTS>>::default());
        let (_writer, reader) = event_ring(events);
        let mut log = |_: &str| {};
        let mut ports =
            Ports::new(&config, 1, Box::new(transport), ends, reader, &mut log).unwrap();
        let tick_ns = config.period_ns;
        let due = glidepath_realtime::Wake {
            tick: 1,
            scheduled_ns: tick_ns,
            woke_ns: tick_ns,
            missed: 0,
        };
        let mut report = TickReport::blank();
        interpolator.prepare(&due, &mut inputs, &mut report);
        interpolator.stamp(&mut report, &due);
        assert!(!ports.hand_over(&|| tick_ns + 50_000), "there is none yet");
        reports.enqueue(report).unwrap();
        assert!(ports.hand_over(&|| tick_ns + 102_000));
        assert_eq!(setpoints.take().unwrap().unwrap().scheduled_ns, tick_ns);
        ports.turn(&|| tick_ns + 200_000);
        assert!(setpoints.take().unwrap().is_none(), "handed over twice");
        let status = ports.status();
        assert_eq!(status.setpoints_published, 1);
        let response_us = status.response.max_ns / 1000;
        assert!((102..104).contains(&response_us), "{response_us}");
    }

    #[test]
    fn a_horizon_too_short_to_stop_on_is_refused() {
        // Three stops of 0.15 s each.
        let config = |horizon_frames| Config {
            horizon_frames,
            ..Config::new(mill(), 4_000_000)
        };
        assert!(validate(&config(113)).is_ok());
        let error = validate(&config(112)).unwrap_err();
        assert!(error.to_string().contains("at least 113"), "{error}");
    }
}
