//! Linux real time: deadline timer, scheduling, memory lock, histogram.
