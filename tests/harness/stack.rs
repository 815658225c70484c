//! A servo stack as a thread of the test, with a machine that obeys it, and that the test upsets.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use glidepath_link::servo::{Servo, ServoSettings};
use glidepath_link::{Feedback, Ipc, LinkConfig, Transport};
use glidepath_plant::{InjectedFault, JointSettings, Plant};
use glidepath_realtime::{Clock as _, Monotonic};

use crate::Instance;

const POLL: Duration = Duration::from_millis(1);
/// How long setpoints may stay away, ns. A thread of a test may be kept from the processor for longer than a servo
/// should be patient for, and once it has stopped by itself it stays stopped.
const PATIENCE_NS: u64 = 100_000_000;

/// The servo library and a plant, stepped at the speed of the clock.
#[derive(Debug)]
pub struct ServoStack {
    plant: Arc<Mutex<Plant>>,
    ending: Arc<AtomicBool>,
    player: Option<JoinHandle<()>>,
}

impl ServoStack {
    /// Starts it with joints that stand somewhere. `boot_id` tells it from those before.
    #[must_use]
    pub fn start(instance: &Instance, boot_id: u64, joints: &[JointSettings]) -> Self {
        let plant = Arc::new(Mutex::new(Plant::new(boot_id, joints)));
        let ending = Arc::new(AtomicBool::new(false));
        let player = {
            let link = instance.config().clone();
            let (plant, ending) = (Arc::clone(&plant), Arc::clone(&ending));
            std::thread::spawn(move || play(&link, &plant, &ending))
        };
        Self {
            plant,
            ending,
            player: Some(player),
        }
    }

    /// Something goes wrong with the machine, or right again.
    pub fn inject(&self, upset: InjectedFault) {
        self.plant.lock().unwrap().inject(upset);
    }

    /// What the machine measures of itself.
    #[must_use]
    pub fn measured(&self) -> Feedback {
        self.plant.lock().unwrap().measured()
    }
}

impl Drop for ServoStack {
    fn drop(&mut self) {
        self.ending.store(true, Ordering::Relaxed);
        // A player that failed has said so.
        let _ended = self.player.take().map(JoinHandle::join);
    }
}

fn play(link: &LinkConfig, plant: &Mutex<Plant>, ending: &AtomicBool) {
    let transport = Ipc::connect(link).unwrap();
    let setpoints = transport.setpoint_source().unwrap();
    let settings = ServoSettings {
        patience_ns: PATIENCE_NS,
        ..ServoSettings::default()
    };
    let mut servo = Servo::new(setpoints, settings);
    let mut sink = transport.feedback_sink().unwrap();
    while !ending.load(Ordering::Relaxed) {
        while let Some(setpoint) = servo.receive(Monotonic.now_ns()).unwrap() {
            plant.lock().unwrap().hear(&setpoint);
        }
        let now_ns = Monotonic.now_ns();
        let demand = servo.demand(now_ns);
        let feedback = {
            let mut plant = plant.lock().unwrap();
            plant.step(now_ns, servo.last(), demand.as_ref());
            plant.feedback()
        };
        if let Some(feedback) = feedback {
            sink.publish(&feedback).unwrap();
        }
        std::thread::sleep(POLL);
    }
}
