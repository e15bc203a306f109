#!/usr/bin/env bash
# Every test of hdlyap, built afresh below build/check. Its last line is 'N passed, N failed'. The machine may be busy: tests
# of core and node, of tools and README that fail run once more, alone; what passes then counts, but is named.
#   run.sh [--no-install]
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly WORK=$ROOT/build/check # not build/tests: cmake puts the folder tests there
readonly PREFIX="$WORK/a prefix σ" # a name that pkg-config writes in another way
readonly LOGS=$WORK/log COUNTS=$WORK/counts SECOND=$WORK/second TAKEN=$WORK/taken
export TMPDIR=$WORK/tmp XDG_RUNTIME_DIR=$WORK/runtime
export LC_ALL=C.UTF-8 # of messages that tests read
unset LANGUAGE
export HDLYAP_SUITE=$$.$EPOCHREALTIME # marks its processes
# Core and wrapper are compiled alone, for ROS and for the demo, each time the same: a cache of this run's own.
readonly CACHE=(CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache "CCACHE_DIR=$WORK/ccache" CCACHE_NOHASHDIR=1
    "CCACHE_BASEDIR=$ROOT")
export "${CACHE[@]}"

# ---- the stages ------------------------------------------------------------------------------

shell_scripts() {
    cd "$ROOT"
    shellcheck -x --exclude=SC2317 launch/*.sh launch/*.sbatch tests/*.sh tests/install/*.sh tests/fuzz/*.sh hdlyap_core/bench/*.sh .ci/run
}

# without_ros COMMAND...: as on a machine that has no ROS.
without_ros() {
    env -i HOME="$HOME" PATH=/usr/bin:/bin LC_ALL=C.UTF-8 "TMPDIR=$TMPDIR" "HDLYAP_SUITE=$HDLYAP_SUITE" "${CACHE[@]}" "$@"
}

core_build() {
    without_ros cmake -S "$ROOT" -B "$WORK/core" -G Ninja -DHDLYAP_ROS=OFF \
        -DCMAKE_DISABLE_FIND_PACKAGE_catkin=ON -DCMAKE_INSTALL_PREFIX="$PREFIX" "$@"
    without_ros cmake --build "$WORK/core" -- -j "$(nproc)"
}

core_install() {
    without_ros cmake --install "$WORK/core"
    without_ros "$ROOT/tests/install/check.sh" "$PREFIX" "$WORK/install"
}

sanitizers_build() {
    without_ros cmake -S "$ROOT/hdlyap_core" -B "$WORK/sanitizers" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
        -DCMAKE_C_FLAGS=-O1 -DHDLYAP_SANITIZE=ON -DHDLYAP_VERIFY=ON
    without_ros cmake --build "$WORK/sanitizers" -- -j "$(nproc)"
}

# Installed, it would take the place of the OpenBLAS in use: one more to compare with, in a folder of its own.
other_blas() {
    mkdir -p "$WORK/blas"
    cd "$WORK/blas"
    apt-get download libopenblas0-pthread
    dpkg -x libopenblas0-pthread_*.deb .
}

core_ctest() {
    local folders=("$WORK"/blas/usr/lib/*/)
    HDLYAP_BLAS=${folders[0]} run_ctest "$WORK/core" "$(nproc)"
}

# run_ctest FOLDER JOBS: what fails once more, with a log of its own.
run_ctest() {
    local log status=0
    log=$LOGS/$(basename "$1").second.log
    cd "$1"
    ctest --output-on-failure -j "$2" && return
    say "what failed, once more: $log"
    ctest --rerun-failed --output-on-failure -j 1 >"$log" 2>&1 || status=$?
    sed -nE 's|^ *[0-9]+/[0-9]+ Test +#[0-9]+: (.*[^ .]) \.+ +Passed .*|passed on the second try: \1|p' "$log"
    return "$status"
}

