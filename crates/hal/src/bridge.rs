//! The bridge between setpoints and HAL: which lines are written, and what rows mean. It knows no
//! processes and no clock.

use crate::layout::{Layout, Row, tick_of};
use bytemuck::Zeroable as _;
use glidepath_link::servo::{JointState, JointStates};
use glidepath_link::{DriveState, Feedback, Setpoint};
use std::collections::VecDeque;

/// Rows over which velocities are taken: HAL's rows have six digits behind the point, and encoders
/// have steps.
const VELOCITY_ROWS: usize = 8;
/// Rows at rest after which the FIFO is judged.
const JUDGED_ROWS: u32 = 256;
/// How far off its mean may be, lines.
const FILL_TOLERANCE: f64 = 1.5;
/// Lines that are remembered until they come back: more than the FIFO and the pipes hold.
const REMEMBERED: usize = 8192;
/// Lines behind the clock beyond which they are left out: so many that the FIFO has run empty long
/// ago, which has opened the enable chain.
const GIVEN_UP: u64 = 256;

/// Faults of HAL's drives, as numbers in [`Feedback::fault_code`].
const FAULT_PIN: u32 = 1;
const FAULT_UNDERRUN: u32 = 2;

/// The counts of what went through so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct HalCounts {
    /// Lines written.
    pub lines: u64,
    /// Rows read.
    pub rows: u64,
    /// Rows that HAL lost because they were not read in time.
    pub lost_rows: u64,
    /// Periods of HAL in which there was no line, since the first one.
    pub underruns: u64,
    /// Lines that were added or left out at rest, to have as many in the FIFO as there are to be.
    pub recentred: u64,
}

/// A line on its way.
#[derive(Debug, Clone, Copy)]
struct Sent {
    tick: u32,
    time_ns: u64,
    reference: u64,
    number: u64,
}

#[derive(Debug)]
pub(crate) struct Bridge {
    layout: Layout,
    period_ns: u64,
    prefill: u32,
    boot_id: u64,
    counts: HalCounts,
    /// The period whose line is next.
    next: Option<u64>,
    sent: VecDeque<Sent>,
    /// What the last line said.
    told: JointStates,
    rests: bool,
    asks_power: bool,
    /// Where the joints were last, and some rows before.
    places: VecDeque<[f64; 9]>,
    last: Option<Row>,
    stamped_ns: u64,
    repeats: u64,
    /// Whether the FIFO ran empty since power was asked for last.
    ran_empty: bool,
    unknown_rows: u32,
    fill: (f64, u32),
    /// Lines to be added at rest, or left out.
    owed: i64,
}

fn standing(places: &[f64; 9]) -> JointStates {
    places.map(|position| JointState {
        position,
        ..JointState::default()
    })
}

#[allow(clippy::float_cmp, reason = "at rest a demand is the same to the bit")]
fn are_at_rest(before: &JointStates, now: &JointStates) -> bool {
    let mut pairs = before.iter().zip(now);
    pairs.all(|(before, now)| {
        (now.velocity, now.acceleration) == (0.0, 0.0) && now.position == before.position
    })
}

impl Bridge {
    pub(crate) fn new(layout: Layout, period_ns: u64, prefill: u32, boot_id: u64) -> Self {
        Self {
            layout,
            period_ns,
            prefill,
            boot_id,
            counts: HalCounts::default(),
            next: None,
            sent: VecDeque::with_capacity(REMEMBERED),
            told: [JointState::default(); 9],
            rests: true,
            asks_power: false,
            places: VecDeque::with_capacity(VELOCITY_ROWS + 1),
            last: None,
            stamped_ns: 0,
            repeats: 0,
            ran_empty: false,
            unknown_rows: 0,
            fill: (0.0, 0),
            owed: 0,
        }
    }

    pub(crate) const fn counts(&self) -> &HalCounts {
        &self.counts
    }

    /// Whether the last line moves nothing.
    pub(crate) const fn is_at_rest(&self) -> bool {
        self.rests
    }

    /// Rows in a row whose ticks were none of the lines'.
    pub(crate) const fn unknown_rows(&self) -> u32 {
        self.unknown_rows
    }

    /// Rows were lost before the next one.
    pub(crate) fn lose_rows(&mut self) {
        self.counts.lost_rows += 1;
        self.places.clear();
    }

    /// Writes the lines that are due. None before the first row: until then nobody knows where the
    /// joints stand.
    pub(crate) fn write(
        &mut self,
        now_ns: u64,
        setpoint: Option<&Setpoint>,
        mut demand: impl FnMut(u64) -> Option<JointStates>,
        out: &mut String,
    ) {
        if self.last.is_none() {
            return;
        }
        let due = now_ns / self.period_ns;
        let mut next = match self.next {
            Some(next) if due <= next + GIVEN_UP => next,
            // The FIFO is empty.
            None | Some(_) => {
                self.fill_up(due, setpoint, out);
                due + 1
            }
        };
        while next <= due {
            let line = self.line_of(setpoint, demand(next * self.period_ns));
            self.rests = are_at_rest(&self.told, &line);
            if self.rests && self.owed < 0 {
                (self.owed, self.counts.recentred) = (self.owed + 1, self.counts.recentred + 1);
            } else {
                self.put(next, line, setpoint, out);
            }
            while self.rests && self.owed > 0 {
                (self.owed, self.counts.recentred) = (self.owed - 1, self.counts.recentred + 1);
                self.put(next, line, setpoint, out);
            }
            next += 1;
        }
        self.next = Some(next);
    }

