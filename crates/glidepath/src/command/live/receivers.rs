//! Who receives setpoints, beside the page.

use serde_json::{Value, json};

/// Who receives setpoints: name and process of each.
pub(super) fn receivers(processes: &[i32]) -> Value {
    let own = std::process::id();
    let object = |process: &i32| {
        let name = std::fs::read_to_string(format!("/proc/{process}/comm"));
        let command = std::fs::read(format!("/proc/{process}/cmdline")).unwrap_or_default();
        let command = String::from_utf8_lossy(&command);
        let word = command.split('\0').nth(1).unwrap_or_default();
        let is_own = u32::try_from(*process) == Ok(own);
        let role = match word {
            _ if is_own => "this page",
            "servo" => "servo stack that imitates drives",
            "live" => "another page",
            "record" => "recorder",
            _ => "receives every setpoint",
        };
        let name = name.unwrap_or_default().trim().to_owned();
        json!({ "pid": process, "name": name, "role": role })
    };
    processes.iter().map(object).collect()
}
