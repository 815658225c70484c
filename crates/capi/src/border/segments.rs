//! The functions for segments, on their way to a listening planner.

use super::call::{GOT, NONE};
use super::handle::{Handle, Held};
use super::link::{Link, patience};
use super::pointer::{Given, Room, check_size};
use super::text::gp_now_ns;
use crate::failure::{Code, Failure, remember};
use core::time::Duration;
use glidepath_link::{
    Client, Record as _, RequestKind, SegmentReply, SegmentRequest, Transport as _,
};
use std::time::Instant;

/// A stream of segments.
pub(super) struct Segments {
    client: Box<dyn Client<SegmentRequest, SegmentReply>>,
    session: u64,
    /// The number of the next piece.
    next: u64,
    /// The piece that was sent, and is not yet answered.
    asked: Option<SegmentRequest>,
}

impl Held for Segments {
    const MARK: u32 = 0x7365_676d;
    const NAME: &'static str = "the stream";
    const NO_HANDLE: &'static str = "segments: no open gp_segments";
}

const NO_HANDLE_ROOM: &str = "segments: NULL, where the handle is to go";
const NO_REPLY: &str = "reply: not aligned";

/// Between two looks for an answer.
const POLL: Duration = Duration::from_micros(200);

impl Segments {
    /// Sends a piece, or goes on waiting for the answer to it; `None` if there is none in time.
    fn call(
        &mut self,
        mut piece: SegmentRequest,
        patience: Duration,
    ) -> Result<Option<SegmentReply>, Failure> {
        (piece.session, piece.number) = (self.session, self.next);
        if piece.kind == RequestKind::Open.code() && piece.asked_ns == 0 {
            // The same again, where the answer to it is still to come.
            let asked = self.asked.as_ref().map(|asked| asked.asked_ns);
            piece.asked_ns = asked.unwrap_or_else(|| gp_now_ns());
        }
        piece.check()?;
        match &self.asked {
            None => {
                self.client.ask(&piece)?;
                self.asked = Some(piece);
            }
            Some(asked) if *asked == piece => {}
            Some(_) => {
                return Err(Failure::Argument(
                    "segment: the one before it is not answered yet; send that one again, which \
                     waits for its answer",
                ));
            }
        }
        let started = Instant::now();
        loop {
            // A planner that has gone away will not answer any more.
            let answer = self.client.reply().inspect_err(|_| self.asked = None)?;
            if let Some(answer) = answer {
                self.asked = None;
                answer.check()?;
                if answer.refusal == 0 {
                    self.next += 1;
                }
                return Ok(Some(answer));
            }
            if started.elapsed() >= patience {
                return Ok(None);
            }
            std::thread::sleep(POLL);
        }
    }
}

#[unsafe(no_mangle)]
extern "C" fn gp_segments_open(link: Handle<Link>, segments: Room<Handle<Segments>>) -> i32 {
    link.with(|link| {
        segments.check(NO_HANDLE_ROOM)?;
        let handle = Handle::open(Segments {
            client: link.ipc.segment_client()?,
            // Another one for every stream that was ever opened since the host was started.
            session: gp_now_ns() ^ u64::from(std::process::id()) << 40,
            next: 0,
            asked: None,
        });
        segments.put(handle, NO_HANDLE_ROOM)?;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_segments_send(
    segments: Handle<Segments>,
    segment: Given<SegmentRequest>,
    size: usize,
    patience_ms: u32,
    reply: Room<SegmentReply>,
    reply_size: usize,
) -> i32 {
    segments.with(|segments| {
        check_size::<SegmentRequest>("gp_segment", size)?;
        if !reply.is_null() {
            check_size::<SegmentReply>("gp_segment_reply", reply_size)?;
            reply.check(NO_REPLY)?;
        }
        let piece = segment.get("segment: NULL, what is to be sent")?;
        let Some(answer) = segments.call(piece, patience(patience_ms))? else {
            return Ok(NONE);
        };
        if !reply.is_null() {
            reply.put(answer, NO_REPLY)?;
        }
        if answer.outcome()?.is_ok() {
            return Ok(GOT);
        }
        remember(format_args!("refused: {}", answer.message.as_str()));
        Ok(Code::Refused as i32)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_segments_close(segments: Handle<Segments>) -> i32 {
    segments.close(|segments| {
        drop(segments);
        Ok(())
    })
}
