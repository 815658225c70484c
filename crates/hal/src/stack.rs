//! The servo stack of HAL: the bridge with its processes.

use crate::bridge::{Bridge, HalCounts};
use crate::error::HalError;
use crate::layout::Layout;
use crate::programs::{Sampler, Streamer};
use glidepath_link::servo::JointStates;
use glidepath_link::{Feedback, Setpoint};

/// No rows for so long is a HAL that does not run, ns.
const SILENCE_NS: u64 = 2_000_000_000;
/// Rows with foreign ticks after which HAL's nets are wrong: more than the FIFOs of both hold.
const FOREIGN_ROWS: u32 = 20_000;

/// The settings by which HAL is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HalSettings {
    /// The number of `streamer` and `sampler`, from 0.
    pub channel: u32,
    /// The period of the thread they are in, ns, > 0.
    pub period_ns: u64,
    /// Lines that the FIFO holds back: the time by which this process may be late, and by which the
    /// machine is behind its setpoints. 1 to 256.
    pub prefill: u32,
    /// Tells this servo stack from every other.
    pub boot_id: u64,
}

/// HAL as a servo stack. Dropping it ends its two programs, not HAL.
#[derive(Debug)]
pub struct Hal {
    bridge: Bridge,
    layout: Layout,
    channel: u32,
    streamer: Streamer,
    sampler: Sampler,
    lines: String,
    heard_ns: Option<u64>,
}

impl Hal {
    /// Starts HAL's two programs. They end at once where HAL does not run, which [`Hal::turn`]
    /// tells.
    ///
    /// # Errors
    ///
    /// [`HalError::Start`], [`HalError::Pipe`].
    pub fn open(layout: Layout, settings: &HalSettings) -> Result<Self, HalError> {
        let HalSettings {
            channel,
            period_ns,
            prefill,
            boot_id,
        } = *settings;
        Ok(Self {
            bridge: Bridge::new(layout, period_ns, prefill, boot_id),
            layout,
            channel,
            sampler: Sampler::start(channel)?,
            streamer: Streamer::start(channel, layout.streamer_cfg())?,
            lines: String::new(),
            heard_ns: None,
        })
    }

    /// Reads what has come, and writes the lines that are due: `demand` is asked for each of them,
    /// with rising times up to `now_ns`. To be called once a period of HAL, or more often. `setpoint`
    /// is the last one that was received; `now_ns` is of `CLOCK_MONOTONIC`, or behind it by a
    /// constant time, which HAL is behind then, too. Gives the feedback of every row to `send`.
    ///
    /// # Errors
    ///
    /// Why HAL is no servo stack any more. The drives lose their power by themselves then, if HAL's
    /// enable chain is as the manual has it: the FIFO runs empty.
    pub fn turn<E: From<HalError>>(
        &mut self,
        now_ns: u64,
        setpoint: Option<&Setpoint>,
        demand: impl FnMut(u64) -> Option<JointStates>,
        mut send: impl FnMut(&Feedback) -> Result<(), E>,
    ) -> Result<(), E> {
        while let Some(text) = self.sampler.take()? {
            self.heard_ns = Some(now_ns);
            if text.trim() == "overrun" {
                self.bridge.lose_rows();
                continue;
            }
            let row = self.layout.read(&text).ok_or_else(|| HalError::Row {
                row: text.trim().to_owned(),
                cfg: self.layout.sampler_cfg(),
            })?;
            if let Some(feedback) = self.bridge.take(row) {
                send(&feedback)?;
            }
        }
        let silent_ns = now_ns.saturating_sub(*self.heard_ns.get_or_insert(now_ns));
        if silent_ns > SILENCE_NS {
            return Err(HalError::Silent {
                channel: self.channel,
                waited_ms: silent_ns / 1_000_000,
            }
            .into());
        }
        if self.bridge.unknown_rows() > FOREIGN_ROWS {
            return Err(HalError::NoEcho {
                channel: self.channel,
            }
            .into());
        }
        self.lines.clear();
        self.bridge.write(now_ns, setpoint, demand, &mut self.lines);
        Ok(self.streamer.write(&self.lines)?)
    }

    /// Whether the last line moves nothing.
    #[must_use]
    pub const fn is_at_rest(&self) -> bool {
        self.bridge.is_at_rest()
    }

    /// The counts of what went through so far.
    #[must_use]
    pub const fn counts(&self) -> &HalCounts {
        self.bridge.counts()
    }
}
