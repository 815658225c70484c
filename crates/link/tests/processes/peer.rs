//! The other processes.

use crate::instance::{frame, reply_to, take, wait_for};
use crate::intruder::intrude;
use bytemuck::Zeroable;
use core::time::Duration;
use glidepath_link::{
    Capacity, Command, CommandRequest, Delivery, Ipc, LinkConfig, Setpoint, Transport,
};
use std::io::{BufRead, BufReader, Lines};
use std::path::PathBuf;
use std::process::{Child, ChildStdout, Stdio};

const ROLE: &str = "GLIDEPATH_TEST_ROLE";
const ROOT: &str = "GLIDEPATH_TEST_ROOT";
/// Marks a line of a child for its parent, among the test harness' own.
const MARK: &str = "peer: ";

pub(crate) const CAPACITY: Capacity = Capacity {
    frames: 8,
    setpoints: 4,
    subscribers: 3,
};

/// A process that is killed when dropped, without a chance to clean up.
pub(crate) struct Peer {
    process: Child,
    lines: Lines<BufReader<ChildStdout>>,
}

impl Peer {
    /// Starts a process in one of the roles of [`child`].
    pub(crate) fn start(role: &str, config: &LinkConfig) -> Self {
        let program = std::env::current_exe().unwrap();
        Self::spawn(std::process::Command::new(program), role, config)
    }

    /// The same as another user, who may have no way to where this program is.
    pub(crate) fn start_as(user: u32, role: &str, config: &LinkConfig) -> Self {
        let mut program = std::process::Command::new("setpriv");
        let (user, group) = (format!("--reuid={user}"), format!("--regid={user}"));
        let copy = config.root.with_file_name("program");
        // By another process: a program is busy while anybody has it open for writing, and a child
        // that another test has just forked would have it open, too.
        let copied = std::process::Command::new("cp")
            .args([&std::env::current_exe().unwrap(), &copy])
            .status();
        assert!(copied.unwrap().success());
        program.args([&user, &group, "--clear-groups"]).arg(copy);
        Self::spawn(program, role, config)
    }

    fn spawn(mut program: std::process::Command, role: &str, config: &LinkConfig) -> Self {
        let mut process = program
            .args(["peer::child", "--exact", "--nocapture"])
            .env(ROLE, role)
            .env(ROOT, &config.root)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let lines = BufReader::new(process.stdout.take().unwrap()).lines();
        Self { process, lines }
    }

    /// Waits until the process says something.
    pub(crate) fn says(&mut self) -> String {
        let marked = self
            .lines
            .by_ref()
            .map(Result::unwrap)
            .find_map(|line| line.split_once(MARK).map(|(_, said)| said.to_owned()));
        marked.unwrap_or_else(|| panic!("the child ended without a word"))
    }

    /// SIGKILL.
    pub(crate) fn kill(mut self) {
        self.process.kill().unwrap();
        self.process.wait().unwrap();
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

pub(crate) fn say(what: &str) {
    println!("{MARK}{what}");
}

/// Long enough to be killed; short enough to end by itself if the parent is.
fn sleep_until_killed() {
    std::thread::sleep(Duration::from_secs(120));
}

#[test]
fn child() {
    let Ok(role) = std::env::var(ROLE) else {
        return;
    };
    let root: PathBuf = std::env::var_os(ROOT).unwrap().into();
    if role == "intruder" {
        return intrude(&root);
    }
    let config = LinkConfig {
        instance: "processes".to_owned(),
        root,
        capacity: CAPACITY,
    };
    let link = Ipc::connect(&config).unwrap();
    match role.as_str() {
        "consumer that takes one and stalls" => stalling_consumer(&link),
        "consumer of frames 1 to 100" => consumer(&link),
        "planner that fills the queue" => planner(&link),
        "command server that never answers" => {
            let _server = link.command_server().unwrap();
            say("up");
            sleep_until_killed();
        }
        "command server" => server(&link),
        "client that asks and never looks" => client(&link),
        "setpoint subscriber" => subscriber(&link),
        "setpoint publisher" => publisher(&link),
        other => panic!("no such role: {other}"),
    }
}

fn stalling_consumer(link: &Ipc) {
    let mut source = link.frame_source().unwrap();
    say(&take(&mut *source).sequence.to_string());
    sleep_until_killed();
}

fn consumer(link: &Ipc) {
    let mut source = link.frame_source().unwrap();
    for expected in 1..=100 {
        assert_eq!(take(&mut *source).sequence, expected);
    }
    say("all");
    sleep_until_killed();
}

fn planner(link: &Ipc) {
    let mut sink = link.frame_sink().unwrap();
    let mut next = 0;
    wait_for(|| match sink.offer(&frame(next)).unwrap() {
        Delivery::Delivered => {
            next += 1;
            None
        }
        Delivery::NoConsumer => None,
        Delivery::Full => Some(()),
    });
    say(&next.to_string());
    sleep_until_killed();
}

fn server(link: &Ipc) {
    let mut server = link.command_server().unwrap();
    say("up");
    wait_for(|| {
        server.serve(&mut reply_to).unwrap();
        None::<()> // until killed
    });
}

fn client(link: &Ipc) {
    let mut client = link.command_client().unwrap();
    wait_for(|| client.ask(&CommandRequest::new(1, 0, Command::Ping)).ok());
    say("asked");
    sleep_until_killed();
}

fn subscriber(link: &Ipc) {
    let mut source = link.setpoint_source().unwrap();
    say("up");
    take(&mut *source);
    say("got one");
    sleep_until_killed();
}

fn publisher(link: &Ipc) {
    let mut sink = link.setpoint_sink().unwrap();
    let boot_id = u64::from(std::process::id());
    let mut number = 0;
    wait_for(|| {
        sink.publish(&Setpoint {
            boot_id,
            number,
            ..Setpoint::zeroed()
        })
        .unwrap();
        if number == 0 {
            say(&boot_id.to_string());
        }
        number += 1;
        None::<()> // until killed
    });
}
