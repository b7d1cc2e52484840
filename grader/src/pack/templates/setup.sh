#!/usr/bin/env bash
# Gradescope runs this once, as root, when it builds the autograder's image. Afterwards grading needs no network.
set -euo pipefail

root=${AUTOGRADER_ROOT:-/autograder}
export RUSTUP_HOME=/opt/rust CARGO_HOME=/opt/rust PATH=/opt/rust/bin:$PATH

apt-get update
DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends build-essential ca-certificates curl
# rustup's installer itself; the script at sh.rustup.rs would only choose it, from one host more.
installer=$(mktemp -d)/rustup-init
curl --proto '=https' --tlsv1.2 --location --silent --show-error --fail --output "$installer" \
    "https://static.rust-lang.org/rustup/dist/$(uname -m)-unknown-linux-gnu/rustup-init"
chmod +x "$installer"
"$installer" -y --no-modify-path --profile minimal --default-toolchain @TOOLCHAIN@
rm "$installer"

cd "$root/source"
# Also a plain Cargo.lock pins every dependency; with a folder `vendor` none is fetched.
cargo build --release --locked --package grader

# Grading refuses to start where submissions could reach files or the network; better to know that now.
target/release/grader sandbox || {
    echo "This container allows no sandbox; AUTOGRADER.md tells what it must allow." >&2
    exit 1
}

# The solved sources are graded once: that builds what submissions are linked with, and where they do not pass, no image is made.
selftest=$(mktemp -d)
CARGO_NET_OFFLINE=true target/release/grader grade .@RUBRIC@ --out "$selftest" --seed @SEED@
grep -q "@FUNCTIONS@ of @FUNCTIONS@ functions pass" "$selftest/report.md" || {
    echo "The solved sources do not pass in this container; the lines above tell why." >&2
    exit 1
}
rm -r "$selftest"
