//! The errors of HAL as a servo stack.

use std::io;

/// The reason why HAL is no servo stack, or no longer.
#[derive(Debug, thiserror::Error)]
pub enum HalError {
    /// HAL's programs are not there.
    #[error(
        "cannot start {program}: {source}; it comes with LinuxCNC (Debian's package \
         linuxcnc-uspace), and has to be in PATH"
    )]
    Start {
        /// Which.
        program: &'static str,
        /// What the system says.
        source: io::Error,
    },
    /// A program of HAL ended.
    #[error(
        "{program} ended{}; HAL has to run, as the same user, with the components streamer and \
         sampler loaded: start it with `halrun -f FILE.hal` before",
        said(.text)
    )]
    Ended {
        /// Which.
        program: &'static str,
        /// What it said.
        text: String,
    },
    /// A program of HAL cannot be spoken to.
    #[error("{program} cannot be spoken to: {source}")]
    Pipe {
        /// Which.
        program: &'static str,
        /// What the system says.
        source: io::Error,
    },
    /// The streamer takes no lines.
    #[error(
        "HAL takes no lines any more: its thread does not run, streamer.{channel}.enable is off, or \
         streamer.{channel} is in no thread (addf)"
    )]
    Full {
        /// The channel.
        channel: u32,
    },
    /// The streamer does not understand the lines.
    #[error("halstreamer does not take the lines: {text}; load it with cfg={cfg} for this machine")]
    Line {
        /// What it said.
        text: String,
        /// What the streamer is to be loaded with.
        cfg: String,
    },
    /// The rows are not what they are to be.
    #[error(
        "halsampler gives rows that do not fit this machine, such as `{row}`; load the sampler with \
         cfg={cfg}"
    )]
    Row {
        /// The row.
        row: String,
        /// What the sampler is to be loaded with.
        cfg: String,
    },
    /// No rows come.
    #[error(
        "HAL gives no rows for {waited_ms} ms: start its thread (`start`), and have sampler.{channel} \
         in it (addf)"
    )]
    Silent {
        /// The channel.
        channel: u32,
        /// How long they were waited for.
        waited_ms: u64,
    },
    /// Rows come back with other ticks than were sent.
    #[error(
        "HAL gives rows, but not the ticks of the lines: net streamer.{channel}.pin.0 to \
         sampler.{channel}.pin.0, and have streamer.{channel} before sampler.{channel} in the thread"
    )]
    NoEcho {
        /// The channel.
        channel: u32,
    },
    /// More joints than HAL's components have columns for.
    #[error("HAL takes 1 to {most} joints by one channel, and this machine has {joints}")]
    Joints {
        /// Those of the machine.
        joints: usize,
        /// The most.
        most: usize,
    },
}

fn said(text: &str) -> String {
    if text.is_empty() {
        String::new()
    } else {
        format!(": {text}")
    }
}
