//! The time that the processors spent, and on what, as the kernel counts it in `/proc/stat`.
//!
//! Of interest is *steal*: the time a virtual processor was ready to run and the hypervisor ran
//! something else. No program can be on time then, however well it is written, so a measurement
//! that means to judge a program has to know.

use crate::Host;

/// `USER_HZ`, in which Linux tells times to programs on every architecture still in use.
const TICKS_PER_S: f64 = 100.0;

/// Time spent by one processor or by all, in clock ticks of 10 ms, since the start of the host.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ProcessorTime {
    /// Everything, the idle time too.
    pub total: u64,
    /// Taken away by the hypervisor.
    pub steal: u64,
}

impl ProcessorTime {
    /// The time of a processor, or of all together for `None`. `None` if the host does not tell.
    #[must_use]
    pub fn read(host: &Host, cpu: Option<usize>) -> Option<Self> {
        Self::parse(&host.text("proc/stat")?, cpu)
    }

    /// [`steal`](Self::steal) in seconds.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "exact below 2⁵³ ticks")]
    pub const fn steal_s(&self) -> f64 {
        self.steal as f64 / TICKS_PER_S
    }

    /// From the text of `/proc/stat`: `cpu1 user nice system idle iowait irq softirq steal …`; the
    /// two columns that may follow are part of `user` and `nice`.
    fn parse(stat: &str, cpu: Option<usize>) -> Option<Self> {
        const STEAL: usize = 7;
        let name = cpu.map_or_else(|| "cpu".to_owned(), |cpu| format!("cpu{cpu}"));
        let columns: Vec<u64> = stat
            .lines()
            .find_map(|line| line.strip_prefix(&name)?.strip_prefix(' '))?
            .split_whitespace()
            .take(STEAL + 1)
            .map(str::parse)
            .collect::<Result<_, _>>()
            .ok()?;
        Some(Self {
            total: columns.iter().sum(),
            steal: *columns.get(STEAL)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STAT: &str = "cpu  30 2 10 200 5 0 3 7 1 1\n\
                        cpu1 15 1 5 100 2 0 1 4 0 0\n\
                        cpu10 15 1 5 100 3 0 2 3 0 0\nctxt 9\n";

    #[test]
    fn steal_is_the_eighth_column() {
        let of = |cpu| ProcessorTime::parse(STAT, cpu).map(|t| (t.total, t.steal));
        assert_eq!(of(None), Some((257, 7)));
        assert_eq!(of(Some(1)), Some((128, 4)));
        assert_eq!(of(Some(10)), Some((129, 3)));
        assert_eq!(of(Some(2)), None);
    }

    #[test]
    fn nonsense_is_no_time() {
        assert_eq!(ProcessorTime::parse("", None), None);
        assert_eq!(ProcessorTime::parse("cpu  1 2 3\n", None), None);
        assert_eq!(ProcessorTime::parse("cpu  1 2 3 x 5 6 7 8\n", None), None);
    }
}
