//! The proof that nothing allocates after creation.

use glidepath_realtime::{
    Clock, CountingAllocator, DeadlineTimer, Events, Histogram, Monotonic, event_ring,
};

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

#[test]
fn the_counter_counts() {
    let before = CountingAllocator::calls_of_this_thread();
    drop(std::hint::black_box(Box::new([0_u8; 100])));
    assert_eq!(CountingAllocator::calls_of_this_thread() - before, 2);
}

#[test]
fn timer_histogram_and_events_do_not_allocate() {
    let mut timer = DeadlineTimer::new(Monotonic, Monotonic.now_ns(), 100_000);
    let mut histogram = Histogram::new();
    let mut events = Events::<u64, 8>::default();
    let (mut writer, mut reader) = event_ring(&mut events);
    let before = CountingAllocator::calls_of_this_thread();
    for _ in 0..100 {
        let wake = timer.wait();
        histogram.record(wake.lateness_ns());
        histogram.record(u64::MAX);
        writer.write(wake.tick);
        reader.read();
    }
    let quantiles = histogram.quantiles();
    assert_eq!(CountingAllocator::calls_of_this_thread(), before);
    assert_eq!(quantiles.count, 200);
}
