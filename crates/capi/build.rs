//! The name that programs look for when they start: another one for every version of the ABI that
//! is not the one before.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libglidepath.so.0");
}
