//! The set-up of a real-time thread.
//!
//! Each [`Item`] is asked for, read back, and reported by itself: granted, not asked for, or
//! refused with the call, the error and what to do about it. Whether a refusal is the end is the
//! caller's choice ([`Mode`]): a machine does not move on a host that cannot keep time, a desk may.

use crate::sys::{sched, stack};
use core::fmt;
use rustix::fs::{Mode as FileMode, OFlags, open};
use rustix::mm::{MlockAllFlags, mlockall};
use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};
use std::io;
use std::os::fd::OwnedFd;

/// The request of a real-time thread to the host.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Request {
    /// `SCHED_FIFO` priority, 1 to 99.
    pub priority: Option<i32>,
    /// The processor to run on, from 0.
    pub cpu: Option<usize>,
    /// Lock the whole process, present and future, into memory. Every later mapping of any thread
    /// is then populated at once.
    pub lock_memory: bool,
    /// Make 256 KiB of the thread's stack resident.
    pub prefault_stack: bool,
    /// Hold `/dev/cpu_dma_latency` at 0, which keeps the processors out of deep idle states.
    pub hold_cpu_awake: bool,
}

/// An item that a [`Request`] may ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Item {
    /// [`Request::priority`].
    Scheduling,
    /// [`Request::cpu`].
    Affinity,
    /// [`Request::lock_memory`].
    MemoryLock,
    /// [`Request::prefault_stack`].
    StackPrefault,
    /// [`Request::hold_cpu_awake`].
    CpuDmaLatency,
}

impl Item {
    /// All items, in the order in which they are asked for.
    pub const ALL: [Self; 5] = [
        Self::MemoryLock,
        Self::StackPrefault,
        Self::Affinity,
        Self::Scheduling,
        Self::CpuDmaLatency,
    ];

    /// What it is called in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Scheduling => "SCHED_FIFO",
            Self::Affinity => "CPU affinity",
            Self::MemoryLock => "memory lock",
            Self::StackPrefault => "stack prefault",
            Self::CpuDmaLatency => "CPU idle latency",
        }
    }
}

/// The reason why an item was not granted, and what to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Refusal {
    /// The item.
    pub item: Item,
    /// The call that failed, or after which the setting read back was another.
    pub call: &'static str,
    /// Its error number; 0 if the call succeeded and the setting read back was another.
    pub errno: i32,
    /// How to mend it.
    pub remedy: &'static str,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: ", self.item.name(), self.call)?;
        if self.errno == 0 {
            write!(f, "reads back otherwise")?;
        } else {
            write!(f, "{}", io::Error::from_raw_os_error(self.errno))?;
        }
        write!(f, "; {}", self.remedy)
    }
}

/// The outcome of one item.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Nobody asked.
    NotRequested,
    /// In force, and read back where it can be.
    Granted,
    /// Not in force.
    Refused(Refusal),
}

/// The outcomes of all items.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grants {
    outcomes: [(Item, Outcome); Item::ALL.len()],
}

impl Grants {
    /// Nothing asked for, nothing granted.
    pub const NONE: Self = Self {
        outcomes: [(Item::Scheduling, Outcome::NotRequested); 5],
    };

    /// Every item and its outcome.
    pub fn outcomes(&self) -> impl Iterator<Item = (Item, Outcome)> + '_ {
        self.outcomes.iter().copied()
    }

    /// True if the item is in force.
    #[must_use]
    pub fn is_granted(&self, item: Item) -> bool {
        self.outcomes.contains(&(item, Outcome::Granted))
    }

    /// What was asked for and refused.
    pub fn refusals(&self) -> impl Iterator<Item = Refusal> + '_ {
        self.outcomes
            .iter()
            .filter_map(|(_, outcome)| match outcome {
                Outcome::Refused(refusal) => Some(*refusal),
                Outcome::NotRequested | Outcome::Granted => None,
            })
    }
}

/// Whether a refusal matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// Any refusal is an error.
    Strict,
    /// Go on with what is granted.
    BestEffort,
}

