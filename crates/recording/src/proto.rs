//! The Protocol Buffers file of the messages, for whoever reads recordings with code that is
//! generated. A recording itself has them described inside.

use crate::table::{FieldOf, Message};
use core::fmt::Write as _;
use glidepath_link::{EventRecord, Setpoint, Status};

/// The text of `glidepath.proto`.
#[must_use]
pub fn proto() -> String {
    let mut text = "// The messages of recordings. Made from the code of glidepath-recording, and compared by\n\
                    // a test.\n\
                    // What the fields mean, with units: crates/link/src/record.\n\
                    syntax = \"proto3\";\n\npackage glidepath;\n"
        .to_owned();
    put(EventRecord::NAME, &EventRecord::fields(), &mut text);
    put(Setpoint::NAME, &Setpoint::fields(), &mut text);
    put(Status::NAME, &Status::fields(), &mut text);
    text
}

fn put(name: &str, fields: &[FieldOf], text: &mut String) {
    let name = name.rsplit('.').next().unwrap_or(name);
    // Writing into a text does not fail.
    let _ = writeln!(text, "\nmessage {name} {{");
    for field in fields {
        let _ = writeln!(
            text,
            "  {} {} = {};",
            field.type_name(),
            field.name,
            field.number
        );
    }
    text.push_str("}\n");
}
