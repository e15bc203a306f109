#!/usr/bin/env bash
# Builds and runs the consumer against an installed core, found in both ways that are promised.
#   check.sh PREFIX WORK_FOLDER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
prefix=$1 work=$2
mkdir -p "$work"

with_pkg_config() {
    local pc
    pc=$(find "$prefix" -name hdlyap_core.pc)
    export PKG_CONFIG_PATH=${pc%/*}
    pkg-config --cflags --libs hdlyap_core |
        xargs cc -std=c11 -Wall -Wextra -Werror "$here/consumer.c" -o "$work/with_pkg_config" -Wl,-rpath,"${pc%/pkgconfig/*}"
    env -u LD_LIBRARY_PATH "$work/with_pkg_config"
}

with_cmake() {
    cmake -S "$here" -B "$work/with_cmake" -DCMAKE_PREFIX_PATH="$prefix"
    cmake --build "$work/with_cmake"
    "$work/with_cmake/consumer"
}

# Four disks have (16 - 6) / 2 positive exponents, the largest is 3.35 (physics: N = 4, rho = 0.5).
check() {
    local log=$work/$1.log
    if ("$1") >"$log" 2>&1 && [[ $(grep -cE '^[1-5] [0-9.]+$' "$log") == 5 ]] &&
        grep -qE '^1 3\.[0-9]+$' "$log"; then
        echo "ok $1"
    else
        cat "$log"
        echo "FAILED $1"
        return 1
    fi
}

failed=0
check with_pkg_config || failed=1
check with_cmake || failed=1
exit "$failed"
