#!/usr/bin/env bash
# The tests of hdlyap, built afresh below build/check; the last line is 'N passed, N failed'. tests/README.md says what lies
# where.
#   run.sh [--all] [--no-install]    without --all: the first tier, for after a change; what each stage is stands below
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly WORK=$ROOT/build/check # not build/tests: cmake puts the folder tests there
readonly PREFIX="$WORK/a prefix σ" # a name that pkg-config writes in another way
readonly LOGS=$WORK/log COUNTS=$WORK/counts TAKEN=$WORK/taken
export TMPDIR=$WORK/tmp XDG_RUNTIME_DIR=$WORK/runtime
export LC_ALL=C.UTF-8 # of messages that tests read
unset LANGUAGE LANG # the cache asks whether they are the same, too
export ROS_LANG_DISABLE=genlisp # messages that no test reads
export HDLYAP_SUITE=$$.$EPOCHREALTIME # marks its processes
# Core and wrapper are compiled alone, for ROS and for the demo, each time the same: a cache of this run's own.
# Commands are the same only with one generator.
readonly CACHE=(CMAKE_GENERATOR=Ninja CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache "CCACHE_DIR=$WORK/ccache" CCACHE_NOHASHDIR=1
    "CCACHE_BASEDIR=$ROOT")
export "${CACHE[@]}"

# ---- the table of stages: name, which is its function's; how its log is counted; its tier; what comes before it. A stage that
# ---- waits for other programs goes before one that only computes, and a long one before a short one.

readonly STAGES='
shell_scripts     one      first  -
library           one      first  -
ros_build         one      first  library
core_build        one      first  library
ros_tests         catkin   first  ros_build
life_build        one      first  ros_build
life              checks   first  life_build
demo              checks   first  ros_build
core_tests        ctest    first  core_build,blas
tools_tests       pytest   first  ros_build
lint              one      first  -
format            one      first  -
weight            one      first  -
standards         one      second ros_build,core_build
blas              one      second -
checked           checks   second ros_build,core_build
readme            checks   second ros_build
sanitizers_build  one      second core_build
sanitizers_tests  ctest    second sanitizers_build
downstream        checks   second ros_build
one_more          checks   second ros_build,core_build
reproduce         checks   second demo
slurm             checks   second ros_build
ssh               checks   second ros_build
core_install      checks   second core_build
fuzz              checks   second -
doxygen           one      second ros_build
'
# ---- the stages ------------------------------------------------------------------------------

shell_scripts() {
    cd "$ROOT"
    shellcheck -x --exclude=SC2317 launch/*.sh launch/*.sbatch doc/reproduction/*.sh tests/*.sh tests/install/*.sh tests/fuzz/*.sh hdlyap_core/bench/*.sh .ci/run
}

# without_ros COMMAND...: as on a machine that has no ROS.
without_ros() {
    env -i HOME="$HOME" PATH=/usr/bin:/bin LC_ALL=C.UTF-8 "TMPDIR=$TMPDIR" "HDLYAP_SUITE=$HDLYAP_SUITE" "${CACHE[@]}" "$@"
}

# First, so that nobody compiles at the same time what is then in the cache.
library() {
    without_ros cmake -S "$ROOT" -B "$WORK/core" -DHDLYAP_ROS=OFF \
        -DHDLYAP_BENCH="$([[ $TIER == second ]] && echo ON || echo OFF)" -DCMAKE_DISABLE_FIND_PACKAGE_catkin=ON -DCMAKE_INSTALL_PREFIX="$PREFIX"
    without_ros cmake --build "$WORK/core" --target hdlyap_core -- -j "$(nproc)"
}

core_build() { without_ros cmake --build "$WORK/core" -- -j "$(nproc)"; }

# What the oldest compilers make of the sources.
standards() { "$ROOT/tests/standards.py" "$WORK/core" "$WORK/ros"; }

core_install() {
    without_ros cmake --install "$WORK/core"
    without_ros "$ROOT/tests/install/check.sh" "$PREFIX" "$WORK/install"
}

sanitizers_build() {
    without_ros cmake -S "$ROOT/hdlyap_core" -B "$WORK/sanitizers" -DCMAKE_BUILD_TYPE=Debug \
        -DCMAKE_C_FLAGS=-O1 -DHDLYAP_SANITIZE=ON -DHDLYAP_VERIFY=ON
    without_ros cmake --build "$WORK/sanitizers" -- -j "$(nproc)"
}

# Installed, it would take the place of the OpenBLAS in use: one more to compare with, in a folder of its own.
blas() {
    mkdir -p "$WORK/blas"
    cd "$WORK/blas"
    apt-get download libopenblas0-pthread
    dpkg -x libopenblas0-pthread_*.deb .
}
can_blas() { [[ $INSTALL == yes ]]; }

core_tests() {
    local folders=("$WORK"/blas/usr/lib/*/)
    [[ $TIER == first ]] || export HDLYAP_SECOND_TIER=1 # more cases of a kind
    HDLYAP_BLAS=${folders[0]} run_ctest "$WORK/core" "$(nproc)"
}

