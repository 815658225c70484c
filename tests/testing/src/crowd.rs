//! The crowd: whether others wanted the processors, too.

/// Parts of the time, %, in which something waited for a processor, above which a host is crowded.
const PRESSURE: f64 = 10.0;

/// True if in the last minute more threads wanted to run than there are processors, or in the last ten seconds some had to
/// wait: those under test, which are few and mostly sleep, were not alone. A [`crate::Pulse`] sees what a thread waits that
/// wakes now and then; it does not see what a chain of processes loses that hand things to each other.
#[must_use]
pub fn is_crowded() -> bool {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    // Not every kernel tells it.
    let pressure = std::fs::read_to_string("/proc/pressure/cpu").unwrap_or_default();
    #[expect(clippy::cast_precision_loss, reason = "a count of processors")]
    let processors = processors as f64;
    first(&load).is_some_and(|load| load > processors)
        || last_seconds(&pressure).is_some_and(|part| part > PRESSURE)
}

/// The load of the last minute.
fn first(load: &str) -> Option<f64> {
    load.split_whitespace().next()?.parse().ok()
}

/// The part of the last ten seconds, %, in which some waited: `some avg10=2.04 avg60=0.75 …`.
fn last_seconds(pressure: &str) -> Option<f64> {
    let some = pressure.lines().find(|line| line.starts_with("some "))?;
    let mut words = some.split_whitespace();
    words.find_map(|word| word.strip_prefix("avg10=")?.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_kernel_tells_is_read() {
        assert_eq!(first("2.24 2.13 2.81 3/105 23924\n"), Some(2.24));
        let pressure = "some avg10=12.65 avg60=14.84 avg300=17.77 total=16184068675\n\
                        full avg10=0.00 avg60=0.00 avg300=0.00 total=0\n";
        assert_eq!(last_seconds(pressure), Some(12.65));
        assert_eq!((first(""), last_seconds("")), (None, None));
    }
}
