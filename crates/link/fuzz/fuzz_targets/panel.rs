//! The fuzz target: foreign bytes in the files of the operator's panel, with a right checksum or
//! without: whoever serves them does not die, and answers what is a request.
//!
//! `cargo +nightly fuzz run panel` in `crates/link`.

#![no_main]

use glidepath_link::{
    CommandReply, CommandRequest, Ipc, LinkConfig, MachineState, Record, Server, Transport,
};
use libfuzzer_sys::fuzz_target;
use std::cell::RefCell;
use std::fs::File;
use std::os::unix::fs::FileExt;
use std::path::PathBuf;

struct Panel {
    files: Vec<PathBuf>,
    server: Box<dyn Server<CommandRequest, CommandReply>>,
    _transport: Ipc,
}

impl Panel {
    fn new() -> Self {
        let root = PathBuf::from(format!("/dev/shm/glidepath-fuzz-{}", std::process::id()));
        let config = LinkConfig {
            root,
            ..LinkConfig::new("panel")
        };
        let transport = Ipc::connect(&config).expect("an instance");
        let server = transport.command_server().expect("the only server");
        let files = (0..8).map(|k| config.directory().join(format!("panel.{k}")));
        Self {
            files: files.collect(),
            server,
            _transport: transport,
        }
    }
}

thread_local! {
    static PANEL: RefCell<Panel> = RefCell::new(Panel::new());
}

/// FNV-1a, 64 bits, as the panel has it.
fn checksum(bytes: &[u8]) -> u64 {
    let mix = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, mix)
}

fuzz_target!(|input: (u8, bool, Option<u16>, Vec<u8>)| {
    let (place, is_whole, cut, mut bytes) = input;
    if is_whole {
        bytes.resize(8 + size_of::<CommandRequest>(), 0);
        let sum = checksum(&bytes);
        bytes.extend(sum.to_ne_bytes());
    }
    PANEL.with_borrow_mut(|panel| {
        let path = &panel.files[usize::from(place) % panel.files.len()];
        let file = File::options().write(true).open(path).expect("it was made");
        if let Some(length) = cut {
            file.set_len(length.into()).expect("memory has room");
        }
        file.write_all_at(&bytes, 0).expect("memory has room");
        let mut asked = 0;
        let mut answer = |request: &CommandRequest| {
            asked += 1;
            let _ = request.check();
            CommandReply::new(1, request.number, Ok(()), MachineState::Idle, "")
        };
        while panel.server.serve(&mut answer).expect("it goes on serving") {}
        assert!(asked <= 1, "{asked} answers");
    });
});
