//! The report of `jitter`.

use super::bins::{Bin, COARSE, FINE, rebin};
use super::cyclictest::Latencies;
use super::measure::Measurement;
use super::setup::Setup;
use crate::plot::{LatenessSeries, lateness};
use crate::report::grouped;
use core::fmt::Write as _;
use glidepath_realtime::{Grants, Histogram, Item, Outcome, Quantiles};
use serde_json::{Map, Value, json};

/// Width of the longest bar on a terminal.
const BAR: f64 = 40.0;

/// A measurement, ready to be shown.
#[derive(Debug)]
pub struct JitterReport<'a> {
    setup: &'a Setup,
    measured: &'a Measurement,
}

#[allow(clippy::cast_precision_loss, reason = "for display")]
fn us(ns: u64) -> f64 {
    ns as f64 / 1e3
}

fn times(histogram: &Histogram) -> impl Iterator<Item = (f64, u64)> + '_ {
    histogram.buckets().map(|(ns, count)| (us(ns), count))
}

#[allow(clippy::cast_precision_loss, reason = "for display")]
fn cyclictest_times(latencies: &Latencies) -> impl Iterator<Item = (f64, u64)> + '_ {
    let beyond = (latencies.overflows > 0).then_some((latencies.max_us, latencies.overflows));
    latencies
        .counts
        .iter()
        .copied()
        .chain(beyond)
        .map(|(us, count)| (us as f64, count))
}

/// p50, p99, p99.9 and max in µs.
#[derive(Debug, Clone, Copy)]
struct QuantileRow([f64; 4]);

impl QuantileRow {
    const NAMES: [&'static str; 4] = ["p50", "p99", "p999", "max"];

    fn of(q: &Quantiles) -> Self {
        Self([q.p50_ns, q.p99_ns, q.p999_ns, q.max_ns].map(us))
    }

    #[allow(clippy::cast_precision_loss, reason = "for display")]
    fn of_cyclictest(latencies: &Latencies) -> Self {
        let at = |part| latencies.quantile_us(part) as f64;
        Self([at(0.5), at(0.99), at(0.999), latencies.max_us as f64])
    }

    fn minus(self, other: Self) -> Self {
        let mut row = self;
        for (value, subtrahend) in row.0.iter_mut().zip(other.0) {
            *value -= subtrahend;
        }
        row
    }

    fn object(self) -> Value {
        let pairs = Self::NAMES.iter().zip(self.0);
        Value::Object(pairs.map(|(k, v)| ((*k).to_owned(), v.into())).collect())
    }

    fn text(self) -> String {
        self.0.iter().fold(String::new(), |mut text, value| {
            let _ = write!(text, "{value:10.1}");
            text
        })
    }
}

impl<'a> JitterReport<'a> {
    /// The report of a measurement.
    #[must_use]
    pub const fn new(setup: &'a Setup, measured: &'a Measurement) -> Self {
        Self { setup, measured }
    }

    fn load(&self) -> &'static str {
        if self.setup.motion.is_some() {
            "full tick"
        } else {
            "empty loop"
        }
    }

    fn difference(&self) -> Option<QuantileRow> {
        let cyclictest = self.measured.cyclictest.as_ref()?;
        let own = QuantileRow::of(&self.measured.windows.all.quantiles());
        Some(own.minus(QuantileRow::of_cyclictest(cyclictest)))
    }

    /// The report as one JSON object.
    #[must_use]
    pub fn object(&self) -> Value {
        let windows = &self.measured.windows;
        let all = windows.all.quantiles();
        let mut latency = QuantileRow::of(&all).object();
        latency["min"] = us(windows.all.min_ns()).into();
        let mut clean = QuantileRow::of(&windows.clean.quantiles()).object();
        clean["ticks"] = windows.clean.quantiles().count.into();
        clean["missed_ticks"] = windows.clean_missed.into();
        let cyclictest = self.measured.cyclictest.as_ref().map(|latencies| {
            let mut object = QuantileRow::of_cyclictest(latencies).object();
            object["ticks"] = latencies.total().into();
            object["histogram"] = bins(rebin(cyclictest_times(latencies), FINE));
            object
        });
        json!({
            "period_us": us(self.setup.period_ns),
            "seconds": windows.count,
            "cpu": self.setup.request.cpu,
            "priority": self.setup.request.priority,
            "load": self.load(),
            "ticks": all.count,
            "missed_ticks": windows.missed,
            "moving_ticks": windows.moving,
            "lost_samples": self.measured.lost_beats,
            "latency_us": latency,
            "latency_without_steal_us": clean,
            "lateness_us": QuantileRow::of(&windows.lateness.quantiles()).object(),
            "work_us": QuantileRow::of(&windows.work.quantiles()).object(),
            "windows": windows.count,
            "windows_with_steal": windows.with_steal,
            "steal_ms": windows.steal.map(|ticks| ticks * 10),
            "realtime": grants_object(&self.measured.grants),
            "histogram": bins(rebin(times(&windows.all), FINE)),
            "cyclictest": cyclictest,
            "difference_us": self.difference().map(QuantileRow::object),
        })
    }

    /// The report for people.
    #[must_use]
    pub fn text(&self) -> String {
        let windows = &self.measured.windows;
        let all = windows.all.quantiles();
        let mut text = format!(
            "{}, period {} µs, {} s: {} ticks, {} missed\n",
            self.load(),
            us(self.setup.period_ns),
            windows.count,
            grouped(all.count),
            grouped(windows.missed)
        );
        let _ = writeln!(
            text,
            "  real time     {}",
            grants_text(&self.measured.grants)
        );
        let _ = writeln!(text, "  steal         {}", self.steal());
        if self.measured.lost_beats > 0 {
            let lost = grouped(self.measured.lost_beats);
            let _ = writeln!(
                text,
                "  lost          {lost} samples: the host is overloaded"
            );
        }
        if self.setup.motion.is_some() {
            let moving = grouped(windows.moving);
            let _ = writeln!(text, "  in motion     {moving} ticks");
        }
        text.push('\n');
        text.push_str(&self.table());
        text.push('\n');
        text.push_str(&drawn(&rebin(times(&windows.all), COARSE)));
        text
    }

