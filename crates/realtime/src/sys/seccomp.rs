//! The sentinel against system calls.
//!
//! A BPF program in the kernel looks at every system call of the thread. What is not on the list of
//! the allowed ones raises SIGSYS, whose handler writes the number of the call and ends the
//! process. The filter stays for the life of the thread.

use core::sync::atomic::{AtomicU8, Ordering};
use libc::{c_int, c_long, c_void, siginfo_t, sock_filter, sock_fprog};
use std::io;

/// Exit code of a process the sentinel ended: 128 + SIGSYS, as a shell would say.
pub const SENTINEL_EXIT_CODE: i32 = 128 + libc::SIGSYS;

/// The sentinel could not be put in place.
#[derive(Debug, thiserror::Error)]
#[error("cannot install the system call sentinel: {call}: {source}")]
pub struct SentinelError {
    /// The call that failed.
    pub call: &'static str,
    /// Why.
    pub source: io::Error,
}

const TEXT: &[u8; 43] = b"real-time sentinel: forbidden syscall 0000\n";
const DIGITS_AT: usize = 38;

/// The message of the handler. `write` is allowed from this buffer alone, so a real-time thread
/// that logs is caught as well.
static MESSAGE: [AtomicU8; TEXT.len()] = {
    let mut message = [const { AtomicU8::new(0) }; TEXT.len()];
    let mut i = 0;
    while i < TEXT.len() {
        message[i] = AtomicU8::new(TEXT[i]);
        i += 1;
    }
    message
};

/// The system calls a real-time thread may make.
const ALLOWED: [c_long; 4] = [
    libc::SYS_clock_nanosleep,
    libc::SYS_clock_gettime,
    libc::SYS_exit,
    libc::SYS_exit_group,
];

/// From here on every system call of the calling thread ends the process with
/// [`SENTINEL_EXIT_CODE`] and a message on the standard error, except the sleep and the reading of
/// the clock.
///
/// A diagnostic for tests. The end of a thread itself makes other calls: a thread with a sentinel
/// has to sleep until the process ends, or end the process.
///
/// # Errors
/// The kernel refused the filter or the signal handler.
pub fn forbid_system_calls() -> Result<(), SentinelError> {
    install_handler()?;
    let mut program = filter();
    let fprog = sock_fprog {
        len: u16::try_from(program.len()).unwrap_or(0),
        filter: program.as_mut_ptr(),
    };
    // SAFETY: this option takes plain numbers.
    let result = unsafe { libc::prctl(libc::PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) };
    check("prctl(PR_SET_NO_NEW_PRIVS)", result.into())?;
    // SAFETY: `fprog` and the program it points to outlive the call; the kernel copies both.
    let result = unsafe {
        libc::syscall(
            libc::SYS_seccomp,
            libc::SECCOMP_SET_MODE_FILTER,
            0,
            &raw const fprog,
        )
    };
    check("seccomp(SECCOMP_SET_MODE_FILTER)", result)
}

fn check(call: &'static str, result: c_long) -> Result<(), SentinelError> {
    if result == 0 {
        Ok(())
    } else {
        Err(SentinelError {
            call,
            source: io::Error::last_os_error(),
        })
    }
}

/// Load the number; compare with each allowed one; then, for `write`, compare both halves of the
/// buffer's address with that of [`MESSAGE`].
fn filter() -> Vec<sock_filter> {
    const LOAD: u16 = 0x20; // BPF_LD | BPF_W | BPF_ABS
    const JUMP_IF_EQUAL: u16 = 0x15; // BPF_JMP | BPF_JEQ | BPF_K
    const RETURN: u16 = 0x06; // BPF_RET | BPF_K
    const NUMBER: u32 = 0; // offsets in `seccomp_data`
    const SECOND_ARGUMENT: u32 = 16 + 8;
    let statement = |code, k| sock_filter {
        code,
        jt: 0,
        jf: 0,
        k,
    };
    let unless_equal = |k, skip| sock_filter {
        code: JUMP_IF_EQUAL,
        jt: 0,
        jf: skip,
        k,
    };
    let number = |call: c_long| u32::try_from(call).unwrap_or(u32::MAX);
    let address = MESSAGE.as_ptr().addr() as u64;
    let [low, high] = [address & 0xffff_ffff, address >> 32].map(|half| {
        let bytes = half.to_le_bytes();
        u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
    });
    let (low_at, high_at) = if cfg!(target_endian = "little") {
        (0, 4)
    } else {
        (4, 0)
    };

    let mut program = vec![statement(LOAD, NUMBER)];
    for call in ALLOWED {
        program.push(unless_equal(number(call), 1));
        program.push(statement(RETURN, libc::SECCOMP_RET_ALLOW));
    }
    program.extend([
        unless_equal(number(libc::SYS_write), 5),
        statement(LOAD, SECOND_ARGUMENT + low_at),
        unless_equal(low, 3),
        statement(LOAD, SECOND_ARGUMENT + high_at),
        unless_equal(high, 1),
        statement(RETURN, libc::SECCOMP_RET_ALLOW),
        statement(RETURN, libc::SECCOMP_RET_TRAP),
    ]);
    program
}

fn install_handler() -> Result<(), SentinelError> {
    let handler: extern "C" fn(c_int, *const siginfo_t, *mut c_void) = caught;
    // SAFETY: all-zero bytes are a valid `sigaction`: no flags, an empty mask.
    let mut action: libc::sigaction = unsafe { core::mem::zeroed() };
    action.sa_sigaction = handler as libc::sighandler_t;
    action.sa_flags = libc::SA_SIGINFO;
    // SAFETY: `action` outlives the call; the handler keeps to what a signal handler may do.
    let result = unsafe { libc::sigaction(libc::SIGSYS, &raw const action, core::ptr::null_mut()) };
    check("sigaction(SIGSYS)", result.into())
}

/// How the kernel lays out `siginfo_t` for SIGSYS.
#[repr(C)]
struct SigsysInfo {
    header: [c_int; 4],
    address: *const c_void,
    syscall: c_int,
    arch: u32,
}

extern "C" fn caught(_signal: c_int, info: *const siginfo_t, _context: *mut c_void) {
    // SAFETY: with SA_SIGINFO the kernel passes a valid `siginfo_t`, larger than `SigsysInfo`, and
    // for SIGSYS from seccomp its union holds these fields.
    let mut number = unsafe { (*info.cast::<SigsysInfo>()).syscall };
    for index in (DIGITS_AT..DIGITS_AT + 4).rev() {
        let digit = u8::try_from(number % 10).unwrap_or(0);
        if let Some(byte) = MESSAGE.get(index) {
            byte.store(b'0' + digit, Ordering::Relaxed);
        }
        number /= 10;
    }
    // SAFETY: the buffer is a static of this length.
    unsafe { libc::write(libc::STDERR_FILENO, MESSAGE.as_ptr().cast(), MESSAGE.len()) };
    // SAFETY: ends the process; allowed by the filter and in a signal handler.
    unsafe { libc::_exit(SENTINEL_EXIT_CODE) };
}
