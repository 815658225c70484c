//! Arguments of `telemetry`.

use super::basic::{BasicArgs, InstanceArgs};
use clap::Args;

/// Arguments of `telemetry`.
#[derive(Debug, Args)]
pub struct TelemetryArgs {
    /// The broker, as HOST or HOST:PORT
    #[arg(long, value_name = "HOST:PORT", default_value = "localhost:1883", value_parser = broker)]
    pub broker: (String, u16),
    /// First part of all topics: TOPIC/INSTANCE/status and so on
    #[arg(long, value_name = "TOPIC", default_value = "glidepath", value_parser = topic)]
    pub topic: String,
    /// User at the broker; the password comes from the environment variable GLIDEPATH_MQTT_PASSWORD
    #[arg(long, value_name = "NAME")]
    pub user: Option<String>,
    /// Messages per second while the machine moves
    #[arg(long, value_name = "HZ", default_value_t = 10,
          value_parser = clap::value_parser!(u32).range(1..=50))]
    pub rate: u32,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// The instance, by which processes find each other.
    #[command(flatten)]
    pub instance: InstanceArgs,
}

/// The port that MQTT without TLS has by convention.
const PORT: u16 = 1883;

fn broker(text: &str) -> Result<(String, u16), &'static str> {
    let (host, port) = match text.rsplit_once(':') {
        Some((host, port)) => (host, port.parse().ok()),
        None => (text, Some(PORT)),
    };
    match port {
        Some(port) if port > 0 && !host.is_empty() => Ok((host.to_owned(), port)),
        _ => Err("write HOST or HOST:PORT, such as localhost:1883"),
    }
}

fn topic(text: &str) -> Result<String, &'static str> {
    let is_level = |level: &str| !level.is_empty() && !level.contains(['+', '#', '\0']);
    if text.split('/').all(is_level) && !text.starts_with('$') {
        Ok(text.to_owned())
    } else {
        Err("levels between slashes, none of them empty, without + and #")
    }
}
