//! Arguments of `grbl`.

use super::operator::OperatorArgs;
use clap::Args;
use std::path::PathBuf;

/// The port that endpoints take by themselves.
const PORT: u16 = 2323;

/// Arguments of `grbl`.
#[derive(Debug, Args)]
pub struct GrblArgs {
    /// The TCP port on 127.0.0.1; 0 selects any free one. Without --port and --pty it is 2323
    #[arg(long)]
    pub port: Option<u16>,
    /// Create this link to a pseudo-terminal, for senders that open serial ports
    #[arg(long, value_name = "LINK", value_hint = clap::ValueHint::AnyPath)]
    pub pty: Option<PathBuf>,
    /// Another user, by number, whose programs may connect by TCP, in addition to this one's and
    /// root's
    #[arg(long, value_name = "UID")]
    pub user: Option<u32>,
    /// Seconds of planned motion before ok is withheld
    #[arg(long, value_name = "SECONDS", default_value_t = 3.0, value_parser = ahead)]
    pub ahead: f64,
    /// Bytes that a sender may have unanswered
    #[arg(long, value_name = "BYTES", default_value_t = 128,
          value_parser = clap::value_parser!(u16).range(128..=1024))]
    pub rx_bytes: u16,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

impl GrblArgs {
    /// The TCP port, if senders are served there.
    #[must_use]
    pub fn tcp_port(&self) -> Option<u16> {
        self.port.or_else(|| self.pty.is_none().then_some(PORT))
    }
}

fn ahead(text: &str) -> Result<f64, &'static str> {
    let seconds: Option<f64> = text.parse().ok();
    seconds
        .filter(|seconds| (0.5..=60.0).contains(seconds))
        .ok_or("seconds from 0.5 to 60")
}