sanitizers_tests() { run_ctest "$WORK/sanitizers" "$(nproc)"; }

# run_ctest FOLDER JOBS: those of the tier.
run_ctest() {
    local -a choice=()
    [[ $TIER == second ]] || choice=(-LE second_tier)
    cd "$1"
    ctest --output-on-failure -j "$2" "${choice[@]}"
}

ros_build() {
    build "$WORK/ros" -DCATKIN_ENABLE_TESTING=ON -DHDLYAP_CORE_TESTS=OFF \
        "-DCMAKE_INSTALL_PREFIX=$WORK/ros/.install"
    cmake --build "$WORK/ros" --target tests -- -j "$(nproc)"
    cmake --install "$WORK/ros"
    # catkin keeps the environment of the tests as it is when configured: devel was empty then
    cmake "$WORK/ros"
    # on Debian 11 the options of gtest are gone then: built now, not by the demo while tests run
    cmake --build "$WORK/ros" -- -j "$(nproc)"
}

# What run_tests of catkin runs, but several at a time: each has a master of its own, and mostly waits.
ros_tests() {
    source_setup "$WORK/ros/devel/setup.bash"
    run_ctest "$WORK/ros" $(($(nproc) + 1)) || true
    catkin_test_results --verbose "$WORK/ros/test_results"
}

# The node, and the parallel parts of the core, with sanitizers.
life_build() { "$ROOT/tests/checked.sh" build "$TIER" "$WORK/checked"; }
life() { "$ROOT/tests/checked.sh" life "$TIER" "$WORK/checked" "$WORK/ros"; }
checked() { "$ROOT/tests/checked.sh" rest second "$WORK/checked" "$WORK/ros" "$WORK/core"; }