/// This host or this user does not give what real time needs.
#[derive(Debug, Clone, thiserror::Error)]
#[error("not real-time capable: {}", refusals.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n  "))]
pub struct NotRealTime {
    /// What was refused, one or more.
    pub refusals: Vec<Refusal>,
}

/// The calling thread is set up. Dropping this lets the processors go to sleep deeply again; the
/// rest lasts as long as the thread (the memory lock as long as the process).
#[derive(Debug)]
pub struct Entered {
    /// What was granted.
    pub grants: Grants,
    _cpu_dma_latency: Option<OwnedFd>,
}

/// Sets up the calling thread. Allocates and makes system calls: call it before the first deadline.
///
/// # Errors
/// In [`Mode::Strict`], [`NotRealTime`] with every item that was refused.
pub fn enter(request: &Request, mode: Mode) -> Result<Entered, NotRealTime> {
    let mut cpu_dma_latency = None;
    let outcomes = Item::ALL.map(|item| {
        let result = match item {
            Item::Scheduling => request.priority.map(schedule),
            Item::Affinity => request.cpu.map(pin),
            Item::MemoryLock => request.lock_memory.then(lock_memory),
            Item::StackPrefault => request.prefault_stack.then(|| {
                stack::prefault();
                Ok(())
            }),
            Item::CpuDmaLatency => request.hold_cpu_awake.then(|| {
                cpu_dma_latency = Some(hold_cpu_awake()?);
                Ok(())
            }),
        };
        let outcome = match result {
            None => Outcome::NotRequested,
            Some(Ok(())) => Outcome::Granted,
            Some(Err(Failure { call, errno })) => Outcome::Refused(Refusal {
                item,
                call,
                errno,
                remedy: remedy(item, errno),
            }),
        };
        (item, outcome)
    });
    let grants = Grants { outcomes };
    let refusals: Vec<_> = grants.refusals().collect();
    if mode == Mode::Strict && !refusals.is_empty() {
        return Err(NotRealTime { refusals });
    }
    Ok(Entered {
        grants,
        _cpu_dma_latency: cpu_dma_latency,
    })
}

struct Failure {
    call: &'static str,
    errno: i32,
}

fn failed(call: &'static str) -> impl FnOnce(rustix::io::Errno) -> Failure {
    move |errno| Failure {
        call,
        errno: errno.raw_os_error(),
    }
}

fn schedule(priority: i32) -> Result<(), Failure> {
    let call = "sched_setscheduler(SCHED_FIFO)";
    sched::set_fifo(priority).map_err(|e| Failure {
        call,
        errno: e.raw_os_error().unwrap_or(libc::EIO),
    })?;
    if sched::fifo_priority() == Some(priority) {
        Ok(())
    } else {
        Err(Failure { call, errno: 0 })
    }
}

fn pin(cpu: usize) -> Result<(), Failure> {
    let call = "sched_setaffinity";
    if cpu >= CpuSet::MAX_CPU {
        return Err(Failure {
            call,
            errno: libc::EINVAL,
        });
    }
    let mut wanted = CpuSet::new();
    wanted.set(cpu);
    sched_setaffinity(None, &wanted).map_err(failed(call))?;
    let actual = sched_getaffinity(None).map_err(failed("sched_getaffinity"))?;
    if actual == wanted {
        Ok(())
    } else {
        Err(Failure { call, errno: 0 })
    }
}

fn lock_memory() -> Result<(), Failure> {
    let call = "mlockall(MCL_CURRENT | MCL_FUTURE)";
    mlockall(MlockAllFlags::CURRENT | MlockAllFlags::FUTURE).map_err(failed(call))?;
    let locked = std::fs::read_to_string("/proc/self/status")
        .ok()
        .and_then(|status| crate::host::field_kib(&status, "VmLck:"));
    if locked == Some(0) {
        Err(Failure { call, errno: 0 })
    } else {
        Ok(())
    }
}

