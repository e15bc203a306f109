#!/usr/bin/env bash
# The node under the address and leak sanitizers; it and the parallel parts of the core under the thread sanitizer and valgrind.
#   checked.sh build WORK_FOLDER                      with the address sanitizer
#   checked.sh life first|second WORK_FOLDER ROS_BUILD   of that node, one or all; the plain build is for the messages
#   checked.sh rest WORK_FOLDER ROS_BUILD CORE_BUILD   the plain builds are for valgrind
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly MODE=$1
[[ $MODE != life ]] || { readonly TIER=$2 && shift; }
readonly WORK=$2 ROS=${3:-} CORE=${4:-}
readonly PARALLEL=(frame ortho threads two_threads) # tests of the core
mkdir -p "$WORK"
# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

# build_with SANITIZER C_COMPILER CXX_COMPILER TARGET...: clang's OpenMP tells the thread sanitizer what it orders.
build_with() {
    local sanitizer=$1 c=$2 cxx=$3
    shift 3
    ROS_LANG_DISABLE=genlisp:genpy cmake -S "$ROOT" -B "$WORK/$sanitizer" -G Ninja -DPYTHON_EXECUTABLE=/usr/bin/python3 \
        "-DCMAKE_C_COMPILER=$c" "-DCMAKE_CXX_COMPILER=$cxx" -DCMAKE_BUILD_TYPE=Debug \
        -DCMAKE_C_FLAGS=-O1 -DCMAKE_CXX_FLAGS=-O1 -DHDLYAP_CORE_TESTS=ON -DCATKIN_ENABLE_TESTING=OFF \
        "-DHDLYAP_SANITIZE=$sanitizer"
    cmake --build "$WORK/$sanitizer" --target "$@" -- -j "$(nproc)"
}

# under_threads COMMAND...: with the thread sanitizer. Libraries that are not compiled with it are not looked into; their
# locks count. Copies of whole structures are lost with them.
under_threads() {
    local omp
    omp=$(sed -n 's/^OpenMP_omp_LIBRARY:FILEPATH=//p' "$WORK/thread/CMakeCache.txt")
    [[ -f ${omp%/*}/libarcher.so ]] || die "no libarcher.so beside $omp"
    TSAN_OPTIONS='ignore_noninstrumented_modules=1 exitcode=66' \
        OMP_TOOL_LIBRARIES="${omp%/*}/libarcher.so" "$@"
}

parallel_tests() {
    local name program
    for name in "${PARALLEL[@]}"; do
        program=$(find "$WORK/thread" -name "test_$name" -type f)
        "$program"
    done
}

readonly MEMCHECK=(valgrind --quiet --leak-check=full --errors-for-leak-kinds=definite
    --show-leak-kinds=definite --error-exitcode=9 "--suppressions=$ROOT/tests/log4cxx.supp")

# 12 disks between walls, all vectors, modes, steps and phases, 5 time units
core_in_valgrind() {
    "${MEMCHECK[@]}" "$(find "$CORE" -name hdlyap_load -type f)" 12 0.7 1 0 1 -2 7 5
}

# live TIER NAME COMMAND...: a node's short life, see sanitized.py.
live() {
    "$ROOT/tests/ros/sanitized.py" "$@"
}

node_of() { find "$1" -path '*/devel/lib/hdlyap/hdlyap_node' -type f; }

stop_at_exit
own_environment "$WORK/home"
if [[ $MODE == build ]]; then
    build_with address gcc g++ hdlyap_node
    exit
fi
source_setup "$ROS/devel/setup.bash"
# what a node sets by starting itself once more, which valgrind and the sanitizers do not need
export HDLYAP_RESTARTED=1 GOMP_SPINCOUNT=2000
if [[ $MODE == life ]]; then
    check address_node run live "$TIER" address "$(node_of "$WORK/address")"
else
    check thread_build build_with thread clang clang++ hdlyap_node "${PARALLEL[@]/#/hdlyap_test_}"
    check thread_core run under_threads parallel_tests
    check thread_node run under_threads live second thread "$(node_of "$WORK/thread")"
    check valgrind_core run core_in_valgrind
    check valgrind_node run live second valgrind "${MEMCHECK[@]}" "$(node_of "$ROS")"
fi
exit "$FAILED"
