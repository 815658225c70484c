//! The causes that stop spindle and coolant together with the motion: which there are, and which the machine is configured
//! for.

/// The causes that stop spindle and coolant together with the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StopSettings {
    /// An abort.
    pub abort: bool,
    /// A fault.
    pub fault: bool,
    /// The loss of the drives' power, asked for or not.
    pub disable: bool,
}

impl StopSettings {
    pub(crate) const fn is_by(self, cause: StopCause) -> bool {
        match cause {
            StopCause::Abort => self.abort,
            StopCause::Fault => self.fault,
            StopCause::Disable => self.disable,
            StopCause::Loss => true,
        }
    }
}

impl Default for StopSettings {
    /// All of them.
    fn default() -> Self {
        Self {
            abort: true,
            fault: true,
            disable: true,
        }
    }
}

/// Why things are to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StopCause {
    Abort,
    Fault,
    Disable,
    /// A servo stack has lost something, and has stopped them itself: what is told and latched is to say
    /// so, whatever the configuration leaves on.
    Loss,
}
