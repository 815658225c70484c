//! The answers to orders: what came of them, or why nothing did.

use crate::machine_options::complete;
use glidepath_live::{ContentType, Response, Status};
use serde_json::{Value, json};

/// What came of an order: what a page is told besides that it was accepted, or why it was not.
pub(super) type Done = Result<Value, (Status, String)>;

pub(super) fn not_now(text: impl Into<String>) -> (Status, String) {
    (Status::Conflict, complete(&text.into()))
}

pub(super) fn malformed() -> (Status, String) {
    let text = "no such command, or its value is out of range";
    (Status::BadRequest, text.to_owned())
}

pub(super) fn answer(done: Done) -> Response {
    match done {
        Ok(mut told) => {
            told["accepted"] = true.into();
            object(&told)
        }
        Err(refused) => refusal(&refused),
    }
}

pub(super) fn refusal((status, reason): &(Status, String)) -> Response {
    object(&json!({ "accepted": false, "reason": reason })).with(*status)
}

pub(super) fn object(value: &Value) -> Response {
    Response::new(ContentType::Json, value.to_string().into_bytes())
}
