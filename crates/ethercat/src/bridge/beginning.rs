//! The beginning of a life of the bus: where the drives are then.

use super::{Bridge, WINDOW};
use crate::axis::Axis;
use crate::device_state::DeviceState;
use crate::image::Inputs;
use glidepath_geometry::AXES;
use glidepath_link::{Setpoint, Subscriber};

impl<S: Subscriber<Setpoint>> Bridge<S> {
    /// The bus was brought up, and says this, after what terminals say was heard: the drives count anew, maybe
    /// elsewhere. `boot_id` is a number of this life of the bus.
    pub fn begin(&mut self, boot_id: u64, inputs: &[Inputs]) {
        let is_first = self.boot_id == 0;
        self.boot_id = boot_id;
        (self.number, self.cycles) = (0, 0);
        // Nobody gets power by a setpoint of before.
        (self.is_latched, self.is_bus_lost) = (true, false);
        let (mut actual, mut window) = ([0.0; AXES], [f64::INFINITY; AXES]);
        for (drive, inputs) in self.drives.iter_mut().zip(inputs) {
            let settings = drive.axis.settings;
            drive.axis = Axis::new(settings);
            drive.inputs = *inputs;
            drive.device = DeviceState::in_op();
            drive.told = drive.device;
            let mut place = settings.place(inputs.actual);
            if let Some(load_side) = &mut drive.load_side {
                load_side.begin(&mut drive.axis);
                let terminals = self.terminals.as_ref();
                // What came last.
                let said = terminals.and_then(|it| it.joint_place(settings.joint, u64::MAX));
                place = load_side.sample(said, &mut drive.axis, inputs.actual);
            }
            drive.places = [place; WINDOW];
            if let (Some(actual), Some(window)) = (
                actual.get_mut(settings.joint),
                window.get_mut(settings.joint),
            ) {
                (*actual, *window) = (place, settings.enable_window);
            }
        }
        if let Some(probing) = &mut self.probing {
            probing.begin();
        }
        self.indices.begin();
        if is_first {
            self.servo.rearm_at(&actual, &window);
        }
    }
}
