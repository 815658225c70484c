//! The crowd: whether others wanted the processors, too.

/// True if in the last minute more threads wanted to run than there are processors: those under test, which are
/// few and mostly sleep, were not alone. A [`crate::Pulse`] sees what a thread waits that wakes now and then; it
/// does not see what a chain of processes loses that hand things to each other.
#[must_use]
pub fn is_crowded() -> bool {
    let text = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load = text
        .split_whitespace()
        .next()
        .and_then(|load| load.parse::<f64>().ok());
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    #[expect(clippy::cast_precision_loss, reason = "a count of processors")]
    load.is_some_and(|load| load > processors as f64)
}
