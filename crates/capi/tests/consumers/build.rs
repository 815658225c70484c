//! The build of test programs, compiled as a user of the library would.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Language {
    C,
    Cpp,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Linked {
    Shared,
    Static,
}

/// Where a test works: its folder, which is the runtime directory of its processes, and the name of its
/// instance.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place<'a> {
    pub(crate) directory: &'a Path,
    pub(crate) instance: &'a str,
}

/// What a static library of Rust needs beside it: `rustc --print native-static-libs`.
const NATIVE: [&str; 6] = ["-lgcc_s", "-lutil", "-lrt", "-lpthread", "-lm", "-ldl"];

const STRICT: [&str; 4] = ["-Wall", "-Wextra", "-Werror", "-pedantic"];

impl Language {
    const fn compiler(self) -> &'static str {
        match self {
            Self::C => "cc",
            Self::Cpp => "c++",
        }
    }

    const fn standard(self) -> &'static str {
        match self {
            Self::C => "-std=c11",
            Self::Cpp => "-std=c++17",
        }
    }

    const fn suffix(self) -> &'static str {
        match self {
            Self::C => "c",
            Self::Cpp => "cpp",
        }
    }

    fn is_there(self) -> bool {
        Command::new(self.compiler())
            .arg("--version")
            .output()
            .is_ok()
    }
}

/// A file of this crate.
pub(crate) fn source(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    path.to_str().unwrap().to_owned()
}

/// The library. What is a test of a library for other languages does not make cargo build it, so it
/// is built here, once, with all it needs being there; not where `GLIDEPATH_BUILT` says that everything
/// was built just now.
pub(crate) fn library(linked: Linked) -> PathBuf {
    static BUILT: OnceLock<()> = OnceLock::new();
    BUILT.get_or_init(|| {
        if std::env::var_os("GLIDEPATH_BUILT").is_some() {
            return;
        }
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut build = Command::new(cargo);
        build.args(["build", "--quiet", "--offline", "--package"]);
        build.arg(env!("CARGO_PKG_NAME"));
        if !cfg!(debug_assertions) {
            build.arg("--release");
        }
        let output = build
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .unwrap();
        assert!(output.status.success(), "{output:?}");
    });
    let this = std::env::current_exe().unwrap();
    let name = match linked {
        Linked::Shared => "libglidepath.so",
        Linked::Static => "libglidepath.a",
    };
    let path = this.with_file_name(name);
    assert!(path.is_file(), "{} is not there", path.display());
    path
}

/// The name that programs look for: with the version of the ABI, as the header has it.
pub(crate) fn soname() -> String {
    let header = std::fs::read_to_string(source("include/glidepath.h")).unwrap();
    let abi = header.split_once("#define GP_ABI ").unwrap().1;
    format!("libglidepath.so.{}", abi.split_once('u').unwrap().0)
}

/// A folder with the library under the name that programs look for.
pub(crate) fn library_folder(place: Place<'_>) -> PathBuf {
    let folder = place.directory.join("lib");
    if !folder.exists() {
        std::fs::create_dir(&folder).unwrap();
        let shared = library(Linked::Shared);
        for name in ["libglidepath.so".to_owned(), soname()] {
            std::os::unix::fs::symlink(&shared, folder.join(name)).unwrap();
        }
    }
    folder
}

/// Compiles an example; gives its path, or `None` without a compiler.
pub(crate) fn example(
    place: Place<'_>,
    name: &str,
    language: Language,
    linked: Linked,
) -> Option<String> {
    if !language.is_there() {
        return None;
    }
    let folder = library_folder(place);
    let program = place
        .directory
        .join(format!("{name}-{language:?}-{linked:?}"));
    let mut compile = Command::new(language.compiler());
    compile
        .arg(language.standard())
        .args(STRICT)
        .args(["-O1", "-pthread", "-I", &source("include"), "-o"])
        .arg(&program)
        .arg(source(&format!("examples/{name}.{}", language.suffix())));
    match linked {
        Linked::Shared => {
            let at = format!("-Wl,-rpath,{}", folder.display());
            compile.arg("-L").arg(&folder).args(["-lglidepath", &at]);
        }
        Linked::Static => {
            compile.arg(library(Linked::Static)).args(NATIVE);
        }
    }
    let output = compile.output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{name}, {language:?}, {linked:?}: {message}"
    );
    Some(program.to_str().unwrap().to_owned())
}

/// Whether a text compiles with a header; the compiler's words if it does not, `None` without one.
pub(crate) fn compiles(
    place: Place<'_>,
    header: &str,
    text: &str,
    language: Language,
) -> Option<Result<(), String>> {
    if !language.is_there() {
        return None;
    }
    let include = place.directory.join("include");
    std::fs::create_dir_all(&include).unwrap();
    std::fs::write(include.join("glidepath.h"), header).unwrap();
    let file = include.join(format!("text.{}", language.suffix()));
    std::fs::write(&file, text).unwrap();
    let output = Command::new(language.compiler())
        .arg(language.standard())
        .args(STRICT)
        .args(["-fsyntax-only", "-I"])
        .args([&include, &file])
        .output()
        .unwrap();
    Some(if output.status.success() {
        Ok(())
    } else {
        Err(String::from_utf8_lossy(&output.stderr).into_owned())
    })
}
