//! The promises about setpoints and status.

use super::{CAPACITY, Fixture, drain, take};
use bytemuck::Zeroable;
use glidepath_link::{Feedback, JogDemand, LinkError, Setpoint, Status, Transport};

fn setpoint(number: u64) -> Setpoint {
    Setpoint {
        number,
        ..Setpoint::zeroed()
    }
}

fn status(tick: u64) -> Status {
    Status {
        tick,
        ..Status::zeroed()
    }
}

pub(crate) fn setpoints_reach_every_subscriber<F: Fixture>(fixture: &F) {
    let interpolator = fixture.connect();
    let mut sink = interpolator.setpoint_sink().unwrap();
    let ends: Vec<F::Transport> = (0..CAPACITY.subscribers)
        .map(|_| fixture.connect())
        .collect();
    let mut sources: Vec<_> = ends
        .iter()
        .map(|end| end.setpoint_source().unwrap())
        .collect();
    for number in 0..50 {
        sink.publish(&setpoint(number)).unwrap();
        for source in &mut sources {
            assert_eq!(take(&mut **source), setpoint(number));
        }
    }
    assert!(matches!(
        fixture.connect().setpoint_source(),
        Err(LinkError::Taken { .. })
    ));
}

pub(crate) fn setpoints_never_wait_and_loss_is_a_gap<F: Fixture>(fixture: &F) {
    const SENT: u64 = 1000;
    let interpolator = fixture.connect();
    let mut sink = interpolator.setpoint_sink().unwrap();
    sink.publish(&setpoint(0)).unwrap(); // Nobody listens, and that is no error.
    let end = fixture.connect();
    let mut source = end.setpoint_source().unwrap();
    for number in 1..=SENT {
        sink.publish(&setpoint(number)).unwrap();
    }
    let arrived: Vec<u64> = drain(&mut *source)
        .iter()
        .map(|setpoint| setpoint.number)
        .collect();
    let depth = CAPACITY.setpoints as u64;
    assert_eq!(arrived, (SENT - depth + 1..=SENT).collect::<Vec<_>>());
}

pub(crate) fn a_late_subscriber_gets_the_last_setpoint<F: Fixture>(fixture: &F) {
    let interpolator = fixture.connect();
    let mut sink = interpolator.setpoint_sink().unwrap();
    for number in 0..10 {
        sink.publish(&setpoint(number)).unwrap();
    }
    let end = fixture.connect();
    let mut source = end.setpoint_source().unwrap();
    sink.refresh().unwrap();
    sink.refresh().unwrap();
    assert_eq!(take(&mut *source).number, 9);
    assert_eq!(source.take().unwrap(), None);
    sink.publish(&setpoint(10)).unwrap();
    assert_eq!(take(&mut *source).number, 10);
}

pub(crate) fn a_status_is_the_latest<F: Fixture>(fixture: &F) {
    let interpolator = fixture.connect();
    let mut sink = interpolator.status_sink().unwrap();
    let end = fixture.connect();
    let mut source = end.status_source().unwrap();
    for tick in 0..5 {
        sink.publish(&status(tick)).unwrap();
    }
    assert_eq!(take(&mut *source).tick, 4);
    assert_eq!(source.take().unwrap(), None);
    let late = fixture.connect();
    let mut late = late.status_source().unwrap();
    sink.refresh().unwrap();
    assert_eq!(take(&mut *late).tick, 4);
}

pub(crate) fn feedback_of_every_stack_arrives<F: Fixture>(fixture: &F) {
    let interpolator = fixture.connect();
    let mut source = interpolator.feedback_source().unwrap();
    let stacks: Vec<F::Transport> = (0..9).map(|_| fixture.connect()).collect();
    let mut sinks: Vec<_> = stacks.iter().map(|s| s.feedback_sink().unwrap()).collect();
    for number in 0..20 {
        for (joint, sink) in sinks.iter_mut().enumerate() {
            let feedback = Feedback {
                boot_id: joint as u64 + 1,
                number,
                joints: 1 << joint,
                ..Feedback::zeroed()
            };
            sink.publish(&feedback).unwrap();
        }
        let arrived = drain(&mut *source);
        let joints = arrived.iter().fold(0, |all, f| all | f.joints);
        assert_eq!((arrived.len(), joints), (9, 0x1ff));
        assert!(arrived.iter().all(|f| f.number == number));
    }
}

pub(crate) fn demands_of_every_panel_arrive<F: Fixture>(fixture: &F) {
    let interpolator = fixture.connect();
    let mut source = interpolator.jog_source().unwrap();
    let panels = [fixture.connect(), fixture.connect()];
    let mut sinks = panels.each_ref().map(|p| p.jog_sink().unwrap());
    for number in 0..10 {
        for (client, sink) in sinks.iter_mut().enumerate() {
            let demand = JogDemand {
                client: client as u64,
                number,
                ..JogDemand::zeroed()
            };
            sink.publish(&demand).unwrap();
        }
    }
    let arrived = drain(&mut *source);
    for client in 0..2 {
        let newest = arrived
            .iter()
            .filter(|d| d.client == client)
            .map(|d| d.number);
        assert_eq!(newest.max(), Some(9));
    }
}
