//! The paired devices as the server needs them: who keeps them, and how one is paired, is its user's business.

use crate::response::Response;
use crate::role::Role;
use crate::sha256::Sha256;
use core::fmt::Debug;

/// What a paired device may at most: operating is for the panel of the host.
pub(crate) const MOST: Role = Role::Hold;

/// The devices that are paired. Asked from several threads.
pub trait Devices: Debug + Send + Sync {
    /// What the device may whose token has this hash; `None` if it is not paired, or not any more.
    fn role(&self, token: &Sha256) -> Option<Role>;
    /// A device has asked for something.
    fn seen(&self, token: &Sha256);
    /// Answers a device that sends a code to be paired.
    fn pair(&self, body: &[u8]) -> Response;
}
