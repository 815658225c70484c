//! `glidepath preview`: the speed-sensitive regions of a NURBS.

use crate::cli::{PreviewArgs, PreviewMethod};
use crate::clock;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::curve_file;
use crate::exit::Exit;
use crate::output;
use crate::output_file::{self, OutputKind, OverwriteGuard};
use crate::plot::curve::{CurvePlot, Mark};
use crate::report::seconds;
use core::fmt::Write as _;
use glidepath_geometry::NurbsPath;
use glidepath_motion::preview::{
    Certified, Demand, Method, Preview, Region, Traditional, preview as read_ahead,
};
use serde_json::{Value, json};

/// Finds the regions of a curve file and reports them.
///
/// # Errors
/// The curve file is rejected, there is no feedrate, or the plot cannot be written.
pub(super) fn preview(args: &PreviewArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    args.file.keep(curve_file::MOST_BYTES)?;
    let file = curve_file::read(args.file.name(), args.file.path())?;
    let feed = args.feed.or(file.feed_mm_min).or(config.path.default_feed);
    let feed_mm_min = feed.ok_or(Failure::NoFeed)?;
    let period_us = args.period_us.unwrap_or(config.interpolator.period_us);
    let chord_mm = args.chord_error.unwrap_or(config.path.tolerance_mm);
    let demand = Demand::chord(feed_mm_min / 60.0, f64::from(period_us) / 1e6, chord_mm);
    let method: &dyn Method = match args.method {
        PreviewMethod::Traditional => &Traditional,
        PreviewMethod::AdvanceRetreat => &config.preview,
        PreviewMethod::Certified => &Certified,
    };
    let path = NurbsPath::new(file.curve);
    let start = clock::elapsed();
    let found = read_ahead(&path, &demand, method);
    let wall_s = (clock::elapsed() - start).as_secs_f64();

    let report = Report {
        name: file.name.as_deref().unwrap_or_default(),
        method: method.name(),
        path: &path,
        demand: &demand,
        found: &found,
        wall_s,
    };
    if let Some(plot) = &args.plot {
        let guard = OverwriteGuard {
            inputs: [Some(&args.file), args.basic.config.as_ref()]
                .into_iter()
                .flatten()
                .map(|file| file.name().to_owned())
                .collect(),
            force: args.overwrite.force,
        };
        output_file::write(plot, OutputKind::Plot, &guard, &report.plot())?;
    }
    if args.basic.json {
        output::object(&report.object());
    } else {
        output::result(&report.text());
    }
    Ok(Exit::Done)
}

struct Report<'a> {
    name: &'a str,
    method: &'static str,
    path: &'a NurbsPath,
    demand: &'a Demand,
    found: &'a Preview,
    wall_s: f64,
}

impl Report<'_> {
    fn object(&self) -> Value {
        let regions: Vec<Value> = self.found.regions.iter().map(|r| self.region(r)).collect();
        json!({
            "curve": self.name,
            "method": self.method,
            "degree": self.path.curve().degree(),
            "control_points": self.path.curve().control_points().len(),
            "length_mm": self.path.length(),
            "feed_mm_min": self.demand.feed_v * 60.0,
            "period_s": self.demand.period_t,
            "chord_error_mm": self.demand.chord_mm,
            "critical_radius_mm": self.demand.critical_radius_mm(),
            "points_evaluated": self.found.points_evaluated,
            "regions": regions,
            "wall_s": self.wall_s,
        })
    }

    fn region(&self, region: &Region) -> Value {
        let minima: Vec<Value> = region
            .minima
            .iter()
            .map(|minimum| {
                json!({
                    "u": minimum.u,
                    "s_mm": self.path.s_at(minimum.u),
                    "rho_mm": minimum.radius_mm,
                    "speed_cap_mm_s": minimum.cap_v,
                })
            })
            .collect();
        json!({
            "start_u": region.from_u,
            "start_s_mm": self.path.s_at(region.from_u),
            "end_u": region.to_u,
            "end_s_mm": self.path.s_at(region.to_u),
            "minima": minima,
        })
    }

    fn text(&self) -> String {
        let mut text = String::new();
        let _ = writeln!(
            text,
            "{}: {:.3} mm, {} knot spans; {} regions with radius below {:.4} mm",
            self.name,
            self.path.length(),
            self.path.curve().spans().len(),
            self.found.regions.len(),
            self.demand.critical_radius_mm(),
        );
        for region in &self.found.regions {
            let [from_s, to_s] = [region.from_u, region.to_u].map(|u| self.path.s_at(u));
            let _ = writeln!(
                text,
                "  u {:.9} to {:.9}, {from_s:.4} to {to_s:.4} mm",
                region.from_u, region.to_u
            );
            for minimum in &region.minima {
                let _ = writeln!(
                    text,
                    "    radius {:.6} mm at u {:.9}: {:.3} mm/s",
                    minimum.radius_mm, minimum.u, minimum.cap_v
                );
            }
        }
        let _ = writeln!(
            text,
            "{} evaluated {} points in {}",
            self.method,
            self.found.points_evaluated,
            seconds(self.wall_s)
        );
        text
    }

    /// The curve coloured by the speed its curvature allows, with the minima.
    fn plot(&self) -> String {
        let mut plot = CurvePlot::new();
        let curve = self.path.curve();
        for span in curve.spans() {
            let (from_u, to_u) = (span.from_u(), span.to_u());
            for i in 0..=200 {
                let u = from_u + (to_u - from_u) * f64::from(i) / 200.0;
                let allowed_v = self.demand.cap_v(1.0 / curve.curvature(u));
                plot.point(&curve.jet(u).position, allowed_v);
            }
        }
        for minimum in self.found.regions.iter().flat_map(|region| &region.minima) {
            plot.mark(&curve.jet(minimum.u).position, Mark::Found);
        }
        let title = format!("{}: allowed speed", self.name);
        let subtitle = format!(
            "{} regions, {} points evaluated ({}); {:.0} mm/min, {} µs, chord error {} mm",
            self.found.regions.len(),
            self.found.points_evaluated,
            self.method,
            self.demand.feed_v * 60.0,
            self.demand.period_t * 1e6,
            self.demand.chord_mm,
        );
        plot.render(&title, &subtitle)
    }
}