# Those of tests/ros that need no master, each file in a process of its own.
tools_tests() {
    local folder=$WORK/pytest status=0
    source_setup "$WORK/ros/devel/setup.bash"
    cd "$ROOT/tests/ros"
    mkdir -p "$folder"
    # shellcheck disable=SC2016
    grep -L UNDER_A_MASTER test_*.py | env "FOLDER=$folder" "CHOICE=$([[ $TIER == second ]] || echo not second_tier)" xargs -P "$(nproc)" -I FILE \
        sh -c 'python3 -m pytest -m "$CHOICE" FILE >"$FOLDER/FILE.log" 2>&1 || [ "$?$CHOICE" = "5not second_tier" ]' || status=1
    cat "$folder"/*.log
    return "$status"
}

# Both build in one folder: one after the other.
demo() { "$ROOT/tests/demo.sh" "$TIER" "$WORK/demo" "$WORK/ros"; }
reproduce() { "$ROOT/tests/reproduce.sh" "$WORK/reproduce"; }

readme() { "$ROOT/tests/readme.sh" "$WORK/readme" "$WORK/ros/.install/setup.bash"; }

one_more() { "$ROOT/tests/one_more/run.sh" "$WORK/one_more"; }

downstream() { "$ROOT/tests/install/ros.sh" "$WORK/downstream" "$WORK/ros" "$WORK/ros/.install"; }

fuzz() { without_ros "$ROOT/tests/fuzz/run.sh" "$WORK/fuzz"; }

slurm() { "$ROOT/tests/slurm.sh" "$WORK/slurm" "$WORK/ros/.install/setup.bash"; }
# A Slurm of the suite's own needs root.
can_slurm() { ((EUID == 0)) && command -v slurmctld slurmd srun >/dev/null; }

ssh() { "$ROOT/tests/ssh.sh" "$WORK/ssh" "$WORK/ros/.install/setup.bash"; }
# Nor do machines of its own go without root: they are network namespaces on a bridge.
can_ssh() {
    ((EUID == 0)) && command -v sshd ip >/dev/null && ip netns add "hdlyap$$" && ip netns del "hdlyap$$" &&
        ip link add "hdlyap$$" type bridge && ip link del "hdlyap$$"
} 2>/dev/null

lint() {
    # the folder of a clone may have any name
    catkin_lint --offline --strict -W2 --ignore package_path_name "$ROOT" "$ROOT/tests/downstream"
}

# sources FIND_EXPRESSION...: files of the repository, without what is built.
sources() { find . \( -name build -o -name .git \) -prune -o -type f \( "$@" \) -print; }

# As the formatters of Debian 12 have it, whose versions differ in details.
can_format() { [[ $(clang-format --version) == *' 14.'* ]]; }
format() {
    local -a in_c in_python
    cd "$ROOT"
    mapfile -t in_c < <(sources -name '*.[ch]' -o -name '*.[ch]pp' -o -name '*.inc')
    mapfile -t in_python < <(sources -name '*.py' && sources ! -name '*.*' -exec grep -qE '^#!/usr/bin/(env )?python3' {} \;)
    clang-format --dry-run -Werror "${in_c[@]}" && BLACK_CACHE_DIR=$WORK/black black --check "${in_python[@]}" &&
        flake8 "${in_python[@]}"
}

# Lines of each area, against what tests/weight.txt allows: text that people write.
weight() {
    local most area paths lines status=0
    cd "$ROOT"
    while read -r most area paths; do
        lines=$(sources -regextype posix-extended -regex "$paths.*" ! -regex '.*\.(png|gif|svg|mp4|bag|csv|txt|bin)' ! -name 'CMakeLists.txt' \
            ! -path '*/__pycache__/*' | xargs -d '\n' cat | wc -l)
        echo "$area: $lines lines, $most allowed"
        ((lines <= most)) || status=1
    done < <(grep -v '^#' tests/weight.txt)
    return "$status"
}

# The public headers, as they are installed: of parameters and names that do not exist.
doxygen() {
    mkdir -p "$WORK/doxygen"
    cd "$WORK/ros/.install/include"
    {
        cat "$ROOT/tests/doxygen/Doxyfile"
        printf "%s\n" "INPUT = hdlyap hdlyap_ros" "INCLUDE_PATH = ." "OUTPUT_DIRECTORY = $WORK/doxygen"
    } | command doxygen - >"$WORK/doxygen/said" 2>&1
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
    # genpy's for the messages of a bag, and Open MPI 5's: a Python program or a rank that had to be killed leaves them
    find "$TMPDIR" -mindepth 1 -name 'genpy_*' -prune -o -mindepth 1 -name 'ompi.*' -exec test -d '{}/jf.0' ';' -prune -o -mindepth 1 -print |
        grep . && status=1
    return "$status"
}

# ---- how many tests a log reports: total and failed ------------------------------------------

count_one() { echo 1 0; }

count_ctest() {
    awk 'match($0, /[0-9]+ tests? failed out of [0-9]+/) { split(substr($0, RSTART), word); total = word[6]; failed = word[1] }
         END { print total + 0, failed + 0 }' "$1"
}

# a test that was skipped has not passed
count_catkin() {
    sed -nE 's/^Summary: ([0-9]+) tests, ([0-9]+) errors, ([0-9]+) failures, ([0-9]+) skipped.*/\1 \2 \3 \4/p' \
        "$1" | awk '{ print $1, $2 + $3 + $4 }'
}

# a test that was skipped has not passed, nor has a file that cannot be read
count_pytest() {
    awk '/^[0-9]+ .* in [0-9.]+s/ {
             for (k = 1; k < NF; k++) {
                 if ($(k + 1) ~ /^(passed|failed|errors?|skipped),?$/) total += $k
                 if ($(k + 1) ~ /^(failed|errors?|skipped),?$/) failed += $k
             }
         }
         END { print total + 0, failed + 0 }' "$1"
}

count_checks() {
    awk '/^ok / { ok++ } /^FAILED / { failed++ } END { print ok + failed + 0, failed + 0 }' "$1"
}

# A command that fails ends the stage: bash would go on where somebody asks for the status by || or if.
strictly() {
    set -e
    "$@"
}

