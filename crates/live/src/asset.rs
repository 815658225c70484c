//! The files of the page, which are part of the program.

use crate::response::{ContentType, Response};

/// The page.
pub(crate) const INDEX: &str = include_str!("../page/index.html");
/// How it looks.
pub(crate) const STYLE: &str = include_str!("../page/style.css");
/// How what is operated looks.
const HANDS_STYLE: &str = include_str!("../page/hands.css");

/// What shows a motion, in the order in which the page names it.
const SHOWING: [(&str, &str); 12] = [
    ("/base.js", include_str!("../page/base.js")),
    ("/units.js", include_str!("../page/units.js")),
    ("/plan.js", include_str!("../page/plan.js")),
    ("/ring.js", include_str!("../page/ring.js")),
    ("/path3d.js", include_str!("../page/path3d.js")),
    ("/strips.js", include_str!("../page/strips.js")),
    ("/course.js", include_str!("../page/course.js")),
    ("/ribbon.js", include_str!("../page/ribbon.js")),
    ("/spectrum.js", include_str!("../page/spectrum.js")),
    ("/words.js", include_str!("../page/words.js")),
    ("/health.js", include_str!("../page/health.js")),
    ("/why.js", include_str!("../page/why.js")),
];

/// What operates a machine, behind that.
const HANDS: [(&str, &str); 16] = [
    ("/orders.js", include_str!("../page/orders.js")),
    ("/bar.js", include_str!("../page/bar.js")),
    ("/bell.js", include_str!("../page/bell.js")),
    ("/jog.js", include_str!("../page/jog.js")),
    ("/gamepad.js", include_str!("../page/gamepad.js")),
    ("/judged.js", include_str!("../page/judged.js")),
    ("/setup.js", include_str!("../page/setup.js")),
    ("/spindle.js", include_str!("../page/spindle.js")),
    ("/touch.js", include_str!("../page/touch.js")),
    ("/devices.js", include_str!("../page/devices.js")),
    ("/machines.js", include_str!("../page/machines.js")),
    ("/programs.js", include_str!("../page/programs.js")),
    ("/certificate.js", include_str!("../page/certificate.js")),
    ("/queue.js", include_str!("../page/queue.js")),
    ("/last.js", include_str!("../page/last.js")),
    ("/shuttle.js", include_str!("../page/shuttle.js")),
];

/// The page as a whole.
const WHOLE: (&str, &str) = ("/app.js", include_str!("../page/app.js"));

/// What the page does, in the order in which it names it.
fn scripts() -> impl Iterator<Item = (&'static str, &'static str)> {
    SHOWING.into_iter().chain(HANDS).chain([WHOLE])
}

/// The same for a page without a machine.
pub(crate) fn scripts_of_file() -> impl Iterator<Item = &'static str> {
    SHOWING.into_iter().chain([WHOLE]).map(|(_, script)| script)
}

/// Its typeface: B612, made for cockpits.
pub(crate) const FONTS: [(&str, &[u8]); 4] = [
    (
        "/fonts/b612-latin-400-normal.woff2",
        include_bytes!("../fonts/b612-latin-400-normal.woff2"),
    ),
    (
        "/fonts/b612-latin-700-normal.woff2",
        include_bytes!("../fonts/b612-latin-700-normal.woff2"),
    ),
    (
        "/fonts/b612-mono-latin-400-normal.woff2",
        include_bytes!("../fonts/b612-mono-latin-400-normal.woff2"),
    ),
    (
        "/fonts/b612-mono-latin-700-normal.woff2",
        include_bytes!("../fonts/b612-mono-latin-700-normal.woff2"),
    ),
];

/// The licence of the typeface.
pub(crate) const FONT_LICENCE: &str = include_str!("../fonts/LICENSE-OFL.txt");

/// The file at a path.
pub(crate) fn find(path: &str) -> Option<Response> {
    let text = |content, text: &str| Some(Response::new(content, text.as_bytes()));
    match path {
        "/" => text(ContentType::Html, INDEX),
        "/style.css" => text(ContentType::Css, STYLE),
        "/hands.css" => text(ContentType::Css, HANDS_STYLE),
        "/fonts/LICENSE-OFL.txt" => text(ContentType::Text, FONT_LICENCE),
        path => {
            let script = scripts().find(|(at, _)| *at == path);
            if let Some((_, script)) = script {
                return text(ContentType::Script, script);
            }
            let font = FONTS.iter().find(|(at, _)| *at == path);
            font.map(|(_, font)| Response::new(ContentType::Font, *font))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_names_every_script_in_its_order_and_nothing_of_others() {
        let named: Vec<&str> = INDEX
            .split("<script src=\"")
            .skip(1)
            .filter_map(|rest| rest.split('"').next())
            .collect();
        let own: Vec<&str> = scripts().map(|(path, _)| &path[1..]).collect();
        assert_eq!(named, own);
        let texts = [INDEX, STYLE, HANDS_STYLE];
        for text in scripts().map(|(_, text)| text).chain(texts) {
            assert!(!text.contains("://"), "nothing is loaded from elsewhere");
        }
        for (path, _) in FONTS {
            assert!(STYLE.contains(&path[1..]), "{path}");
            assert!(find(path).is_some());
        }
        for path in ["/style.css", "/hands.css"] {
            assert!(find(path).is_some() && INDEX.contains(&path[1..]));
        }
        assert!(find("/nothing").is_none());
    }
}
