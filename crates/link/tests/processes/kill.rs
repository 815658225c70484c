//! Tests of every role, killed at its worst moment, and what the others see.

use crate::instance::{Instance, frame, reply_to, take, wait_for};
use crate::peer::{CAPACITY, Peer};
use bytemuck::Zeroable;
use core::time::Duration;
use glidepath_link::{
    Command, CommandRequest, Delivery, LinkError, Setpoint, Transport, remove_leftovers,
};

#[test]
fn a_consumer_killed_with_a_full_queue_is_noticed_and_replaced() {
    let instance = Instance::new();
    let link = instance.connect();
    let mut sink = link.frame_sink().unwrap();
    let mut consumer = Peer::start("consumer that takes one and stalls", &instance.config);
    let mut next = 0;
    wait_for(|| match sink.offer(&frame(next)).unwrap() {
        Delivery::Delivered => {
            next += 1;
            None
        }
        Delivery::NoConsumer => None,
        Delivery::Full => Some(()),
    });
    assert_eq!(consumer.says(), "0");
    while sink.offer(&frame(next)).unwrap() == Delivery::Delivered {
        next += 1;
    }
    // One taken, the rest waiting.
    assert_eq!(next, 1 + CAPACITY.frames as u64);
    consumer.kill();

    // The producer alone finds out, without ever blocking.
    wait_for(|| (sink.offer(&frame(next)).unwrap() == Delivery::NoConsumer).then_some(()));

    // What was queued died with it: the producer goes back to what was executed.
    let mut consumer = Peer::start("consumer of frames 1 to 100", &instance.config);
    for sequence in 1..=100 {
        wait_for(|| (sink.offer(&frame(sequence)).unwrap() == Delivery::Delivered).then_some(()));
    }
    assert_eq!(consumer.says(), "all");
    consumer.kill();
}

#[test]
fn the_place_of_a_killed_consumer_is_free_at_once() {
    let instance = Instance::new();
    // Joined before the other dies, so that joining has not cleaned up after it.
    let link = instance.connect();
    let mut sink = link.frame_sink().unwrap();
    let mut consumer = Peer::start("consumer that takes one and stalls", &instance.config);
    wait_for(|| (sink.offer(&frame(0)).unwrap() == Delivery::Delivered).then_some(()));
    consumer.says();
    assert!(matches!(link.frame_source(), Err(LinkError::Taken { .. })));
    consumer.kill();
    link.frame_source().unwrap();
}

#[test]
fn frames_of_a_killed_planner_arrive_and_another_takes_over() {
    let instance = Instance::new();
    let link = instance.connect();
    let mut source = link.frame_source().unwrap();
    for _ in 0..2 {
        let mut planner = Peer::start("planner that fills the queue", &instance.config);
        // Receiving is what connects: until then the planner has no consumer.
        let first = take(&mut *source);
        assert_eq!(first.sequence, 0);
        let sent: u64 = planner.says().parse().unwrap();
        planner.kill();
        for sequence in 1..sent {
            assert_eq!(take(&mut *source).sequence, sequence);
        }
        assert_eq!(source.take().unwrap(), None);
        // Another thread of this process may be cleaning up its own instance: then not yet.
        wait_for(|| (link.clean_up_dead_peers().unwrap() == 1).then_some(()));
        assert_eq!(source.take().unwrap(), None);
    }
}

#[test]
fn a_killed_server_is_noticed_by_its_client_and_replaced() {
    let instance = Instance::new();
    let link = instance.connect();
    let mut client = link.command_client().unwrap();
    let request = CommandRequest::new(1, 7, Command::Hold);
    let mut server = Peer::start("command server that never answers", &instance.config);
    assert_eq!(server.says(), "up");
    wait_for(|| client.ask(&request).ok());
    assert_eq!(client.reply().unwrap(), None);
    server.kill();
    let lost = wait_for(|| client.reply().err());
    assert!(matches!(lost, LinkError::NoServer { .. }), "{lost}");

    let mut server = Peer::start("command server", &instance.config);
    assert_eq!(server.says(), "up");
    wait_for(|| client.ask(&request).ok());
    assert_eq!(wait_for(|| client.reply().unwrap()).number, 7);
    server.kill();
}

