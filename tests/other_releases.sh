#!/usr/bin/env bash
# The two commands of README in a fresh minimal system of another Debian release, from a clean clone of what is committed. Ends
# with a row for doc/platforms.md; fails if anything did. As root, with debootstrap; no part of the suite.
#   other_releases.sh bullseye|bookworm|trixie [demo] [tests] [compilers]    which steps; demo and tests if none is named
# compilers: core, its tests, node and viewer with each gcc and clang of the release; a warning fails.
# HDLYAP_MIRROR and HDLYAP_RELEASES: see tests/fresh_system.sh.
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"
# shellcheck source=tests/fresh_system.sh
source "$ROOT/tests/fresh_system.sh"

tests() {
    step tests inside tests/run.sh || true
    TESTS="$(tail -n 1 "$(log_of tests)"), $SAID"
}

# What the release has, and what clang needs of the same version for OpenMP, one after the other: they exclude each other.
compilers_of_release() {
    inside apt-cache search --names-only '^(gcc|clang)-[0-9]+$' | sed 's/ .*//' | sort -V
}

# with_compiler NAME: all of the tree; a warning is an error, but not in headers of the system. Then the hashes of the event logs.
# shellcheck disable=SC2016
with_compiler() {
    inside bash -euc '
        version=${1#*-}
        case $1 in
            gcc-*) cxx=g++-$version needs="$1 g++-$version" ;;
            clang-*) cxx=clang++-$version needs="$1 libomp-$version-dev" ;;
        esac
        apt-get install -y -q --no-install-recommends ninja-build libcmocka-dev $needs
        rm -rf "build/$1"
        set -- "$1" "-DCMAKE_C_COMPILER=$1" "-DCMAKE_CXX_COMPILER=$cxx" -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCATKIN_ENABLE_TESTING=OFF
        cmake -S . -B "build/$1" -G Ninja "${@:2}" -DHDLYAP_CORE_TESTS=ON -DCMAKE_C_FLAGS=-Werror -DCMAKE_CXX_FLAGS=-Werror
        cmake --build "build/$1" -- -k 0
        for golden in test_golden test_spheres_golden; do "$(find "build/$1" -name "$golden" -type f)"; done' -- "$1"
}

compilers() {
    local name list
    list=$(inside launch/install.sh run >"$(log_of compilers)" 2>&1 && compilers_of_release)
    [[ -n $list ]] || die "no compilers; the log is $(log_of compilers)"
    COMPILERS=
    for name in $list; do
        if step "$name" with_compiler "$name"; then COMPILERS+="$name "; else COMPILERS+="$name (failed) "; fi
    done
}

[[ ${1:-} == @(bullseye|bookworm|trixie) ]] || die "usage: other_releases.sh bullseye|bookworm|trixie [demo] [tests] [compilers]" 2
choose_steps 'demo tests compilers' "${@:2}"
((${#STEPS[@]})) || STEPS=(demo tests)
stop_at_exit
fresh_system "$1"
for word in "${STEPS[@]}"; do "$word" || true; done
row 'roscpp | GCC | CMake | Python | OpenBLAS | demo | tests | without warnings' \
    "$(version libroscpp-dev)" "$(first_number gcc -dumpfullversion)" "$(first_number cmake --version)" \
    "$(first_number python3 --version)" "$(version libopenblas-openmp-dev)" \
    "${DEMO:-not run}" "${TESTS:-not run}" "${COMPILERS:-not run}"
leave_system
exit "$FAILED"
