//! The scheduling class of the calling thread.

use std::io;

/// Puts the calling thread into `SCHED_FIFO` with a priority.
pub(crate) fn set_fifo(priority: i32) -> io::Result<()> {
    let param = libc::sched_param {
        sched_priority: priority,
    };
    // SAFETY: 0 names the calling thread; `param` outlives the call, which only reads it.
    let result = unsafe { libc::sched_setscheduler(0, libc::SCHED_FIFO, &raw const param) };
    if result == 0 {
        Ok(())
    } else {
        Err(io::Error::last_os_error())
    }
}

/// Priority of the calling thread if its class is `SCHED_FIFO`.
pub(crate) fn fifo_priority() -> Option<i32> {
    // SAFETY: no memory is involved; 0 names the calling thread.
    let class = unsafe { libc::sched_getscheduler(0) };
    if class & !libc::SCHED_RESET_ON_FORK != libc::SCHED_FIFO {
        return None;
    }
    let mut param = libc::sched_param { sched_priority: 0 };
    // SAFETY: `param` is valid for the write the call makes.
    let result = unsafe { libc::sched_getparam(0, &raw mut param) };
    (result == 0).then_some(param.sched_priority)
}
