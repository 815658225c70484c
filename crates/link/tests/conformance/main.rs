//! Tests of both transports by one suite: what it promises holds for each.
#![allow(
    clippy::unwrap_used,
    clippy::cast_precision_loss,
    reason = "a test that cannot go on fails; small counts are exact"
)]

mod suite;

use glidepath_link::{InProcess, Ipc, LinkConfig};

struct WithinProcess(InProcess);

impl suite::Fixture for WithinProcess {
    type Transport = InProcess;

    fn connect(&self) -> InProcess {
        self.0.clone()
    }
}

/// An instance of its own, in a directory of its own.
struct BetweenProcesses {
    config: LinkConfig,
    _root: tempfile::TempDir,
}

impl BetweenProcesses {
    fn new() -> Self {
        let root = tempfile::tempdir_in("/dev/shm").unwrap();
        let config = LinkConfig {
            instance: "conformance".to_owned(),
            root: root.path().join("link"),
            capacity: suite::CAPACITY,
        };
        Self {
            config,
            _root: root,
        }
    }
}

impl suite::Fixture for BetweenProcesses {
    type Transport = Ipc;

    fn connect(&self) -> Ipc {
        Ipc::connect(&self.config).unwrap()
    }
}

impl Drop for BetweenProcesses {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let left = suite::files_of(&self.config);
            assert!(left.is_empty(), "left behind: {left:?}");
        }
    }
}

/// The whole suite over one transport: a module of tests, each on an instance of its own.
macro_rules! conformance {
    ($transport:ident, $fixture:expr, { $($promise:ident),+ $(,)? }) => {
        mod $transport {
            use super::*;
            $(#[test]
            fn $promise() {
                suite::$promise(&$fixture);
            })+
        }
    };
    ($transport:ident, $fixture:expr) => {
        conformance!($transport, $fixture, {
            frames_arrive_in_order_without_gaps,
            a_full_queue_is_reported_and_loses_nothing,
            waiting_for_room_ends_by_time_and_by_the_stop_flag,
            a_frame_counts_as_delivered_only_with_a_consumer,
            a_consumer_that_went_away_is_reported_and_may_come_back,
            frames_of_a_planner_that_went_away_still_arrive,
            there_is_one_consumer_of_frames,
            there_are_two_publishers_of_setpoints_at_most,
            there_is_one_planner,
            setpoints_reach_every_subscriber,
            setpoints_never_wait_and_loss_is_a_gap,
            a_late_subscriber_gets_the_last_setpoint,
            a_status_is_the_latest,
            feedback_of_every_stack_arrives,
            demands_of_every_panel_arrive,
            commands_are_answered_in_order,
            a_command_without_a_server_is_an_error,
            unanswered_requests_are_bounded_and_none_is_overwritten,
            a_client_that_went_away_does_not_disturb_the_server,
            segments_are_acknowledged_one_by_one,
        });
    };
}

conformance!(in_process, WithinProcess(InProcess::new(suite::CAPACITY)));
conformance!(ipc, BetweenProcesses::new());
