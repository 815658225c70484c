//! Setpoints through a pipe, from the servo process to this one: as they are in memory, one after
//! the other. Both ends are the same program.

use glidepath_link::{LinkError, Setpoint, Subscriber};
use std::io::{ErrorKind, Read};

/// The receiving end.
#[derive(Debug)]
pub(super) struct Pipe<R>(pub(super) R);

impl<R: Read> Subscriber<Setpoint> for Pipe<R> {
    /// The next setpoint; `None` at the end, also where a writer that died left part of one.
    fn take(&mut self) -> Result<Option<Setpoint>, LinkError> {
        let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
        match self.0.read_exact(bytemuck::bytes_of_mut(&mut setpoint)) {
            Ok(()) => Ok(Some(setpoint)),
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => Ok(None),
            Err(error) => Err(LinkError::Transport {
                service: "servo",
                action: "reading what it received",
                detail: error.into(),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn setpoints_come_through_to_the_bit_and_parts_of_one_do_not() {
        let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
        (setpoint.number, setpoint.position[2]) = (7, -0.1);
        let mut bytes = bytemuck::bytes_of(&setpoint).to_vec();
        bytes.extend_from_within(..100);
        let mut pipe = Pipe(bytes.as_slice());
        assert_eq!(pipe.take().unwrap(), Some(setpoint));
        assert!(pipe.take().unwrap().is_none());
    }
}
