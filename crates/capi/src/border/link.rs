//! The functions for an instance: joining it, its status, and commands.

use super::call::{GOT, NONE, call};
use super::handle::{Handle, Held};
use super::pointer::{Given, GivenText, Room, check_size};
use crate::failure::{Code, Failure, remember};
use crate::layout::{ABI, LAYOUT};
use core::time::Duration;
use glidepath_link::{
    CommandKind, CommandReply, CommandRequest, EventId, Ipc, LinkConfig, Operator, Record as _,
    Status, Text,
};

/// A thread's part in an instance.
pub(super) struct Link {
    pub(super) config: LinkConfig,
    pub(super) ipc: Ipc,
    /// Commands given so far.
    commands: u64,
}

impl Held for Link {
    const MARK: u32 = 0x6c69_6e6b;
    const NAME: &'static str = "the link";
    const NO_HANDLE: &'static str = "link: no open gp_link";
}

const NO_ROOM: &str = "link: NULL, where the handle is to go";
const NO_STATUS: &str = "status: NULL, where it is to go";
const NO_REPLY: &str = "reply: not aligned";

#[unsafe(no_mangle)]
extern "C" fn gp_open_as(
    instance: GivenText,
    abi: u32,
    layout: u64,
    link: Room<Handle<Link>>,
) -> i32 {
    call(|| {
        if abi != ABI {
            let (asked, here) = (abi, ABI);
            return Err(Failure::Abi { asked, here });
        }
        if layout != LAYOUT {
            return Err(Failure::Layout);
        }
        link.check(NO_ROOM)?;
        let name = instance.get("instance: NULL or not UTF-8; \"default\" is one")?;
        let config = LinkConfig::new(name);
        let ipc = Ipc::connect(&config)?;
        let handle = Handle::open(Link {
            config,
            ipc,
            commands: 0,
        });
        link.put(handle, NO_ROOM)?;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_close(link: Handle<Link>) -> i32 {
    link.close(|link| {
        drop(link);
        Ok(())
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_read_status(
    link: Handle<Link>,
    status: Room<Status>,
    size: usize,
    patience_ms: u32,
) -> i32 {
    link.with(|link| {
        check_size::<Status>("gp_status", size)?;
        status.check(NO_STATUS)?;
        let operator = Operator::find(&link.config)?;
        let Some(found) = operator.status(patience(patience_ms))? else {
            return Ok(NONE);
        };
        status.put(found, NO_STATUS)?;
        Ok(GOT)
    })
}

pub(super) fn patience(patience_ms: u32) -> Duration {
    Duration::from_millis(patience_ms.into())
}

#[unsafe(no_mangle)]
extern "C" fn gp_command(
    link: Handle<Link>,
    kind: u32,
    value: f64,
    joints: u32,
    patience_ms: u32,
    reply: Room<CommandReply>,
    size: usize,
) -> i32 {
    let request = || {
        if CommandKind::from_code(kind) == Some(CommandKind::Acknowledge) {
            let what = "kind: events are acknowledged with gp_acknowledge";
            return Err(Failure::Argument(what));
        }
        if CommandKind::from_code(kind) == Some(CommandKind::Job) {
            return Err(Failure::Argument("kind: only planners tell of jobs"));
        }
        Ok(request(kind, value, joints, EventId::default()))
    };
    command(&link, request, patience_ms, &reply, size)
}

#[unsafe(no_mangle)]
extern "C" fn gp_acknowledge(
    link: Handle<Link>,
    event: Given<EventId>,
    done: i32,
    patience_ms: u32,
    reply: Room<CommandReply>,
    size: usize,
) -> i32 {
    let request = || {
        let event = event.get("event: NULL, which event it is about")?;
        let value = f64::from(u8::from(done != 0));
        Ok(request(CommandKind::Acknowledge.code(), value, 0, event))
    };
    command(&link, request, patience_ms, &reply, size)
}

fn request(kind: u32, value: f64, joints: u32, event: EventId) -> CommandRequest {
    CommandRequest {
        client: std::process::id().into(),
        number: 0,
        value,
        kind,
        joints,
        event,
        job: 0,
        asked_ns: 0,
        job_stream: 0,
        reserved: 0,
        text: Text::default(),
    }
}

/// Gives a command, by the way that needs no shared memory.
fn command(
    link: &Handle<Link>,
    request: impl FnOnce() -> Result<CommandRequest, Failure>,
    patience_ms: u32,
    reply: &Room<CommandReply>,
    size: usize,
) -> i32 {
    link.with(|link| {
        if !reply.is_null() {
            check_size::<CommandReply>("gp_reply", size)?;
            reply.check(NO_REPLY)?;
        }
        let mut request = request()?;
        link.commands += 1;
        request.number = link.commands;
        // What the interpolator would refuse as malformed is told here, by field.
        request.check()?;
        let operator = Operator::find(&link.config)?;
        let Some(answer) = operator.call(&request, patience(patience_ms))? else {
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
