//! Tests of the file that opens the page: by a press on an icon, say, and without a word of its address.

use std::fs;

use glidepath_tests::{Browser, Instance, Process, Services, Watchdog};

use super::{Live, PATIENCE};

#[test]
fn a_file_opens_the_page_that_operates_the_machine_and_says_when_it_has_ended() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let service = Process::service(&instance);
    let file = instance.path("Glidepath.html");
    let live = Live::start(&instance, &["--may", "operate", "--shortcut", &file]);
    let text = fs::read_to_string(&file).unwrap();
    assert!(text.contains(&live.url), "{text}");
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    browser.open(&format!("file://{file}"));
    browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'idle'");
    drop(live);
    browser.open(&format!("file://{file}"));
    browser.wait("document.body.textContent.includes('not served now')");
    let _ended = service.end().expect(0);
    drop(services.end());
}