fn hold_cpu_awake() -> Result<OwnedFd, Failure> {
    let flags = OFlags::WRONLY | OFlags::CLOEXEC;
    let file = open("/dev/cpu_dma_latency", flags, FileMode::empty())
        .map_err(failed("open(/dev/cpu_dma_latency)"))?;
    rustix::io::write(&file, &0_i32.to_ne_bytes())
        .map_err(failed("write(/dev/cpu_dma_latency)"))?;
    Ok(file)
}

const fn remedy(item: Item, errno: i32) -> &'static str {
    match (item, errno) {
        (Item::Scheduling, libc::EINVAL) => "priority must be 1 to 99",
        (Item::Scheduling, _) => {
            "give the process CAP_SYS_NICE (systemd: AmbientCapabilities=CAP_SYS_NICE) or a real-time \
             limit (LimitRTPRIO=99, or rtprio in /etc/security/limits.conf); if it has that, its cpu \
             control group has no real-time budget: write e.g. 100000 to the group's \
             cpu.rt_runtime_us, or run it in the root group"
        }
        (Item::Affinity, _) => {
            "choose a processor that exists and that the process may use (nproc, taskset -p, and the \
             control group's cpuset.cpus)"
        }
        (Item::MemoryLock, _) => {
            "give the process CAP_IPC_LOCK (systemd: AmbientCapabilities=CAP_IPC_LOCK) or a larger \
             limit (LimitMEMLOCK=infinity, or memlock in /etc/security/limits.conf)"
        }
        (Item::StackPrefault, _) => "give the thread a stack of at least 512 KiB",
        (Item::CpuDmaLatency, libc::ENOENT) => {
            "this kernel has no /dev/cpu_dma_latency: limit idle states on the kernel's command line \
             instead (processor.max_cstate=1), and do not ask for it"
        }
        (Item::CpuDmaLatency, _) => {
            "let the user write /dev/cpu_dma_latency (udev: KERNEL==\"cpu_dma_latency\", \
             GROUP=\"realtime\", MODE=\"0660\")"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Settings of a thread last as long as it: each test uses one of its own.
    fn on_own_thread<T: Send>(f: impl FnOnce() -> T + Send) -> T {
        std::thread::scope(|scope| scope.spawn(f).join().unwrap())
    }

    #[test]
    fn an_impossible_request_names_call_error_and_remedy() {
        let request = Request {
            priority: Some(1_000),
            cpu: Some(1 << 20),
            ..Request::default()
        };
        let error = on_own_thread(|| enter(&request, Mode::Strict).unwrap_err());
        let items: Vec<_> = error.refusals.iter().map(|r| (r.item, r.errno)).collect();
        assert!(items.contains(&(Item::Affinity, libc::EINVAL)));
        assert!(items.iter().any(|(item, _)| *item == Item::Scheduling));
        let text = error.to_string();
        assert!(
            text.contains("sched_setaffinity") && text.contains("cpuset"),
            "{text}"
        );
    }

    #[test]
    fn best_effort_goes_on_and_reports() {
        let request = Request {
            priority: Some(1_000),
            prefault_stack: true,
            ..Request::default()
        };
        let grants = on_own_thread(|| enter(&request, Mode::BestEffort).unwrap().grants);
        assert!(!grants.is_granted(Item::Scheduling));
        assert!(grants.is_granted(Item::StackPrefault));
        assert!(
            grants
                .outcomes()
                .any(|o| o == (Item::MemoryLock, Outcome::NotRequested))
        );
        assert_eq!(grants.refusals().count(), 1);
    }

    #[test]
    fn pinning_reads_back() {
        let allowed = on_own_thread(|| sched_getaffinity(None).unwrap());
        let cpu = (0..CpuSet::MAX_CPU)
            .find(|&cpu| allowed.is_set(cpu))
            .unwrap();
        let request = Request {
            cpu: Some(cpu),
            ..Request::default()
        };
        let pinned = on_own_thread(|| {
            enter(&request, Mode::Strict).unwrap();
            sched_getaffinity(None).unwrap()
        });
        assert!(pinned.is_set(cpu) && pinned.count() == 1);
    }
}
