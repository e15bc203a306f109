#!/usr/bin/env bash
# Tests doc/reproduction/reproduce.sh as a user meets it: what it refuses before it builds, and the parts of two quick runs.
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

readonly PARTS=(1 2 3 4 5 7) # of the runs halves and periodic
for number in "${PARTS[@]}"; do drawn+=(--part "$number"); done

# Also in a quick run the indices are the paper's.
writes_results() {
    local file number
    for file in {01_spectrum,02_dispersion,03_coordinates,05_p_mode,07_phases}.{png,csv} 04_fields.png rows_01_02_03_04_05_07.csv; do
        [[ -s $WORK/out/results/$file ]] || { echo "no $file" && return 1; }
    done
    file=$WORK/out/results/results_01_02_03_04_05_07.txt
    for number in "${PARTS[@]}"; do grep "^$number\. " "$file" || return 1; done
    grep '^  agrees: indices of the five smallest steps' "$file"
}

stop_at_exit
check refuses_an_option refuses --bogus
check refuses_no_value refuses --part
check runs run "$COMMAND" --no-install --quick --only "halves periodic" "${drawn[@]}" --folder "$WORK/out"
check writes_results writes_results
exit "$FAILED"
