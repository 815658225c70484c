//! `glidepath live devices`: lists the paired devices, and revokes one, whether the page is served or not.

use super::book::{Book, Device};
use crate::cli::{DevicesAction, DevicesArgs};
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::output;
use crate::persistence::error::StateError;
use core::fmt::Write as _;
use serde_json::{Value, json};
use time::OffsetDateTime;

/// Lists the devices, or revokes one.
///
/// # Errors
/// The machine keeps nothing, the list cannot be used, or there is no such device.
pub(in crate::command) fn devices(
    args: &DevicesArgs,
    config: &MachineConfig,
) -> Result<Exit, Failure> {
    let state = config.state_directory.as_deref();
    let book = Book::at(state.ok_or(StateError::NoFolder)?);
    let listed = book.devices()?;
    if let Some(DevicesAction::Revoke(revoke)) = &args.action {
        let is_there = listed.iter().any(|device| device.name == revoke.name);
        if !is_there || !book.revoke(&revoke.name)? {
            let names: Vec<_> = listed.into_iter().map(|device| device.name).collect();
            return Err(Failure::NoDevice {
                name: revoke.name.clone(),
                names,
            });
        }
    }
    show(&book.devices()?, args.basic().json);
    Ok(Exit::Done)
}

fn show(devices: &[Device], as_json: bool) {
    if as_json {
        let object = |device: &Device| {
            json!({
                "name": device.name,
                "may": device.may,
                "paired": moment(device.paired_s),
                "seen": moment(device.seen_s),
            })
        };
        let devices: Vec<Value> = devices.iter().map(object).collect();
        output::object(&json!({ "devices": devices }));
        return;
    }
    if devices.is_empty() {
        output::result("no device is paired\n");
        return;
    }
    let mut text = format!("{:32} {:5} {:20}  seen\n", "device", "may", "paired");
    for device in devices {
        let (paired, seen) = (moment(device.paired_s), moment(device.seen_s));
        // Writing to a String does not fail.
        let _ = writeln!(
            text,
            "{:32} {:5} {paired:20}  {seen}",
            device.name, device.may
        );
    }
    output::result(&text);
}

/// A time, s since 1970, as ISO 8601 has it; nothing for one that no calendar has.
fn moment(at_s: u64) -> String {
    let at = i64::try_from(at_s).ok();
    let Some(at) = at.and_then(|at| OffsetDateTime::from_unix_timestamp(at).ok()) else {
        return String::new();
    };
    let (year, month, day) = (at.year(), u8::from(at.month()), at.day());
    let (hour, minute, second) = (at.hour(), at.minute(), at.second());
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_that_of_the_calendar() {
        for (at_s, text) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_735_689_599, "2024-12-31T23:59:59Z"),
            (1_796_000_000, "2026-11-30T00:53:20Z"),
            (u64::MAX, ""),
        ] {
            assert_eq!(moment(at_s), text);
        }
    }
}
