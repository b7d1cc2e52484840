#!/usr/bin/env bash
# Grades a class on a Slurm cluster: SHARDS jobs of an array, then one that joins them.
# Submitting again grades only what is missing.
set -euo pipefail

if [ $# -lt 2 ]; then
    echo "usage: GRADER=PROGRAM $0 FOLDER OUT [SHARDS [ARGUMENTS OF grader class]]" >&2
    exit 2
fi
grader=$(command -v "${GRADER:-grader}") || {
    echo "$0: no grader; set GRADER to the program that cargo build --release -p grader made" >&2
    exit 2
}
grader=$(realpath "$grader")
here=$(cd "$(dirname "$0")" && pwd)
folder=$(realpath "$1")
mkdir -p "$2/logs"
out=$(realpath "$2")
shards=${3:-@SHARDS@}
shift $(($# < 3 ? $# : 3))

array=$(sbatch --parsable --array="1-$shards" --output="$out/logs/shard-%a-%A.log" \
    "$here/array.sbatch" "$grader" "$folder" "$out" "$shards" "$@")
array=${array%%;*}
# Also after a shard that failed: the others have grades, and the joined table names what is missing.
merge=$(sbatch --parsable --dependency="afterany:$array" --output="$out/logs/merge-%j.log" \
    "$here/merge.sbatch" "$grader" "$out" "$shards")
echo "shards: job $array, merge: job ${merge%%;*}; the class will be in $out/merged"
