//! The table of points evaluated by each method on the reference curves.

use super::curves::path;
use core::fmt::Write as _;
use glidepath_motion::preview::{
    AdvanceRetreat, Certified, Demand, Method, Preview, Traditional, preview,
};

const CURVES: [&str; 9] = [
    "butterfly",
    "infinity",
    "circle",
    "star",
    "fan",
    "snail",
    "trident_like",
    "helix3d",
    "needle",
];

/// The table in Markdown.
pub(crate) fn markdown() -> String {
    let mut text = String::from(
        "| curve | period | regions | traditional | η = 8 | η = 64 | η = ∞ | certified |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    for name in CURVES {
        let path = path(name);
        for period_ms in [1.0, 4.0] {
            let demand = Demand::chord(100.0, period_ms * 1e-3, 0.001);
            let growth = |max_growth: f64| AdvanceRetreat {
                max_growth,
                ..AdvanceRetreat::default()
            };
            let certified = preview(&path, &demand, &Certified);
            let cell = |method: &dyn Method| cell(&preview(&path, &demand, method), &certified);
            let _ = writeln!(
                text,
                "| {name} | {period_ms} ms | {} | {} | {} | {} | {} | {} |",
                certified.regions.len(),
                cell(&Traditional),
                cell(&growth(8.0)),
                cell(&growth(64.0)),
                cell(&growth(f64::INFINITY)),
                cell(&Certified),
            );
        }
    }
    text.push_str(
        "\nη: longest step of advance and retreat, in first steps. Missed regions in bold.\n",
    );
    text
}

fn cell(preview: &Preview, truth: &Preview) -> String {
    match preview.missed(truth) {
        0 => preview.points_evaluated.to_string(),
        missed => format!("{}, **{missed} missed**", preview.points_evaluated),
    }
}
