#!/usr/bin/env bash
# Tests launch/reproduce.sh as a user meets it: what it refuses before it installs or builds, a part from a plan of a run of
# seconds, and Ctrl-C. What reproduce does with its runs is tests/ros/test_reproduce_runs.py's.
#   reproduce.sh WORK_FOLDER
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly WORK=$1 OUT=$1/out
mkdir -p "$WORK/clone/build"
# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

# plan DURATION
plan() {
    cat >"$WORK/plan.yaml" <<END
periodic: {base: quick, disks: 60, aspect: 0.2, equilibration: 5.0, warmup: 20.0, duration: $1, seconds: [1, 1]}
END
}

readonly COMMAND=("$ROOT/launch/reproduce.sh" --no-install --part 1 --plan "$WORK/plan.yaml" --out "$OUT")

# A clone without a build, in which to install or to build would fail at once.
unbuilt() {
    cp -r "$ROOT/launch" "$ROOT/hdlyap_ros" "$WORK/clone"
    printf '#!/bin/sh\necho installs\nexit 9\n' >"$WORK/clone/launch/install.sh"
}

# refuses PATTERN OPTION...: in one line, with status 2, and nothing is there that was not.
refuses() {
    local status=0 said
    said=$(cd "$WORK" && "$WORK/clone/launch/reproduce.sh" "${@:2}" 2>&1) || status=$?
    echo "$said"
    [[ $status == 2 && $said =~ $1 && $said != *$'\n'* && -z $(ls -A "$WORK/clone/build") ]]
}

helps() {
    local said
    said=$("$WORK/clone/launch/reproduce.sh" --help) && [[ $said == *--no-install*--part\ N*--quick* ]] &&
        [[ -z $(ls -A "$WORK/clone/build") ]]
}

writes_results() {
    local file commit
    commit=$(commit_here) # none without git
    for file in "$OUT"/{periodic.bag,results/{01_spectrum.png,01_exponents.csv,rows*.csv}}; do
        [[ -s $file ]] || { echo "no $file" && return 1; }
    done
    grep -q "reproduce.sh --part 1 .*/plan.yaml${commit:+ at commit $commit}\. " "$OUT"/results/results*.txt
}

# does_nothing_again: the bag stays as it is.
does_nothing_again() {
    local before
    before=$(stat -c %Y "$OUT/periodic.bag")
    run "${COMMAND[@]}" && [[ $(stat -c %Y "$OUT/periodic.bag") == "$before" ]]
}

# interrupted SIGNAL STATUS: while the run goes on; nothing is left that knows the folder that ROS was given.
interrupted() {
    local status=0 waited
    plan 1000000
    rm -f "$OUT/log/periodic.log"
    start "${COMMAND[@]}"
    for ((waited = 0; waited < 600; waited++)); do
        ! grep -qs 'waiting for subscribers' "$OUT/log/periodic.log" || break
        sleep 0.1
    done
    kill "-$1" "$CHILD"
    finish "$CHILD" || status=$?
    grep -qs 'waiting for subscribers' "$OUT/log/periodic.log" && [[ $status == "$2" && -s $OUT/periodic.bag ]] && none_is_left
}

none_is_left() { [[ -z $(grep -lzs "^ROS_HOME=$ROOT/build/home/" /proc/[0-9]*/environ || true) ]]; }

stop_at_exit
unbuilt
check refuses_a_part refuses "must be 1 \.\. " --part 99
check refuses_no_jobs refuses "must be 1 or more" --quick --jobs 0
check refuses_a_file refuses "is no folder" --out clone/launch/common.sh
check refuses_an_empty_folder refuses "is empty" --out ''
check refuses_an_option refuses "unrecognized arguments: --bogus" --bogus --no-install
check helps_before_a_build helps
plan 30
check runs run "${COMMAND[@]}"
check writes_results writes_results
check does_nothing_again does_nothing_again
check ends_on_int interrupted INT 130
exit "$FAILED"
