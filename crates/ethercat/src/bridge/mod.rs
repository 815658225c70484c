//! The bridge between setpoints and drives: what each drive is to be told in a cycle, and what is
//! said of it.

mod beginning;
mod load_side;
mod loss;
mod losses;
mod outputs;
mod report;

use crate::axis::{self, Axis, DriveCommand, DriveInputs};
use crate::device_state::DeviceState;
use crate::event::Event;
use crate::image::{Inputs, Outputs};
use crate::probe::{IndexSearches, ProbeUse, Probing};
use crate::settings::{DriveSettings, Settings};
use crate::state;
use crate::terminal::{DigitalInput, Terminals};
use glidepath_geometry::AXES;
use glidepath_link::servo::{JointStates, OwnStop, Servo, ServoCounts};
use glidepath_link::{DriveState, MachineState, Setpoint, Subscriber};
use load_side::LoadSide;
use loss::BridgeLoss;

/// Over how many cycles a velocity is taken: a count is not to look like a motion.
const WINDOW: usize = 16;
/// How long the motion may go on after a drive has failed, ns. Then the joints stop by themselves.
const LED_NS: u64 = 1_000_000_000;

/// A drive and what is known of it.
#[derive(Debug)]
struct Drive {
    axis: Axis,
    inputs: Inputs,
    device: DeviceState,
    /// The last places, mm or degrees.
    places: [f64; WINDOW],
    told: DeviceState,
    /// Its second encoder.
    load_side: Option<LoadSide>,
}

impl Drive {
    const fn is_present(&self) -> bool {
        self.device.is_in_op()
    }

    /// How far its two encoders are apart, if that is too much, and whether it stays so until the process ends.
    fn apart(&self) -> Option<(f64, bool)> {
        self.load_side.as_ref()?.beyond()
    }

    const fn has_failed(&self) -> bool {
        !self.is_present()
            || matches!(
                state::of(self.inputs.status),
                DriveState::Fault | DriveState::FaultReaction
            )
    }
}

/// The drives of a machine, led by setpoints.
#[derive(Debug)]
pub struct Bridge<S: Subscriber<Setpoint>> {
    servo: Servo<S>,
    joints: u32,
    period_ns: u64,
    drives: Vec<Drive>,
    outputs: Vec<Outputs>,
    boot_id: u64,
    number: u64,
    cycles: usize,
    /// The state of the setpoint before.
    state: Option<(u64, u32)>,
    resets: bool,
    /// The same for the drive of the spindle.
    resets_spindle: bool,
    /// No drive gets power before it was taken from all, and asked for anew.
    is_latched: bool,
    ends: bool,
    /// No joint was told to move in the last cycle.
    rests: bool,
    failed_ns: Option<u64>,
    stops_told: u64,
    restarts_told: u64,
    /// All that is no drive; `None` if there is nothing.
    terminals: Option<Terminals>,
    /// How long after the time of the last setpoint somebody is still obeyed, ns.
    patience_ns: u64,
    /// Too many frames were lost, and none has come since.
    is_bus_lost: bool,
    /// What was lost, and stopped something.
    loss: Option<BridgeLoss>,
    /// Their inputs, by the number of the drive.
    drive_inputs: Vec<(usize, DigitalInput)>,
    /// The touch probes of the drives, if they are used.
    probing: Option<Probing>,
    /// The same units, while joints look for the index pulse of their encoders.
    indices: IndexSearches,
}

impl<S: Subscriber<Setpoint>> Bridge<S> {
    /// A bridge whose drives have just been switched on. That somebody starts it counts as a reset
    /// of what faults there are.
    #[must_use]
    pub fn new(settings: &Settings, source: S) -> Self {
        let settings_of = |joint| {
            let mut encoders = (settings.terminals.iter()).flat_map(|it| &it.joint_encoders);
            encoders.find(|encoder| encoder.joint == joint).copied()
        };
        #[allow(clippy::cast_precision_loss, reason = "a period")]
        let period_t = settings.bus.period_ns as f64 * 1e-9;
        let drive = |settings: DriveSettings| Drive {
            load_side: settings_of(settings.joint).map(|encoder| {
                LoadSide::new(encoder, settings.home_offset, settings.max_v * period_t)
            }),
            axis: Axis::new(settings),
            inputs: Inputs::default(),
            device: DeviceState::default(),
            places: [0.0; WINDOW],
            told: DeviceState::default(),
        };
        Self {
            servo: Servo::new(source, settings.servo),
            joints: settings.joints(),
            period_ns: settings.bus.period_ns,
            drives: settings.drives.iter().copied().map(drive).collect(),
            outputs: vec![Outputs::default(); settings.drives.len()],
            boot_id: 0,
            number: 0,
            cycles: 0,
            state: None,
            resets: true,
            resets_spindle: true,
            is_latched: true,
            ends: false,
            rests: false,
            failed_ns: None,
            stops_told: 0,
            restarts_told: 0,
            terminals: (!settings.terminals.is_empty())
                .then(|| Terminals::new(settings.bus.lost_frames, settings.bus.delay_ns)),
            patience_ns: settings.servo.patience_ns,
            is_bus_lost: false,
            loss: None,
            drive_inputs: settings.drive_inputs.clone(),
            probing: Probing::new(settings, WINDOW),
            indices: IndexSearches::new(settings.drives.len(), settings.bus.period_ns),
        }
    }