# stage NAME COUNTER
stage() {
    local name=$1 log=$LOGS/$1.log status=0 total=0 failed=0 TIMEFORMAT='%0R %0U %0S'
    set +e
    { time run strictly "$name" >"$log" 2>&1; } 2>"$log.time"
    status=$?
    set -e
    read -r total failed < <("count_$2" "$log") || true
    # neither a crash behind the last test nor a run without tests is a success
    if ((total == 0 || status != 0 && failed == 0)); then
        failed=1
        total=$((total > 0 ? total : 1))
    fi
    report "$name" $((total - failed)) "$failed" "$log" >"$log.report"
    flock "$COUNTS" cat "$log.report" # in one piece: other workers report too
}

# report NAME PASSED FAILED LOG: with seconds, and those of processors, where they were measured.
report() {
    local seconds=0 user=0 system=0
    read -r seconds user system < <(tail -n 1 "$4.time" 2>/dev/null) || true
    echo "$2 $3" >>"$COUNTS"
    printf '%-18s %4d passed %4d failed %5d s %5d s of processors\n' "${@:1:3}" "$seconds" $((user + system))
    if (($3)); then
        tail -n 60 "$4"
        say "all of it is in $4"
    fi
}

# ---- workers, each with one stage at a time: all processors are busy, also while a stage waits for ROS -----------------------

# choose: the rows of the tier that this machine can run, as TABLE; what it can't is said.
choose() {
    local name counter tier needs
    TABLE=()
    while read -r name counter tier needs; do
        [[ $tier == first || $TIER == second ]] || continue
        if declare -F "can_$name" >/dev/null && ! "can_$name"; then
            say "$name: skipped, this machine or this user can't"
        else
            TABLE+=("$name $counter ${needs//,/ }")
        fi
    done < <(grep . <<<"$STAGES")
}

# is_ready NEED...: have these reported, as far as they are in the tier?
is_ready() {
    local need
    for need; do
        [[ $need == - || -s $LOGS/$need.log.report || " ${TABLE[*]%% *} " != *" $need "* ]] || return 1
    done
}

# worker: takes the first stage that is ready, until none is left, in a process that ends what it has started.
worker() {
    local row name counter needs left=1
    CHILDREN=()
    stop_at_exit
    while ((left)); do
        left=0
        for row in "${TABLE[@]}"; do
            read -r name counter needs <<<"$row"
            [[ ! -d $TAKEN/$name ]] || continue
            left=1
            # shellcheck disable=SC2086
            if is_ready $needs && mkdir "$TAKEN/$name" 2>/dev/null; then
                stage "$name" "$counter"
                continue 2
            fi
        done
        sleep 0.3
    done
}

# A worker stops its own; unlike stop, which insists after a while, this leaves it the time.
end_workers() {
    local pid
    for pid in "${CHILDREN[@]}"; do kill -TERM "$pid" 2>/dev/null || true; done
    for pid in "${CHILDREN[@]}"; do wait "$pid" || true; done
}

[[ $ROOT != *[[:space:]]* ]] || die "$ROOT: catkin runs no tests in a folder with a blank in its name; builds and demo do there" 2
TIER=first INSTALL=yes
for option; do
    case $option in
        --all) TIER=second ;;
        --no-install) INSTALL=no ;;
        *) die "usage: run.sh [--all] [--no-install]" 2 ;;
    esac
done
# packages find no folder there yet
[[ $INSTALL == no ]] || env -u TMPDIR -u XDG_RUNTIME_DIR "$ROOT/launch/install.sh" test
stop_at_exit
trap end_workers EXIT
rm -rf "$WORK"
can_write "$WORK" || die "the folder of the clone must be one that can be written"
mkdir -p "$LOGS" "$TAKEN" "$TMPDIR"
mkdir -m 700 "$XDG_RUNTIME_DIR"
: >"$TAKEN.since"
own_environment "$WORK/home"

SECONDS=0 whole=0
choose
for ((k = 0; k <= $(nproc); k++)); do start worker; done
for pid in "${CHILDREN[@]}"; do finish "$pid" || whole=1; done
for name in warnings leftovers; do stage "$name" one; done
((!whole)) || report "end of a worker" 0 1 "$COUNTS"
printf '%d s of wall time on %d processors\n' "$SECONDS" "$(nproc)"

awk '{ passed += $1; failed += $2 } END { print passed " passed, " failed + 0 " failed"; exit failed > 0 }' "$COUNTS"