ros_build() {
    build "$WORK/ros" -DCATKIN_ENABLE_TESTING=ON -DHDLYAP_CORE_TESTS=OFF \
        "-DCMAKE_INSTALL_PREFIX=$WORK/ros/.install"
    cmake --build "$WORK/ros" --target tests -- -j "$(nproc)"
    cmake --install "$WORK/ros"
    # catkin keeps the environment of the tests as it is when configured: devel was empty then
    cmake "$WORK/ros"
}

# What run_tests of catkin runs, but several at a time: each has a master of its own, and mostly waits.
ros_tests() {
    source_setup "$WORK/ros/devel/setup.bash"
    run_ctest "$WORK/ros" $(($(nproc) + 1)) || true
    catkin_test_results --verbose "$WORK/ros/test_results"
}

# Those of tests/ros that no rostest runs, each file in a process of its own; files with a failure once more.
plot_tests() {
    local file folder=$WORK/unittest status=0
    source_setup "$WORK/ros/devel/setup.bash"
    cd "$ROOT/tests/ros"
    mkdir -p "$folder"
    # shellcheck disable=SC2016
    for file in test_*.py; do
        grep -qF "\"$file\"" ./*.test || echo "${file%.py}"
    done | env "FOLDER=$folder" xargs -P "$(nproc)" -I MODULE sh -c '
        python3 -m unittest -v MODULE >"$FOLDER/MODULE.log" 2>&1 || mv "$FOLDER/MODULE.log" "$FOLDER/MODULE.first"' ||
        status=1
    for file in "$folder"/*.first; do
        [[ ! -e $file ]] || unittest_again "${file%.first}" || status=1
    done
    cat "$folder"/*.log
    return "$status"
}

# unittest_again FOLDER/MODULE
unittest_again() {
    say "what failed, once more: $1.first"
    python3 -m unittest -v "$(basename "$1")" >"$1.log" 2>&1 || return 1
    echo "passed on the second try: $(basename "$1")"
}

downstream() { "$ROOT/tests/install/ros.sh" "$WORK/downstream" "$WORK/ros" "$WORK/ros/.install"; }

lint() {
    # the folder of a clone may have any name
    catkin_lint --offline --strict -W2 --ignore package_path_name "$ROOT" "$ROOT/tests/downstream"
}

# sources FIND_EXPRESSION...: files of the repository, without what is built.
sources() { find . \( -name build -o -name .git \) -prune -o -type f \( "$@" \) -print; }

# As the formatters of Debian 12 have it, whose versions differ in details.
format() {
    local -a in_c in_python
    cd "$ROOT"
    mapfile -t in_c < <(sources -name '*.[ch]' -o -name '*.[ch]pp' -o -name '*.inc')
    mapfile -t in_python < <(sources -name '*.py' && sources ! -name '*.*' -exec grep -qE '^#!/usr/bin/(env )?python3' {} \;)
    clang-format --dry-run -Werror "${in_c[@]}" && BLACK_CACHE_DIR=$WORK/black black --check "${in_python[@]}" &&
        flake8 "${in_python[@]}"
}

# The public headers, as they are installed: of parameters and names that do not exist.
public_headers() {
    mkdir -p "$WORK/doxygen"
    cd "$WORK/ros/.install/include"
    {
        cat "$ROOT/tests/doxygen/Doxyfile"
        printf "%s\n" "INPUT = hdlyap hdlyap_ros" "INCLUDE_PATH = ." "OUTPUT_DIRECTORY = $WORK/doxygen"
    } | doxygen - >"$WORK/doxygen/said" 2>&1
    cat "$WORK/doxygen/said"
    [[ ! -s $WORK/doxygen/said ]] && python3 "$ROOT/tests/doxygen/names.py" "$WORK/doxygen/xml"
}

warnings() {
    ! grep -n ': warning:' "$LOGS"/*_build.log
}

# Nothing may be left of the suite: no process, no file among the temporary ones, no lock of a screen.
leftovers() {
    local pid lock status=0
    for pid in $(cd /proc && grep -lzsxF "HDLYAP_SUITE=$HDLYAP_SUITE" [0-9]*/environ | cut -d/ -f1); do
        ps -o pid=,args= -p "$pid" && status=1
    done
    while read -r lock; do
        is_running "$(tr -d ' ' <"$lock")" || { echo "$lock" && status=1; }
    done < <(find /tmp -maxdepth 1 -name '.X*-lock' -user "$(id -un)" -newer "$TAKEN.since")
    find "$TMPDIR" -mindepth 1 | grep . && status=1
    return "$status"
}