    /// The drives that answered, and in what states they are.
    pub fn hear(&mut self, inputs: &[Inputs], states: &[DeviceState], tell: &mut dyn FnMut(Event)) {
        self.is_bus_lost = false;
        for (drive, (inputs, device)) in self.drives.iter_mut().zip(inputs.iter().zip(states)) {
            drive.device = *device;
            if drive.is_present() {
                drive.inputs = *inputs;
            }
            if drive.device != drive.told {
                drive.told = drive.device;
                let joint = drive.axis.settings.joint;
                if drive.device.state == 0 {
                    tell(Event::Gone(joint));
                } else if !drive.is_present() {
                    tell(Event::LeftOp(joint, drive.device.code));
                }
            }
        }
    }

    /// Nothing is known of the drives: if they hear, they stop by their own ramp, and lose their power.
    /// No setpoint is played until the position was taken over anew.
    pub fn lose_bus(&mut self, now_ns: u64) {
        self.servo.stop(now_ns);
        (self.is_latched, self.is_bus_lost) = (true, true);
    }

    /// From here on the joints come to rest, and lose their power then: where the setpoints that have
    /// come lead to a rest, there; else by the joints' own stop.
    pub const fn end(&mut self) {
        self.ends = true;
    }

    /// Whether no drive has power, that of the spindle among them.
    #[must_use]
    pub fn is_off(&self) -> bool {
        let terminals = self.terminals.as_ref();
        self.are_drives_off() && terminals.is_none_or(Terminals::is_spindle_off)
    }

    fn are_drives_off(&self) -> bool {
        self.drives.iter().all(|drive| drive.axis.is_off())
    }

    /// Whether a drive is not in OP.
    #[must_use]
    pub fn has_lost_drive(&self) -> bool {
        !self.drives.iter().all(Drive::is_present)
    }

    /// Whether that, or another device is lost.
    #[must_use]
    pub fn has_lost_device(&self) -> bool {
        self.has_lost_drive() || self.has_lost_terminal()
    }

    fn has_lost_terminal(&self) -> bool {
        self.terminals.as_ref().is_some_and(Terminals::has_lost)
    }

    /// The counts of what has become of the setpoints so far.
    #[must_use]
    pub const fn played(&self) -> ServoCounts {
        *self.servo.counts()
    }

    /// What each drive is to be told in this cycle.
    #[must_use]
    pub fn targets(&self) -> &[Outputs] {
        &self.outputs
    }

    /// A cycle: takes setpoints in, and finds what each drive is to be told, for the setpoints of
    /// `meant_ns`. `since_ns` is the time since targets reached the drives last. Times are of
    /// `CLOCK_MONOTONIC`.
    pub fn cycle(
        &mut self,
        now_ns: u64,
        meant_ns: u64,
        since_ns: u64,
        tell: &mut dyn FnMut(Event),
    ) {
        // A source that fails falls silent.
        while let Ok(Some(setpoint)) = self.servo.receive(now_ns) {
            if let Some(terminals) = &mut self.terminals {
                terminals.note(&setpoint);
            }
            if let Some(probing) = &mut self.probing {
                probing.note(&setpoint);
            }
            self.look_at_state();
        }
        if self.ends && !self.servo.comes_to_rest() {
            self.servo.stop(now_ns);
        }
        let demand = self.servo.demand(meant_ns);
        self.watch_motion(now_ns, demand.as_ref(), tell);
        self.tell_stops(tell);
        let (enable, home) = self.servo.last().map_or((0, 0), |s| (s.enable, s.home));
        self.is_latched &= enable & self.joints != 0;
        self.is_latched |= self.ends && self.rests;
        // Told to the drives in this cycle, before any power is taken.
        self.rests = demand.is_none_or(|joints| joints.iter().all(|joint| joint.velocity == 0.0));
        let are_all_ready = self
            .drives
            .iter()
            .all(|drive| drive.axis.is_ready(&drive.inputs));
        // Who wants them to look for their home is to be there as long as they do.
        if home != 0 && self.is_silent(meant_ns) {
            self.lose_setpoints(tell);
        }
        let home = if self.loss.is_some() { 0 } else { home };
        let looks = self.next_to_home(home);
        let resets = core::mem::take(&mut self.resets);
        let mut latches = false;
        for (drive, output) in self.drives.iter_mut().zip(&mut self.outputs) {
            if let Some(event) = drive.load_side.as_mut().and_then(LoadSide::take_event) {
                tell(event);
            }
            let bit = 1 << drive.axis.settings.joint;
            let drive_inputs = DriveInputs {
                now_ns,
                since_ns: since_ns.max(self.period_ns),
                inputs: drive.inputs,
                is_present: drive.is_present(),
                apart: drive.apart(),
                fault: if drive.has_failed() {
                    drive.inputs.fault
                } else {
                    0
                },
            };
            let homing = drive.axis.settings.homing;
            let drive_command = DriveCommand {
                enable: !self.is_latched && enable & bit != 0,
                home: home & bit != 0,
                may_home: homing.is_none_or(|homing| Some(homing.sequence) <= looks),
                are_all_ready,
                demand: demand.map(|joints| joints[drive.axis.settings.joint.min(AXES - 1)]),
                reset: resets,
            };
            *output = drive
                .axis
                .step(&drive_inputs, &drive_command, &mut |event| {
                    latches |= axis::is_common(&event);
                    tell(event);
                });
        }
        self.lead_probes(tell);
        if latches {
            self.is_latched = true;
            self.drives.iter_mut().for_each(|drive| drive.axis.latch());
        }
    }

