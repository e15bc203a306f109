#!/usr/bin/env bash
# Runs what the documents show: every command of the shell blocks of README and of the guides, and all of their programs.
# Those of demo.sh are tests/demo.sh's, tests/run.sh is this suite itself. Then the package that doc/wrapper.md shows.
#   readme.sh WORK_FOLDER INSTALLED_SETUP
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly WORK=$1 SETUP=$2

readonly WRAPPER=$ROOT/doc/wrapper.md CORE=$ROOT/doc/core.md
readonly DOCUMENTS=("$ROOT/README.md" "$ROOT/tests/README.md" "$ROOT/CONTRIBUTING.md" "$ROOT/doc/user_guide.md" "$ROOT/doc/performance.md"
    "$ROOT/doc/findings.md" "$ROOT/doc/first_hour.md" "$ROOT/doc/tour.md")

# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

# blocks LANGUAGE FILE...: the contents of the fenced blocks of that language.
blocks() { awk -v fence="\`\`\`$1" '$0 == "```" { on = 0 } on { print } $0 == fence { on = 1 }' "${@:2}"; }

# block LANGUAGE WORD FILE: the first of that language in which the word occurs.
block() {
    awk -v fence="\`\`\`$1" -v word="$2" '
        $0 == "```" { if (on && index(text, word)) { printf "%s", text; exit } on = 0 }
        on { text = text $0 "\n" }
        $0 == fence { on = 1; text = "" }' "$3"
}

# commands: one a line, each once, without comments.
commands() {
    { blocks bash "${DOCUMENTS[@]}" && block bash watch_steps "$WRAPPER"; } | sed -E 's/ *#.*//; /^$/d' | awk '!seen[$0]++'
}

# Commands that other tests run: demo.sh, the suite itself, packages.sh, tests/ros/test_bags.py; the last one is done below, for
# another folder.
is_run_elsewhere() {
    [[ $1 == @(launch/demo.sh*|tests/run.sh*|tests/packages.sh*|dpkg-buildpackage*|*replay*|source*) ]]
}

# A command as a user would type it, in the folder of the clone's copy.
type_in() {
    case $1 in
        'hdlyap launch') # endless
            says 'T\(1,0\) .*\([0-9]+\)' 'LP\(1,0\) .*\([0-9]+\)' -- hdlyap launch &&
                grep -q ': result: averaged ' "$WORK/said.txt" && ! grep -q 'has died' "$WORK/said.txt"
            ;;
        'rosrun hdlyap hdlyap_node') run timeout --preserve-status -s INT 8 rosrun hdlyap hdlyap_node ;;
        *bench/run.sh*) run bash -ec "$1 --quick" ;; # fifteen minutes otherwise
        build/findings/*) run bash -ec "${1/ / --quick }" ;; # minutes otherwise
        *scene:=covariant*) # a minute otherwise
            sed 's/^number: .*/number: 40/' "$ROOT/launch/scenes/covariant.yaml" >few.yaml
            run bash -ec "${1/scene:=covariant/scene:=$PWD/few.yaml}"
            ;;
        *rviz:=true*) opens rviz bash -ec "$1" ;;
        *plot:=true*) opens plot bash -ec "$1" ;;
        *'plot --live') beside_a_node opens plot bash -ec "$1" ;;
        *rviz.launch) beside_a_node opens rviz bash -ec "$1" ;;
        rosservice*)
            beside_a_node bash -ec "until rosservice info /hdlyap/set; do sleep 0.1; done; timeout 60 $1 | tee /dev/stderr | grep -q 'success: True'"
            ;;
        *follow* | rostopic*) beside_a_node bash -ec "timeout 60 $1" ;;
        *'compare run.bag again.bag') run bash -ec "$1 | tee compared.txt" && grep -q identical compared.txt ;;
        *) run bash -ec "$1" ;;
    esac
}

# opens NAME COMMAND...: a node NAME_.. on a screen without a monitor; then both are stopped.
opens() {
    local name=$1 screen command waited status=1
    shift
    mkfifo "$WORK/screen"
    start Xvfb -displayfd 3 -screen 0 1400x1000x24 3<>"$WORK/screen" 2>/dev/null
    screen=$CHILD
    read -r DISPLAY <"$WORK/screen"
    rm "$WORK/screen"
    start env "DISPLAY=:$DISPLAY" LIBGL_ALWAYS_SOFTWARE=1 "$@"
    command=$CHILD
    for ((waited = 0; waited < 600 && status; waited++)); do
        sleep 0.1
        ! rosnode list 2>/dev/null | grep -q "^/${name}_" || status=0
    done
    stop "$command"
    finish "$command" || true
    stop "$screen"
    finish "$screen" || true
    return "$status"
}

