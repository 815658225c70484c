//! `glidepath telemetry`: tells what the machine does to whoever watches many of them by an MQTT
//! broker. It takes no commands.

mod events;
mod message;

use super::session;
use crate::cli::TelemetryArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use crate::report::grouped;
use events::Events;
use glidepath_link::{Record as _, Status, Transport as _};
use glidepath_realtime::{Clock as _, Monotonic};
use glidepath_telemetry::{Broker, BrokerSettings, Quality};
use serde_json::json;
use std::time::{Duration, Instant};

/// Between two looks at the shared memory.
const POLL: Duration = Duration::from_millis(20);
/// Between two looks for processes that died.
const CLEAN_EVERY: Duration = Duration::from_secs(1);
/// Between two messages about a machine that does not move, ns.
const AT_REST_NS: u64 = 1_000_000_000;
/// A status that is older is that of an interpolator that is not there, ns.
const DEAD_NS: u64 = 2_000_000_000;

/// Publishes until asked to end.
///
/// # Errors
/// The link cannot be used.
pub(super) fn telemetry(args: &TelemetryArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let instance = session::instance(&args.instance, config);
    let link = session::join(&args.instance, config)?;
    let (mut statuses, mut setpoints) = (link.status_source()?, link.setpoint_source()?);
    let broker = Broker::connect(&settings(args, config, &instance)?);
    let mut watched = Watched::new(args);
    let mut events = Events::default();
    let mut cleaned = Instant::now();
    while !interrupt.is_set() {
        while let Some(status) = statuses.take()? {
            watched.status = Some(status).filter(|status| status.check().is_ok());
        }
        let now_ns = Monotonic.now_ns();
        while let Some(setpoint) = setpoints.take()? {
            if setpoint.check().is_ok()
                && let Some(event) = events.next(&setpoint, now_ns)
            {
                broker.publish("event", Quality::AtLeastOnce, event);
            }
        }
        if let Some(message) = watched.message(now_ns, config) {
            broker.publish("status", Quality::AtMostOnce, message);
        }
        watched.tell_connection(&broker, args);
        if cleaned.elapsed() >= CLEAN_EVERY {
            cleaned = Instant::now();
            link.clean_up_dead_peers()?;
            link.stands()?;
        }
        std::thread::sleep(POLL);
    }
    let counts = broker.counts();
    broker.close();
    if args.basic.json {
        output::object(&json!({
            "published": counts.published,
            "left_out": counts.left_out,
            "connections": counts.connections,
        }));
    } else {
        output::result(&format!(
            "telemetry: {} messages, {} left out, {} connections\n",
            grouped(counts.published),
            grouped(counts.left_out),
            grouped(counts.connections)
        ));
    }
    Ok(interrupt.exit())
}

fn settings(
    args: &TelemetryArgs,
    config: &MachineConfig,
    instance: &str,
) -> Result<BrokerSettings, Failure> {
    let configuration = session::configuration(&args.basic)?;
    let (host, port) = args.broker.clone();
    let password = std::env::var("GLIDEPATH_MQTT_PASSWORD").unwrap_or_default();
    Ok(BrokerSettings {
        host,
        port,
        client_id: client_id(&args.topic, instance),
        credentials: args.user.clone().map(|user| (user, password)),
        topic: format!("{}/{instance}", args.topic),
        info: message::info(config, instance, &configuration),
    })
}

/// One for each process of each host: a broker ends the older of two that have the same. Processes in
/// containers may have the same number, but not the same host name.
fn client_id(topic: &str, instance: &str) -> String {
    // Without the name two hosts may have to be told apart by their instances.
    let host = std::fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    format!("{topic}-{instance}-{}-{}", host.trim(), std::process::id()).replace('/', "-")
}

/// The machine, as it was told last.
struct Watched {
    status: Option<Status>,
    told_ns: u64,
    told_state: u32,
    moving_ns: u64,
    was_connected: bool,
    has_told_trouble: bool,
}

impl Watched {
    fn new(args: &TelemetryArgs) -> Self {
        Self {
            status: None,
            told_ns: 0,
            told_state: 0,
            moving_ns: 1_000_000_000 / u64::from(args.rate),
            was_connected: false,
            has_told_trouble: false,
        }
    }

    /// The next message about the machine, when it is time for one: often while it moves, seldom at
    /// rest, at once at a change of state.
    fn message(&mut self, now_ns: u64, config: &MachineConfig) -> Option<String> {
        let status = self.status.as_ref();
        let status = status.filter(|status| now_ns.saturating_sub(status.updated_ns) < DEAD_NS);
        let state = status.map_or(0, |status| status.state);
        let moves = status.is_some_and(|status| status.feed_v != 0.0);
        let every_ns = if moves { self.moving_ns } else { AT_REST_NS };
        // A look comes a little early or late: half of one makes no difference.
        let slack_ns = 10_000_000;
        if state == self.told_state && now_ns + slack_ns < self.told_ns + every_ns {
            return None;
        }
        (self.told_ns, self.told_state) = (now_ns, state);
        Some(message::status(status, now_ns, config))
    }

    fn tell_connection(&mut self, broker: &Broker, args: &TelemetryArgs) {
        let (host, port) = &args.broker;
        let is_connected = broker.is_connected();
        if is_connected && !self.was_connected {
            output::note(&format!("telemetry: connected to {host}:{port}"));
            self.has_told_trouble = false;
        }
        self.was_connected = is_connected;
        if let Some(trouble) = broker.trouble()
            && !self.has_told_trouble
        {
            self.has_told_trouble = true;
            output::note(&format!(
                "telemetry: no connection to {host}:{port} ({trouble}); it is tried again and again"
            ));
        }
    }
}
