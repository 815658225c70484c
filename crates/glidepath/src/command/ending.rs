//! The reason why a motion without a program has ended before its end, as a status tells it.

use glidepath_link::{FaultCause, MachineState, SWITCHED_OFF, Status};

/// A fault or the loss of power, which end every motion; `None` if there is neither.
pub(super) fn failure(status: &Status) -> Option<String> {
    if let Some(fault) = status.fault_text() {
        let cause = status.fault().ok().flatten();
        let remedy = cause.map_or("`glidepath reset`", FaultCause::remedy);
        return Some(format!("{fault}; {remedy}"));
    }
    let is_off = status.state() == Ok(MachineState::Off);
    is_off.then(|| format!("{SWITCHED_OFF}; `glidepath enable`"))
}

/// The same, or what was told of it: the last error is of the motion that began last.
pub(super) fn why(status: &Status) -> Option<String> {
    failure(status).or_else(|| {
        let told = status.last_error.as_str();
        (!told.is_empty()).then(|| told.to_owned())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_link::Text;

    #[test]
    fn a_fault_comes_before_what_was_told_and_neither_is_no_reason() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        status.state = MachineState::Idle.code();
        assert_eq!((failure(&status), why(&status)), (None, None));
        status.last_error = Text::new("a hold ended the jog");
        assert_eq!(failure(&status), None);
        assert_eq!(why(&status).as_deref(), Some("a hold ended the jog"));
        status.state = MachineState::Off.code();
        assert!(why(&status).unwrap().contains("switched off"));
        status.fault = FaultCause::FeedbackLost.code();
        let reason = why(&status).unwrap();
        assert!(reason.starts_with(FaultCause::FeedbackLost.text()));
        assert!(reason.ends_with(FaultCause::FeedbackLost.remedy()));
    }
}
