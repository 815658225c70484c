//! The progress bar: on standard error, and only if that is a terminal.

use crate::output;
use crate::report::rough_time;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A file shorter than this is read before anybody could look at a bar.
const LONG_BYTES: u64 = 1 << 20;

/// Between two lines about a work that goes on for hours, where there is no bar.
const TELL_EVERY: Duration = Duration::from_secs(60);

/// A bar, and what stands beside it.
#[derive(Debug)]
pub struct ProgressDisplay {
    bar: ProgressBar,
    /// Where there is no terminal: when a line was told last, and all of the motion, s.
    told: Option<(Mutex<Instant>, f64)>,
}

impl ProgressDisplay {
    /// A bar that counts the lines of a program, with the time to go; none with `--json`.
    #[must_use]
    pub fn lines(total: u64, json: bool) -> Self {
        let style = "{msg:10} {wide_bar} line {human_pos} of {human_len}, {elapsed}, {eta} to go";
        Self::counting(total, style, json)
    }

    /// A bar for a long motion, which counts its seconds. Where there is no terminal a line tells them now and
    /// then; nothing with `--json`.
    #[must_use]
    pub fn motion(total_s: f64, json: bool) -> Self {
        let style = "{msg:10} {wide_bar} {human_pos} of {human_len} s, {elapsed}, {eta} to go";
        let mut progress = Self::counting(whole(total_s), style, json);
        if !json && progress.bar.is_hidden() {
            progress.told = Some((Mutex::new(Instant::now()), total_s));
        }
        progress
    }

    /// So much motion is planned.
    pub fn has_planned(&self, planned_s: f64) {
        self.at(whole(planned_s));
        let Some((last, total_s)) = &self.told else {
            return;
        };
        let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
        if last.elapsed() >= TELL_EVERY {
            *last = Instant::now();
            let (planned, total) = (rough_time(planned_s), rough_time(*total_s));
            output::note(&format!("planning: {planned} of about {total}"));
        }
    }

    /// A bar that counts the bytes of a file being read, with the time to go; none with `--json`,
    /// and none for a file that is read at once.
    #[must_use]
    pub fn bytes(total: u64, json: bool) -> Self {
        let style = "{msg:10} {wide_bar} {bytes} of {total_bytes}, {elapsed}, {eta} to go";
        Self::counting(total, style, json || total < LONG_BYTES)
    }

    fn counting(total: u64, style: &str, is_hidden: bool) -> Self {
        let target = if is_hidden {
            ProgressDrawTarget::hidden()
        } else {
            // Hides itself where standard error is not a terminal.
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(total), target);
        if let Ok(style) = ProgressStyle::with_template(style) {
            bar.set_style(style);
        }
        Self { bar, told: None }
    }

    /// A bar that counts the seconds of a measurement.
    #[must_use]
    pub fn seconds(total: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{msg:10} {wide_bar} {pos} of {len} s") {
            bar.set_style(style);
        }
        Self { bar, told: None }
    }

    /// A bar of so many steps that tells nothing but their share.
    #[must_use]
    pub fn share(total: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
        if let Ok(style) =
            ProgressStyle::with_template("{msg:10} {wide_bar} {percent} %, {elapsed}")
        {
            bar.set_style(style);
        }
        Self { bar, told: None }
    }

    /// What is being done.
    pub fn doing(&self, what: &'static str) {
        self.bar.set_message(what);
    }

    /// The count and its time begin anew.
    pub fn start_again(&self) {
        self.bar.reset();
    }

    /// The line or second reached.
    pub fn at(&self, position: u64) {
        self.bar.set_position(position);
    }

    /// Prints a line above the bar, or to standard error where there is no bar.
    pub fn note(&self, text: &str) {
        if self.bar.is_hidden() {
            output::note(text);
        } else {
            self.bar.println(output::shown(text));
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// Whole seconds.
fn whole(seconds: f64) -> u64 {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a cast saturates"
    )]
    let whole = seconds as u64;
    whole
}
