//! The promises about commands and segments.

use super::{Fixture, wait_for};
use bytemuck::Zeroable;
use glidepath_link::{
    Command, CommandReply, CommandRequest, LinkError, MAX_UNANSWERED, MachineState, SegmentReply,
    SegmentRequest, StreamItem, Transport,
};

fn reply_to(request: &CommandRequest) -> CommandReply {
    CommandReply::new(7, request.number, Ok(()), MachineState::Idle, "")
}

pub(crate) fn commands_are_answered_in_order<F: Fixture>(fixture: &F) {
    let interpolator = fixture.connect();
    let mut server = interpolator.command_server().unwrap();
    let ends = [fixture.connect(), fixture.connect()];
    let mut clients: Vec<_> = ends
        .iter()
        .map(|end| end.command_client().unwrap())
        .collect();
    let mut served = Vec::new();
    for (who, client) in clients.iter_mut().enumerate() {
        for number in 0..3 {
            let command = Command::FeedOverride(0.5 + number as f64 / 4.0);
            client
                .ask(&CommandRequest::new(who as u64, number, command))
                .unwrap();
        }
    }
    while served.len() < 6 {
        wait_for(|| {
            let mut answer = |request: &CommandRequest| {
                served.push(*request);
                reply_to(request)
            };
            server.serve(&mut answer).unwrap().then_some(())
        });
    }
    assert!(!server.serve(&mut reply_to).unwrap());
    for (who, client) in clients.iter_mut().enumerate() {
        let of_client: Vec<_> = served.iter().filter(|r| r.client == who as u64).collect();
        assert_eq!(of_client.len(), 3);
        for (number, request) in of_client.iter().enumerate() {
            assert_eq!(request.number, number as u64);
            let command = request.command().unwrap();
            assert_eq!(command, Command::FeedOverride(0.5 + number as f64 / 4.0));
            let reply = wait_for(|| client.reply().unwrap());
            assert_eq!(reply.number, number as u64);
            assert_eq!(reply.outcome().unwrap(), Ok(()));
        }
        assert_eq!(client.reply().unwrap(), None);
    }
}

pub(crate) fn a_command_without_a_server_is_an_error<F: Fixture>(fixture: &F) {
    let end = fixture.connect();
    let mut client = end.command_client().unwrap();
    let request = CommandRequest::new(1, 0, Command::Ping);
    assert!(matches!(
        client.ask(&request),
        Err(LinkError::NoServer { .. })
    ));
    let interpolator = fixture.connect();
    let server = interpolator.command_server().unwrap();
    wait_for(|| client.ask(&request).ok());
    drop(server);
    drop(interpolator);
    // The one that was asked has gone, unanswered; then there is nobody to ask.
    let lost = wait_for(|| client.reply().err());
    assert!(matches!(lost, LinkError::NoServer { .. }));
    assert!(matches!(
        client.ask(&request),
        Err(LinkError::NoServer { .. })
    ));
    // And one that comes back is found.
    let interpolator = fixture.connect();
    let mut server = interpolator.command_server().unwrap();
    wait_for(|| client.ask(&request).ok());
    wait_for(|| server.serve(&mut reply_to).unwrap().then_some(()));
    assert_eq!(wait_for(|| client.reply().unwrap()).number, 0);
}

pub(crate) fn unanswered_requests_are_bounded_and_none_is_overwritten<F: Fixture>(fixture: &F) {
    let interpolator = fixture.connect();
    let mut server = interpolator.command_server().unwrap();
    let end = fixture.connect();
    let mut client = end.command_client().unwrap();
    for number in 0..MAX_UNANSWERED as u64 {
        client
            .ask(&CommandRequest::new(1, number, Command::Hold))
            .unwrap();
    }
    let extra = CommandRequest::new(1, 99, Command::Abort);
    assert!(matches!(
        client.ask(&extra),
        Err(LinkError::TooManyRequests { .. })
    ));
    let mut numbers = Vec::new();
    while numbers.len() < MAX_UNANSWERED {
        wait_for(|| {
            let mut answer = |request: &CommandRequest| {
                numbers.push(request.number);
                reply_to(request)
            };
            server.serve(&mut answer).unwrap().then_some(())
        });
    }
    assert_eq!(numbers, (0..MAX_UNANSWERED as u64).collect::<Vec<_>>());
    for number in 0..MAX_UNANSWERED as u64 {
        assert_eq!(wait_for(|| client.reply().unwrap()).number, number);
    }
    client.ask(&extra).unwrap();
}

pub(crate) fn a_client_that_went_away_does_not_disturb_the_server<F: Fixture>(fixture: &F) {
    let interpolator = fixture.connect();
    let mut server = interpolator.command_server().unwrap();
    let end = fixture.connect();
    let mut client = end.command_client().unwrap();
    client
        .ask(&CommandRequest::new(1, 0, Command::Ping))
        .unwrap();
    drop(client);
    drop(end);
    while server.serve(&mut reply_to).unwrap() {}
    let end = fixture.connect();
    let mut client = end.command_client().unwrap();
    client
        .ask(&CommandRequest::new(2, 5, Command::Ping))
        .unwrap();
    wait_for(|| server.serve(&mut reply_to).unwrap().then_some(()));
    assert_eq!(wait_for(|| client.reply().unwrap()).number, 5);
}

pub(crate) fn segments_are_acknowledged_one_by_one<F: Fixture>(fixture: &F) {
    let planner = fixture.connect();
    let mut server = planner.segment_server().unwrap();
    assert!(matches!(
        fixture.connect().segment_server(),
        Err(LinkError::Taken { .. })
    ));
    let end = fixture.connect();
    let mut client = end.segment_client().unwrap();
    let mut accept = |request: &SegmentRequest| SegmentReply {
        session: request.session,
        number: request.number,
        accepted: request.number + 1,
        credit: 3,
        ..SegmentReply::zeroed()
    };
    for number in 0..20 {
        let item = if number == 0 {
            StreamItem::Open { asked_ns: 5 }
        } else {
            StreamItem::End
        };
        client.ask(&SegmentRequest::new(42, number, &item)).unwrap();
        wait_for(|| server.serve(&mut accept).unwrap().then_some(()));
        let reply = wait_for(|| client.reply().unwrap());
        assert_eq!(
            (reply.session, reply.accepted, reply.credit),
            (42, number + 1, 3)
        );
        assert_eq!(reply.outcome().unwrap(), Ok(()));
    }
}
