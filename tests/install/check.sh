#!/usr/bin/env bash
# Builds and runs the consumer against an installed core, found in both ways that are promised; and the studies of doc/findings/.
#   check.sh PREFIX WORK_FOLDER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
prefix=$1 WORK=$2
mkdir -p "$WORK"
# shellcheck source=tests/check.sh
source "$here/../check.sh"

# Four disks have (16 - 6) / 2 positive exponents, the largest is 3.35 (physics: N = 4, rho = 0.5).
is_spectrum() {
    "$@" | tee "$WORK/said"
    [[ $(grep -cE '^[1-5] [0-9.]+$' "$WORK/said") == 5 ]] && grep -qE '^1 3\.[0-9]+$' "$WORK/said"
}

# compile SOURCE PROGRAM
compile() (
    pc=$(find "$prefix" -name hdlyap_core.pc)
    export PKG_CONFIG_PATH=${pc%/*}
    pkg-config --cflags --libs hdlyap_core |
        xargs cc -std=c11 -Wall -Wextra -Werror "$1" -o "$2" -lm -Wl,-rpath,"${pc%/pkgconfig/*}"
)

with_pkg_config() {
    compile "$here/consumer.c" "$WORK/with_pkg_config" && is_spectrum env -u LD_LIBRARY_PATH "$WORK/with_pkg_config"
}

# with_cmake SOURCES FOLDER
with_cmake() { cmake -S "$1" -B "$WORK/$2" -DCMAKE_PREFIX_PATH="$prefix" && cmake --build "$WORK/$2"; }

consumer() { with_cmake "$here" with_cmake && is_spectrum "$WORK/with_cmake/consumer"; }

studies() { with_cmake "$here/../../doc/findings" studies && "$here/studies.py" "$WORK/studies"; }

# The example of doc/core.md: 16 particles have 14 pairs and four zeros; with beta = 0 all of eight vanish.
chain() {
    compile "$prefix/share/hdlyap/examples/chain.c" "$WORK/chain" &&
        "$WORK/chain" 16 1 | awk '{ x[$1] = $2 } END { for (k = 1; k <= 16; k++) bad += x[k] != -x[33 - k]
            exit bad || !(NR == 32 && x[1] > 0.08 && x[1] < 0.13 && x[13] > 0.005 && x[15] < 0.005) }' &&
        "$WORK/chain" 8 0 | awk '{ if ($2 > 0.003 || $2 < -0.003) bad = 1 } END { exit bad || NR != 16 }' &&
        [[ $("$WORK/chain" 2) == "number = 2: must be 3 or more with particles = chain" ]]
}

check chain chain
check with_pkg_config with_pkg_config
check with_cmake consumer
check studies studies
exit "$FAILED"
