//! An order as it was given, with the time that tells how late it comes.

use super::order::Order;
use serde_json::{Map, Value};

/// An order with the time that its page had heard last from here, ms of this host's steady clock. The order was
/// given after that, and before the page could hear of anything later.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Given {
    pub(super) order: Order,
    pub(super) heard_ms: Option<f64>,
}

impl Given {
    /// The order of a body; `None` if it is none.
    pub(super) fn of(body: &[u8]) -> Option<Self> {
        let mut fields: Map<String, Value> = serde_json::from_slice(body).ok()?;
        let heard_ms = match fields.remove("heard_ms") {
            Some(heard) => Some(heard.as_f64()?),
            None => None,
        };
        let order = serde_json::from_value(Value::Object(fields)).ok()?;
        Some(Self { order, heard_ms })
    }

    /// When it was given, ns of the host's steady clock: at the latest that can be known.
    ///
    /// # Errors
    /// Why it does not count: what moves the axes is done at once, or not at all.
    pub(super) fn asked_ns(&self, now_ns: u64) -> Result<u64, &'static str> {
        if !self.order.counts_at_once_or_never() {
            return Ok(now_ns);
        }
        let Some(heard_ms) = self.heard_ms else {
            return Err("an order says what its page has heard last: start the page anew");
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole, saturating"
        )]
        let heard_ns = (heard_ms * 1e6) as u64;
        // One from the future is of another host's clock, or of another life of this one.
        let age_ns = now_ns.checked_sub(heard_ns);
        if age_ns.is_none_or(|age_ns| age_ns > self.order.longest_way_ns()) {
            return Err(
                "this order came late and does not count; give it again if it is still wanted",
            );
        }
        Ok(heard_ns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_begins_motion_is_done_soon_or_never() {
        let given = |body: &str| Given::of(body.as_bytes()).unwrap();
        let asked = |body: &str, now_ms: u64| given(body).asked_ns(now_ms * 1_000_000);
        let resume = "{\"kind\":\"resume\",\"heard_ms\":5000.5}";
        assert_eq!(asked(resume, 6500), Ok(5_000_500_000));
        let step = "{\"kind\":\"jog-step\",\"axes\":{\"X\":1},\"feed\":1,\"heard_ms\":5000}";
        assert_eq!(asked(step, 5500), Ok(5_000_000_000));
        for (body, now_ms) in [
            (resume, 6501),
            (resume, 4000),
            (step, 5501),
            ("{\"kind\":\"resume\"}", 1),
            (
                "{\"kind\":\"mdi\",\"line\":\"G0 X1\",\"heard_ms\":-1e300}",
                9000,
            ),
        ] {
            assert!(asked(body, now_ms).is_err(), "{body} at {now_ms}");
        }
        for stop in ["hold", "abort", "disable"] {
            let body = format!("{{\"kind\":\"{stop}\",\"heard_ms\":1}}");
            assert_eq!(asked(&body, 99_000), Ok(99_000_000_000), "{stop}");
        }
        assert_eq!(Given::of(b"{\"kind\":\"resume\",\"heard_ms\":\"1\"}"), None);
    }
}
