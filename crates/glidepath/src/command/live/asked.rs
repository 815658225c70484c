//! The request to a person, in full: the tool with all that is known of it, and what the program
//! says.

use super::super::tool_names::ToolNames;
use crate::config::MachineConfig;
use crate::persistence::read::{read, set_up, table};
use crate::report::awaited_code;
use glidepath_geometry::Axis;
use glidepath_link::{Auxiliary, MachineState, Status};
use glidepath_program::Event;
use serde_json::{Value, json};

/// What is asked, and which tool was in the spindle before.
pub(super) struct Asked {
    config: MachineConfig,
    names: ToolNames,
    /// The tool that was told last, and the one before it; `None` before anything was told.
    tools: [Option<u32>; 2],
    /// Tools as they were looked up last: they are asked for as long as a person takes.
    known: Option<([Option<u32>; 2], Value)>,
}

impl Asked {
    pub(super) fn new(config: &MachineConfig) -> Self {
        Self {
            names: ToolNames::new(config),
            config: config.clone(),
            tools: [None; 2],
            known: None,
        }
    }

    /// What spindle and tool were told.
    pub(super) fn take(&mut self, told: Option<&Auxiliary>) {
        let tool = told.map(|told| told.tool);
        let [now, _] = self.tools;
        if tool.is_some() && tool != now {
            self.tools = [tool, now];
        }
    }

    /// What is asked of a person; null if nothing is.
    pub(super) fn object(&mut self, status: &Status) -> Value {
        let said = status.message.as_str();
        if status.state() == Ok(MachineState::ProgramStop) {
            return json!({ "what": "stop", "says": said, "line": status.line });
        }
        if status.state() != Ok(MachineState::Awaiting) {
            self.known = None;
            return Value::Null;
        }
        let line = status.awaited_line;
        match status.awaited_event() {
            Ok(Some(Event::MCode(6) | Event::Await(6))) => {
                let (code, tools) = (awaited_code(status), self.tools());
                json!({ "what": "tool", "code": code, "says": said, "line": line, "tools": tools })
            }
            Ok(Some(Event::MCode(_) | Event::Await(_))) => {
                json!({ "what": "code", "code": awaited_code(status), "says": said, "line": line })
            }
            // The spindle answers that.
            _ => Value::Null,
        }
    }

    /// The tool that is to be put in, and the one that was in the spindle before.
    fn tools(&mut self) -> Value {
        if let Some((of, known)) = &self.known
            && *of == self.tools
        {
            return known.clone();
        }
        let mut machine = self.config.clone();
        if let Ok(Some(kept)) = read(&self.config) {
            set_up(&mut machine, &kept);
        }
        let [wanted, before] = self.tools.map(|tool| self.tool(tool?, &machine));
        let tools = json!({ "wanted": wanted, "before": before });
        self.known = Some((self.tools, tools.clone()));
        tools
    }

    fn tool(&self, number: u32, machine: &MachineConfig) -> Option<Value> {
        let tools = table(machine);
        let tool = tools.get(number);
        Some(json!({
            "number": number,
            "name": self.names.of(number),
            "diameter_mm": tool.map(|tool| tool.diameter_mm),
            "length_mm": tool.and_then(|tool| tool.offset.get(Axis::Z.index()).copied()),
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn awaiting(code: f64) -> Status {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        status.state = MachineState::Awaiting.code();
        let kind = glidepath_link::EventKind::MCode.code();
        (status.awaited_kind, status.awaited_value) = (kind, code);
        (status.awaited_line, status.awaited_since_ns) = (7, 1);
        status
    }

    #[test]
    fn a_tool_is_asked_for_with_what_the_table_says_of_it() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("tools.tbl");
        std::fs::write(&file, "T1 P1 Z50 D6 ; end mill\nT4 P4 Z118.25 D5 ; drill\n").unwrap();
        let mut config = crate::config::load(None).unwrap();
        let text = std::fs::read(&file).unwrap();
        let tools = glidepath_gcode::ToolTable::parse(&text).unwrap();
        config.program.tools = Some(std::sync::Arc::new(tools));
        config.program.tool_table = Some(file);
        let mut asked = Asked::new(&config);
        assert_eq!(asked.object(&bytemuck::Zeroable::zeroed()), Value::Null);
        let mut told = Auxiliary::default();
        for tool in [1, 4] {
            told.take(Event::SelectTool(tool));
            told.take(Event::MCode(6));
            asked.take(Some(&told));
            // It is told again and again.
            asked.take(Some(&told));
        }
        let object = asked.object(&awaiting(6.0));
        assert_eq!(object["what"], "tool");
        assert_eq!(
            object["tools"]["wanted"],
            json!({ "number": 4, "name": "drill", "diameter_mm": 5.0, "length_mm": 118.25 })
        );
        assert_eq!(object["tools"]["before"]["name"], "end mill");
        let object = asked.object(&awaiting(100.0));
        assert_eq!(
            (&object["what"], &object["code"]),
            (&"code".into(), &"M100".into())
        );
    }

    #[test]
    fn a_stop_says_what_the_program_says() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        status.state = MachineState::ProgramStop.code();
        status.message = glidepath_link::Text::new("measure the pocket");
        let mut asked = Asked::new(&crate::config::load(None).unwrap());
        let object = asked.object(&status);
        assert_eq!(object["says"], "measure the pocket");
    }
}
