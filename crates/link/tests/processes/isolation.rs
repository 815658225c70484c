//! Tests of isolation: instances do not meet, other versions and other users' directories are
//! refused.

use crate::instance::{Instance, frame, take, wait_for};
use glidepath_link::{Delivery, Ipc, LinkConfig, LinkError, Transport, remove_leftovers};
use std::os::unix::fs::PermissionsExt;

#[test]
fn an_instance_that_comes_and_goes_is_always_there_when_wanted() {
    let instance = Instance::new();
    std::thread::scope(|scope| {
        for thread in 0..crate::peer::CAPACITY.subscribers {
            let config = &instance.config;
            scope.spawn(move || {
                for round in 0..30 {
                    let link = Ipc::connect(config).unwrap();
                    let _status = link.status_source().unwrap();
                    drop(link);
                    if (round + thread) % 5 == 0 {
                        remove_leftovers(config).unwrap();
                    }
                }
            });
        }
    });
}

#[test]
fn another_capacity_is_a_clear_error() {
    let instance = Instance::new();
    let link = instance.connect();
    let _source = link.frame_source().unwrap();
    let mut config = instance.config.clone();
    config.capacity.frames *= 2;
    let error = Ipc::connect(&config).unwrap().frame_sink().err().unwrap();
    assert!(
        matches!(error, LinkError::VersionMismatch { .. }),
        "{error}"
    );
}

#[test]
fn instances_do_not_meet() {
    let one = Instance::new();
    // Another name under the same root, and the same name under another root.
    let another_name = LinkConfig {
        instance: "another".to_owned(),
        ..one.config.clone()
    };
    let another_root = Instance::new();
    let ends = [Ipc::connect(&another_name).unwrap(), another_root.connect()];
    let mut strangers: Vec<_> = ends.iter().map(|end| end.frame_source().unwrap()).collect();
    let link = one.connect();
    let mut sink = link.frame_sink().unwrap();
    for stranger in &mut strangers {
        assert_eq!(stranger.take().unwrap(), None);
        assert_eq!(sink.offer(&frame(0)).unwrap(), Delivery::NoConsumer);
        assert_eq!(stranger.take().unwrap(), None);
    }
    let mut own = link.frame_source().unwrap();
    wait_for(|| {
        let delivered = sink.offer(&frame(3)).unwrap() == Delivery::Delivered;
        let _ = own.take().unwrap();
        delivered.then_some(())
    });
    assert_eq!(sink.offer(&frame(4)).unwrap(), Delivery::Delivered);
    assert_eq!(take(&mut *own).sequence, 4);
    for stranger in &mut strangers {
        assert_eq!(stranger.take().unwrap(), None);
    }
}

#[test]
fn names_that_are_no_file_names_are_refused() {
    let instance = Instance::new();
    for name in ["", "a/b", "..", "a b", "ä", &"x".repeat(33)] {
        let config = LinkConfig {
            instance: name.to_owned(),
            ..instance.config.clone()
        };
        let error = Ipc::connect(&config).unwrap_err();
        assert!(matches!(error, LinkError::Name { .. }), "{name}: {error}");
    }
}

#[test]
fn a_directory_that_others_can_enter_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::set_permissions(directory.path(), PermissionsExt::from_mode(0o755)).unwrap();
    let root = directory.path().to_owned();
    let config = LinkConfig {
        root,
        ..LinkConfig::new("default")
    };
    let error = Ipc::connect(&config).unwrap_err();
    assert!(matches!(error, LinkError::Root { .. }), "{error}");
    assert!(error.to_string().contains("0700"), "{error}");
}

#[test]
fn files_are_private_to_the_user() {
    let instance = Instance::new();
    let _link = instance.connect();
    for path in [&instance.config.root, &instance.config.directory()] {
        assert_eq!(
            path.metadata().unwrap().permissions().mode() & 0o777,
            0o700,
            "{path:?}"
        );
    }
}
