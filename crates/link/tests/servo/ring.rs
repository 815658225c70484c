//! The ring between the thread that owns the port and the one that plays setpoints.

use super::references::standing;
use super::{PERIOD_NS, ServoSettings, setpoint, truth};
use glidepath_link::servo::{Servo, ring};
use glidepath_link::{
    Capacity, InProcess, LinkError, MachineState, Publisher, Setpoint, Transport,
};
use glidepath_realtime::{
    Clock as _, CountingAllocator, DeadlineTimer, Monotonic, forbid_system_calls,
};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

/// Far longer than anything here takes: only a hang reaches it.
const PATIENCE: Duration = Duration::from_secs(60);

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

fn publish(sink: &mut Box<dyn Publisher<Setpoint>>, numbers: core::ops::Range<u64>) {
    for number in numbers {
        sink.publish(&setpoint(number)).unwrap();
    }
}

#[test]
fn what_arrives_comes_through_in_order_and_the_port_keeps_the_rest() {
    let capacity = Capacity {
        setpoints: 500,
        ..Capacity::default()
    };
    let link = InProcess::new(capacity);
    let mut sink = link.setpoint_sink().unwrap();
    let (source, filler) = ring(move || link.setpoint_source()).unwrap();
    let mut servo = Servo::new(source, ServoSettings::default());
    // More than the ring and the port hold together: the port loses its oldest, and says so by the
    // numbers.
    let (started, mut numbers) = (Instant::now(), Vec::new());
    publish(&mut sink, 0..200);
    while numbers.len() < 200 {
        assert!(started.elapsed() < PATIENCE, "{numbers:?}");
        numbers.extend(servo.receive(0).unwrap().map(|setpoint| setpoint.number));
    }
    publish(&mut sink, 200..1000);
    while numbers.last() != Some(&999) {
        assert!(started.elapsed() < PATIENCE, "{numbers:?}");
        while let Some(setpoint) = servo.receive(0).unwrap() {
            numbers.push(setpoint.number);
        }
    }
    assert!(numbers.is_sorted() && numbers.len() >= 500);
    assert_eq!(numbers[..200], *(0..200).collect::<Vec<_>>());
    let counts = servo.counts();
    assert_eq!(counts.received + counts.lost, 1000);
    assert!(!filler.has_failed());
    filler.finish().unwrap();
}

#[test]
fn a_port_that_cannot_be_made_or_fails_says_why() {
    let none = ring(|| Err(LinkError::NoServer { service: "test" }));
    assert!(matches!(none, Err(LinkError::NoServer { service: "test" })));

    struct Failing(bool);
    impl glidepath_link::Subscriber<Setpoint> for Failing {
        fn take(&mut self) -> Result<Option<Setpoint>, LinkError> {
            if core::mem::replace(&mut self.0, true) {
                return Err(LinkError::NoServer { service: "test" });
            }
            Ok(Some(setpoint(0)))
        }
    }
    let (source, filler) = ring(|| Ok(Box::new(Failing(false)))).unwrap();
    let mut servo = Servo::new(source, ServoSettings::default());
    let started = Instant::now();
    while !filler.has_failed() {
        assert!(started.elapsed() < PATIENCE);
        std::thread::sleep(Duration::from_millis(1));
    }
    assert_eq!(servo.receive(0).unwrap().unwrap().number, 0);
    assert!(
        servo.receive(0).unwrap().is_none(),
        "silence, and no error in the loop"
    );
    let why = filler.finish();
    assert!(matches!(why, Err(LinkError::NoServer { service: "test" })));
}

const ROLE: &str = "GLIDEPATH_RING_ROLE";
/// Periods that are played at least, and at most if the thread that fills the ring is not let run.
const PERIODS: u32 = 400;
const MOST_PERIODS: u32 = 120_000;
/// How the real-time thread ends the process: `exit` would make system calls.
const GOOD: i32 = 42;

/// Plays for a fifth of a second, or until something has come, and ends the process.
fn play_in_silence(mut servo: Servo<glidepath_link::servo::RingSource>) -> ! {
    let mut timer = DeadlineTimer::new(Monotonic, Monotonic.now_ns(), 500_000);
    forbid_system_calls().unwrap();
    let before = CountingAllocator::calls_of_this_thread();
    let (mut demands, mut played) = (0, 0);
    let has_played = |servo: &Servo<_>, demands| servo.counts().received >= 10 && demands >= 10;
    while played < PERIODS || (played < MOST_PERIODS && !has_played(&servo, demands)) {
        played += 1;
        let now_ns = timer.wait().woke_ns;
        while let Ok(Some(_)) = servo.receive(now_ns) {}
        demands += u32::from(servo.demand(now_ns).is_some());
    }
    servo.stop(timer.wait().woke_ns);
    let is_silent = CountingAllocator::calls_of_this_thread() == before;
    let code = match (is_silent, has_played(&servo, demands)) {
        (true, true) => GOOD,
        (false, _) => 1,
        (true, false) => 2,
    };
    #[allow(
        unsafe_code,
        reason = "any other end of the process makes system calls"
    )]
    // SAFETY: `_exit` takes a number and does not return.
    unsafe {
        libc::_exit(code)
    }
}

#[test]
fn the_real_time_thread_makes_no_system_call_and_no_allocation() {
    if std::env::var_os(ROLE).is_some() {
        let link = InProcess::default();
        let mut sink = link.setpoint_sink().unwrap();
        let (made, is_made) = channel();
        let _playing = std::thread::spawn(move || {
            let (source, filler) = ring(move || link.setpoint_source()).unwrap();
            made.send(()).unwrap();
            let _stays = core::mem::ManuallyDrop::new(filler);
            play_in_silence(Servo::new(source, ServoSettings::default()));
        });
        is_made.recv().unwrap();
        for number in 0.. {
            let now_ns = Monotonic.now_ns();
            let setpoint = Setpoint {
                scheduled_ns: now_ns,
                apply_ns: now_ns + PERIOD_NS,
                ..standing(number, 0, MachineState::Idle, truth(0.1).position)
            };
            sink.publish(&setpoint).unwrap();
            std::thread::sleep(Duration::from_nanos(PERIOD_NS));
        }
    }
    let output = std::process::Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "--nocapture", "--test-threads=1"])
        .arg("ring::the_real_time_thread_makes_no_system_call_and_no_allocation")
        .env(ROLE, "child")
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(GOOD), "{output:?}");
}
