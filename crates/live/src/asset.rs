//! The files of the page, which are part of the program.

use crate::response::{Answer, ContentType};

/// The page.
pub(crate) const INDEX: &str = include_str!("../page/index.html");
/// How it looks.
pub(crate) const STYLE: &str = include_str!("../page/style.css");

/// What it does, in the order in which the page names it.
pub(crate) const SCRIPTS: [(&str, &str); 10] = [
    ("/base.js", include_str!("../page/base.js")),
    ("/plan.js", include_str!("../page/plan.js")),
    ("/ring.js", include_str!("../page/ring.js")),
    ("/path3d.js", include_str!("../page/path3d.js")),
    ("/strips.js", include_str!("../page/strips.js")),
    ("/ribbon.js", include_str!("../page/ribbon.js")),
    ("/spectrum.js", include_str!("../page/spectrum.js")),
    ("/words.js", include_str!("../page/words.js")),
    ("/health.js", include_str!("../page/health.js")),
    ("/app.js", include_str!("../page/app.js")),
];

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
pub(crate) fn find(path: &str) -> Option<Answer> {
    let text = |content, text: &str| Some(Answer::new(content, text.as_bytes()));
    match path {
        "/" => text(ContentType::Html, INDEX),
        "/style.css" => text(ContentType::Css, STYLE),
        "/fonts/LICENSE-OFL.txt" => text(ContentType::Text, FONT_LICENCE),
        path => {
            let script = SCRIPTS.iter().find(|(at, _)| *at == path);
            if let Some((_, script)) = script {
                return text(ContentType::Script, script);
            }
            let font = FONTS.iter().find(|(at, _)| *at == path);
            font.map(|(_, font)| Answer::new(ContentType::Font, *font))
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
        let own: Vec<&str> = SCRIPTS.iter().map(|(path, _)| &path[1..]).collect();
        assert_eq!(named, own);
        for text in SCRIPTS.iter().map(|(_, text)| *text).chain([INDEX, STYLE]) {
            assert!(!text.contains("://"), "nothing is loaded from elsewhere");
        }
        for (path, _) in FONTS {
            assert!(STYLE.contains(&path[1..]), "{path}");
            assert!(find(path).is_some());
        }
        assert!(find("/style.css").is_some() && find("/nothing").is_none());
    }
}