# ---- how many tests a log reports: total and failed ------------------------------------------

count_one() { echo 1 0; }

count_ctest() {
    awk 'match($0, /[0-9]+ tests? failed out of [0-9]+/) { split(substr($0, RSTART), word); total = word[6]; failed = word[1] }
         /^passed on the second try: / { failed-- }
         END { print total + 0, failed + 0 }' "$1"
}

# of the last try of each, whose results replace the first ones; a test that was skipped has not passed
count_catkin() {
    sed -nE 's/^Summary: ([0-9]+) tests, ([0-9]+) errors, ([0-9]+) failures, ([0-9]+) skipped.*/\1 \2 \3 \4/p' \
        "$1" | awk '{ print $1, $2 + $3 + $4 }'
}

count_unittest() {
    awk '/^Ran / { total += $2 } /\.\.\. (FAIL|ERROR|skipped)/ { failed++ }
         END { print total + 0, failed + 0 }' "$1"
}

count_checks() {
    awk '/^ok / { ok++ } /^FAILED / { failed++ } END { print ok + failed + 0, failed + 0 }' "$1"
}

# stage NAME COUNTER COMMAND...
stage() {
    local name=$1 counter=$2 log=$LOGS/$1.log status=0 total=0 failed=0 TIMEFORMAT='%0R %0U %0S'
    shift 2
    { time run "$@" >"$log" 2>&1; } 2>"$log.time" || status=$?
    read -r total failed < <("count_$counter" "$log") || true
    # neither a crash behind the last test nor a run without tests is a success
    if ((total == 0 || status != 0 && failed == 0)); then
        failed=1
        total=$((total > 0 ? total : 1))
    fi
    report "$name" $((total - failed)) "$failed" "$log" >"$log.report"
    flock "$COUNTS" cat "$log.report" # in one piece: the other lane reports too
}

# report NAME PASSED FAILED LOG: with seconds, and those of processors, where they were measured.
report() {
    local seconds=0 user=0 system=0
    read -r seconds user system < <(tail -n 1 "$4.time" 2>/dev/null) || true
    echo "$2 $3" >>"$COUNTS"
    printf '%-18s %4d passed %4d failed %5d s %5d s of processors\n' "${@:1:3}" "$seconds" $((user + system))
    grep '^passed on the second try: ' "$4" | tee -a "$SECOND" || true
    if (($3)); then
        tail -n 60 "$4"
        say "all of it is in $4"
    fi
}

has_reported() { [[ -s $LOGS/$1.log.report ]]; }

# ---- two lanes beside each other: what computes, and what mostly waits for ROS -----------------

# lane FUNCTION: its stages one after the other, in a process that ends what it has started.
lane() {
    CHILDREN=()
    stop_at_exit
    "$1"
}

# A lane stops its own; unlike stop, which insists after a while, this leaves it the time.
end_lanes() {
    local pid
    for pid in "${CHILDREN[@]}"; do kill -TERM "$pid" 2>/dev/null || true; done
    for pid in "${CHILDREN[@]}"; do wait "$pid" || true; done
}

