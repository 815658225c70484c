//! Stop requests: what the operator and the faults want of the motion, and the state that follows.
//!
//! Each reason to stop is kept by itself, and the state is worked out from them: a hold during
//! starvation, or a fault during a hold, needs no case of its own.
//!
//! | reason | while moving | at rest | ends by |
//! |---|---|---|---|
//! | fault | Stopping | Faulted (the epoch has ended) | reset |
//! | abort | Stopping | Idle (the epoch has ended) | – |
//! | program stop, end of a block | – | ProgramStop | resume, step |
//! | feed hold, or override 0, or an adaptive feed of 0 | Holding | Held | resume, step, or another override |
//! | the other way along the path is wanted | Holding | – | the turn |
//! | the way back ends here | – | Held | the way onward is wanted |
//! | too few frames | Starving | Starved | frames |
//! | the plan rests and has no more | – | Waiting | frames |
//! | none | Running | Running | |
//!
//! That the operator wants to rest at the end of a block is no reason to stop before the motion is
//! there; how it gets there is for the rate of program time.

use crate::real_time::block_end::Ends;
use crate::real_time::queue_level::QueueLevel;
use crate::shared::fault::Fault;
use crate::shared::message::Order;
use glidepath_link::{Command, MachineState};

/// Reasons to stop, and overrides.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StopRequests {
    fault: Option<Fault>,
    abort: bool,
    hold: bool,
    program_stop: bool,
    /// The motion stands at the end of a block.
    block_end: bool,
    /// It is to do so once.
    stop_at_block_end: bool,
    /// It is to do so at every block.
    single_block: bool,
    feed_override: f64,
    rapid_override: f64,
    /// What slows the program down besides, -1 to 1; below 0 it turns the motion round.
    adaptive_r: f64,
    /// The operator wants the motion to go back along the path.
    is_reversed: bool,
    /// Which way the motion goes.
    heading: Heading,
    /// It was told that there is no way back from where the motion stands.
    is_told: bool,
    /// Both together, for feeds and for rapids: every tick asks for them, and they change seldom.
    feed_r: f64,
    rapid_r: f64,
    /// It goes, or is to go, through frames that were passed before.
    retraces: bool,
    /// No rapid is to begin.
    bars_rapids: bool,
    /// A job has the machine, and none of its frames has come.
    is_prepared: bool,
}

/// Which way along the path the motion goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Heading {
    /// As the frames come in.
    Onward,
    /// Onward, through frames that were passed before, or taken to be.
    OnwardAgain,
    /// Back through frames that were passed.
    Back,
    /// Nowhere: there is no way back beyond this.
    BackAtEnd,
}

impl Heading {
    /// Whether the track that is played is the way back.
    pub(crate) const fn is_back(self) -> bool {
        matches!(self, Self::Back | Self::BackAtEnd)
    }
}

/// What the operator lets the motion pass, of what it stands at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Released {
    pub(crate) program_stop: bool,
    pub(crate) block_end: bool,
}

impl Released {
    const NOTHING: Self = Self {
        program_stop: false,
        block_end: false,
    };
}

impl Default for StopRequests {
    fn default() -> Self {
        Self {
            fault: None,
            abort: false,
            hold: false,
            program_stop: false,
            block_end: false,
            stop_at_block_end: false,
            single_block: false,
            feed_override: 1.0,
            rapid_override: 1.0,
            adaptive_r: 1.0,
            is_reversed: false,
            heading: Heading::Onward,
            is_told: false,
            feed_r: 1.0,
            rapid_r: 1.0,
            retraces: false,
            bars_rapids: false,
            is_prepared: false,
        }
    }
}

impl StopRequests {
    /// Carries out an order. Returns what the motion is to pass of that which it stands at.
    pub(crate) const fn carry_out(&mut self, order: Order, is_open: bool) -> Released {
        match order {
            Order::Command(command) => return self.carry_out_command(command, is_open),
            Order::Fault(fault) | Order::Cut(fault) => self.fail(fault),
            Order::Prepare(is_prepared) => self.prepare(is_prepared, is_open),
            // These concern the supply, the joints and the epochs.
            Order::PlannerLives | Order::Joints(_) | Order::Bar(_) => {}
        }
        Released::NOTHING
    }

