#!/usr/bin/env bash
# Checks the plugin: formatting, lints, the tests of apps without a window on one and two threads of rayon, positions bit for bit those of
# the command line, memory, the time by which frames are held up, and a picture of the example by Mesa's Vulkan driver in software.
# Too long for .ci/run: the first build takes a quarter of an hour on two cores.
set -euo pipefail
cd "$(dirname "$0")"
export CARGO_TERM_COLOR=never

step() { printf '\n== %s (%s s so far)\n' "$1" "$SECONDS"; }

step "formatting and lints"
cargo fmt --check -- --config-path ../../rustfmt.toml
cargo clippy --all-targets --features window -- -D warnings
RUSTDOCFLAGS="-D warnings" cargo doc --no-deps

step "the program whose positions are compared"
root=$(cd ../.. && pwd)
program_target=${FEM_PROGRAM_TARGET:-$root/target}
(cd "$root" && CARGO_TARGET_DIR="$program_target" cargo build --release --no-default-features --features engine)
export FINITE_ELEMENTS_3D="$program_target/release/finite-elements-3d"

for threads in 1 2; do
    step "tests on $threads of rayon's threads"
    RAYON_NUM_THREADS=$threads cargo test
    RAYON_NUM_THREADS=$threads cargo test --test headless -- --ignored positions
done

step "memory after bodies that are gone"
cargo test --test headless -- --ignored --nocapture a_hundred_bodies_leave_no_memory

step "costs at 60 frames a second; 99 frames in 100 are held up for less than 0.5 ms"
cargo run --quiet --example costs

step "a picture of the example, without a window"
driver=/usr/share/vulkan/icd.d/lvp_icd.x86_64.json # of Debian's package mesa-vulkan-drivers
if [ -e "$driver" ]; then
    cargo build --features window --example bevy_armadillo
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
    VK_ICD_FILENAMES=$driver timeout 300 env -u DISPLAY -u WAYLAND_DISPLAY \
        cargo run --quiet --features window --example bevy_armadillo -- --picture "$folder/armadillo.png"
    # A picture of one colour packs into a few kilobytes.
    [ "$(stat -c %s "$folder/armadillo.png")" -gt 20000 ] || { echo "the picture shows nothing"; exit 1; }
    cp "$folder/armadillo.png" "$root/docs/bevy-armadillo.png"
else
    echo "skipped: there is no $driver"
fi

step "done"
