//! Beginning with a line in the middle of a program, as if all before it had been executed.
//!
//! The program is read from its beginning, without motion, up to the line. What spindle, coolant,
//! tool and outputs are to do there, and where the machine is to stand, follows from what was read;
//! what is otherwise now is made so first:
//!
//! ```text
//!  tool axis up ──► tool, spindle, coolant, outputs ──► the other axes ──► tool axis down, at the feed
//! ```

use std::collections::VecDeque;

use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_link::{Auxiliary, Coolant, SpindleState};
use glidepath_program::{CodeWord, Event, Item, ItemKind, PathMode, Rate};
use thiserror::Error;

use crate::{Answer, ItemSource, Refusal, Remainder, ResumePoint, Settled, Supply};

/// What is no way, mm or degrees.
const NO_WAY: f64 = 1e-6;
/// The way down where the program has no feed move ahead, mm/s.
const SLOW_V: f64 = 5.0;
/// Items looked ahead for the feed.
const LOOK_AHEAD: usize = 64;

/// The code that switches the adaptive feed by its P word.
const ADAPTIVE_FEED: u32 = 52;

/// A line, at one of the times that it is executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StartLine {
    /// Its number.
    pub line: u32,
    /// Which time, from 1: it is executed again where it comes after another line.
    pub pass: u32,
}

/// Why a program cannot begin there.
#[derive(Debug, Error)]
pub enum StartLineError {
    /// The program is refused before that line.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// Nothing is executed there.
    #[error(
        "line {line} makes no motion and no event the {pass}. time{}",
        match next {
            Some(next) => format!("; line {next} is the next one that does"),
            None => String::new(),
        }
    )]
    NoSuchLine {
        /// The line.
        line: u32,
        /// Which time.
        pass: u32,
        /// The next line that does something.
        next: Option<u32>,
    },
    /// The line is in the middle of something that has to be executed as a whole.
    #[error("line {line} is on a contour beside the tool (G41, G42); begin before it is entered")]
    OnContour {
        /// The line.
        line: u32,
    },
}

/// A program at a line it is to begin with.
#[derive(Debug)]
pub struct LineStart<S> {
    source: S,
    ahead: VecDeque<Item>,
    /// What comes behind those, if it is no item.
    last: Option<Supply>,
    /// Number of the first item.
    block: u32,
    expected: Auxiliary,
    begins_at: AxisVector,
    told: u32,
    /// What M52 has last made of the adaptive feed, as its P word.
    adaptive: Option<f64>,
}

/// How the machine goes to where a program is to begin.
#[derive(Debug, Clone, Copy)]
pub struct Approach {
    /// Where the machine stands.
    pub position: AxisVector,
    /// What spindle, coolant, tool and outputs do now.
    pub now: Auxiliary,
    /// The axis that goes up first and down last.
    pub tool_axis: Axis,
    /// Where it is up, in machine coordinates; `None`: at the higher one of both ends.
    pub top: Option<f64>,
}

impl<S: ItemSource> LineStart<S> {
    /// Reads a program, opened for the machine where it stands, up to a line. What the program says
    /// nothing of before that line stays as it is. For sources that are never pending.
    ///
    /// # Errors
    /// [`StartLineError`].
    pub fn find(
        mut source: S,
        start: StartLine,
        approach: &Approach,
    ) -> Result<Self, StartLineError> {
        let mut expected = approach.now;
        let (mut begins_at, mut before, mut passes, mut block) = (approach.position, 0, 0, 1);
        let (mut told, mut word, mut adaptive) = (0, None, None);
        let mut next = None;
        loop {
            let item = match source.next_item() {
                Supply::Item(item) => item,
                Supply::Refused(refusal) => return Err(refusal.into()),
                Supply::Pending | Supply::Probe => {
                    return Err(Refusal::AnswerUnknown { line: before }.into());
                }
                Supply::End => {
                    let StartLine { line, pass } = start;
                    return Err(StartLineError::NoSuchLine { line, pass, next });
                }
            };
            if item.line > start.line && next.is_none_or(|next| item.line < next) {
                next = Some(item.line);
            }
            passes += u32::from(item.line == start.line && before != start.line);
            before = item.line;
            if passes == start.pass && item.line == start.line {
                if source.is_on_contour() {
                    return Err(StartLineError::OnContour { line: start.line });
                }
                return Ok(Self {
                    source,
                    ahead: VecDeque::from([item]),
                    last: None,
                    block,
                    expected,
                    begins_at,
                    told,
                    adaptive,
                });
            }
            match item.kind {
                ItemKind::Move { segment, .. } => begins_at = segment.end(),
                ItemKind::Event(event) => {
                    match event {
                        Event::CodeWord { value, .. } => word = Some(value),
                        Event::MCode(ADAPTIVE_FEED) => adaptive = word,
                        _ => {}
                    }
                    expected.take(event);
                }
                ItemKind::Dwell(_) => {}
            }
            if let Settled::Answered(answer) = source.settle(None)? {
                told += 1;
                if let Answer::Probe(probed) = answer {
                    begins_at = probed.stands;
                }
            }
            block += 1;
        }
    }

