//! What the panel shows of devices: those that are paired, and the code of one that is to be, as a picture and as text.

use super::PairedDevices;
use crate::command::live::answers::{Done, malformed, not_now};
use crate::command::live::order::Order;
use crate::command::live::pages::Pages;
use glidepath_live::{Caller, Role, Shown, Status};
use qrcodegen::{QrCode, QrCodeEcc};
use serde_json::{Value, json};
use std::time::Instant;

impl PairedDevices {
    /// The devices, and the code that the page of a caller shows.
    pub(in crate::command::live) fn object(&self, caller: Caller) -> Value {
        let shown = self.pairing().shown(caller.page, Instant::now());
        let (devices, trouble) = self.book.now();
        let devices: Vec<Value> = devices
            .iter()
            .map(|(device, is_here)| {
                json!({
                    "name": device.name,
                    "may": device.may,
                    "paired_ms": device.paired_s * 1000,
                    "seen_ms": device.seen_s * 1000,
                    "here": is_here,
                })
            })
            .collect();
        json!({
            "url": self.url,
            "fingerprint": self.fingerprint(),
            "devices": devices,
            "trouble": trouble,
            "offer": shown.map(|shown| self.offer(&shown)),
        })
    }

    fn offer(&self, shown: &Shown) -> Value {
        // Behind `#`, which browsers do not send.
        let link = format!("{}#code={}", self.url, shown.long);
        let short = shown.short.as_deref();
        let typed = short.and_then(|code| code.split_at_checked(4));
        json!({
            "may": shown.role.name(),
            "code": typed.map(|(first, last)| format!("{first}-{last}")),
            "qr": qr(&link),
            "left_s": shown.left.as_secs(),
        })
    }
}

/// The rows of a QR code, one digit for each module, 1 if it is dark. An address is never too long for one.
fn qr(text: &str) -> Vec<String> {
    let Ok(code) = QrCode::encode_text(text, QrCodeEcc::Medium) else {
        return Vec::new();
    };
    let row = |y| {
        let dark = (0..code.size()).map(|x| code.get_module(x, y));
        dark.map(|is_dark| if is_dark { '1' } else { '0' })
            .collect()
    };
    (0..code.size()).map(row).collect()
}

impl Pages {
    /// Has a code shown, or no more, or takes a device out.
    pub(in crate::command::live) fn pair(&self, caller: Caller, order: &Order) -> Done {
        let none = || {
            not_now(
                "this page has no devices: `glidepath live --devices 192.168.1.20:8443`, with an address of this host",
            )
        };
        let devices = self.devices.as_ref().ok_or_else(none)?;
        match order {
            Order::PairDevice { may } => {
                let role = Role::named(may).filter(|role| *role < Role::Operate);
                let role = role.ok_or_else(malformed)?;
                let offered = devices.pairing().offer(caller.page, role, Instant::now());
                offered.map_err(|error| (Status::Unavailable, error.to_string()))?;
            }
            Order::EndPairing {} => devices.pairing().end(caller.page),
            Order::RevokeDevice { name } => {
                if !devices.revoke(name).map_err(not_now)? {
                    return Err(not_now(format!("no device is paired as {name}")));
                }
            }
            _ => return Err(malformed()),
        }
        Ok(devices.object(caller))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_of_an_address_is_square_and_has_its_three_eyes() {
        let rows = qr(
            "https://[fe80:1234:5678:9abc:def0:1234:5678:9abc]:65535/#code=0123456789abcdef0123456789abcdef",
        );
        assert!(rows.len() >= 33 && rows.iter().all(|row| row.len() == rows.len()));
        let eye = "1111111";
        assert!(rows[0].starts_with(eye) && rows[0].ends_with(eye));
        assert!(rows[rows.len() - 1].starts_with(eye));
    }
}