    /// Writes as many lines as the FIFO is to hold, all of them at rest.
    fn fill_up(&mut self, due: u64, setpoint: Option<&Setpoint>, out: &mut String) {
        let at_rest = self.line_of(setpoint, None);
        for _ in 0..self.prefill {
            self.put(due, at_rest, setpoint, out);
        }
        (self.fill, self.owed) = ((0.0, 0), 0);
    }

    /// What a line says of the joints. Without a demand they stay where they are: with power, or
    /// about to have it, where they were told to be; without, where they say that they are, so that
    /// HAL's loops begin without an error.
    fn line_of(&mut self, setpoint: Option<&Setpoint>, demand: Option<JointStates>) -> JointStates {
        let mask = self.layout.mask();
        let asked_before = self.asks_power;
        self.asks_power = setpoint.is_some_and(|setpoint| setpoint.enable & mask == mask);
        self.ran_empty &= !self.asks_power || asked_before;
        let actual = self.last.map_or([0.0; 9], |row| row.position);
        match demand {
            Some(demand) if self.asks_power => demand,
            _ if self.asks_power => standing(&self.told.map(|joint| joint.position)),
            _ => standing(&actual),
        }
    }

    fn put(
        &mut self,
        index: u64,
        line: JointStates,
        setpoint: Option<&Setpoint>,
        out: &mut String,
    ) {
        let tick = tick_of(index);
        self.layout.write(out, tick, self.asks_power, &line);
        self.told = line;
        self.counts.lines += 1;
        if self.sent.len() == REMEMBERED {
            self.sent.pop_front();
        }
        self.sent.push_back(Sent {
            tick,
            time_ns: index * self.period_ns,
            reference: setpoint.map_or(0, |setpoint| setpoint.reference),
            number: setpoint.map_or(0, |setpoint| setpoint.number),
        });
    }

    /// What a row says to the interpolator; nothing as long as no line of ours came back.
    pub(crate) fn take(&mut self, row: Row) -> Option<Feedback> {
        self.counts.rows += 1;
        let before = self.last.replace(row);
        if self.places.len() > VELOCITY_ROWS {
            self.places.pop_front();
        }
        self.places.push_back(row.position);
        self.next?;
        let Some(at) = self.sent.iter().position(|sent| sent.tick == row.tick) else {
            self.unknown_rows += 1;
            return None;
        };
        self.unknown_rows = 0;
        self.sent.drain(..at);
        let sent = *self.sent.front()?;
        let repeats = before.is_some_and(|before| before.tick == row.tick);
        self.repeats = if repeats { self.repeats + 1 } else { 0 };
        if repeats && row.depth <= 0 {
            self.counts.underruns += 1;
            self.ran_empty = true;
        }
        self.judge_fill(&row);
        // A row of a line that HAL waited for is not older than the one before.
        let time_ns = sent.time_ns + self.repeats * self.period_ns;
        self.stamped_ns = self.stamped_ns.max(time_ns);
        Some(self.feedback(&row, &sent))
    }

    fn judge_fill(&mut self, row: &Row) {
        if !self.rests {
            self.fill = (0.0, 0);
            return;
        }
        #[allow(clippy::cast_precision_loss, reason = "a few thousand at most")]
        let depth = row.depth as f64;
        self.fill = (self.fill.0 + depth, self.fill.1 + 1);
        if self.fill.1 < JUDGED_ROWS {
            return;
        }
        let off = f64::from(self.prefill) - self.fill.0 / f64::from(self.fill.1);
        self.fill = (0.0, 0);
        if off.abs() > FILL_TOLERANCE {
            #[allow(clippy::cast_possible_truncation, reason = "a few thousand at most")]
            let lines = off.round() as i64;
            self.owed = lines;
        }
    }

    #[allow(clippy::cast_precision_loss, reason = "a few periods are exact")]
    fn velocities(&self) -> [f64; 9] {
        let mut velocities = [0.0; 9];
        if let (Some(first), Some(last)) = (self.places.front(), self.places.back())
            && self.places.len() > 1
        {
            let span_t = (self.places.len() - 1) as f64 * self.period_ns as f64 * 1e-9;
            for (velocity, (from, to)) in velocities.iter_mut().zip(first.iter().zip(last)) {
                *velocity = (to - from) / span_t;
            }
        }
        velocities
    }

    fn feedback(&self, row: &Row, sent: &Sent) -> Feedback {
        let mask = self.layout.mask();
        let of = |is: bool| if is { mask } else { 0 };
        let state = match (row.has_fault, row.has_power) {
            (true, _) => DriveState::Fault,
            (false, true) => DriveState::OperationEnabled,
            (false, false) => DriveState::Ready,
        };
        let code = match (row.has_fault, self.ran_empty) {
            (false, _) => 0,
            (true, false) => FAULT_PIN,
            (true, true) => FAULT_UNDERRUN,
        };
        let mut feedback = Feedback {
            boot_id: self.boot_id,
            number: self.counts.rows,
            sample_ns: self.stamped_ns,
            reference: sent.reference,
            setpoint_number: sent.number,
            joints: mask,
            enabled: of(row.has_power),
            homed: mask,
            fault: of(row.has_fault),
            home_switch: row.home_switch,
            position: row.position,
            velocity: self.velocities(),
            ..Feedback::zeroed()
        };
        for joint in 0..9 {
            if mask & (1 << joint) != 0 {
                feedback.drive_state[joint] = state.code();
                feedback.fault_code[joint] = code;
            }
        }
        feedback
    }
}

#[cfg(test)]
mod tests;