    /// What spindle, coolant, tool and outputs are to do there.
    pub const fn expected(&self) -> &Auxiliary {
        &self.expected
    }

    /// The number of its first item.
    pub const fn block(&self) -> u32 {
        self.block
    }

    /// Where the machine is to stand there.
    pub const fn begins_at(&self) -> AxisVector {
        self.begins_at
    }

    /// How often inputs and the probe were asked before; it is answered as it was then.
    pub const fn told(&self) -> u32 {
        self.told
    }

    /// The program from there on, with the way to its beginning in front.
    pub fn approached(mut self, approach: &Approach) -> Remainder<S> {
        let mut items = Vec::new();
        let axis = approach.tool_axis.index();
        let top = approach.top.unwrap_or(f64::NEG_INFINITY);
        let mut up = approach.position;
        up[axis] = up[axis].max(self.begins_at[axis]).max(top);
        let mut over = self.begins_at;
        over[axis] = up[axis];
        push_move(&mut items, approach.position, up, Rate::Rapid);
        let mut events = restoring(&approach.now, &self.expected);
        // In front of the first feed, whatever the machine waits for later than where it stands.
        let awaited = events.iter().filter_map(|event| match event {
            Event::MCode(code) => Some(Event::Await(*code)),
            _ => None,
        });
        let awaited: Vec<Event> = awaited.collect();
        if let Some(value) = self.adaptive {
            let word = CodeWord::P;
            events.extend([Event::CodeWord { word, value }, Event::MCode(ADAPTIVE_FEED)]);
        }
        items.extend(events.into_iter().map(ItemKind::Event));
        push_move(&mut items, up, over, Rate::Rapid);
        items.extend(awaited.into_iter().map(ItemKind::Event));
        let feed_v = self.feed_ahead();
        push_move(&mut items, over, self.begins_at, Rate::Feed(feed_v));
        let line = self.ahead.front().map_or(0, |item| item.line);
        let count = u32::try_from(items.len()).unwrap_or(u32::MAX);
        for kind in items.into_iter().rev() {
            self.ahead.push_front(Item {
                line,
                block: 0,
                kind,
            });
        }
        let first_block = self.block.saturating_sub(count).max(1);
        let point = ResumePoint {
            position: approach.position,
            program_start: approach.position,
            program: self.source.fingerprint(),
            block: first_block,
            path_s: 0.0,
            block_path_s: 0.0,
            found: None,
        };
        Remainder::beginning_with(self.source, point, first_block, (self.ahead, self.last))
    }

    /// The feed of the first feed move ahead.
    fn feed_ahead(&mut self) -> f64 {
        let feed_of = |item: &Item| match item.kind {
            ItemKind::Move { rate, .. } => rate.feed_v(),
            _ => None,
        };
        if let Some(feed_v) = self.ahead.iter().find_map(feed_of) {
            return feed_v;
        }
        while self.ahead.len() < LOOK_AHEAD {
            let item = match self.source.next_item() {
                Supply::Item(item) => item,
                Supply::Pending => break,
                last => {
                    self.last = Some(last);
                    break;
                }
            };
            self.ahead.push_back(item);
            if let Some(feed_v) = feed_of(&item) {
                return feed_v;
            }
        }
        SLOW_V
    }
}

