//! The servo on LinuxCNC's HAL, which stands in the place of the drives.

use super::notices::Notices;
use super::part::part;
use super::settings::settings;
use super::silence::Silence;
use crate::cli::{HalArgs, ServoArgs};
use crate::command::failure::Failure;
use crate::command::session;
use crate::config::{HomingBy, MachineConfig};
use crate::interrupt::Interrupt;
use crate::output;
use glidepath_hal::{Hal, HalCounts, HalSettings, Layout};
use glidepath_link::servo::{Servo, ServoCounts};
use glidepath_link::{Feedback, Setpoint, Subscriber, Transport as _};
use glidepath_realtime::{Clock as _, Monotonic};
use std::time::Duration;

/// How much older than the FIFO makes it a row may be when it comes: halsampler looks for rows every
/// 10 ms.
const ROWS_LATE_NS: u64 = 20_000_000;
/// Setpoints of which the interpolator remembers what it demanded.
const REMEMBERED_PERIODS: u64 = 60;
/// The longest that joints are given to come to rest in the end, ns.
const REST_WITHIN_NS: u64 = 5_000_000_000;

fn period_ns(args: &HalArgs) -> u64 {
    u64::from(args.hal_period_us) * 1000
}

/// How long after its time a demand is asked for, so that a setpoint that comes late by as much is still
/// in time.
fn wait_ns(args: &HalArgs, config: &MachineConfig) -> u64 {
    let asked_ns = args.hal_wait_us.map(|us| u64::from(us) * 1000);
    asked_ns.unwrap_or_else(|| config.period_ns())
}

/// How far HAL is behind the setpoints: by that, and by what its FIFO holds back.
fn latency_ns(args: &HalArgs, config: &MachineConfig) -> u64 {
    u64::from(args.hal_prefill) * period_ns(args) + wait_ns(args, config)
}

fn refused<T>(what: impl Into<String>, remedy: impl Into<String>) -> Result<T, Failure> {
    Err(Failure::HalConfiguration {
        what: what.into(),
        remedy: remedy.into(),
    })
}

/// Whether the configuration fits HAL.
#[allow(clippy::cast_precision_loss, reason = "milliseconds")]
fn check(args: &HalArgs, config: &MachineConfig) -> Result<(), Failure> {
    let late_ns = latency_ns(args, config) + ROWS_LATE_NS;
    let late_ms = late_ns as f64 * 1e-6;
    let remembered_ns = REMEMBERED_PERIODS * config.period_ns();
    if late_ns > remembered_ns {
        return refused(
            format!(
                "feedback of HAL would come {late_ms} ms late, and following errors can be judged \
                 for {} ms",
                remembered_ns as f64 * 1e-6
            ),
            "take a smaller --hal-prefill or --hal-wait-us, or a longer period_us",
        );
    }
    let feedback = &config.feedback;
    if !feedback.is_expected {
        return Ok(());
    }
    if feedback.homing == HomingBy::Drive {
        return refused(
            "HAL's rows have no column for drives that find their home by themselves",
            "set homing = \"controller\" (with `absolute` for absolute encoders) or \"none\" in \
             [feedback]",
        );
    }
    let mut homes = config.home_of_joints.iter().flatten();
    if homes.any(|home| home.index.is_some()) {
        return refused(
            "HAL's rows have no column for index pulses",
            "take index and index_input out of the tables [home.…]: the edge of the switch is the home then",
        );
    }
    let late_t = late_ns as f64 * 1e-9;
    let stale_t = feedback.stale_t.unwrap_or(3.0 * config.period_t());
    if stale_t < late_t || feedback.off_t < late_t {
        return refused(
            format!(
                "feedback of HAL may be {late_ms} ms old without a fault: {} periods in its FIFO, {} ms \
                 in which setpoints may come late, and the way back",
                args.hal_prefill,
                wait_ns(args, config) as f64 * 1e-6
            ),
            format!("set stale_s = {late_t:.3} or more in [feedback], and off_s above it"),
        );
    }
    Ok(())
}