    const fn carry_out_command(&mut self, command: Command, is_open: bool) -> Released {
        match command {
            // Without power there is no motion.
            Command::Disable => self.abort = is_open,
            // The ports thread has answered them, or they concern drives or the jog.
            Command::Ping
            | Command::Tell
            | Command::Enable
            | Command::SetPosition { .. }
            | Command::Home(_)
            | Command::Unhome(_)
            | Command::Return
            | Command::JogOverride(_)
            | Command::SpindleOverride(_)
            | Command::Job { .. }
            | Command::Acknowledge { .. } => {}
            Command::Hold => self.hold = is_open || self.is_prepared,
            Command::Resume => return self.go_on(),
            Command::Step => {
                self.stop_at_block_end = is_open;
                return self.go_on();
            }
            Command::StopAtEndOfBlock => self.stop_at_block_end = is_open,
            Command::SingleBlock(on) => self.single_block = on,
            Command::FeedOverride(ratio) => {
                self.feed_override = ratio.abs();
                self.reverse(ratio < 0.0 && is_open);
            }
            Command::Reverse => self.reverse(is_open),
            Command::Forward => self.reverse(false),
            Command::RapidOverride(ratio) => {
                self.rapid_override = ratio;
                self.adapt(self.adaptive_r);
            }
            Command::Abort => self.abort = is_open,
            Command::Reset if is_open => self.abort = true,
            Command::Reset => self.fault = None,
        }
        Released::NOTHING
    }

    const fn go_on(&mut self) -> Released {
        self.hold = false;
        Released {
            program_stop: core::mem::replace(&mut self.program_stop, false),
            block_end: core::mem::replace(&mut self.block_end, false),
        }
    }

    /// A job has the machine: a hold counts for the epoch to come.
    const fn prepare(&mut self, is_prepared: bool, is_open: bool) {
        self.is_prepared = is_prepared && !is_open;
        self.hold = self.hold && (is_open || is_prepared);
    }

    /// The job that has the machine does not begin: a hold of it is over, too.
    pub(crate) const fn give_machine_back(&mut self) {
        if self.is_prepared {
            self.prepare(false, false);
        }
    }

    /// Whether a job has the machine, of which no frame has come.
    pub(crate) const fn is_prepared(&self) -> bool {
        self.is_prepared
    }

    /// The program goes on only when the operator says so.
    pub(crate) const fn hold(&mut self) {
        self.hold = true;
    }

    /// The epoch is to end.
    pub(crate) const fn abort(&mut self) {
        self.abort = true;
    }

    /// Latches a fault. The first one stays: the others follow from it.
    pub(crate) const fn fail(&mut self, fault: Fault) {
        if self.fault.is_none() {
            self.fault = Some(fault);
        }
    }

    pub(crate) const fn fault(&self) -> Option<&Fault> {
        self.fault.as_ref()
    }

    /// True if the epoch is to end as soon as the motion has come to rest.
    pub(crate) const fn is_stopping(&self) -> bool {
        self.abort || self.fault.is_some()
    }

    /// The motion stands at a program stop.
    pub(crate) const fn wait_for_operator(&mut self) {
        self.program_stop = true;
    }

    /// The motion stands at the end of a block.
    pub(crate) const fn stand_at_block_end(&mut self) {
        self.block_end = true;
        self.stop_at_block_end = false;
    }

    /// The ends of blocks at which the motion is to rest. A single block ends before a rapid, too.
    pub(crate) const fn wanted_ends(&self) -> Option<Ends> {
        if self.single_block || self.stop_at_block_end {
            Some(Ends::Every)
        } else if self.bars_rapids {
            Some(Ends::BeforeRapids)
        } else {
            None
        }
    }

    /// Whether no rapid is to begin.
    pub(crate) const fn bars_rapids(&self) -> bool {
        self.bars_rapids
    }

    /// Whether it rests there.
    pub(crate) const fn is_at_block_end(&self) -> bool {
        self.block_end
    }

    pub(crate) const fn is_single_block(&self) -> bool {
        self.single_block
    }

    /// An epoch begins or ends: only a latched fault, the overrides and the single-block mode
    /// outlive it, and a hold if the program goes on or was prepared. Every program begins onward.
    pub(crate) const fn forget_epoch(&mut self, goes_on: bool) {
        let goes_on = goes_on || core::mem::replace(&mut self.is_prepared, false);
        self.go(Heading::Onward);
        self.reverse(false);
        self.abort = false;
        self.hold = self.hold && goes_on;
        self.program_stop = false;
        self.block_end = false;
        self.stop_at_block_end = false;
    }

