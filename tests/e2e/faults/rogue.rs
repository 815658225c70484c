//! A planner that makes one bad frame.

use std::time::{Duration, Instant};

use glidepath_link::{Delivery, FrameSink, MachineState, SetpointFrame, Transport};
use glidepath_program::Frame;

use super::bench::{Bench, Checked, Heard};
use super::case::{Chance, Fault};

const PERIOD_NS: u64 = 4_000_000;
/// As far ahead as a planner with the built-in configuration.
const HORIZON: u64 = 150;
/// What a position has at most.
const FAR_MM: f64 = 1e5;

/// Plays frames as a planner does, from a thread of the test.
pub(super) struct Rogue {
    sink: Box<dyn FrameSink>,
    frames: Vec<SetpointFrame>,
    /// What is offered next, an index of `frames`.
    next: usize,
}

impl Rogue {
    /// Connects, for the epoch after the machine's last.
    pub(super) fn connect(bench: &Bench<'_>, frames: &[Frame]) -> Checked<Self> {
        let sink = bench
            .transport
            .frame_sink()
            .map_err(|error| error.to_string())?;
        let last = bench.look(|heard| heard.status.map(|status| status.epoch));
        let epoch = last.ok_or("no status")? + 1;
        let record = |frame| SetpointFrame::from_frame(frame, epoch, PERIOD_NS);
        Ok(Self {
            sink,
            frames: frames.iter().map(record).collect(),
            next: 0,
        })
    }

    /// Makes the next frame a bad one.
    pub(super) fn spoil(&mut self, fault: Fault, chance: &mut Chance) -> Checked<()> {
        let at = self.next;
        let frame = self.frames.get_mut(at).ok_or("all frames are sent")?;
        match fault {
            Fault::CorruptFrame => {
                let bytes = size_of::<SetpointFrame>();
                let (place, change) = (chance.below(bytes), chance.between(1, 255));
                *frame = with_byte_changed(frame, place, u8::try_from(change).unwrap());
            }
            Fault::RepeatFrame => {
                let frame = *frame;
                self.frames.insert(at, frame);
            }
            Fault::SkipFrame => {
                self.frames.remove(at);
            }
            Fault::SpoilNumber => {
                let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][chance.below(3)];
                let vector = match chance.below(3) {
                    0 => &mut frame.position,
                    1 => &mut frame.velocity,
                    _ => &mut frame.acceleration,
                };
                vector[chance.below(9)] = bad;
            }
            Fault::MoveFrame => frame.position[chance.below(3)] += 0.5,
            Fault::MoveFrameFar => frame.position[chance.below(3)] = FAR_MM,
            Fault::ChangeVelocity => frame.velocity[chance.below(3)] += 50.0,
            Fault::OldEpoch => frame.epoch -= 1,
            Fault::NewEpoch => frame.epoch += 1,
            other => return Err(format!("{other:?} is not about a frame")),
        }
        Ok(())
    }

    /// Offers frames for as long as what was heard does not please, and there are any.
    pub(super) fn play(
        &mut self,
        bench: &Bench<'_>,
        what: &str,
        pleases: impl Fn(&Heard) -> bool,
    ) -> Checked<()> {
        let begun = Instant::now();
        while !bench.look(&pleases) {
            self.offer(bench)?;
            if begun.elapsed() > Duration::from_secs(30) {
                return Err(format!("played in vain for {what}"));
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        Ok(())
    }

    /// Offers what the machine wants.
    fn offer(&mut self, bench: &Bench<'_>) -> Checked<()> {
        let epoch = self.frames.first().map_or(0, |frame| frame.epoch);
        let executed = bench.look(|heard| {
            let status = heard.status.filter(|status| status.epoch == epoch);
            let ended = heard.is(MachineState::Faulted);
            status.map_or(0, |status| {
                if ended {
                    u64::MAX
                } else {
                    status.frames_executed
                }
            })
        });
        while let Some(frame) = self.frames.get(self.next) {
            if self.next as u64 >= executed.saturating_add(HORIZON) {
                return Ok(());
            }
            let delivery = self.sink.offer(frame).map_err(|error| error.to_string())?;
            if delivery != Delivery::Delivered {
                return Ok(());
            }
            self.next += 1;
        }
        Ok(())
    }
}

fn with_byte_changed(frame: &SetpointFrame, place: usize, change: u8) -> SetpointFrame {
    let mut frame = *frame;
    bytemuck::bytes_of_mut(&mut frame)[place] ^= change;
    frame
}
