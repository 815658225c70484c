//! `glidepath grbl`: the machine as senders of grbl know one, on a pseudo-terminal and a TCP port of this host.
//!
//! ```text
//!   sender ── bytes ──► Wire ──► Session ──► Sent ── lines ──► planner's service
//!                                  │ ▲
//!                  Hands ◄── acts ─┘ └── status ── interpolator
//!        (commands, jogs: a thread of their own, because a report waits for nothing)
//! ```
//!
//! What senders say and are told is the crate `glidepath-grbl`; here it meets ports and processes.

mod checking;
pub(super) mod error;
mod hands;
mod owner;
mod peer;
mod pty;
mod sent;
mod view;
mod wire;

use super::session;
use crate::cli::GrblArgs;
use crate::command::failure::Failure;
use crate::config::{HomingBy, MachineConfig};
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use checking::Checking;
use error::EndpointError;
use glidepath_geometry::AXES;
use glidepath_grbl::{Act, MachineSettings, Session};
use glidepath_link::{Auxiliary, Ipc, Record as _, STALL, Status, Subscriber, Transport as _};
use glidepath_realtime::{Clock as _, Monotonic};
use hands::Hands;
use sent::Sent;
use serde_json::json;
use std::time::{Duration, Instant};
use view::View;
use wire::Wire;

/// Between two looks while a sender's lines are executed, or it jogs.
const BUSY_POLL: Duration = Duration::from_millis(2);
/// Between two looks while it does nothing of that.
const QUIET_POLL: Duration = Duration::from_millis(10);
/// How long an interpolator may take to tell what the machine does, before senders are told that nobody knows.
const PATIENCE: Duration = Duration::from_secs(2);
/// Between two looks for what dead processes hold.
const CLEAN_UP_EVERY: Duration = Duration::from_secs(1);

/// Serves senders until the process is asked to end.
///
/// # Errors
/// The port or the pseudo-terminal cannot be had, or the link cannot be used.
pub(super) fn grbl(args: &GrblArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let instance = session::instance(&args.operator.instance, config);
    let link = session::link(&instance, config);
    let transport = Ipc::connect(&link)?;
    let mut statuses = transport.status_source()?;
    let mut view = View::new(config);
    // What a sender is told first is to be so.
    let started = Instant::now();
    while view.status().is_none() && started.elapsed() < PATIENCE && !interrupt.is_set() {
        while let Some(status) = statuses.take()? {
            if status.check().is_ok() {
                view.take(status);
            }
        }
        std::thread::sleep(QUIET_POLL);
    }
    let wire = Wire::open(args.tcp_port(), args.pty.as_deref(), args.user)?;
    tell(args, &instance, &wire);
    let mut endpoint = Endpoint {
        statuses,
        auxiliaries: transport.auxiliary_source()?,
        view,
        session: Session::new(settings(config, args)),
        sent: Sent::new(args.ahead),
        hands: Hands::start(config, &link).map_err(EndpointError::Thread)?,
        checking: Checking::new(config),
        transport,
        wire,
        started: Instant::now(),
        cleaned_up: Instant::now(),
        looked_ns: Monotonic.now_ns(),
    };
    endpoint.serve(&interrupt)?;
    Ok(interrupt.exit())
}

/// Where senders connect to.
fn tell(args: &GrblArgs, instance: &str, wire: &Wire) {
    let pty = args.pty.as_ref().map(|link| link.display().to_string());
    if args.operator.basic.json {
        output::object(&json!({
            "instance": instance,
            "port": wire.port(),
            "pty": pty,
            "rx_bytes": args.rx_bytes,
        }));
        return;
    }
    let tcp = wire.port().map(|port| format!("TCP 127.0.0.1:{port}"));
    let places: Vec<String> = tcp.into_iter().chain(pty).collect();
    output::result(&format!(
        "grbl: a sender connects to {}; whoever does moves the machine\n\
         Ctrl-C ends the endpoint; a job that is under way comes to its end.\n",
        places.join(" or ")
    ));
}

