//! The functions for setpoints, as they come.

use super::call::{GOT, NONE, code_of};
use super::handle::{Handle, Held};
use super::link::Link;
use super::pointer::{Room, check_size};
use crate::failure::Failure;
use glidepath_link::{Record as _, Setpoint, Subscriber, Transport as _};

/// A subscriber.
pub(super) struct Setpoints {
    source: Box<dyn Subscriber<Setpoint>>,
}

impl Held for Setpoints {
    const MARK: u32 = 0x7365_7470;
    const NAME: &'static str = "the subscriber";
    const NO_HANDLE: &'static str = "setpoints: no open gp_setpoints";
}

const NO_HANDLE_ROOM: &str = "setpoints: NULL, where the handle is to go";
const NO_ROOM: &str = "setpoint: NULL, where it is to go";

impl Setpoints {
    /// The next one, checked.
    fn next(&mut self) -> Result<Option<Setpoint>, Failure> {
        let Some(setpoint) = self.source.take()? else {
            return Ok(None);
        };
        setpoint.check()?;
        Ok(Some(setpoint))
    }
}

#[unsafe(no_mangle)]
extern "C" fn gp_setpoints_open(link: Handle<Link>, setpoints: Room<Handle<Setpoints>>) -> i32 {
    link.with(|link| {
        setpoints.check(NO_HANDLE_ROOM)?;
        let source = link.ipc.setpoint_source()?;
        setpoints.put(Handle::open(Setpoints { source }), NO_HANDLE_ROOM)?;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_next(setpoints: Handle<Setpoints>, setpoint: Room<Setpoint>, size: usize) -> i32 {
    setpoints.with(|setpoints| {
        check_size::<Setpoint>("gp_setpoint", size)?;
        setpoint.check(NO_ROOM)?;
        let Some(next) = setpoints.next()? else {
            return Ok(NONE);
        };
        setpoint.put(next, NO_ROOM)?;
        Ok(GOT)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_latest(
    setpoints: Handle<Setpoints>,
    setpoint: Room<Setpoint>,
    size: usize,
    skipped: Room<u64>,
) -> i32 {
    setpoints.with(|setpoints| {
        check_size::<Setpoint>("gp_setpoint", size)?;
        setpoint.check(NO_ROOM)?;
        let (mut latest, mut taken) = (None, 0_u64);
        while let Some(next) = setpoints.next()? {
            (latest, taken) = (Some(next), taken + 1);
        }
        if !skipped.is_null() {
            skipped.put(taken.saturating_sub(1), "skipped: not aligned")?;
        }
        if let Some(latest) = latest {
            setpoint.put(latest, NO_ROOM)?;
        }
        Ok(code_of(latest.is_some()))
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_setpoints_close(setpoints: Handle<Setpoints>) -> i32 {
    setpoints.close(|setpoints| {
        drop(setpoints);
        Ok(())
    })
}
