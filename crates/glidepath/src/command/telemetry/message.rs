//! The messages of telemetry, as JSON.

use crate::config::MachineConfig;
use crate::report::names;
use glidepath_link::{MachineState, Power, Status};
use serde_json::{Map, Value, json};
use std::time::{SystemTime, UNIX_EPOCH};
use twox_hash::XxHash64;

/// What does not change while the process runs.
pub(super) fn info(config: &MachineConfig, instance: &str, configuration: &str) -> String {
    let axes: Vec<String> = config
        .axis_names()
        .iter()
        .map(ToString::to_string)
        .collect();
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "instance": instance,
        "axes": axes,
        "joints": config.drives(),
        "period_us": config.period_ns() / 1000,
        "configuration_xxh64": format!("{:016x}", XxHash64::oneshot(0, configuration.as_bytes())),
    })
    .to_string()
}

/// Milliseconds since 1970, as historians count; 0 before.
#[expect(clippy::disallowed_methods, reason = "a stamp for historians")]
pub(super) fn unix_ms() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    since.map_or(0, |since| {
        u64::try_from(since.as_millis()).unwrap_or(u64::MAX)
    })
}

/// What the machine does; `None` where no interpolator says so.
#[allow(clippy::cast_precision_loss, reason = "seconds of a buffer")]
pub(super) fn status(status: Option<&Status>, now_ns: u64, config: &MachineConfig) -> String {
    let Some(status) = status else {
        return json!({ "unix_ms": unix_ms(), "t_ns": now_ns, "state": "absent" }).to_string();
    };
    let axes = config.axis_names().into_iter();
    let position: Map<String, Value> = axes
        .map(|axis| (axis.to_string(), rounded(status.position[axis.index()])))
        .collect();
    json!({
        "unix_ms": unix_ms(),
        "t_ns": status.updated_ns,
        "boot": format!("{:x}", status.boot_id),
        "state": status.state().map_or("unknown", MachineState::name),
        "power": status.power() == Ok(Power::On),
        "line": status.line,
        "position": position,
        "axes_not_homed": names(&config.axes_not_homed(status)),
        "feed_mm_s": rounded(status.feed_v),
        "override": rounded(status.effective_override),
        "buffer_s": rounded(f64::from(status.queue_depth) * config.period_t()),
        "missed_ticks": status.missed_ticks,
        "fault": status.fault_text(),
    })
    .to_string()
}

/// To what a dashboard can show: micrometres.
fn rounded(value: f64) -> Value {
    json!((value * 1e6).round() / 1e6)
}
