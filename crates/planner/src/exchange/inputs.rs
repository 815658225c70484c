//! The input watch, which answers the input arbiter: it looks at the inputs of feedback for the M66 that asks.
//!
//! The source gives nothing out before it has its answer, so that the machine rests at the M66; only
//! then the input is looked at, and the time runs. A probing move ends an epoch, and what that came
//! to is its answer.

use std::collections::BTreeMap;
use std::time::Duration;

use glidepath_gcode::{Input, InputWait, Probed, WaitFor};
use glidepath_link::{Feedback, Record as _, Subscriber};

use crate::run::error::RunError;
use crate::run::refusal::Refusal;
use crate::source::input_arbiter::{InputArbiter, InputResult};

/// What `#5399` is where an input did not do in time what was waited for.
const TOO_LATE: f64 = -1.0;
/// Feedback of a stack that is so much older than the newest is not used.
const STALE_NS: u64 = 1_000_000_000;

/// Looks at inputs for the input arbiter.
pub(crate) struct InputWatch {
    arbiter: InputArbiter,
    source: Box<dyn Subscriber<Feedback>>,
    /// The last record of each stack.
    stacks: BTreeMap<u64, Feedback>,
    /// How long the machine has rested at the M66.
    waited: Duration,
    /// What the input was when it was looked at last.
    before: Option<bool>,
}

impl InputWatch {
    pub(crate) fn new(arbiter: InputArbiter, source: Box<dyn Subscriber<Feedback>>) -> Self {
        Self {
            arbiter,
            source,
            stacks: BTreeMap::new(),
            waited: Duration::ZERO,
            before: None,
        }
    }

    /// Looks at the inputs, and answers if the machine `rests` at the M66 that asks.
    ///
    /// # Errors
    /// Feedback cannot be received, or the answer cannot be kept.
    pub(crate) fn look(&mut self, rests: bool, passed: Duration) -> Result<(), RunError> {
        while let Some(feedback) = self.source.take()? {
            if feedback.check().is_ok() {
                self.stacks.insert(feedback.boot_id, feedback);
            }
        }
        let newest = self.stacks.values().map(|f| f.sample_ns).max().unwrap_or(0);
        self.stacks
            .retain(|_, f| newest.saturating_sub(f.sample_ns) < STALE_NS);
        let Some(wait) = self.arbiter.asked().filter(|_| rests) else {
            (self.waited, self.before) = (Duration::ZERO, None);
            return Ok(());
        };
        self.waited = self.waited.saturating_add(passed);
        if let Some(value) = self.value_of(&wait) {
            self.answer(InputResult::Input(value))?;
        }
        Ok(())
    }

    /// Says how a probing move ended.
    ///
    /// # Errors
    /// That cannot be kept.
    pub(crate) fn answer_probe(&self, probed: Probed) -> Result<(), RunError> {
        self.answer(InputResult::Probe(probed))
    }

    fn answer(&self, answer: InputResult) -> Result<(), RunError> {
        let answered = self.arbiter.answer(answer);
        answered.map_err(|error| Refusal::NotKept(error).into())
    }

    fn value_of(&mut self, wait: &InputWait) -> Option<f64> {
        if self.stacks.is_empty() {
            return None;
        }
        let level = match wait.input {
            Input::Analog(number) => return Some(self.analog(number)),
            Input::Digital(number) => self.digital(number),
        };
        let before = self.before.replace(level).unwrap_or(level);
        let is_so = match wait.until {
            WaitFor::Nothing => true,
            WaitFor::Rise => level && !before,
            WaitFor::Fall => !level && before,
            WaitFor::High => level,
            WaitFor::Low => !level,
        };
        if is_so {
            return Some(f64::from(u8::from(level)));
        }
        (self.waited.as_secs_f64() >= wait.limit_s).then_some(TOO_LATE)
    }

    /// An input is high if a stack says so.
    fn digital(&self, number: u32) -> bool {
        let all = self.stacks.values().fold(0, |all, f| all | f.digital_in);
        all.checked_shr(number).unwrap_or(0) & 1 == 1
    }

