//! `glidepath mirror`: publishes setpoints and status as ordinary services of iceoryx2, for programs
//! that look on.

use super::session;
use crate::cli::MirrorArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use crate::report::grouped;
use glidepath_link::mirror::{
    Gap, Mirror, MirrorCounts, MirrorError, MirrorNote, MirrorSettings, obstacle,
};
use glidepath_link::{Ipc, LinkConfig};
use serde_json::json;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

/// Between two looks whether the process was asked to end.
const POLL: Duration = Duration::from_millis(50);
/// How long iceoryx2 may take to make the services. A file of another user can make it wait for ever.
const OPENING: Duration = Duration::from_secs(10);
/// How long the mirror may take to end in good order. What it leaves after that, the next one cleans
/// up.
const ENDING: Duration = Duration::from_millis(600);

/// What the mirror tells.
enum News {
    Open,
    Noted(MirrorNote),
    Ended(Result<MirrorCounts, MirrorError>),
}

/// Mirrors until asked to end.
///
/// # Errors
/// The link or iceoryx2 cannot be used.
pub(super) fn mirror(args: &MirrorArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let instance = session::instance(&args.instance, config);
    let link = session::link(&instance, config);
    let settings = MirrorSettings {
        instance,
        root: args.root.clone(),
    };
    let (news, heard) = channel();
    let (ending, asked) = (interrupt.clone(), settings.clone());
    let thread = std::thread::Builder::new().name("glidepath-mirror".to_owned());
    // Never waited for: iceoryx2 may hang in it.
    let spawned = thread.spawn(move || work(&link, &asked, &ending, &news));
    drop(spawned.map_err(Failure::Process)?);
    if let Some(counts) = attend(&heard, &settings, &interrupt)? {
        report(args, &counts);
    }
    Ok(interrupt.exit())
}

fn work(link: &LinkConfig, settings: &MirrorSettings, ending: &Interrupt, news: &Sender<News>) {
    // Where nobody listens any more, the process ends.
    let tell = |told| drop(news.send(told));
    let mirrored = || {
        let link = Ipc::connect(link)?;
        let mut mirror = Mirror::open(settings)?;
        tell(News::Open);
        mirror.relay(&link, ending.flag(), &mut |note| tell(News::Noted(note)))
    };
    tell(News::Ended(mirrored()));
}

/// Tells what the mirror tells, until it ends or does not; gives what it counted, if it ended.
fn attend(
    heard: &Receiver<News>,
    settings: &MirrorSettings,
    interrupt: &Interrupt,
) -> Result<Option<MirrorCounts>, Failure> {
    let (started, mut is_open, mut asked_to_end) = (Instant::now(), false, None);
    loop {
        match heard.recv_timeout(POLL) {
            Ok(News::Open) => {
                is_open = true;
                let instance = &settings.instance;
                output::note(&format!(
                    "mirror: ready; glidepath/{instance}/setpoints and glidepath/{instance}/status are \
                     for looking on, never for drives"
                ));
            }
            Ok(News::Noted(note)) => output::note(&noted(note)),
            Ok(News::Ended(ended)) => return Ok(Some(ended?)),
            Err(RecvTimeoutError::Disconnected) => return Err(Failure::Thread("the mirror")),
            Err(RecvTimeoutError::Timeout) => {}
        }
        if interrupt.is_set() {
            let since = asked_to_end.get_or_insert_with(Instant::now);
            if since.elapsed() >= ENDING {
                output::note("mirror: iceoryx2 does not come back; ended without it");
                return Ok(None);
            }
        } else if !is_open && started.elapsed() >= OPENING {
            return Err(Failure::Mirror(MirrorError::Hangs {
                waited_s: OPENING.as_secs(),
                obstacle: obstacle(settings.root.as_deref()),
            }));
        }
    }
}

fn noted(note: MirrorNote) -> String {
    match note {
        MirrorNote::Lost(gap) => lost(gap),
        MirrorNote::Short(error) => format!(
            "mirror: readers that came have no memory: {error}; the mirror goes on without, and may end by SIGBUS"
        ),
        MirrorNote::Ample => "mirror: its readers have their memory again".to_owned(),
    }
}

fn lost(gap: Gap) -> String {
    let Gap { first, last } = gap;
    let count = gap.count();
    if count == 1 {
        format!("mirror: setpoint {first} never came, and is missing from the mirror")
    } else {
        format!(
            "mirror: setpoints {first} to {last} never came ({}), and are missing from the mirror",
            grouped(count)
        )
    }
}

fn report(args: &MirrorArgs, counts: &MirrorCounts) {
    let MirrorCounts {
        setpoints,
        statuses,
        lost,
        refused,
    } = *counts;
    if args.basic.json {
        output::object(&json!({
            "setpoints": setpoints,
            "statuses": statuses,
            "lost_setpoints": lost,
            "refused": refused,
        }));
    } else {
        output::result(&format!(
            "mirror: {} setpoints, {} lost, {} refused, {} of status\n",
            grouped(setpoints),
            grouped(lost),
            grouped(refused),
            grouped(statuses)
        ));
    }
}