    fn steal(&self) -> String {
        let windows = &self.measured.windows;
        match windows.steal {
            None => "the host does not tell".to_owned(),
            Some(0) => "none".to_owned(),
            Some(ticks) => format!(
                "{} ms in {} of {} windows of 1 s",
                grouped(ticks * 10),
                windows.with_steal,
                windows.count
            ),
        }
    }

    fn table(&self) -> String {
        let windows = &self.measured.windows;
        let mut text = format!(
            "  {:24}{:>10}{:>10}{:>10}{:>10}\n",
            "µs", "p50", "p99", "p99.9", "max"
        );
        let mut row = |name: &str, row: QuantileRow| {
            let _ = writeln!(text, "  {name:24}{}", row.text());
        };
        let all = QuantileRow::of(&windows.all.quantiles());
        row("latency of waking", all);
        if windows.with_steal > 0 && windows.with_steal < windows.count {
            row(
                "  windows without steal",
                QuantileRow::of(&windows.clean.quantiles()),
            );
        }
        if let Some(latencies) = &self.measured.cyclictest {
            row("cyclictest", QuantileRow::of_cyclictest(latencies));
        }
        if let Some(difference) = self.difference() {
            row("  latency − cyclictest", difference);
        }
        row(
            "lateness of ticks",
            QuantileRow::of(&windows.lateness.quantiles()),
        );
        if self.setup.motion.is_some() {
            row("work of a tick", QuantileRow::of(&windows.work.quantiles()));
        }
        let least = us(windows.all.min_ns());
        let _ = writeln!(text, "  least latency {least:.1} µs");
        text
    }

    /// A plot of the latency as SVG.
    #[must_use]
    pub fn plot(&self) -> String {
        let windows = &self.measured.windows;
        let mut series = vec![LatenessSeries {
            name: "glidepath",
            bins: rebin(times(&windows.all), FINE),
        }];
        if let Some(latencies) = &self.measured.cyclictest {
            series.push(LatenessSeries {
                name: "cyclictest",
                bins: rebin(cyclictest_times(latencies), FINE),
            });
        }
        let q = windows.all.quantiles();
        let caption = format!(
            "{}, period {} µs, {} ticks, {} missed · p50 {:.1}, p99 {:.1}, p99.9 {:.1}, max {:.1} µs · \
             steal: {}",
            self.load(),
            us(self.setup.period_ns),
            grouped(q.count),
            grouped(windows.missed),
            us(q.p50_ns),
            us(q.p99_ns),
            us(q.p999_ns),
            us(q.max_ns),
            self.steal()
        );
        lateness("Latency of waking of the real-time loop", &caption, &series)
    }
}

fn bins(bins: Vec<Bin>) -> Value {
    let object =
        |bin: Bin| json!({"from_us": bin.low_us, "to_us": bin.high_us, "count": bin.count});
    bins.into_iter().map(object).collect()
}

/// Bars whose length is the logarithm of the number: one single outlier must be seen.
#[allow(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a length of at most BAR"
)]
fn drawn(bins: &[Bin]) -> String {
    let length = |count: u64| {
        if count == 0 {
            0.0
        } else {
            1.0 + (count as f64).log10()
        }
    };
    let longest = bins.iter().map(|bin| length(bin.count)).fold(1.0, f64::max);
    let mut text = String::from("  latency of waking, µs (bars: logarithm of the number)\n");
    for bin in bins {
        let bar = "█".repeat((BAR * length(bin.count) / longest).round() as usize);
        let (low, high, count) = (bin.low_us, bin.high_us, grouped(bin.count));
        let space = if bar.is_empty() { "" } else { " " };
        let _ = writeln!(text, "  {low:>8} to {high:<8} {bar}{space}{count}");
    }
    text
}

/// The key of an item in JSON, as in the other reports.
const fn key(item: Item) -> &'static str {
    match item {
        Item::Scheduling => "fifo",
        Item::Affinity => "pinned",
        Item::MemoryLock => "memory_locked",
        Item::StackPrefault => "prefaulted",
        Item::CpuDmaLatency => "cpu_awake",
    }
}

fn grants_object(grants: &Grants) -> Value {
    let mut object: Map<String, Value> = Item::ALL
        .into_iter()
        .map(|item| (key(item).to_owned(), grants.is_granted(item).into()))
        .collect();
    let refusals: Vec<String> = grants.refusals().map(|r| r.to_string()).collect();
    object.insert("refusals".to_owned(), refusals.into());
    Value::Object(object)
}

fn grants_text(grants: &Grants) -> String {
    let names = |wanted: fn(Outcome) -> bool| {
        let list: Vec<_> = grants
            .outcomes()
            .filter(|(_, outcome)| wanted(*outcome))
            .map(|(item, _)| item.name())
            .collect();
        list.join(", ")
    };
    let granted = names(|outcome| outcome == Outcome::Granted);
    let refused = names(|outcome| matches!(outcome, Outcome::Refused(_)));
    match (granted.as_str(), refused.as_str()) {
        (granted, "") => granted.to_owned(),
        ("", refused) => format!("none; refused: {refused}"),
        (granted, refused) => format!("{granted}; refused: {refused}"),
    }
}

#[cfg(test)]
mod tests;
