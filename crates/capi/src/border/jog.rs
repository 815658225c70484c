//! The functions for moving by hand: demands on their way to the interpolator.

use super::call::{NONE, code_of};
use super::handle::{Handle, Held};
use super::link::Link;
use super::pointer::{Given, Room, check_size};
use super::text::gp_now_ns;
use crate::failure::Failure;
use bytemuck::Zeroable as _;
use glidepath_link::{JogDemand, Publisher, Record as _, Status, Transport as _};

/// A client that moves the machine by hand.
pub(super) struct JogSink {
    sink: Box<dyn Publisher<JogDemand>>,
    /// What was asked for last, with the client's number.
    asked: JogDemand,
}

impl Held for JogSink {
    const MARK: u32 = 0x6a6f_6773;
    const NAME: &'static str = "the jog sink";
    const NO_HANDLE: &'static str = "sink: no open gp_jog_sink";
}

const NO_ROOM: &str = "sink: NULL, where the handle is to go";

impl JogSink {
    /// Sends what was asked for, as of now.
    fn send(&mut self) -> Result<(), Failure> {
        self.asked.sent_ns = gp_now_ns();
        Ok(self.sink.publish(&self.asked)?)
    }

    /// Asks for something new.
    fn ask(&mut self, mut demand: JogDemand) -> Result<(), Failure> {
        demand.client = self.asked.client;
        demand.number = self.asked.number + 1;
        if demand.asked_ns == 0 {
            demand.asked_ns = gp_now_ns();
        }
        demand.check()?;
        self.asked = demand;
        self.send()
    }
}

#[unsafe(no_mangle)]
extern "C" fn gp_jog_open(link: Handle<Link>, sink: Room<Handle<JogSink>>) -> i32 {
    link.with(|link| {
        sink.check(NO_ROOM)?;
        let asked = JogDemand {
            // Another one for every sink that was ever opened since the host was started.
            client: gp_now_ns() ^ u64::from(std::process::id()) << 40,
            ..JogDemand::zeroed()
        };
        let handle = Handle::open(JogSink {
            sink: link.ipc.jog_sink()?,
            asked,
        });
        sink.put(handle, NO_ROOM)?;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_jog_send(sink: Handle<JogSink>, jog: Given<JogDemand>, size: usize) -> i32 {
    sink.with(|sink| {
        check_size::<JogDemand>("gp_jog", size)?;
        sink.ask(jog.get("jog: NULL, what is asked for")?)?;
        Ok(NONE)
    })
}

/// Whether what was asked for last is what moves the machine, or was the last that did.
const fn is_followed(asked: &JogDemand, status: &Status) -> bool {
    asked.number != 0 && status.jog_client == asked.client && status.jog_number == asked.number
}

#[unsafe(no_mangle)]
extern "C" fn gp_jog_is_followed(sink: Handle<JogSink>, status: Given<Status>, size: usize) -> i32 {
    sink.with(|sink| {
        check_size::<Status>("gp_status", size)?;
        let status = status.get("status: NULL, what the machine says")?;
        Ok(code_of(is_followed(&sink.asked, &status)))
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_jog_keep(sink: Handle<JogSink>) -> i32 {
    sink.with(|sink| {
        if sink.asked.number == 0 {
            return Err(Failure::Argument(
                "sink: nothing was asked for that could be kept; begin with gp_jog_send",
            ));
        }
        sink.send()?;
        Ok(NONE)
    })
}

#[unsafe(no_mangle)]
extern "C" fn gp_jog_close(sink: Handle<JogSink>) -> i32 {
    sink.close(|mut sink| {
        // Whoever goes lets go: the motion would stop a moment later anyway.
        if sink.asked.mode != 0 {
            sink.ask(JogDemand::zeroed())?;
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_another_client_is_told_is_no_result_of_this_one() {
        let asked = |client, number| JogDemand {
            client,
            number,
            ..JogDemand::zeroed()
        };
        let mut status = Status::zeroed();
        assert!(!is_followed(&asked(0, 0), &status), "nothing was asked for");
        (status.jog_client, status.jog_number) = (7, 3);
        assert!(is_followed(&asked(7, 3), &status));
        for (client, number) in [(8, 3), (7, 2), (7, 4)] {
            assert!(!is_followed(&asked(client, number), &status));
        }
    }
}
