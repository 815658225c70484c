//! The build script: it sets the soname, the name that programs look for when they start. It carries the version of
//! the ABI, so that a program never loads a library of another one.

const ABI: &str = "src/layout/abi.rs";
const BEFORE: &str = "const ABI: u32 = ";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed={ABI}");
    let source = std::fs::read_to_string(ABI)?;
    let (_, rest) = source.split_once(BEFORE).ok_or(BEFORE)?;
    let (abi, _) = rest.split_once(';').ok_or("the end of a constant")?;
    println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libglidepath.so.{abi}");
    Ok(())
}
