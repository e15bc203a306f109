#!/usr/bin/env bash
# The node under the address and leak sanitizers; it and the parallel parts of the core under the thread sanitizer and valgrind.
#   checked.sh build first|second WORK_FOLDER            the node with the address sanitizer; first: in what is C
#   checked.sh life first|second WORK_FOLDER ROS_BUILD   of that node: one, or all; the plain build is for the messages
#   checked.sh rest second WORK_FOLDER ROS_BUILD CORE_BUILD   the plain builds are for valgrind
# Builds lie beside the folder.
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly MODE=$1 TIER=$2 WORK=$3 ROS=${4:-} CORE=${5:-} BUILDS=${3%/*}
ADDRESS=address
[[ $TIER == second ]] || ADDRESS=address_of_c
readonly PARALLEL=(frame ortho threads two_threads) # tests of the core
mkdir -p "$WORK"
# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

# build_with SANITIZER C_COMPILER CXX_COMPILER TARGET...: clang's OpenMP tells the thread sanitizer what it orders, and clang
# warns of what gcc does not. What is C++ and not looked at is compiled as in the plain build, whose results are in the cache.
build_with() {
    local sanitizer=$1 c=$2 cxx=$3 for_c=-O1 for_cxx='-O1 -Wno-maybe-uninitialized' # gcc's are of its own library
    shift 3
    [[ $sanitizer != address_of_c ]] || for_cxx='-O3 -DNDEBUG'
    [[ $c != clang* ]] || for_c+=' -Werror'
    ROS_LANG_DISABLE=genlisp:genpy cmake -S "$ROOT" -B "$BUILDS/$sanitizer" -DPYTHON_EXECUTABLE=/usr/bin/python3 \
        "-DCMAKE_C_COMPILER=$c" "-DCMAKE_CXX_COMPILER=$cxx" -DCMAKE_BUILD_TYPE=Checked \
        "-DCMAKE_C_FLAGS_CHECKED=$for_c" "-DCMAKE_CXX_FLAGS_CHECKED=$for_cxx" -DHDLYAP_CORE_TESTS=ON \
        -DHDLYAP_BENCH=OFF -DCATKIN_ENABLE_TESTING=OFF "-DHDLYAP_SANITIZE=$sanitizer"
    cmake --build "$BUILDS/$sanitizer" --target "$@" -- -j "$(nproc)"
}

# under_threads COMMAND...: with the thread sanitizer. Libraries that are not compiled with it are not looked into; their
# locks count. Copies of whole structures are lost with them.
under_threads() {
    local omp
    omp=$(sed -n 's/^OpenMP_omp_LIBRARY:FILEPATH=//p' "$BUILDS/thread/CMakeCache.txt")
    [[ -f ${omp%/*}/libarcher.so ]] || die "no libarcher.so beside $omp"
    TSAN_OPTIONS='ignore_noninstrumented_modules=1 exitcode=66' \
        OMP_TOOL_LIBRARIES="${omp%/*}/libarcher.so" "$@"
}

parallel_tests() {
    local name program
    for name in "${PARALLEL[@]}"; do
        program=$(find "$BUILDS/thread" -name "test_$name" -type f)
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
    build_with "$ADDRESS" cc c++ hdlyap_node
    exit
fi
source_setup "$ROS/devel/setup.bash"
# what a node sets by starting itself once more, which valgrind and the sanitizers do not need
export HDLYAP_RESTARTED=1 GOMP_SPINCOUNT=2000
if [[ $MODE == life ]]; then
    check address_node run live "$TIER" "$ADDRESS" "$(node_of "$BUILDS/$ADDRESS")"
else
    check thread_build build_with thread clang clang++ hdlyap_node "${PARALLEL[@]/#/hdlyap_test_}"
    check thread_core run under_threads parallel_tests
    check thread_node run under_threads live second thread "$(node_of "$BUILDS/thread")"
    check valgrind_core run core_in_valgrind
    check valgrind_node run live second valgrind "${MEMCHECK[@]}" "$(node_of "$ROS")"
fi
exit "$FAILED"
