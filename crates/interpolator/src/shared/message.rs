//! The messages between the two threads, by rings of fixed size.
//!
//! ```text
//!  ports thread ── SetpointFrame, Order, Demand ──►  real-time thread
//!               ◄──────── TickReport, LogEvent ──────
//! ```

pub(crate) mod jog_demand;
pub(crate) mod joints_order;
pub(crate) mod observation;
pub(crate) mod superposition_demand;

use crate::shared::fault::Fault;
use core::fmt;
use glidepath_kinematics::JointVector;
use glidepath_link::{
    Command, EndOfEpoch, EventId, FreezeReason, MachineState, Power, Setpoint, SetpointFrame,
    StateChange, SuperpositionState,
};
use heapless::spsc::{Consumer, Producer, Queue};
use jog_demand::{Demand, Jogged};
use joints_order::{JointsOrder, Moved};
use observation::Observation;

/// Frames under way between the threads, one less.
pub(crate) const FRAMES: usize = 256;
/// Observations under way, one less. Only the last counts.
pub(crate) const OBSERVATIONS: usize = 4;
/// Orders under way, one less.
pub(crate) const ORDERS: usize = 32;
/// Demands for a jog under way, one less.
pub(crate) const DEMANDS: usize = 32;
/// Reports under way, one less: a second at 4 ms.
pub(crate) const REPORTS: usize = 256;
/// Happenings under way, one less.
pub(crate) const LOG_EVENTS: usize = 128;

/// The rings between the threads. Large, so each has a place of its own on the heap: a box of all
/// of them would be built on the stack first, and the thread that calls [`run`](crate::run) may have
/// no more than the 2 MiB that a thread has by default.
#[derive(Default)]
pub(crate) struct Rings {
    pub(crate) frames: Box<Queue<SetpointFrame, FRAMES>>,
    pub(crate) orders: Box<Queue<Order, ORDERS>>,
    pub(crate) demands: Box<Queue<Demand, DEMANDS>>,
    pub(crate) observations: Box<Queue<Observation, OBSERVATIONS>>,
    pub(crate) reports: Box<Queue<TickReport, REPORTS>>,
}

/// The ends of the rings that the real-time thread reads.
pub(crate) struct Inputs<'a> {
    pub(crate) frames: Consumer<'a, SetpointFrame>,
    pub(crate) orders: Consumer<'a, Order>,
    pub(crate) demands: Consumer<'a, Demand>,
    pub(crate) observations: Consumer<'a, Observation>,
}

/// The ends of the rings that the ports thread writes and reads.
pub(crate) struct PortsEnds<'a> {
    pub(crate) frames: Producer<'a, SetpointFrame>,
    orders: Producer<'a, Order>,
    demands: Producer<'a, Demand>,
    pub(crate) observations: Producer<'a, Observation>,
    pub(crate) reports: Consumer<'a, TickReport>,
    /// Stops that were ordered so far: holds, aborts, the power taken.
    stops: u64,
}

impl PortsEnds<'_> {
    /// How many more orders there is room for.
    pub(crate) fn room(&self) -> usize {
        self.orders.capacity() - self.orders.len()
    }

    /// Passes an order on; false if the ring is full.
    pub(crate) fn order(&mut self, order: Order) -> bool {
        let is_stop = matches!(
            order,
            Order::Command(Command::Hold | Command::Abort | Command::Disable)
        );
        let is_passed = self.orders.enqueue(order).is_ok();
        self.stops += u64::from(is_passed && is_stop);
        is_passed
    }

    /// Passes a demand on; false if the ring is full. Demands have a ring of their own, so that they take no room
    /// from orders: so each says which stops it came behind.
    pub(crate) fn demand(&mut self, demand: Demand) -> bool {
        let behind_stops = self.stops;
        let demand = Demand {
            behind_stops,
            ..demand
        };
        self.demands.enqueue(demand).is_ok()
    }
}

impl Rings {
    /// The ends for the real-time thread and for the ports thread.
    pub(crate) fn split(&mut self) -> ((Inputs<'_>, Producer<'_, TickReport>), PortsEnds<'_>) {
        let (frames_in, frames) = self.frames.split();
        let (orders_in, orders) = self.orders.split();
        let (demands_in, demands) = self.demands.split();
        let (observations_in, observations) = self.observations.split();
        let (reports_in, reports) = self.reports.split();
        let ports = PortsEnds {
            frames: frames_in,
            orders: orders_in,
            demands: demands_in,
            observations: observations_in,
            reports,
            stops: 0,
        };
        let inputs = Inputs {
            frames,
            orders,
            demands,
            observations,
        };
        ((inputs, reports_in), ports)
    }
}

/// Ports thread to real-time thread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Order {
    /// What the operator wants. The ports thread has judged it by the state it knew; what the state
    /// does not allow any more is without effect. Never [`Command::Ping`].
    Command(Command),
    /// A frame was refused, the ports failed, or a joint does not follow.
    Fault(Fault),
    /// A joint is so far from its demand that the drives must lose their power at once.
    Cut(Fault),
    /// The planner has no new frames, but is there.
    PlannerLives,
    /// Joints are moved each for itself.
    Joints(JointsOrder),
    /// A job has the machine, or has it no longer.
    Prepare(bool),
    /// No epoch up to this number begins; the one with this number ends, if it is open.
    Bar(u64),
}

