#!/usr/bin/env bash
# Times of explicit substeps: the thesis' method in C++ and this engine, on the same donuts, in one run on one machine.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
cd "$here/../../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

g++ -O3 -march=native -o "$folder/sandbox2d" "$here/main.cpp"
cargo build --quiet --release
program="${CARGO_TARGET_DIR:-target}/release/finite-elements-3d"

echo "C++, f32, one thread:"
for edge in 0.0775 0.0388 0.0194 0.0097; do # those of the experiment
    "$program" mesh from-picture data/pictures/donut.png "$folder/donut.obj" --edge $edge --improve 5 >/dev/null
    "$folder/sandbox2d" "$folder/donut.obj"
done
echo "this engine, f64, one thread (triangles, ms a frame, µs a substep, ns a substep and triangle):"
"$program" experiment flat speed --out "$folder/speed" || true # its mark may fail on a slow machine
cat "$folder/speed/flat-speed.csv"
