//! `glidepath replay`: plays a recording in place of an interpolator, for a servo stack or the
//! page.

use super::session;
use crate::cli::ReplayArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::Interrupt;
use crate::output;
use crate::report::grouped;
use glidepath_link::{
    CommandRefusal, CommandReply, CommandRequest, Ipc, MachineState, Publisher, Server, Setpoint,
    Status, Transport as _,
};
use glidepath_realtime::{Clock as _, Monotonic};
use glidepath_recording::{Entry, Reader};
use serde_json::json;
use std::fs::File;
use std::io::BufReader;
use std::time::Duration;

/// Between two looks whether somebody listens, or whether it is time.
const POLL: Duration = Duration::from_millis(1);
/// How long it waits behind the last setpoint, so that all of it is taken.
const BEHIND: Duration = Duration::from_millis(300);
/// From the first look to the first setpoint, ns.
const LEAD_NS: u64 = 100_000_000;

/// Plays a recording at its own pace.
///
/// # Errors
/// It cannot be read; an interpolator serves the instance, or the link cannot be used.
pub(super) fn replay(args: &ReplayArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let file = File::open(&args.file).map_err(FileError::open(&args.file))?;
    let mut reader =
        Reader::new(BufReader::new(file)).map_err(|error| Failure::recording(&args.file, error))?;
    // Behind that: a pipe into which nobody writes is left by a signal as ever.
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let transport = session::join(&args.operator.instance, config)?;
    // This is the interpolator now: none can be beside it.
    let server = transport.command_server()?;
    let mut stage = Stage {
        setpoints: transport.setpoint_sink()?,
        statuses: transport.status_sink()?,
        server,
        boot_id: Monotonic.now_ns() | 1,
        ahead_ns: None,
        count: 0,
    };
    wait_for_receiver(&transport, &mut stage, &interrupt)?;
    while let Some(entry) = reader
        .next_entry()
        .map_err(|error| Failure::recording(&args.file, error))?
    {
        if interrupt.is_set() {
            break;
        }
        match entry {
            Entry::Setpoint(setpoint) => stage.play(setpoint, &interrupt)?,
            Entry::Status(status) => stage.show(status)?,
        }
    }
    std::thread::sleep(BEHIND);
    if args.operator.basic.json {
        output::object(&json!({
            "recording": args.file,
            "setpoints": stage.count,
            "is_cut": reader.is_cut(),
        }));
    } else {
        let cut = if reader.is_cut() {
            "; the recording was cut short"
        } else {
            ""
        };
        let count = grouped(stage.count);
        output::result(&format!("replay: {count} setpoints played{cut}\n"));
    }
    Ok(interrupt.exit())
}

fn wait_for_receiver(
    transport: &Ipc,
    stage: &mut Stage,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let mut is_told = false;
    while transport.setpoint_receivers()?.is_empty() && !interrupt.is_set() {
        if !is_told {
            is_told = true;
            output::note("replay: waiting for a servo stack, such as `glidepath servo`");
        }
        stage.answer()?;
        std::thread::sleep(POLL);
    }
    Ok(())
}

/// What plays the interpolator.
struct Stage {
    setpoints: Box<dyn Publisher<Setpoint>>,
    statuses: Box<dyn Publisher<Status>>,
    server: Box<dyn Server<CommandRequest, CommandReply>>,
    boot_id: u64,
    /// What is added to the times of the recording, ns.
    ahead_ns: Option<u64>,
    count: u64,
}

impl Stage {
    /// Publishes a setpoint when its time has come.
    fn play(&mut self, mut setpoint: Setpoint, interrupt: &Interrupt) -> Result<(), Failure> {
        let begin_ns = Monotonic.now_ns() + LEAD_NS;
        let first_ns = setpoint.scheduled_ns;
        let ahead_ns = *self
            .ahead_ns
            .get_or_insert_with(|| begin_ns.wrapping_sub(first_ns));
        setpoint.boot_id = self.boot_id;
        setpoint.scheduled_ns = setpoint.scheduled_ns.wrapping_add(ahead_ns);
        setpoint.apply_ns = setpoint.apply_ns.wrapping_add(ahead_ns);
        while Monotonic.now_ns() < setpoint.scheduled_ns && !interrupt.is_set() {
            self.answer()?;
            std::thread::sleep(POLL);
        }
        self.setpoints.publish(&setpoint)?;
        self.count += 1;
        Ok(())
    }

    /// Publishes a status as one of now.
    fn show(&mut self, mut status: Status) -> Result<(), Failure> {
        status.boot_id = self.boot_id;
        status.updated_ns = Monotonic.now_ns();
        status.pid = std::process::id();
        Ok(self.statuses.publish(&status)?)
    }

    /// Refuses what is asked: a recording does what it did.
    fn answer(&mut self) -> Result<(), Failure> {
        let boot_id = self.boot_id;
        let refuse = &mut |request: &CommandRequest| {
            CommandReply::new(
                boot_id,
                request.number,
                Err(CommandRefusal::Unsupported),
                MachineState::Running,
                "this is a recording that is played",
            )
        };
        while self.server.serve(refuse)? {}
        Ok(())
    }
}
