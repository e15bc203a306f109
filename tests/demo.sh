#!/usr/bin/env bash
# Tests launch/demo.sh as a user meets it, on the scene that takes seconds.
#   demo.sh first|second WORK_FOLDER BUILD    first: one run, in that build, and what is refused; second: all, built afresh, in
#                                             a folder beside it: what is compiled alike is in the suite's cache
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly TIER=$1 WORK=$2
BUILD=$3
[[ $TIER == first ]] || BUILD=${3%/*}/demo_build
mkdir -p "$WORK/home" "$WORK/foreign"
# another python3 first on PATH, as pyenv and conda have it, that knows no ROS
printf '#!/bin/sh\necho "foreign python3" >&2\nexit 97\n' >"$WORK/foreign/python3"
chmod +x "$WORK/foreign/python3"

DEMO=(env "HOME=$WORK/home" "PATH=$WORK/foreign:$PATH" "$ROOT/launch/demo.sh" --no-install --build "$BUILD")

# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

gives_status() {
    local wanted=$1 status=0
    shift
    "$@" || status=$?
    [[ $status == "$wanted" ]]
}

demo() { "${DEMO[@]}" "$@" 2>&1 | tee "$LOG"; }

# No process of a demo is left; they are known by the folder that ROS was given.
none_is_left() {
    [[ -z $(grep -lzs "^ROS_HOME=$BUILD/home/" /proc/[0-9]*/environ || true) ]]
}

# is_complete FOLDER FIGURE...
is_complete() {
    local folder=$1 name
    shift
    for name in run.bag "${@/%/.png}" "${@/%/.svg}"; do
        [[ -s $folder/$name ]] || return 1
    done
}

# has_step PATTERN: in the table, with wave number, multiplicities and exponent with its error.
has_step() {
    grep -qE "^ +$1 .* [0-9.]+ +[0-9]+ +[0-9.]+ +[0-9.]+\([0-9.]+\)" "$LOG"
}

# as_background_job COMMAND...: with the signals ignored that such a job, or worse, is started with.
as_background_job() {
    trap '' INT QUIT TERM
    exec "$@"
}

# interrupted SIGNAL [PREFIX]...: the exit status of a demo that gets the signal while its node runs.
interrupted() {
    local waited
    start "${@:2}" "${DEMO[@]}" --scene quick --duration 100000 --out "$WORK/interrupted" >"$LOG" 2>&1
    for ((waited = 0; waited < 600; waited++)); do
        grep -qs averaging "$LOG" && break
        sleep 0.1
    done
    kill "-$1" "$CHILD"
    finish "$CHILD"
}

stop_at_exit
LOG=$WORK/refused.log
check refuses_a_scene gives_status 2 demo --scene nowhere
check refuses_an_option gives_status 2 demo --bogus
LOG=$WORK/first.log
check runs gives_status 0 demo --scene quick --duration 100 --out "$WORK/out"
check writes_all_files is_complete "$WORK/out" spectrum convergence steps dispersion modes cost
check prints_the_table grep -q '^lambda_max' "$LOG"
check names_a_step has_step 'T\(1,0\)'
check leaves_home_alone test -z "$(ls -A "$WORK/home")"
[[ $TIER == second ]] || exit "$FAILED"

LOG=$WORK/channel.log
check runs_a_channel gives_status 0 demo --scene narrow --duration 1200 --out "$WORK/channel"
check names_an_lp_step has_step 'LP\(1,0\)'
check writes_lp_figures is_complete "$WORK/channel" spectrum steps dispersion modes p_mode phases
LOG=$WORK/second.log
check runs_again gives_status 0 demo --scene quick --duration 100 --out "$WORK/out"
check keeps_the_old_bag test -s "$WORK/out/run.bag.old"
check builds_once gives_status 1 grep -E 'Building|Linking' "$BUILD/log/build.log"
LOG=$WORK/int.log
check ends_on_int gives_status 130 interrupted INT as_background_job
check leaves_nothing_after_int none_is_left
LOG=$WORK/term.log
check ends_on_term gives_status 143 interrupted TERM
check leaves_nothing_after_term none_is_left
exit "$FAILED"