#[test]
fn killed_clients_do_not_use_up_the_server() {
    let instance = Instance::new();
    let link = instance.connect();
    let mut server = link.command_server().unwrap();
    // More than there are places for clients at a time.
    for _ in 0..20 {
        let mut client = Peer::start("client that asks and never looks", &instance.config);
        assert_eq!(client.says(), "asked");
        client.kill();
        // The request of a client that was killed is served: it looks like one that is only slow.
        while server.serve(&mut reply_to).unwrap() {}
    }
    link.clean_up_dead_peers().unwrap();
    let mut client = link.command_client().unwrap();
    wait_for(|| client.ask(&CommandRequest::new(2, 5, Command::Ping)).ok());
    wait_for(|| server.serve(&mut reply_to).unwrap().then_some(()));
    assert_eq!(wait_for(|| client.reply().unwrap()).number, 5);
}

#[test]
fn killed_subscribers_never_stop_the_publisher() {
    let instance = Instance::new();
    let link = instance.connect();
    let mut sink = link.setpoint_sink().unwrap();
    let mut number = 0;
    // More than there are places for subscribers at a time.
    for _ in 0..2 * CAPACITY.subscribers {
        let mut subscriber = Peer::start("setpoint subscriber", &instance.config);
        assert_eq!(subscriber.says(), "up");
        sink.publish(&Setpoint {
            number,
            ..Setpoint::zeroed()
        })
        .unwrap();
        assert_eq!(subscriber.says(), "got one");
        subscriber.kill();
        for _ in 0..100 {
            number += 1;
            sink.publish(&Setpoint {
                number,
                ..Setpoint::zeroed()
            })
            .unwrap();
        }
    }
}

#[test]
fn a_killed_publisher_is_replaced_under_its_subscriber() {
    let instance = Instance::new();
    let link = instance.connect();
    let mut source = link.setpoint_source().unwrap();
    let mut lives = Vec::new();
    for _ in 0..3 {
        let mut publisher = Peer::start("setpoint publisher", &instance.config);
        let boot_id: u64 = publisher.says().parse().unwrap();
        let first = wait_for(|| {
            let setpoint = source.take().unwrap();
            setpoint.filter(|setpoint| setpoint.boot_id == boot_id)
        });
        // In order from there on, whatever was lost in between.
        let mut last = first.number;
        for _ in 0..20 {
            let setpoint = take(&mut *source);
            assert_eq!(setpoint.boot_id, boot_id);
            assert!(setpoint.number > last);
            last = setpoint.number;
        }
        lives.push(boot_id);
        publisher.kill();
    }
    lives.dedup();
    assert_eq!(lives.len(), 3);
}

#[test]
fn leftovers_of_killed_processes_are_removed_when_none_lives() {
    let instance = Instance::new();
    let mut publisher = Peer::start("setpoint publisher", &instance.config);
    let mut server = Peer::start("command server", &instance.config);
    publisher.says();
    server.says();
    publisher.kill();
    assert!(!instance.files().is_empty());
    assert!(
        !remove_leftovers(&instance.config).unwrap(),
        "the server lives"
    );
    // And it still serves.
    let link = instance.connect();
    let mut client = link.command_client().unwrap();
    let reply = client.call(
        &CommandRequest::new(1, 3, Command::Ping),
        Duration::from_secs(60),
    );
    assert_eq!(reply.unwrap().unwrap().number, 3);
    drop((client, link));
    server.kill();
    assert!(!instance.files().is_empty());
    assert!(remove_leftovers(&instance.config).unwrap());
    assert_eq!(instance.files(), Vec::<std::path::PathBuf>::new());
    // Nothing there is nothing to fear.
    assert!(remove_leftovers(&instance.config).unwrap());
}
