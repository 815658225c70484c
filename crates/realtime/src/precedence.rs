//! The precedence of a thread that plans over those that need not be in time.

use std::io;

/// The nice value of a thread that plans. The scheduler gives it 29 times the share of an ordinary one, so that 16 busy
/// processes on a core leave it two thirds of that core. It is no real-time class on purpose: a plan that takes
/// long must not stop the host, and whatever has to answer within a period is in such a class itself.
pub const PLANNING_NICE: i32 = -15;

/// Gives the calling thread, and those that it starts from now on, precedence over ordinary ones: a motion has to be
/// planned before its period comes, whatever else the host does.
///
/// # Errors
/// The process may not (`CAP_SYS_NICE`, or a limit of `nice` of -15 or less). The thread stays as it is.
pub fn take_precedence() -> io::Result<()> {
    let now = rustix::process::getpriority_process(None)?;
    if now > PLANNING_NICE {
        rustix::process::setpriority_process(None, PLANNING_NICE)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thread_takes_it_for_those_it_starts_or_stays_as_it_is() {
        let nice = || rustix::process::getpriority_process(None).unwrap();
        let before = nice();
        std::thread::spawn(move || {
            let expected = match take_precedence() {
                Ok(()) => before.min(PLANNING_NICE),
                Err(_) => before,
            };
            assert_eq!(nice(), expected);
            assert_eq!(std::thread::spawn(nice).join().unwrap(), expected);
        })
        .join()
        .unwrap();
        assert_eq!(nice(), before);
    }
}