/// What senders read of the configuration.
fn settings(config: &MachineConfig, args: &GrblArgs) -> MachineSettings {
    let (mut least, mut most) = config.travel();
    for axis in 0..AXES {
        // One without ends is told as a turn, either way.
        if !least[axis].is_finite() || !most[axis].is_finite() {
            (least[axis], most[axis]) = (-1e6, 1e6);
        }
    }
    let limits = config.limits();
    MachineSettings {
        axes: config
            .axis_names()
            .iter()
            .map(|axis| axis.index())
            .collect(),
        least: least.into(),
        most: most.into(),
        velocity: limits.velocity.into(),
        acceleration: limits.acceleration.into(),
        jog_velocity: config.jog.velocity.into(),
        tolerance_mm: config.path.tolerance_mm,
        has_homing: config.feedback.homing != HomingBy::Nobody,
        most_rpm: MachineSettings::default().most_rpm,
        spindle_override: percents(config.spindle_override),
        rx_bytes: args.rx_bytes.into(),
        ahead_t: args.ahead,
        version: env!("CARGO_PKG_VERSION").to_owned(),
    }
}

/// A machine and its senders, one after the other.
struct Endpoint {
    statuses: Box<dyn Subscriber<Status>>,
    auxiliaries: Box<dyn Subscriber<Auxiliary>>,
    view: View,
    session: Session,
    sent: Sent,
    hands: Hands,
    checking: Checking,
    transport: Ipc,
    wire: Wire,
    started: Instant,
    cleaned_up: Instant,
    /// When it looked last, ns of the host's steady clock.
    looked_ns: u64,
}

impl Endpoint {
    fn serve(&mut self, interrupt: &Interrupt) -> Result<(), Failure> {
        while !interrupt.is_set() {
            self.look()?;
            let is_busy = self.session.is_urgent() || self.wire.is_new();
            self.wire.wait(if is_busy { BUSY_POLL } else { QUIET_POLL });
        }
        // What a sender sent last is not to be executed by nobody's leave.
        self.session.lost();
        let asked_ns = Monotonic.now_ns();
        self.act(asked_ns);
        let now = self.started.elapsed();
        self.sent.turn(&self.transport, &mut self.session, now);
        Ok(())
    }

    fn look(&mut self) -> Result<(), Failure> {
        while let Some(status) = self.statuses.take()? {
            if status.check().is_ok() {
                self.view.take(status);
            }
        }
        while let Some(told) = self.auxiliaries.take()? {
            if told.check().is_ok() {
                self.view.told(told);
            }
        }
        if self.cleaned_up.elapsed() >= CLEAN_UP_EVERY {
            self.cleaned_up = Instant::now();
            self.transport.clean_up_dead_peers()?;
            self.transport.stands()?;
        }
        let now = self.started.elapsed();
        let (asked_ns, stood_still) = self.asked_ns();
        let machine = self.view.machine(self.sent.zero());
        self.session.ask_at(asked_ns);
        self.session.see(&machine, now);
        self.wire.turn(&mut self.session, now);
        if stood_still {
            self.session.stood_still();
        }
        self.sent.turn(&self.transport, &mut self.session, now);
        self.act(asked_ns);
        self.wire.send(&mut self.session);
        Ok(())
    }

    /// When what is heard now was asked for at the earliest, ns of the host's steady clock, and whether this endpoint
    /// stood still until now.
    fn asked_ns(&mut self) -> (u64, bool) {
        let now_ns = Monotonic.now_ns();
        let looked_ns = core::mem::replace(&mut self.looked_ns, now_ns);
        let late = Duration::from_nanos(now_ns.saturating_sub(looked_ns));
        let stood_still = late > STALL;
        (if stood_still { looked_ns } else { now_ns }, stood_still)
    }

    /// Has done what the machine is to do at once, and was asked for at that time.
    fn act(&mut self, asked_ns: u64) {
        for act in self.session.take_acts() {
            if let Act::Judge(line) = &act {
                let refused = self.checking.judge(line, self.view.position());
                self.session.judged(refused.as_ref());
                continue;
            }
            self.hands.act(act, self.view.status(), asked_ns);
        }
        for (act, answer) in self.hands.answers() {
            match answer {
                Ok(()) => self.session.accepted(&act),
                Err(why) => self.session.refused(&act, &why),
            }
        }
    }
}

/// Whole percents inside a range of ratios.
#[allow(clippy::cast_possible_truncation, reason = "10 to 200")]
fn percents([least, most]: [f64; 2]) -> (i32, i32) {
    let near = |ratio: f64| (1e6 * ratio).round() * 1e-4;
    (near(least).ceil() as i32, near(most).floor() as i32)
}
