//! The records of the mirror: those of the machine, under names of their own.
#![allow(
    unsafe_code,
    reason = "the derives of `Pod` and `ZeroCopySend` expand to `unsafe impl`; both check the fields"
)]

use crate::{Setpoint, Status};
use iceoryx2::prelude::ZeroCopySend;

/// A copy of a [`Setpoint`], byte for byte. Its type name has the version of that record.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.SetpointMirror.v6")]
pub struct SetpointMirror(pub Setpoint);

/// A copy of a [`Status`], byte for byte. Its type name has the version of that record.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.StatusMirror.v16")]
pub struct StatusMirror(pub Status);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Record as _;

    /// What reads another version must not connect.
    #[test]
    fn a_copy_has_the_version_and_the_size_of_its_record() {
        // SAFETY: it only names a type.
        let setpoint = unsafe { SetpointMirror::type_name() };
        // SAFETY: likewise.
        let status = unsafe { StatusMirror::type_name() };
        assert_eq!(
            setpoint,
            Setpoint::NAME.replace("Setpoint", "SetpointMirror")
        );
        assert_eq!(status, Status::NAME.replace("Status", "StatusMirror"));
        assert_eq!(size_of::<SetpointMirror>(), size_of::<Setpoint>());
        assert_eq!(size_of::<StatusMirror>(), size_of::<Status>());
    }

    /// Readers take the names from the manual and from the examples.
    #[test]
    fn the_manual_and_the_examples_have_the_versions_of_today() {
        const MANUAL: &str = include_str!("../../../glidepath/docs/consumers.md");
        const EXAMPLES: [&str; 3] = [
            include_str!("../../examples/onlooker.rs"),
            include_str!("../../examples/onlooker.py"),
            include_str!("../../examples/onlooker.c"),
        ];
        // SAFETY: it only names a type.
        let setpoint = unsafe { SetpointMirror::type_name() };
        // SAFETY: likewise.
        let status = unsafe { StatusMirror::type_name() };
        let row = |name: &str| {
            let mut rows = MANUAL.lines();
            rows.find(|row| row.contains(&format!("| `{name}` |")))
        };
        assert!(row(status).is_some(), "consumers.md has no {status}");
        let of_setpoints = row(setpoint).expect("a row of consumers.md for setpoints");
        let size = size_of::<Setpoint>();
        assert!(
            of_setpoints.contains(&format!("{size} bytes")),
            "{of_setpoints}"
        );
        for example in EXAMPLES {
            assert!(example.contains(&format!("\"{setpoint}\"")), "{example}");
        }
    }
}
