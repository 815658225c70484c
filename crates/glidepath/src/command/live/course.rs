//! The course of a program: its sections over time, and the moments at which it needs a person, as frames of its plan
//! come by.

use super::section_names::section_names;
use crate::command::text_lines::TextLines;
use crate::command::tool_names::ToolNames;
use crate::config::MachineConfig;
use glidepath_interpolator::{AnswerSource, MCodeWaits};
use glidepath_program::{Event, Frame, FrameFlags};
use serde_json::{Value, json};

/// Sections that are told of one program; it may call the same one again and again.
const MOST_SECTIONS: usize = 200;
/// Moments that are told of one program.
const MOST_MOMENTS: usize = 500;

/// What is known of the course so far.
pub(super) struct Course {
    waits: MCodeWaits,
    tool_names: ToolNames,
    /// Lines from which on names count.
    names: Vec<(u32, String)>,
    /// Which of them counts.
    named: Option<usize>,
    line: u32,
    /// The tool that was selected last.
    tool: u32,
    sections: Vec<Section>,
    moments: Vec<Moment>,
    /// How many more there are.
    more_sections: u32,
    more_moments: u32,
    /// Something was cut since the last section began.
    has_cut: bool,
}

/// A part of the program that has a name or a tool of its own.
struct Section {
    /// The frame that it begins with.
    sequence: u64,
    line: u32,
    name: Option<String>,
    /// The tool that it begins with, and what the tool table calls it.
    tool: Option<(u32, Option<String>)>,
}

/// A time at which the program does not go on without a person.
struct Moment {
    sequence: u64,
    line: u32,
    what: String,
}

impl Course {
    pub(super) fn new(config: &MachineConfig) -> Self {
        Self {
            waits: config.m_code_waits(),
            tool_names: ToolNames::new(config),
            names: Vec::new(),
            named: None,
            line: 0,
            tool: 0,
            sections: Vec::new(),
            moments: Vec::new(),
            more_sections: 0,
            more_moments: 0,
            has_cut: false,
        }
    }

    /// The text of the program, before its first frame.
    pub(super) fn text(&mut self, lines: &TextLines) {
        self.names = section_names(lines);
    }

    /// The next frame of the plan.
    pub(super) fn frame(&mut self, frame: &Frame) {
        if frame.line != self.line {
            self.line = frame.line;
            self.come_to(frame);
        }
        self.has_cut |= frame.path_v > 1e-9 && !frame.flags.contains(FrameFlags::RAPID);
        for timed in frame.events.as_slice() {
            self.event(timed.event, frame);
        }
    }

    fn come_to(&mut self, frame: &Frame) {
        let behind = self.names.partition_point(|(line, _)| *line <= frame.line);
        let named = behind.checked_sub(1);
        if core::mem::replace(&mut self.named, named) == named {
            return;
        }
        let name = named.and_then(|at| self.names.get(at));
        let Some((line, name)) = name.cloned() else {
            return;
        };
        // What begins before the section in front has cut anything is the name of the same one.
        if !self.has_cut
            && let Some(section) = self.sections.last_mut()
        {
            (section.name, section.line) = (Some(name), line);
            return;
        }
        self.begin(Section {
            sequence: frame.sequence,
            line,
            name: Some(name),
            tool: None,
        });
    }

    fn event(&mut self, event: Event, frame: &Frame) {
        let waits = self.waits;
        let by_hand = |code, is_late| {
            waits.of(code).is_some_and(|rule| {
                rule.answer == AnswerSource::Acknowledgement && rule.is_late == is_late
            })
        };
        let needed = match event {
            Event::SelectTool(tool) => {
                self.tool = tool;
                None
            }
            Event::ProgramStop(code) => Some(format!("M{code}")),
            Event::OptionalStop => Some("M1".to_owned()),
            Event::MCode(code) => {
                if code == 6 {
                    self.change_tool(frame);
                }
                by_hand(code, false).then(|| self.code(code))
            }
            Event::Await(code) => by_hand(code, true).then(|| self.code(code)),
            _ => None,
        };
        let Some(what) = needed else {
            return;
        };
        if self.moments.len() < MOST_MOMENTS {
            self.moments.push(Moment {
                sequence: frame.sequence,
                line: frame.line,
                what,
            });
        } else {
            self.more_moments = self.more_moments.saturating_add(1);
        }
    }

    /// A code that waits for a person, with the tool where it is about one.
    fn code(&self, code: u32) -> String {
        match code {
            6 => format!("M6 T{}", self.tool),
            code => format!("M{code}"),
        }
    }

    fn change_tool(&mut self, frame: &Frame) {
        let tool = Some((self.tool, self.tool_names.of(self.tool)));
        if !self.has_cut
            && let Some(section) = self.sections.last_mut()
            && section.tool.is_none()
        {
            section.tool = tool;
            return;
        }
        self.begin(Section {
            sequence: frame.sequence,
            line: frame.line,
            name: None,
            tool,
        });
    }

    fn begin(&mut self, section: Section) {
        self.has_cut = false;
        if self.sections.len() < MOST_SECTIONS {
            self.sections.push(section);
        } else {
            self.more_sections = self.more_sections.saturating_add(1);
        }
    }

