//! The measurement itself: the real-time thread beats, the calling thread collects.

use super::beat::{Idle, Load, LoopBeat, beat};
use super::cyclictest::{Cyclictest, Latencies};
use super::error::JitterError;
use super::section::{Section, sections};
use super::setup::Setup;
use super::windows::Windows;
use crate::progress::ProgressDisplay;
use core::sync::atomic::{AtomicBool, Ordering};
use glidepath_interpolator::{lead_ns, stepped};
use glidepath_realtime::{
    Clock as _, DeadlineTimer, EventReader, EventWriter, Events, Grants, Host, Item, Monotonic,
    NotRealTime, ProcessorTime, enter, event_ring,
};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

/// Beats under way, one less: 0.8 s at the shortest period.
const BEATS: usize = 16_384;
/// From the end of the preparations to the first deadline.
const PREPARED_NS: u64 = 5_000_000;
/// How often the calling thread empties the ring.
const POLL: Duration = Duration::from_millis(20);

/// The result of a measurement.
#[derive(Debug)]
pub struct Measurement {
    /// The beats by windows.
    pub windows: Windows,
    /// What the thread was granted.
    pub grants: Grants,
    /// Beats the calling thread was too slow for; they are in no figure.
    pub lost_beats: u64,
    /// What cyclictest saw in the same time. It refuses to run without the right to `SCHED_FIFO`:
    /// then it is left out.
    pub cyclictest: Option<Latencies>,
}

/// Measures until the time is over or `interrupt` is set; then cyclictest's figures are missing.
///
/// # Errors
/// The host refuses real time, the thread cannot be started, or cyclictest does not run.
pub fn measure(
    setup: &Setup,
    progress: &ProgressDisplay,
    interrupt: &AtomicBool,
) -> Result<Measurement, JitterError> {
    let mut measured = Measurement {
        windows: Windows::new(Some(0)),
        grants: Grants::NONE,
        lost_beats: 0,
        cyclictest: None,
    };
    for section in sections(setup.seconds, setup.period_ns, setup.against_cyclictest) {
        if !interrupt.load(Ordering::Relaxed) {
            let run = SectionRun {
                setup,
                section,
                progress,
                interrupt,
            };
            run.measure(&mut measured)?;
        }
    }
    if interrupt.load(Ordering::Relaxed) {
        measured.cyclictest = None;
    }
    Ok(measured)
}

/// The measurement of one section.
struct SectionRun<'a> {
    setup: &'a Setup,
    section: Section,
    progress: &'a ProgressDisplay,
    interrupt: &'a AtomicBool,
}

impl SectionRun<'_> {
    fn measure(&self, measured: &mut Measurement) -> Result<(), JitterError> {
        let mut events = Box::<Events<LoopBeat, BEATS>>::default();
        let (writer, mut reader) = event_ring(&mut events);
        let stop = AtomicBool::new(false);
        thread::scope(|scope| {
            let (tell, told) = mpsc::channel();
            let stop = &stop;
            thread::Builder::new()
                .name("glidepath-rt".to_owned())
                .spawn_scoped(scope, move || {
                    real_time(self.setup, &self.section, writer, &tell, stop);
                })
                .map_err(JitterError::Start)?;
            let observed = told
                .recv()
                .map_err(|_| JitterError::Ended)
                .and_then(|granted| Ok(granted?))
                .and_then(|grants| {
                    measured.grants = grants;
                    self.observe(measured, &mut reader)
                });
            stop.store(true, Ordering::Relaxed);
            observed
        })
    }

    /// The calling thread: collects the beats, second by second. With cyclictest, which begins at a
    /// whole second, it begins at the same.
    fn observe(
        &self,
        measured: &mut Measurement,
        reader: &mut EventReader<'_, LoopBeat>,
    ) -> Result<(), JitterError> {
        let (setup, grants) = (self.setup, measured.grants);
        let host = Host::here();
        let cpu = setup
            .request
            .cpu
            .filter(|_| grants.is_granted(Item::Affinity));
        let steal = || ProcessorTime::read(&host, cpu).map(|time| time.steal);
        let mut cyclictest = None;
        if setup.against_cyclictest && grants.is_granted(Item::Scheduling) {
            sleep_until(Section::whole_second_after(Monotonic.now_ns()));
            cyclictest = Some(Cyclictest::start(setup, &self.section, &grants)?);
            sleep_until(Section::whole_second_after(Monotonic.now_ns()));
        }
        while reader.read().is_some() {}
        reader.newly_dropped();
        let began = Instant::now();
        measured.windows.resume(steal());
        for second in 1..=self.section.seconds {
            let end = began + Duration::from_secs(second.into());
            while Instant::now() < end && !self.is_interrupted() {
                thread::sleep(POLL.min(end.saturating_duration_since(Instant::now())));
                while let Some(beat) = reader.read() {
                    measured.windows.record(&beat);
                }
            }
            measured.windows.close(steal());
            self.progress.at(measured.windows.count);
            if self.is_interrupted() {
                return Ok(());
            }
        }
        measured.lost_beats += reader.newly_dropped();
        if let Some(latencies) = cyclictest.map(Cyclictest::finish).transpose()? {
            match &mut measured.cyclictest {
                Some(all) => all.merge(&latencies),
                none => *none = Some(latencies),
            }
        }
        Ok(())
    }

    fn is_interrupted(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }
}

fn sleep_until(time_ns: u64) {
    thread::sleep(Duration::from_nanos(
        time_ns.saturating_sub(Monotonic.now_ns()),
    ));
}

/// The real-time thread: tells what it was granted, then beats until `stop`.
fn real_time(
    setup: &Setup,
    section: &Section,
    mut writer: EventWriter<'_, LoopBeat>,
    tell: &mpsc::Sender<Result<Grants, NotRealTime>>,
    stop: &AtomicBool,
) {
    // As long as it is there it keeps the processors awake.
    let entered = match enter(&setup.request, setup.mode) {
        Ok(entered) => entered,
        Err(refused) => {
            // Whoever asked has an error of its own.
            let _told = tell.send(Err(refused));
            return;
        }
    };
    let mut run = |load: &mut dyn Load| {
        let (period_ns, lead_ns) = (setup.period_ns, lead_ns(setup.period_ns));
        let origin_ns = section.origin_ns(Monotonic.now_ns() + PREPARED_NS, period_ns, lead_ns);
        let mut timer = DeadlineTimer::new(Monotonic, origin_ns, period_ns).with_lead(lead_ns);
        if tell.send(Ok(entered.grants)).is_ok() {
            beat(&mut timer, &mut writer, stop, load);
        }
    };
    match &setup.motion {
        None => run(&mut Idle),
        Some(motion) => stepped(motion.config(), |interpolator| {
            run(&mut motion.player(interpolator));
        }),
    }
}
