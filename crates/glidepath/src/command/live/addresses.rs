//! The addresses of the page, as they are printed.

use super::devices::PairedDevices;
use crate::cli::LiveArgs;
use crate::output;
use glidepath_live::Role;
use serde_json::{Map, Value, json};

/// Where the page is, and where devices open it.
pub(super) fn tell(
    args: &LiveArgs,
    instance: &str,
    (urls, port): (&[(Role, String)], u16),
    devices: Option<&PairedDevices>,
) {
    let own = urls.last().map_or("", |(_, url)| url);
    if args.operator.basic.json {
        let urls: Map<String, Value> = urls
            .iter()
            .map(|(role, url)| (role.name().to_owned(), url.as_str().into()))
            .collect();
        let devices = devices
            .map(|devices| json!({ "url": devices.url(), "fingerprint": devices.fingerprint() }));
        output::object(&json!({
            "instance": instance,
            "url": own,
            "urls": urls,
            "port": port,
            "may": args.may.role().name(),
            "devices": devices,
        }));
        return;
    }
    let may = match args.may.role() {
        Role::Look => {
            "The page only shows; --may hold lets it bring the machine to rest, --may operate do all."
        }
        Role::Hold => "The page may hold and abort.",
        Role::Operate => "The page operates the machine: whoever has this address moves it.",
    };
    let less: String = urls
        .iter()
        .rev()
        .skip(1)
        .map(|(role, url)| format!("For a page that may only {}:\n  {url}\n", role.name()))
        .collect();
    let devices = devices.map_or_else(String::new, |devices| {
        format!(
            "For paired tablets and phones, which a page that may operate pairs (Set up, Devices):\n  {}\n  \
             certificate SHA-256 {}\n",
            devices.url(),
            devices.fingerprint()
        )
    });
    output::result(&format!(
        "live: open this in a browser of this host, and keep it to yourself:\n  {own}\n{may}\n{less}{devices}\
         Ctrl-C ends the page; the machine goes on.\n"
    ));
}
