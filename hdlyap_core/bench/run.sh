#!/usr/bin/env bash
# Builds the benchmark programs that are missing, runs all, prints their tables, and leaves CSV files and pictures in a
# folder: what accuracy costs in time, what a run and its effects cost, how costs grow.
#   run.sh [--out DIR] [--quick] [--programs DIR]
# --programs: folder of programs that are built already.
set -euo pipefail

HERE=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
ROOT=$(cd "$HERE/../.." && pwd)
BUILD=$ROOT/build/core
OUT=$ROOT/build/bench
QUICK=()
PROGRAMS=

die() {
    printf 'run.sh: %s\n' "$1" >&2
    exit "$2"
}

while (($#)); do
    case $1 in
        --out)
            (($# > 1)) || die '--out: needs a folder' 2
            OUT=$2
            shift
            ;;
        --programs)
            (($# > 1)) || die '--programs: needs a folder' 2
            PROGRAMS=$2
            shift
            ;;
        --quick) QUICK=(--quick) ;;
        *) die "$1: not known; usage: run.sh [--out DIR] [--quick] [--programs DIR]" 2 ;;
    esac
    shift
done

build() {
    if [[ ! -f $BUILD/CMakeCache.txt ]]; then
        cmake -S "$ROOT/hdlyap_core" -B "$BUILD" -G 'Unix Makefiles' -DHDLYAP_CORE_TESTS=OFF
    fi
    cmake --build "$BUILD" -- -j "$(nproc)"
}

# The build without ROS puts the programs one folder deeper than that of the core alone.
find_programs() {
    local dir
    for dir in "$BUILD/bench" "$BUILD/hdlyap_core/bench"; do
        [[ ! -x $dir/hdlyap_precision ]] || PROGRAMS=$dir
    done
    [[ -n $PROGRAMS ]] || die "no programs in $BUILD" 1
}

DONE=0
TOTAL=0

# stage SHARE TITLE COMMAND...: the share is about the seconds on two idle cores; in a quick run all shares are equal.
stage() {
    local share=$1 title=$2 left
    shift 2
    ((!${#QUICK[@]})) || share=1
    left=$((TOTAL - DONE))
    ((DONE == 0)) || left=$((left * (SECONDS - BEGAN) / DONE))
    printf '\n== %s (%d s gone, about %d s left)\n' "$title" $((SECONDS - BEGAN)) "$left"
    "$@"
    DONE=$((DONE + share))
}

fallback() { OPENBLAS_CORETYPE=Prescott "$PROGRAMS/hdlyap_bench" "$@"; }

# The cost of publishing is measured with the node, if its package is built and sourced.
effects() {
    "$PROGRAMS/hdlyap_effects" --out "$OUT"
    if /usr/bin/python3 -c 'import hdlyap.msg' 2>/dev/null; then
        "$HERE/effects_publishing" "$OUT/effects.csv"
    fi
}

run_all() {
    local -a whole=(--whole --out "$OUT") small=()
    local with_effects=0
    if ((${#QUICK[@]})); then
        small=(--disks 64)
    elif [[ -x $PROGRAMS/hdlyap_effects ]]; then
        with_effects=1
    fi
    TOTAL=$((${#QUICK[@]} ? 6 : 662))
    if ((with_effects)); then TOTAL=$((TOTAL + 60)); fi
    stage 220 'what accuracy costs' "$PROGRAMS/hdlyap_precision" --out "$OUT" "${QUICK[@]}"
    stage 300 'how cost grows' "$PROGRAMS/hdlyap_scaling" --out "$OUT" "${QUICK[@]}"
    stage 15 'a whole run to its floor' "$PROGRAMS/hdlyap_bench" "${whole[@]}" "${small[@]}"
    stage 5 'the same, N = 100, one thread' "$PROGRAMS/hdlyap_bench" "${whole[@]}" --name whole_small \
        --disks 100 --threads 1 --duration 40
    if [[ $(uname -m) == x86_64 ]]; then
        stage 30 "the same on OpenBLAS's oldest kernels" fallback "${whole[@]}" "${small[@]}" --duration 8 \
            --name whole_fallback
    fi
    if ((!${#QUICK[@]})); then
        stage 12 'events alone, and one exponent' "$PROGRAMS/hdlyap_bench" --events
        stage 20 'a step of soft disks' "$PROGRAMS/hdlyap_steps"
    fi
    if ((with_effects)); then
        stage 60 'what each effect costs' effects
    fi
    stage 5 'pictures' draw
}

draw() {
    local scratch=$PROGRAMS/matplotlib
    mkdir -p "$scratch"
    MPLCONFIGDIR=$scratch PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "$HERE/draw.py" "$OUT"
}

BEGAN=$SECONDS
mkdir -p "$OUT" || die "$OUT: cannot be made" 4
if [[ -z $PROGRAMS ]]; then
    mkdir -p "$ROOT/build"
    LOG=$ROOT/build/bench_build.log
    build >"$LOG" 2>&1 || die "the build failed; all of it is in $LOG" 1
    find_programs
fi
run_all
printf '\nCSV files and pictures are in %s (%d s)\n' "$OUT" $((SECONDS - BEGAN))