    /// Those of feeds and of rapids as commanded; that of feeds is below 0 if the motion is to go
    /// back.
    pub(crate) const fn overrides(&self) -> (f64, f64) {
        let feed = if self.is_reversed {
            -self.feed_override
        } else {
            self.feed_override
        };
        (feed, self.rapid_override)
    }

    const fn reverse(&mut self, is_reversed: bool) {
        self.is_reversed = is_reversed;
        self.adapt(self.adaptive_r);
    }

    /// The motion turns where it stands. What it stood at on its way does not hold it on the other.
    pub(crate) const fn turn(&mut self, heading: Heading) {
        self.hold |= self.program_stop;
        self.go(heading);
    }

    /// The motion goes this way from now on.
    pub(crate) const fn go(&mut self, heading: Heading) {
        self.heading = heading;
        self.adapt(self.adaptive_r);
    }

    /// There is no way back from where it stands. Returns whether that is news.
    pub(crate) const fn refuse_to_turn(&mut self) -> bool {
        !core::mem::replace(&mut self.is_told, true)
    }

    /// Which way it goes.
    pub(crate) const fn heading(&self) -> Heading {
        self.heading
    }

    /// Whether it goes the other way than is wanted.
    pub(crate) const fn is_to_turn(&self) -> bool {
        self.wants_back() != self.heading.is_back()
    }

    const fn wants_back(&self) -> bool {
        self.is_reversed != (self.adaptive_r < 0.0)
    }

    /// Whether it goes, or is to go, through frames that were passed before. Every tick asks.
    pub(crate) const fn retraces(&self) -> bool {
        self.retraces
    }

    /// The rate of program time that is wanted, where supply does not matter.
    pub(crate) fn wanted_rate(&self, is_rapid: bool, planned_override: f64) -> f64 {
        if self.is_stopping() || self.hold || self.block_end {
            return 0.0;
        }
        (self.commanded(is_rapid) / planned_override).min(1.0)
    }

    /// The override, and what slows the program down besides.
    const fn commanded(&self, is_rapid: bool) -> f64 {
        if is_rapid { self.rapid_r } else { self.feed_r }
    }

    /// An input slows the program down, -1 to 1; below 0 it turns it round.
    pub(crate) const fn adapt(&mut self, ratio: f64) {
        self.adaptive_r = ratio;
        if self.wants_back() && matches!(self.heading, Heading::BackAtEnd) || self.is_to_turn() {
            (self.feed_r, self.rapid_r) = (0.0, 0.0);
        } else {
            self.feed_r = self.feed_override * ratio.abs();
            self.rapid_r = self.rapid_override * ratio.abs();
        }
        self.is_told &= self.wants_back();
        // While feeds are held as well, nothing moves that could come to a rapid.
        let is_onward = !self.wants_back() && !self.heading.is_back();
        self.bars_rapids = is_onward && self.rapid_r <= 0.0 && self.feed_r > 0.0;
        self.retraces = self.wants_back() || !matches!(self.heading, Heading::Onward);
    }

    /// Whether something keeps the motion from going on that a resume ends.
    pub(crate) const fn is_held(&self) -> bool {
        self.hold || self.block_end || self.program_stop
    }

    /// Whether the operator keeps the motion from going on.
    pub(crate) fn holds(&self, is_rapid: bool) -> bool {
        self.is_held() || self.commanded(is_rapid) <= 0.0
    }

    pub(crate) fn state(
        &self,
        is_open: bool,
        standing: bool,
        is_rapid: bool,
        queue_level: &QueueLevel,
    ) -> MachineState {
        use MachineState::{
            Faulted, Held, Holding, Idle, ProgramStop, Running, Starved, Starving, Stopping,
            Waiting,
        };
        let choose = |at_rest, moving| if standing { at_rest } else { moving };
        match (is_open, self.fault.is_some()) {
            (false, true) => Faulted,
            (false, false) => Idle,
            (true, _) if self.is_stopping() => Stopping,
            (true, _) if self.program_stop || self.block_end => ProgramStop,
            (true, _) if self.holds(is_rapid) => choose(Held, Holding),
            (true, _) if queue_level.is_short() => choose(Starved, Starving),
            (true, _) if standing && queue_level.is_out() => Waiting,
            (true, _) if standing && queue_level.is_barred() => Starved,
            (true, _) => Running,
        }
    }
}
