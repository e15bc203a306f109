#!/usr/bin/env bash
# Builds the fuzzers with clang and runs each for so many inputs, from the same seeds every time.
#   run.sh WORK_FOLDER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly WORK=$1
# shellcheck source=tests/check.sh
source "$here/../check.sh"

build() {
    cmake -S "$here" -B "$WORK/build" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS=-O1
    cmake --build "$WORK/build" -- -j "$(nproc)"
}

# fuzz TARGET CORPUS RUNS OPTION...: a leak, an input that takes 10 s or 2 GB of memory are findings too.
fuzz() {
    local target=$1 corpus=$WORK/corpus/$2 runs=$3
    shift 3
    mkdir -p "$corpus"
    "$WORK/build/$target" -runs="$runs" -seed=1 -timeout=10 -rss_limit_mb=2048 \
        -artifact_prefix="$WORK/$target-" "$@" "$corpus"
}

# Single elements of a run whose phases are followed: among all seeds and changes too few are met.
fuzz_phases() {
    unset HDLYAP_SEEDS
    mkdir -p "$WORK/corpus/phases"
    cp "$WORK/corpus/checkpoint/steps_24_3" "$WORK/corpus/phases" || return
    fuzz fuzz_checkpoint phases 4000 -mutate_depth=1
}

rm -rf "$WORK/corpus"
mkdir -p "$WORK/corpus/checkpoint"
# few threads and no pool: what a file asks for is not this machine's to give
export OMP_THREAD_LIMIT=2 OPENBLAS_NUM_THREADS=1 HDLYAP_SEEDS=$WORK/corpus/checkpoint
check fuzz_build build
check fuzz_settings fuzz fuzz_settings settings 60000 -max_len=400 -len_control=0
check fuzz_checkpoint fuzz fuzz_checkpoint checkpoint 20000
check fuzz_phases fuzz_phases
exit "$FAILED"
