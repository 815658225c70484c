//! The functions for feedback: what the drives say, on its way to the interpolator.

use super::call::NONE;
use super::handle::{Handle, Held};
use super::link::Link;
use super::pointer::{Given, Room, check_size};
use super::text::gp_now_ns;
use glidepath_link::{Feedback, Publisher, Record as _, Transport as _};

/// A servo stack's end.
pub(super) struct FeedbackSink {
    sink: Box<dyn Publisher<Feedback>>,
    boot_id: u64,
    sent: u64,
}

impl Held for FeedbackSink {
    const MARK: u32 = 0x6665_6564;
    const NAME: &'static str = "the feedback sink";
    const NO_HANDLE: &'static str = "sink: no open gp_feedback_sink";
}

const NO_ROOM: &str = "sink: NULL, where the handle is to go";

#[unsafe(no_mangle)]
extern "C" fn gp_feedback_open(link: Handle<Link>, sink: Room<Handle<FeedbackSink>>) -> i32 {
    link.with(|link| {
        sink.check(NO_ROOM)?;
        let handle = Handle::open(FeedbackSink {
            sink: link.ipc.feedback_sink()?,
            // Another one for every sink that was ever opened since the host was started.
            boot_id: gp_now_ns() ^ u64::from(std::process::id()) << 40,
            sent: 0,
        });
        sink.put(handle, NO_ROOM)?;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_feedback_send(
    sink: Handle<FeedbackSink>,
    feedback: Given<Feedback>,
    size: usize,
) -> i32 {
    sink.with(|sink| {
        check_size::<Feedback>("gp_feedback", size)?;
        let mut record = feedback.get("feedback: NULL, what is to be sent")?;
        (record.boot_id, record.number) = (sink.boot_id, sink.sent);
        record.check()?;
        sink.sink.publish(&record)?;
        sink.sent += 1;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_feedback_close(sink: Handle<FeedbackSink>) -> i32 {
    sink.close(|sink| {
        drop(sink);
        Ok(())
    })
}
