//! `glidepath doctor`: the checks of whether this host is fit for real time.

use crate::cli::DoctorArgs;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::output;
use core::fmt::Write as _;
use glidepath_realtime::Host;
use glidepath_realtime::doctor::{Check, CheckVerdict, RealTimeDemand, examine, examine_interface};
use serde_json::{Value, json};

/// Examines the host for the processor and priority of the configuration. The exit code says
/// whether anything required is missing.
pub(super) fn doctor(args: &DoctorArgs, config: &MachineConfig) -> Exit {
    let demand = RealTimeDemand {
        cpu: config.interpolator.cpu,
        priority: i32::from(config.interpolator.priority),
    };
    let host = Host::here();
    let mut checks = examine(&host, demand);
    let interface = args.interface.as_deref();
    checks.extend(
        interface
            .map(|name| examine_interface(&host, name))
            .into_iter()
            .flatten(),
    );
    if args.basic.json {
        output::object(&object(&checks, demand));
    } else {
        output::result(&text(&checks));
    }
    if is_fit(&checks) {
        Exit::Done
    } else {
        Exit::NotRealTime
    }
}

fn is_fit(checks: &[Check]) -> bool {
    checks
        .iter()
        .all(|check| check.verdict != CheckVerdict::Missing)
}

fn count(checks: &[Check], verdict: CheckVerdict) -> usize {
    checks.iter().filter(|c| c.verdict == verdict).count()
}

/// One line per check, the remedy behind what is not good.
fn text(checks: &[Check]) -> String {
    let mut text = String::new();
    for check in checks {
        let (verdict, name, found) = (check.verdict.name(), check.name, &check.found);
        let _ = write!(text, "{verdict:8} {name:17} {found}");
        if let Some(remedy) = &check.remedy {
            let _ = write!(text, " -> {remedy}");
        }
        text.push('\n');
    }
    let missing = count(checks, CheckVerdict::Missing);
    let warnings = count(checks, CheckVerdict::Warning);
    let _ = if missing > 0 {
        writeln!(
            text,
            "\nnot fit: {missing} missing, {warnings} warnings; `glidepath interpolator` refuses to \
             start without --best-effort"
        )
    } else if warnings > 0 {
        writeln!(
            text,
            "\nfit to start, {warnings} warnings; measure under load with `glidepath jitter`"
        )
    } else {
        writeln!(
            text,
            "\nfit; measure for hours under load with `glidepath jitter` to be sure"
        )
    };
    text
}

fn object(checks: &[Check], demand: RealTimeDemand) -> Value {
    let list: Vec<Value> = checks
        .iter()
        .map(|check| {
            json!({
                "name": check.name,
                "verdict": check.verdict.name(),
                "found": check.found,
                "remedy": check.remedy,
            })
        })
        .collect();
    json!({
        "fit": is_fit(checks),
        "missing": count(checks, CheckVerdict::Missing),
        "warnings": count(checks, CheckVerdict::Warning),
        "cpu": demand.cpu,
        "priority": demand.priority,
        "checks": list,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(verdict: CheckVerdict, remedy: Option<&str>) -> Check {
        Check {
            name: "kernel",
            verdict,
            found: "6.12".to_owned(),
            remedy: remedy.map(str::to_owned),
        }
    }

    #[test]
    fn a_line_has_verdict_finding_and_remedy() {
        let checks = [
            check(CheckVerdict::Ok, None),
            check(CheckVerdict::Missing, Some("install it")),
        ];
        let text = text(&checks);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "ok       kernel            6.12");
        assert_eq!(lines[1], "missing  kernel            6.12 -> install it");
        assert!(lines[3].starts_with("not fit: 1 missing, 0 warnings"));
    }

    #[test]
    fn warnings_do_not_make_a_host_unfit() {
        let checks = [check(CheckVerdict::Warning, Some("isolate it"))];
        let demand = RealTimeDemand {
            cpu: Some(1),
            priority: 80,
        };
        let object = object(&checks, demand);
        assert_eq!(object["fit"], true);
        assert_eq!(object["warnings"], 1);
        assert_eq!(object["checks"][0]["remedy"], "isolate it");
        assert!(text(&checks).contains("fit to start, 1 warnings"));
    }
}