/// An event that is awaited.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Awaited {
    pub(crate) epoch: u64,
    /// Of its frame.
    pub(crate) sequence: u64,
    pub(crate) line: u32,
    /// As in a setpoint.
    pub(crate) event_kind: u32,
    pub(crate) event_value: f64,
    /// Since when, ns of `CLOCK_MONOTONIC`.
    pub(crate) since_ns: u64,
    /// Number of the setpoint that told of it.
    pub(crate) told_by: u64,
    /// The drives answer it, and nobody else.
    pub(crate) by_feedback: bool,
}

impl Awaited {
    /// Which event, in a life of the interpolator.
    pub(crate) const fn id(&self, boot_id: u64) -> EventId {
        EventId {
            boot_id,
            epoch: self.epoch,
            sequence: self.sequence,
        }
    }
}

/// How long a tick took, ns; all 0 before the first.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Timing {
    /// From the time at which the thread was to rise to its waking.
    pub(crate) latency_ns: u64,
    /// All work of the tick, before and at the deadline.
    pub(crate) work_ns: u64,
}

/// Real-time thread to ports thread, every tick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TickReport {
    pub(crate) setpoint: Setpoint,
    pub(crate) state: MachineState,
    pub(crate) end_of_epoch: EndOfEpoch,
    pub(crate) fault: Option<Fault>,
    pub(crate) awaited: Option<Awaited>,
    /// The last epoch was left before the event of its block was done.
    pub(crate) is_unanswered: bool,
    /// On the way back to the path, after a jog in a hold.
    pub(crate) is_returning: bool,
    /// The axes are not where the program is held.
    pub(crate) is_away: bool,
    /// A hold, a stop of the program or the end of a block keeps the motion at rest, or brings it there.
    pub(crate) is_held: bool,
    /// Frames of the epoch whose instant has come.
    pub(crate) frames_executed: u64,
    /// Frames the real-time thread owns and has not reached.
    pub(crate) queue_depth: u64,
    /// The timing of the tick before this one.
    pub(crate) timing: Timing,
    pub(crate) late_ticks: u64,
    pub(crate) reports_lost: u64,
    pub(crate) feed_override: f64,
    pub(crate) rapid_override: f64,
    pub(crate) jog_override: f64,
    /// Whose demand for a jog was followed last, and its number.
    pub(crate) jogged: Jogged,
    pub(crate) single_block: bool,
    pub(crate) reserve_stops: u64,
    pub(crate) starved_ticks: u64,
    pub(crate) power: Power,
    pub(crate) moved: Moved,
    /// No epoch up to this number begins any more.
    pub(crate) barred: u64,
    /// On which side of its play each joint is, -1 to 1.
    pub(crate) sides: JointVector,
    pub(crate) superposition: (SuperpositionState, FreezeReason),
}

impl TickReport {
    /// Line and sequence of what is executed; none without a program.
    pub(crate) const fn place(&self) -> (u32, u64) {
        if matches!(self.end_of_epoch, EndOfEpoch::Open) {
            (self.setpoint.line, self.setpoint.sequence)
        } else {
            (0, 0)
        }
    }

    /// The report before the first tick.
    pub(crate) fn blank() -> Self {
        Self {
            setpoint: bytemuck::Zeroable::zeroed(),
            state: MachineState::Idle,
            end_of_epoch: EndOfEpoch::None,
            fault: None,
            awaited: None,
            is_unanswered: false,
            is_returning: false,
            is_away: false,
            is_held: false,
            frames_executed: 0,
            queue_depth: 0,
            timing: Timing::default(),
            late_ticks: 0,
            reports_lost: 0,
            feed_override: 0.0,
            rapid_override: 0.0,
            jog_override: 0.0,
            jogged: Jogged::default(),
            single_block: false,
            reserve_stops: 0,
            starved_ticks: 0,
            power: Power::Simulated,
            moved: Moved::default(),
            barred: 0,
            sides: JointVector::zeros(),
            superposition: (SuperpositionState::None, FreezeReason::None),
        }
    }
}

/// Something for the log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum LogEvent {
    State {
        tick: u64,
        from: MachineState,
        to: MachineState,
        line: u32,
    },
    Missed {
        tick: u64,
        count: u64,
    },
    /// A setpoint exceeded a limit by this part.
    Excess {
        tick: u64,
        part: f64,
    },
    /// The stop in reserve was begun.
    ReserveStop {
        tick: u64,
    },
    /// The motion cannot go further back than to a line.
    WayBackEnds {
        line: u32,
    },
}

impl fmt::Display for LogEvent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::State {
                tick,
                from,
                to,
                line,
            } => {
                let (from, to, line) = (*from, *to, *line);
                write!(f, "tick {tick}: {}", StateChange { from, to, line })
            }
            Self::Missed { tick, count: 1 } => write!(f, "tick {tick}: 1 tick missed"),
            Self::Missed { tick, count } => write!(f, "tick {tick}: {count} ticks missed"),
            Self::Excess { tick, part } => {
                write!(f, "tick {tick}: a limit exceeded by {:.4} %", part * 100.0)
            }
            Self::ReserveStop { tick } => {
                write!(f, "tick {tick}: no later stop is known, so it begins")
            }
            Self::WayBackEnds { line } => {
                write!(f, "the way back ends in line {line}: go on forward")
            }
        }
    }
}