    /// What the stack says that knows the input: the others say zero.
    fn analog(&self, number: u32) -> f64 {
        let index = usize::try_from(number).unwrap_or(usize::MAX);
        let said = self.stacks.values();
        let said = said.filter_map(|f| f.analog_in.get(index).copied());
        said.fold(0.0, |kept, new| if kept == 0.0 { new } else { kept })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::item_source::{ItemSource as _, Supply};
    use crate::source::pipe::PipeSource;
    use crate::source::program::ProgramSource;
    use crate::source::run_channels::RunChannels;
    use bytemuck::Zeroable as _;
    use glidepath_gcode::{Connections, Options};
    use glidepath_geometry::AxisVector;
    use glidepath_link::{InProcess, Transport as _};
    use glidepath_program::{Event, Item, ItemKind};

    const TURN: Duration = Duration::from_millis(100);

    fn source(text: &'static str, arbiter: &InputArbiter) -> ProgramSource<&'static [u8]> {
        let options = Options {
            connections: Connections::Real,
            default_feed_mm_min: Some(600.0),
            ..Options::default()
        };
        ProgramSource::new(text.as_bytes(), options).attended(RunChannels {
            inputs: Some(arbiter.clone()),
            ..RunChannels::default()
        })
    }

    fn asks(supply: Supply) -> bool {
        matches!(
            supply,
            Supply::Item(Item {
                kind: ItemKind::Event(Event::MCode(66)),
                ..
            })
        )
    }

    /// What `#5399` becomes when an input is so at each turn from where the machine rests.
    fn answer(text: &'static str, levels: &[u64]) -> Option<f64> {
        let link = InProcess::default();
        let mut sink = link.feedback_sink().unwrap();
        let arbiter = InputArbiter::default();
        let mut watch = InputWatch::new(arbiter.clone(), link.feedback_source().unwrap());
        let mut source = source(text, &arbiter);
        assert!(asks(source.next_item()));
        assert!(matches!(source.next_item(), Supply::Pending));
        // The machine is not there yet: whatever the input is does not count.
        let say = |number: u64, digital_in| Feedback {
            boot_id: 3,
            number,
            sample_ns: number * 1_000_000,
            digital_in,
            analog_in: [0.0, 2.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            ..Feedback::zeroed()
        };
        for number in 1..5 {
            sink.publish(&say(number, 0b100 * (number % 2))).unwrap();
            watch.look(false, TURN).unwrap();
            assert!(matches!(source.next_item(), Supply::Pending));
        }
        for (number, level) in (5..).zip(levels) {
            sink.publish(&say(number, level << 2)).unwrap();
            watch.look(true, TURN).unwrap();
            if let Supply::Item(item) = source.next_item() {
                return match item.kind {
                    ItemKind::Move { segment, .. } => Some(segment.end()[0]),
                    _ => None,
                };
            }
        }
        None
    }

    #[test]
    fn inputs_answer_by_level_edge_and_time() {
        let high = "M66 P2 L3 Q0.45\nG0 X[10+#5399]\n";
        assert_eq!(answer(high, &[0, 0, 1]), Some(11.0));
        assert_eq!(answer(high, &[0, 0, 0]), None);
        assert_eq!(answer(high, &[0, 0, 0, 0, 0]), Some(9.0));
        let low = "M66 P2 L4 Q9\nG0 X[10+#5399]\n";
        assert_eq!(answer(low, &[1, 0]), Some(10.0));
        let rise = "M66 P2 L1 Q9\nG0 X[10+#5399]\n";
        assert_eq!(answer(rise, &[1, 1, 1]), None);
        assert_eq!(answer(rise, &[1, 0, 1]), Some(11.0));
        let fall = "M66 P2 L2 Q9\nG0 X[10+#5399]\n";
        assert_eq!(answer(fall, &[0, 1, 0]), Some(10.0));
        let now = "M66 P2 L0\nG0 X[10+#5399]\n";
        assert_eq!(answer(now, &[1]), Some(11.0));
        let analog = "M66 E1\nG0 X[10+#5399]\n";
        assert_eq!(answer(analog, &[0]), Some(12.5));
    }

    #[test]
    fn behind_a_probing_move_a_pipe_waits_for_what_it_came_to() {
        let arbiter = InputArbiter::default();
        let options = Options {
            connections: Connections::Real,
            probing_v: Some(10.0),
            ..Options::default()
        };
        let channels = RunChannels {
            inputs: Some(arbiter.clone()),
            ..RunChannels::default()
        };
        let text = "G38.2 Z-5 F60\nG0 X#5063\n";
        let mut ends = Vec::new();
        let mut read = |pipe: &mut PipeSource| loop {
            match pipe.next_item() {
                Supply::Item(item) => {
                    if let ItemKind::Move { segment, .. } = item.kind {
                        ends.push((segment.start()[2], segment.end()[0]));
                    }
                }
                Supply::Pending => std::thread::yield_now(),
                other => return (other, ends.clone()),
            }
        };
        let mut pipe = PipeSource::spawn(text.as_bytes(), options, channels).unwrap();
        assert!(matches!(read(&mut pipe).0, Supply::Probe));
        std::thread::sleep(Duration::from_millis(20));
        assert!(matches!(pipe.next_item(), Supply::Pending));
        arbiter
            .answer(InputResult::Probe(Probed {
                contact: Some(AxisVector::z() * -2.0),
                was_so: false,
                stands: AxisVector::z() * -2.1,
            }))
            .unwrap();
        let (end, ends) = read(&mut pipe);
        assert!(matches!(end, Supply::End));
        assert_eq!(ends.last(), Some(&(-2.1, -2.0)));
    }
}
