#!/usr/bin/env bash
# Gradescope runs this once, as root, when it builds the autograder's image. Afterwards grading needs no network.
set -euo pipefail

root=${AUTOGRADER_ROOT:-/autograder}
export RUSTUP_HOME=/opt/rust CARGO_HOME=/opt/rust PATH=/opt/rust/bin:$PATH

apt-get update
DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends build-essential ca-certificates curl
curl --proto '=https' --tlsv1.2 --silent --show-error --fail https://sh.rustup.rs |
    sh -s -- -y --no-modify-path --profile minimal --default-toolchain @TOOLCHAIN@

cd "$root/source"
# Also a plain Cargo.lock pins every dependency; with a folder `vendor` none is fetched.
cargo build --release --locked --package grader

# The solved sources are graded once: that builds what submissions are linked with, and an image whose grader does not
# work is not made.
selftest=$(mktemp -d)
CARGO_NET_OFFLINE=true target/release/grader grade . --out "$selftest" --seed @SEED@
cat "$selftest/report.md"
rm -r "$selftest"
