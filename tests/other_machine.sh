#!/usr/bin/env bash
# hdlyap on another kind of processor, in a fresh minimal Debian whose programs qemu-user emulates, from a clean clone of what is
# committed: hours rather than minutes. Ends with a row for doc/platforms.md; fails if anything did. As root, with debootstrap and
# qemu-user-static; no part of the suite.
#   other_machine.sh arm64 [core] [tests] [demo]    which steps; all if none is named
# core: built there, a warning is an error; then the hash of the event log. tests: of the core; for which of them an emulator is too
# slow or not the machine itself, doc/platforms.md says. demo: the first command of README.
# HDLYAP_RELEASE (bookworm) is the release; HDLYAP_MIRROR and HDLYAP_RELEASES: see tests/fresh_system.sh.
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"
# shellcheck source=tests/fresh_system.sh
source "$ROOT/tests/fresh_system.sh"

readonly TESTS_NEED=(build-essential cmake ninja-build pkg-config python3 libopenblas-openmp-dev liblapacke-dev zlib1g-dev
    libcmocka-dev)

# The kernel starts the emulator for such programs, also in a chroot where it is not to be found (flag F).
emulate() {
    local list=/proc/sys/fs/binfmt_misc
    [[ -e $list/register ]] || mount -t binfmt_misc binfmt_misc "$list"
    [[ -e $list/qemu-$1 ]] || cat "/usr/lib/binfmt.d/qemu-$1.conf" >"$list/register" || die "needs qemu-user-static"
    grep -q '^flags:.*F' "$list/qemu-$1" || die "$list/qemu-$1: must have the flag F"
}

# shellcheck disable=SC2016
build_core() {
    inside bash -euc '
        apt-get update -q
        apt-get install -y -q --no-install-recommends "$@"
        cmake -S . -B build/core -G Ninja -DHDLYAP_ROS=OFF -DHDLYAP_CORE_TESTS=ON -DCMAKE_C_FLAGS=-Werror
        cmake --build build/core
        cd build/core
        ctest --output-on-failure -R "^core_golden$" | tee golden
        grep -q "100% tests passed, 0 tests failed out of 1$" golden' -- "${TESTS_NEED[@]}"
}

core() {
    CORE=failed
    step core build_core && CORE="passed, $SAID"
}

tests() {
    [[ -d $SYSTEM$CLONE/build/core ]] || core || return 0
    step tests inside bash -c 'cd build/core && ctest --output-on-failure --timeout 7200' || true
    TESTS="$(grep -oE '[0-9]+ tests failed out of [0-9]+' "$(log_of tests)" || echo 'did not end'), $SAID"
}

[[ ${1:-} == arm64 ]] || die "usage: other_machine.sh arm64 [core] [tests] [demo]" 2
choose_steps 'core tests demo' "${@:2}"
((${#STEPS[@]})) || STEPS=(core tests demo)
stop_at_exit
emulate aarch64
fresh_system "${HDLYAP_RELEASE:-bookworm}.$1"
for word in "${STEPS[@]}"; do "$word" || true; done
row 'GCC | OpenBLAS | core | its tests | demo' "$(first_number gcc -dumpfullversion)" "$(version libopenblas-openmp-dev)" \
    "${CORE:-not run}" "${TESTS:-not run}" "${DEMO:-not run}"
leave_system
exit "$FAILED"