/// Plays setpoints and hands over every one, until the process is asked to end; then brings the
/// joints to rest, and takes their power.
pub(super) fn play(
    args: &ServoArgs,
    config: &MachineConfig,
    interrupt: &Interrupt,
    mut take: impl FnMut(&Setpoint) -> Result<bool, Failure>,
) -> Result<(ServoCounts, HalCounts), Failure> {
    check(&args.hal, config)?;
    let layout = Layout::new(config.drives())?;
    let transport = session::join(&args.instance, config)?;
    let _drives = part(&transport, args, config)?;
    let settings = settings(config);
    let servo = Servo::new(transport.setpoint_source()?, settings);
    let mut sink = transport.feedback_sink()?;
    let hal = Hal::open(
        layout,
        &HalSettings {
            channel: args.hal.hal_channel,
            period_ns: period_ns(&args.hal),
            prefill: args.hal.hal_prefill,
            boot_id: Monotonic.now_ns() ^ u64::from(std::process::id()) << 40,
        },
    )?;
    if !args.basic.json {
        output::note(&format!(
            "servo: HAL's streamer has cfg={}, its sampler cfg={}",
            layout.streamer_cfg(),
            layout.sampler_cfg()
        ));
    }
    let mut stack = Stack {
        hal,
        servo,
        period_ns: period_ns(&args.hal),
        behind_ns: wait_ns(&args.hal, config),
        played_ns: 0,
        silence: Silence::new(&settings),
    };
    let mut send = |feedback: &Feedback| Ok::<(), Failure>(sink.publish(feedback)?);
    let mut notices = Notices::new(false);
    let mut underruns = 0;
    while !interrupt.is_set() {
        while let Some(setpoint) = stack.servo.receive(stack.played_ns)? {
            take(&setpoint)?;
        }
        stack.turn(None, &mut send)?;
        notices.look(&stack.servo, &args.instance, config);
        let counts = stack.hal.counts();
        if counts.underruns > 0 && underruns == 0 {
            output::note("servo: HAL's FIFO ran empty, which opens its enable chain");
        }
        underruns = counts.underruns;
        stack.sleep();
    }
    stack.end(2 * latency_ns(&args.hal, config), &mut send)?;
    Ok((*stack.servo.counts(), *stack.hal.counts()))
}

/// HAL, and the servo whose demands it plays.
struct Stack<S: Subscriber<Setpoint>> {
    hal: Hal,
    servo: Servo<S>,
    /// Of HAL's thread.
    period_ns: u64,
    /// How long after its time a demand is asked for.
    behind_ns: u64,
    /// The time of the last demand.
    played_ns: u64,
    silence: Silence,
}

impl<S: Subscriber<Setpoint>> Stack<S> {
    /// Plays what is due. `instead` stands for the last setpoint.
    fn turn(
        &mut self,
        instead: Option<&Setpoint>,
        mut send: impl FnMut(&Feedback) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        self.silence.look(&self.servo);
        let (silence, is_silent) = (self.silence, self.silence.is_told(&self.servo));
        let send = |feedback: &Feedback| {
            let mut feedback = *feedback;
            if is_silent {
                silence.put(&mut feedback);
            }
            send(&feedback)
        };
        let now_ns = Monotonic.now_ns().saturating_sub(self.behind_ns);
        let last = self.servo.last().copied();
        let (servo, played_ns) = (&mut self.servo, &mut self.played_ns);
        let demand = |time_ns| {
            *played_ns = time_ns;
            servo.demand(time_ns)
        };
        self.hal
            .turn(now_ns, instead.or(last.as_ref()), demand, send)
    }

    /// Until the next multiple of the period: lines are for those.
    fn sleep(&self) {
        let into_ns = Monotonic.now_ns() % self.period_ns;
        std::thread::sleep(Duration::from_nanos(self.period_ns - into_ns));
    }

    /// To rest, then no power, for as long as it takes HAL to hear of it. What has come is played to
    /// its end, if that is a rest.
    fn end(
        &mut self,
        off_for_ns: u64,
        mut send: impl FnMut(&Feedback) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let begun_ns = Monotonic.now_ns();
        if !self.servo.comes_to_rest() {
            self.servo.stop(self.played_ns);
        }
        while !self.hal.is_at_rest() && Monotonic.now_ns() < begun_ns + REST_WITHIN_NS {
            self.turn(None, &mut send)?;
            self.sleep();
        }
        let Some(last) = self.servo.last().copied() else {
            return Ok(());
        };
        let off = Setpoint { enable: 0, ..last };
        let until_ns = Monotonic.now_ns() + off_for_ns;
        while Monotonic.now_ns() < until_ns {
            self.turn(Some(&off), &mut send)?;
            self.sleep();
        }
        Ok(())
    }
}