    /// The course of a whole plan, as a page is told it. Places are frames of the plan.
    pub(super) fn object(&self) -> Value {
        let section = |it: &Section| {
            let tool = it.tool.as_ref();
            json!({
                "place": it.sequence,
                "line": it.line,
                "name": it.name,
                "tool": tool.map(|(number, _)| number),
                "tool_name": tool.and_then(|(_, name)| name.as_deref()),
            })
        };
        let moment =
            |it: &Moment| json!({ "place": it.sequence, "line": it.line, "what": it.what });
        json!({
            "sections": self.sections.iter().map(section).collect::<Vec<_>>(),
            "more_sections": self.more_sections,
            "moments": self.moments.iter().map(moment).collect::<Vec<_>>(),
            "more_moments": self.more_moments,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::MCodeRule;
    use glidepath_gcode::WaitsAt;
    use glidepath_geometry::AxisVector;
    use glidepath_interpolator::MCodeWait;
    use glidepath_planner::{Pipeline, ProgramSource, Step};
    use glidepath_program::FrameEvents;

    /// The course of a program on a machine.
    fn course(text: &str, config: &MachineConfig) -> Value {
        let mut course = Course::new(config);
        course.text(&TextLines::of(text.as_bytes().to_vec()));
        let start = AxisVector::zeros();
        let source = ProgramSource::new(text.as_bytes(), config.program_options(start));
        let mut steps = Pipeline::new(source, config.settings(), start);
        loop {
            match steps.step().unwrap() {
                Step::Frame => course.frame(steps.frame()),
                Step::End => return course.object(),
                Step::Item | Step::Pending => {}
            }
        }
    }

    fn list(of: &Value, what: &str) -> Vec<String> {
        let all = of.as_array().unwrap().iter();
        all.map(|it| match &it[what] {
            Value::String(text) => text.clone(),
            other => other.to_string(),
        })
        .collect()
    }

    const TEXT: &str = "G21 G90 G54 F3000\n(ROUGH)\nT1 M6\nG0 X1\nG1 X2\nM1\nG1 X3\nT3\n(FINISH)\nG0 X4\nG1 X5\n\
                        M6\nG1 X6\nM0\n(HOLES)\nG0 X7\nG1 X8\nM60\nM2\n";

    #[test]
    fn a_program_has_sections_and_needs_a_person_where_it_waits_for_one() {
        let mut config = crate::config::load(None).unwrap();
        let told = course(TEXT, &config);
        let sections = &told["sections"];
        assert_eq!(list(sections, "name"), ["ROUGH", "FINISH", "null", "HOLES"]);
        assert_eq!(list(sections, "tool"), ["1", "null", "3", "null"]);
        assert_eq!(list(sections, "line"), ["3", "10", "12", "16"]);
        let moments = &told["moments"];
        let expected = ["M6 T1", "M1", "M6 T3", "M0", "M60"];
        assert_eq!(list(moments, "what"), expected);
        assert_eq!(list(moments, "line"), ["3", "6", "12", "14", "18"]);
        let places = list(moments, "place");
        let places: Vec<u64> = places.iter().map(|it| it.parse().unwrap()).collect();
        assert!(places.is_sorted_by(|a, b| a < b), "{places:?}");

        // Where a changer answers, nobody is needed.
        config.m_codes.push(CHANGER);
        let told = course(TEXT, &config);
        assert_eq!(list(&told["moments"], "what"), ["M1", "M0", "M60"]);
        assert_eq!(list(&told["sections"], "tool"), ["1", "null", "3", "null"]);
    }

    const CHANGER: MCodeRule = MCodeRule {
        m_code_wait: MCodeWait {
            first: 6,
            last: 6,
            answer: AnswerSource::Nobody,
            within: None,
            is_late: false,
        },
        at: WaitsAt::Code,
    };

    #[test]
    fn sections_and_moments_are_bounded() {
        let mut course = Course::new(&crate::config::load(None).unwrap());
        let text = "(A)\nG0 X0\nG1 X1\nM0\n".repeat(MOST_MOMENTS + 3);
        course.text(&TextLines::of(text.into_bytes()));
        let mut frame = Frame::blank(AxisVector::zeros());
        for line in 1..=4 * (MOST_MOMENTS + 3) {
            (frame.sequence, frame.line) = (frame.sequence + 1, u32::try_from(line).unwrap());
            frame.path_v = if line % 4 == 3 { 1.0 } else { 0.0 };
            frame.events = match line % 4 {
                0 => FrameEvents::one(Event::ProgramStop(0), 0),
                _ => FrameEvents::NONE,
            };
            course.frame(&frame);
        }
        let told = course.object();
        assert_eq!(list(&told["sections"], "name").len(), MOST_SECTIONS);
        assert_eq!(told["more_sections"], MOST_MOMENTS + 3 - MOST_SECTIONS);
        assert_eq!(list(&told["moments"], "what").len(), MOST_MOMENTS);
        assert_eq!(told["more_moments"], 3);
    }
}
