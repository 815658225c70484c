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
#[type_name("glidepath.SetpointMirror.v4")]
pub struct SetpointMirror(pub Setpoint);

/// A copy of a [`Status`], byte for byte. Its type name has the version of that record.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.StatusMirror.v13")]
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
}
