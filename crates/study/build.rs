//! Tells the study whether it is compiled for development or with `--release`, which its tables name.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-env=PROFILE={}", env::var("PROFILE").expect("cargo names the profile"));
}