fn push_move(items: &mut Vec<ItemKind>, from: AxisVector, to: AxisVector, rate: Rate) {
    if (to - from).amax() > NO_WAY {
        items.push(ItemKind::Move {
            segment: Segment::line(from, to),
            rate,
            mode: PathMode::ExactStop,
        });
    }
}

/// The events that make what is now what is expected.
fn restoring(now: &Auxiliary, expected: &Auxiliary) -> Vec<Event> {
    let mut events = Vec::new();
    let mut now = *now;
    let mut tell = |now: &mut Auxiliary, event: Event| {
        now.take(event);
        events.push(event);
    };
    if now.tool != expected.tool {
        tell(&mut now, Event::SelectTool(expected.tool));
        tell(&mut now, Event::MCode(6));
    }
    if now.prepared_tool != expected.prepared_tool {
        tell(&mut now, Event::SelectTool(expected.prepared_tool));
    }
    if (now.spindle_speed - expected.spindle_speed).abs() > 0.0 {
        tell(&mut now, Event::SpindleSpeed(expected.spindle_speed));
    }
    if now.spindle != expected.spindle {
        let code = match expected.spindle() {
            Ok(SpindleState::Clockwise) => 3,
            Ok(SpindleState::Counterclockwise) => 4,
            Ok(SpindleState::Oriented) => 19,
            _ => 5,
        };
        tell(&mut now, Event::MCode(code));
    }
    if now.coolant != expected.coolant {
        if now.coolant & !expected.coolant != 0 {
            tell(&mut now, Event::MCode(9));
        }
        for (of, code) in [(Coolant::MIST, 7), (Coolant::FLOOD, 8)] {
            if expected.coolant().contains(of) && !now.coolant().contains(of) {
                tell(&mut now, Event::MCode(code));
            }
        }
    }
    for number in 0..u64::BITS {
        let is_on = |record: &Auxiliary| record.digital_out >> number & 1 == 1;
        let on = is_on(expected);
        if is_on(&now) != on {
            tell(&mut now, Event::DigitalOutput { number, on });
        }
    }
    for (number, value) in (0..).zip(expected.analog_out) {
        let present = now.analog_out.get(number as usize).copied();
        if present.is_some_and(|present| (present - value).abs() > 0.0) {
            tell(&mut now, Event::AnalogOutput { number, value });
        }
    }
    events
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ProgramSource;
    use glidepath_gcode::Options;

    const TEXT: &str = "G21 G90 S500\nM3\nG0 Z5\no100 repeat [3]\nG91 G1 X1 F600\nG90 G1 Z-1\n\
                        G0 Z5\no100 endrepeat\nM8\nG1 Y7\nM9 M5\nG0 X0\nM2\n";

    fn source() -> ProgramSource<&'static [u8]> {
        ProgramSource::new(TEXT.as_bytes(), Options::default())
    }

    fn items(source: &mut impl ItemSource) -> Vec<Item> {
        let mut items = Vec::new();
        while let Supply::Item(item) = source.next_item() {
            items.push(item);
        }
        items
    }

    fn approach(position: AxisVector) -> Approach {
        Approach {
            position,
            now: Auxiliary::default(),
            tool_axis: Axis::Z,
            top: Some(50.0),
        }
    }

    #[test]
    fn from_every_line_at_every_pass_it_is_the_tail_of_the_program() {
        let all = items(&mut source());
        let mut begun = 0;
        for (index, item) in all.iter().enumerate() {
            let same = |other: &&Item| other.line == item.line;
            if index > 0 && all[index - 1].line == item.line {
                continue;
            }
            let pass = all[..=index].iter().filter(same).count();
            let pass = u32::try_from(pass).unwrap();
            let start = StartLine {
                line: item.line,
                pass,
            };
            let found = LineStart::find(source(), start, &approach(AxisVector::zeros())).unwrap();
            if let ItemKind::Move { segment, .. } = item.kind {
                assert_eq!(found.begins_at(), segment.start(), "line {}", item.line);
            }
            let mut rest = found.approached(&approach(AxisVector::repeat(3.0)));
            let rest = items(&mut rest);
            assert_eq!(rest[rest.len() - (all.len() - index)..], all[index..]);
            begun += 1;
        }
        assert!(begun > 12, "{begun}");
    }

    #[test]
    fn the_way_goes_up_restores_and_comes_down() {
        let start = StartLine { line: 10, pass: 1 };
        let found = LineStart::find(source(), start, &approach(AxisVector::zeros())).unwrap();
        assert_eq!(found.expected().spindle(), Ok(SpindleState::Clockwise));
        assert!(found.expected().coolant().contains(Coolant::FLOOD));
        let mut position = AxisVector::repeat(0.0);
        position[0] = -20.0;
        let way = items(&mut found.approached(&approach(position)));
        let kinds: Vec<String> = way[..8]
            .iter()
            .map(|item| match item.kind {
                ItemKind::Move { segment, rate, .. } => {
                    let end = segment.end();
                    let how = if rate.is_rapid() { "G0" } else { "G1" };
                    format!("{how} {} {} {}", end[0], end[1], end[2])
                }
                ItemKind::Event(event) => format!("{event:?}"),
                ItemKind::Dwell(_) => "G4".to_owned(),
            })
            .collect();
        let expected = [
            "G0 -20 0 50",
            "SpindleSpeed(500.0)",
            "MCode(3)",
            "MCode(8)",
            "G0 3 0 50",
            "Await(3)",
            "Await(8)",
            "G1 3 0 5",
        ];
        assert_eq!(kinds, expected);
    }

    #[test]
    fn what_the_program_does_not_name_stays_as_it_is() {
        let mut approach = approach(AxisVector::zeros());
        for event in [
            Event::SelectTool(7),
            Event::MCode(6),
            Event::SpindleSpeed(900.0),
            Event::MCode(4),
            Event::MCode(8),
        ] {
            approach.now.take(event);
        }
        let text = "G21 G90\nG1 X1 F600\nM9\nX2\nM2\n";
        let source = ProgramSource::new(text.as_bytes(), Options::default());
        let start = StartLine { line: 4, pass: 1 };
        let found = LineStart::find(source, start, &approach).unwrap();
        let rest = items(&mut found.approached(&approach));
        let events = rest.iter().filter_map(|item| match item.kind {
            ItemKind::Event(event) => Some(event),
            _ => None,
        });
        let expected = [Event::MCode(9), Event::Await(9)];
        assert_eq!(events.collect::<Vec<_>>(), expected);
    }

    #[test]
    fn the_feed_follows_its_input_where_the_program_has_it_so() {
        let approach = approach(AxisVector::zeros());
        let text = "G21 G90\nM52 P1\nG1 X1 F600\nM52 P0\nX2\nM52\nX3\nM2\n";
        for (line, expected) in [(3, Some(1.0)), (5, Some(0.0)), (7, Some(1.0))] {
            let options = Options {
                adaptive_feed: glidepath_gcode::AdaptiveFeed::Switched,
                ..Options::default()
            };
            let source = ProgramSource::new(text.as_bytes(), options);
            let start = StartLine { line, pass: 1 };
            let found = LineStart::find(source, start, &approach).unwrap();
            let rest = items(&mut found.approached(&approach));
            let switch = rest
                .windows(2)
                .find_map(|pair| match (pair[0].kind, pair[1].kind) {
                    (
                        ItemKind::Event(Event::CodeWord { value, .. }),
                        ItemKind::Event(Event::MCode(ADAPTIVE_FEED)),
                    ) => Some(value),
                    _ => None,
                });
            assert_eq!(switch, expected, "line {line}");
        }
    }

    #[test]
    fn a_line_that_does_nothing_is_refused() {
        let start = StartLine { line: 8, pass: 1 };
        let refused = LineStart::find(source(), start, &approach(AxisVector::zeros())).unwrap_err();
        assert!(
            refused.to_string().contains("line 9 is the next"),
            "{refused}"
        );
        let start = StartLine { line: 5, pass: 4 };
        LineStart::find(source(), start, &approach(AxisVector::zeros())).unwrap_err();
    }
}
