#!/usr/bin/env bash
# Tests doc/reproduction/reproduce.sh as a user meets it: what it refuses before it builds, and the part of one run of seconds.
# What hdlyap sweep does with its runs is tests/ros/test_work.py's.
#   reproduce.sh WORK_FOLDER
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly WORK=$1 COMMAND=$ROOT/doc/reproduction/reproduce.sh
mkdir -p "$WORK"
# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

# refuses OPTION...: in one line, with status 2.
refuses() {
    local status=0 said
    said=$("$COMMAND" "$@" 2>&1) || status=$?
    echo "$said"
    [[ $status == 2 && $said == *"$1"*--help* && $said != *$'\n'* ]]
}

writes_results() {
    local file
    for file in halves.bag results/{03_coordinates.png,03_coordinates.csv,results_03.txt,rows_03.csv}; do
        [[ -s $WORK/out/$file ]] || { echo "no $file" && return 1; }
    done
    grep -q '^3\. ' "$WORK/out/results/results_03.txt"
}

stop_at_exit
check refuses_an_option refuses --bogus
check refuses_no_value refuses --part
check runs run "$COMMAND" --no-install --quick --only halves --part 3 --folder "$WORK/out"
check writes_results writes_results
exit "$FAILED"