# gives way: the other lane holds a node to what it does within a second
core_lane() {
    renice -n 5 "$BASHPID" >/dev/null
    stage core_build one core_build
    [[ $INSTALL == no ]] || stage other_blas one other_blas
    stage core_tests ctest core_ctest
    stage core_install checks core_install
    stage sanitizers_build one sanitizers_build
    stage sanitizers_tests ctest run_ctest "$WORK/sanitizers" "$(nproc)"
    stage fuzz checks without_ros "$ROOT/tests/fuzz/run.sh" "$WORK/fuzz"
    until has_reported ros_build || ! is_running "$ros"; do sleep 1; done
    either_lane
}

ros_lane() {
    stage ros_build one ros_build
    stage ros_tests catkin ros_tests
    either_lane
}

# What needs both builds, the longest first. Demo and reproduce build in one folder: one after the other.
either_lane() {
    first checked checks "$ROOT/tests/checked.sh" "$WORK/checked" "$WORK/core" "$WORK/ros"
    first readme checks "$ROOT/tests/readme.sh" "$WORK/readme" "$WORK/ros/.install/setup.bash"
    first demo checks flock -o "$TAKEN.build" "$ROOT/tests/demo.sh" "$WORK/demo"
    first downstream checks downstream
    first plot_tests unittest plot_tests
    ! can_slurm || first slurm checks "$ROOT/tests/slurm.sh" "$WORK/slurm" "$WORK/ros/.install/setup.bash"
    ! can_ssh || first ssh checks "$ROOT/tests/ssh.sh" "$WORK/ssh" "$WORK/ros/.install/setup.bash"
    first reproduce checks flock -o "$TAKEN.build" "$ROOT/tests/reproduce.sh" "$WORK/reproduce"
    first lint one lint
    [[ $(clang-format --version) != *' 14.'* ]] || first format one format
    first doxygen one public_headers
}

# A Slurm of the suite's own needs root.
can_slurm() { ((EUID == 0)) && command -v slurmctld slurmd srun >/dev/null; }

# Nor do machines of its own go without root: they are network namespaces on a bridge.
can_ssh() {
    ((EUID == 0)) && command -v sshd ip >/dev/null && ip netns add "hdlyap$$" && ip netns del "hdlyap$$" &&
        ip link add "hdlyap$$" type bridge && ip link del "hdlyap$$"
} 2>/dev/null

# first NAME COUNTER COMMAND...: the stage, in the lane that comes first.
first() { ! mkdir "$TAKEN/$1" 2>/dev/null || stage "$@"; }

[[ $ROOT != *[[:space:]]* ]] || die "$ROOT: catkin runs no tests in a folder with a blank in its name; builds and demo do there" 2
INSTALL=yes
case ${1:-} in
    --no-install) INSTALL=no ;;
    # packages find no folder there yet
    '') env -u TMPDIR -u XDG_RUNTIME_DIR "$ROOT/launch/install.sh" test ;;
    *) die "usage: run.sh [--no-install]" 2 ;;
esac
stop_at_exit
trap end_lanes EXIT
rm -rf "$WORK"
can_write "$WORK" || die "the folder of the clone must be one that can be written"
mkdir -p "$LOGS" "$TAKEN" "$TMPDIR"
mkdir -m 700 "$XDG_RUNTIME_DIR"
: >"$SECOND"
: >"$TAKEN.since"
own_environment "$WORK/home"

stage shell_scripts one shell_scripts
whole=0
start lane ros_lane
ros=$CHILD
start lane core_lane
finish "$CHILD" || whole=1
finish "$ros" || whole=1
stage warnings one warnings
stage leftovers one leftovers
can_ssh || say "ssh: skipped, needs root, openssh-server and iproute2"
can_slurm || say "slurm: skipped, needs root, slurmctld, slurmd and slurm-client"
((!whole)) || report "end of a lane" 0 1 "$COUNTS"

cat "$SECOND"
awk '{ passed += $1; failed += $2 } END { print passed " passed, " failed + 0 " failed"; exit failed > 0 }' "$COUNTS"
