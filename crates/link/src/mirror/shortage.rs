//! The notes of a mirror at work: setpoints that never came, and memory that its readers would need.

use super::error::MirrorError;
use super::gap::Gap;

/// What a mirror at work tells.
#[derive(Debug)]
pub enum MirrorNote {
    /// Setpoints never came.
    Lost(Gap),
    /// There is no room for the memory of readers that came. The mirror goes on and tries again; until it has it, whoever
    /// writes there first may end by SIGBUS.
    Short(MirrorError),
    /// There is room again.
    Ample,
}

/// A shortage of memory, which is told once, and its end.
#[derive(Debug, Default)]
pub(super) struct Shortage {
    is_told: bool,
}

impl Shortage {
    /// The note to tell of a try to take the memory, if it is another than before.
    pub(super) fn next(&mut self, taken: Result<(), MirrorError>) -> Option<MirrorNote> {
        let was_told = core::mem::replace(&mut self.is_told, taken.is_err());
        match taken {
            Err(error) if !was_told => Some(MirrorNote::Short(error)),
            Ok(()) if was_told => Some(MirrorNote::Ample),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shortage_is_told_once_and_so_is_its_end() {
        let full = || {
            Err(MirrorError::Memory {
                path: "/dev/shm/iox2_a".into(),
                bytes: 4096,
                source: std::io::Error::from(std::io::ErrorKind::StorageFull),
            })
        };
        let mut shortage = Shortage::default();
        let mut told = Vec::new();
        for taken in [Ok(()), full(), full(), Ok(()), Ok(()), full()] {
            told.push(match shortage.next(taken) {
                None => "",
                Some(MirrorNote::Short(_)) => "short",
                Some(MirrorNote::Ample) => "ample",
                Some(MirrorNote::Lost(_)) => "lost",
            });
        }
        assert_eq!(told, ["", "short", "", "ample", "", "short"]);
    }
}