    /// Has touch probes keep what is asked for.
    fn lead_probes(&mut self, tell: &mut dyn FnMut(Event)) {
        self.indices.ask(self.servo.last().map_or(0, |s| s.index));
        for (nth, output) in self.outputs.iter_mut().enumerate() {
            let of_probe = self.probing.as_ref().map(|probing| {
                let wanted = if probing.is_on(nth) {
                    ProbeUse::Contact
                } else {
                    ProbeUse::Off
                };
                (wanted, probing.asks(nth))
            });
            let of_index = self.indices.used(nth).map(|wanted| (wanted, true));
            (output.probe, output.asks_probe) = of_index.or(of_probe).unwrap_or_default();
        }
        if let Some(event) = self.probing.as_mut().and_then(Probing::take_event) {
            tell(event);
        }
    }

    /// A fault was taken note of: the drives' own are to be reset, and what was lost is known.
    fn look_at_state(&mut self) {
        let Some(setpoint) = self.servo.last() else {
            return;
        };
        let (before, state) = (self.state, (setpoint.boot_id, setpoint.state));
        let was_faulted = before == Some((state.0, MachineState::Faulted.code()));
        let resets = was_faulted && state.1 != MachineState::Faulted.code();
        self.resets |= resets;
        self.resets_spindle |= resets;
        if resets || before.is_some_and(|(boot_id, _)| boot_id != state.0) {
            self.loss = None;
        }
        self.state = Some(state);
    }

    /// A drive has failed, and nobody brings the others to rest.
    fn watch_motion(
        &mut self,
        now_ns: u64,
        demand: Option<&JointStates>,
        tell: &mut dyn FnMut(Event),
    ) {
        let moves = demand.is_some_and(|joints| joints.iter().any(|joint| joint.velocity != 0.0));
        let has_failed = self.drives.iter().any(Drive::has_failed) || self.has_lost_terminal();
        if !(has_failed && moves && self.servo.is_armed()) {
            self.failed_ns = None;
            return;
        }
        let since_ns = *self.failed_ns.get_or_insert(now_ns);
        if now_ns.saturating_sub(since_ns) > LED_NS {
            self.servo.stop(now_ns);
            tell(Event::NobodyStops);
        }
    }

    fn tell_stops(&mut self, tell: &mut dyn FnMut(Event)) {
        let counts = *self.servo.counts();
        if counts.stops > self.stops_told {
            self.stops_told = counts.stops;
            match self.servo.stopped() {
                Some(OwnStop::Silence) => self.lose_setpoints(tell),
                Some(OwnStop::Jump(jump)) => tell(Event::Jump(jump.joint)),
                Some(OwnStop::Asked) | None => {}
            }
        }
        if counts.restarts > self.restarts_told {
            self.restarts_told = counts.restarts;
            tell(Event::Restart);
        }
    }

    /// The sequence number up to which joints may look for their home: the lowest of those that are
    /// to, and have not found it.
    fn next_to_home(&self, home: u32) -> Option<u32> {
        let asked = self.drives.iter().filter(|drive| {
            home & 1 << drive.axis.settings.joint != 0
                && (!drive.axis.is_homed() || drive.axis.is_homing())
        });
        asked
            .filter_map(|drive| Some(drive.axis.settings.homing?.sequence))
            .min()
    }
}