beside_a_node() {
    local node status=0
    rosparam delete /hdlyap 2>/dev/null || true # of a launch before
    start rosrun hdlyap hdlyap_node _number:=100 _density:=0.8 _aspect:=0.2 _duration:=2000 _pace:=300
    node=$CHILD
    run "$@" || status=$?
    stop "$node"
    finish "$node" || true
    return "$status"
}

# says PATTERN... -- COMMAND...: within a minute the command has printed lines that match; then it is stopped.
says() {
    local -a patterns=()
    local pid waited pattern missing=1
    while [[ $1 != -- ]]; do patterns+=("$1") && shift; done
    shift
    "$@" >"$WORK/said.txt" 2>&1 &
    pid=$!
    for ((waited = 0; waited < 600 && missing; waited++)); do
        sleep 0.1
        missing=0
        for pattern in "${patterns[@]}"; do grep -qE "$pattern" "$WORK/said.txt" || missing=1; done
    done
    kill -TERM "$pid"
    wait "$pid" || true
    cat "$WORK/said.txt"
    return "$missing"
}

readonly STEPS_SAID=('T\(1,0\) 196-197: lambda = 0\.8[0-9]+ \+- 0\.[0-9]+' 'c_T = [0-9.]+, c_L = [0-9.]+, v = [0-9.]+')

# The nodes of doc/wrapper.md as a package of their own, and its other way to build them.
nodes_in_c_build() {
    mkdir -p "$WORK/counting" && cd "$WORK/counting" &&
        block c '"counter"' "$WRAPPER" >counter.c &&
        block c '"adder"' "$WRAPPER" >adder.c &&
        block cmake project "$WRAPPER" >CMakeLists.txt &&
        block xml package "$WRAPPER" >package.xml &&
        cmake -S . -B build -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCMAKE_C_FLAGS='-Wall -Wextra -Wpedantic -Werror' &&
        cmake --build build &&
        bash -ec "$(block bash counter.c "$WRAPPER")"
}

nodes_in_c() {
    local counter status=0
    nodes_in_c_build || return 1
    start "$WORK/counting/build/devel/lib/counting/counter"
    counter=$CHILD
    says '[1-9][0-9]* heard, together [1-9]' -- ./adder || status=$?
    stop "$counter"
    return "$status"
}

# The core by hand, with the commands as they are written and nothing else; it prints what the document says that it prints,
# but for the last digits.
c_program_prints_the_steps() {
    env -u LD_LIBRARY_PATH -u PKG_CONFIG_PATH bash -ec "$(block bash 'cmake --install' "$CORE")" >"$WORK/made.txt" &&
        tail -n 3 "$WORK/made.txt" >"$WORK/steps.txt" &&
        diff <(blocks text "$CORE" | grep ' of .* +- ' | cut -d' ' -f1,3) <(cut -d' ' -f1,3 "$WORK/steps.txt")
}

stop_at_exit
mkdir -p "$WORK/clone"
cd "$WORK/clone" # a copy, so that the documents' build folder is not the clone's
find "$ROOT" -mindepth 1 -maxdepth 1 ! -name build ! -name .git -exec cp -r -t . {} +
mkdir -p build/check && ln -s "${SETUP%/.install/*}" build/check/ros
block c hdlyap/hdlyap.h "$CORE" >steps.c
block c /hdlyap/steps "$WRAPPER" >watch_steps.c
block python rospy "$ROOT/README.md" >watch.py
block yaml number: "$ROOT/doc/user_guide.md" >strip.yaml
block yaml number: "$ROOT/doc/first_hour.md" >mine.yaml
block python hdlyap.load "$ROOT/doc/first_hour.md" >mine.py
block python hdlyap.load "$ROOT/README.md" >c_t.py
block yaml base: "$ROOT/doc/user_guide.md" >runs.yaml
source_setup "$SETUP"
start roscore -p "${ROS_MASTER_URI##*:}" >"$WORK/roscore.log" 2>&1
until rostopic list >/dev/null 2>&1; do sleep 0.2; done
while read -r line; do
    is_run_elsewhere "$line" || check "$line" type_in "$line"
done < <(commands)
check c_program c_program_prints_the_steps
check python_on_mine says 'LP\(1,0\) +k = 0\.077[0-9]+  lambda = 0\.2[45]' '^c_T ' -- python3 mine.py
check python_on_run says '^T\(1,0\) .*lambda = ' '^c_T ' -- python3 c_t.py
check python_program beside_a_node says "${STEPS_SAID[@]}" -- python3 watch.py
check c_subscriber beside_a_node says "${STEPS_SAID[@]}" -- ./watch_steps
check nodes_in_c run nodes_in_c
exit "$FAILED"
