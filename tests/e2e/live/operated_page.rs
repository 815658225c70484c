//! A page that operates a machine, in a browser: the machine at rest, with the planner's service and programs.

use std::fs;

use glidepath_tests::{Browser, Instance, Process, Services};

use super::Live;

/// The folder of an instance whose programs its page lists.
pub(crate) fn programs_of(instance: &Instance) -> String {
    instance.path("programs")
}

/// The browser, the page's server, the planner's service, and the machine. The page is opened in a window of a size,
/// with programs (name, text) in its folder and `more` arguments of `glidepath live`. `None` where there is no
/// browser.
pub(crate) fn operated_page<'i>(
    instance: &'i Instance,
    (width, height): (u32, u32),
    programs: &[(&str, &str)],
    more: &[&str],
) -> Option<(Browser, Live, Process, Services<'i>)> {
    let mut browser = Browser::start(width, height)?;
    let folder = programs_of(instance);
    fs::create_dir(&folder).unwrap();
    for (name, text) in programs {
        fs::write(format!("{folder}/{name}"), text).unwrap();
    }
    let services = Services::start(instance);
    let service = Process::service(instance);
    let arguments = [&["--may", "operate", "--programs", &folder], more].concat();
    let live = Live::start(instance, &arguments);
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'idle' && SETUP.jog");
    Some((browser, live, service, services))
}
