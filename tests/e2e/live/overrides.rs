//! Tests of feed override, rapid override and single block on the page: each does what it says, and where the machine
//! rests for one of them the page says so, and what goes on.

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Services, Watchdog};

use super::PATIENCE;
use super::life::{HALF, press};
use super::operated_page::operated_page;

/// Waits for a person in front of motion at the feed and rapids, so that the plan is known before any of it is executed.
const PROGRAM: &str = "G21 G90 F3000\nM0\nG1 X40\nG0 Y60\nG1 X0\nG0 Y0\nG1 X40\nX0\nG0 Y60\nM2\n";

const CAUSE: &str = "document.querySelector('#why').textContent";
const GO: &str = "document.querySelector('[data-c=go]').innerText.replace(/\\s+/g, ' ').trim()";

/// A machine that obeys overrides as the page sets them, in percent.
struct Overridden<'a, 'i> {
    browser: &'a mut Browser,
    services: &'a Services<'i>,
}

impl Overridden<'_, '_> {
    /// Sets both, and waits until the page knows.
    fn set(&mut self, feed: u32, rapid: u32) {
        for (kind, percent) in [("feed-override", feed), ("rapid-override", rapid)] {
            let order = format!(
                "order('{kind}', {{ value: {percent} / 100 }}).then(said => said.accepted)"
            );
            assert_eq!(self.browser.evaluate(&order), true, "{kind} {percent}");
            self.browser.wait(&format!(
                "document.querySelector('[data-ov={kind}] [data-v]').textContent === '{percent}%'"
            ));
        }
    }

    /// Seconds to the end, as the page tells them with these overrides.
    fn left(&mut self, feed: u32, rapid: u32) -> f64 {
        self.set(feed, rapid);
        self.browser.wait("secondsTo() !== null");
        self.browser.evaluate("secondsTo()").as_f64().unwrap()
    }

    /// Rests, says why, and offers no Resume.
    fn rests_for(&mut self, cause: &str, why: &str) {
        let _held = self.services.wait_for(MachineState::Held);
        self.browser.wait(&format!(
            "{CAUSE}.includes('{cause}') && {GO} === 'Resume {why}'"
        ));
        let told = self.browser.evaluate(CAUSE);
        assert!(!told.as_str().unwrap().contains("glidepath "), "{told}");
    }
}

#[test]
fn feed_rapid_and_single_block_do_what_they_say() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let programs = [("part.ngc", PROGRAM)];
    let Some((mut browser, live, service, services)) =
        operated_page(&instance, (1024, 768), &programs, &[])
    else {
        return;
    };
    browser.evaluate("setView('programs')");
    browser.wait("document.querySelector('[data-name=\"part.ngc\"]')");
    browser.press("[data-name=\"part.ngc\"]");
    browser.wait("LOOK.info && LOOK.info.report && whyNoRun() === ''");
    press(&mut browser, "#chosen [data-do=run]", HALF);
    let _stopped = services.wait_for(MachineState::ProgramStop);
    browser.wait("S.view === 'operate' && S.state === 'program-stop' && PLAN && S.status.left_s");
    let mut overridden = Overridden {
        browser: &mut browser,
        services: &services,
    };

    // Moves at the feed obey the one, rapids the other: F and R of 100 %, 2 F and R, F and 2 R, 2 F and 2 R.
    let whole = overridden.left(100, 100);
    let (slow_feed, slow_rapid) = (overridden.left(50, 100), overridden.left(100, 50));
    let slow = overridden.left(50, 50);
    assert!((slow - 2.0 * whole).abs() < 1e-6 * whole, "{slow} {whole}");
    let both = slow_feed + slow_rapid;
    assert!((both - 3.0 * whole).abs() < 1e-6 * whole, "{both} {whole}");
    // There are rapids, and they take less than half of it.
    assert!(
        slow_rapid > 1.02 * whole && slow_rapid < 1.5 * whole,
        "{slow_rapid} {whole}"
    );

    // At 0 % it rests in front of what obeys it, and goes on by itself from there.
    overridden.set(100, 0);
    overridden.browser.evaluate("order('resume')");
    overridden.rests_for(
        "a rapid override of 0 %; Rapid at 100 % goes on",
        "rapid is at 0 %",
    );
    overridden.set(0, 100);
    overridden.rests_for(
        "a feed override of 0 %; Feed at 100 % goes on",
        "feed is at 0 %",
    );

    // Single block rests at the end of the block, and the key is called by what it does.
    overridden.browser.press("[data-c=single]");
    let _single = services.wait(|status| status.single_block != 0);
    overridden
        .browser
        .wait("document.querySelector('[data-c=single] small').textContent === 'block: on'");
    overridden.set(100, 100);
    let before = services.wait_for(MachineState::ProgramStop).line;
    let rests = format!(
        "{CAUSE}.includes('the end of a block, for single block; Next block goes on') && {GO} === 'Next block press ½ s'"
    );
    overridden.browser.wait(&rests);
    // Of two presses, the second before the first was told, both count.
    overridden
        .browser
        .evaluate("[0, 1].forEach(DEEDS['feed-override-more'])");
    let _faster = services.wait(|status| (status.feed_override - 1.1).abs() < 1e-9);
    press(overridden.browser, "[data-c=go]", HALF);
    let _next = services
        .wait(|status| status.state == MachineState::ProgramStop.code() && status.line > before);
    overridden.browser.wait(&rests);
    overridden.browser.press("[data-c=single]");
    let _off = services.wait(|status| status.single_block == 0);
    press(overridden.browser, "[data-c=go]", HALF);
    let _end = services.wait_for(MachineState::Idle);
    drop((live, service));
    drop(services.end());
}
