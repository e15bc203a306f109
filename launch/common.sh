# Shell functions shared by demo.sh, install.sh, reproduce.sh and tests/run.sh. Sourced, never run.
# shellcheck shell=bash

# The background job of a script is started with SIGINT and SIGQUIT ignored, which bash cannot undo and hands on to all that it
# starts: begins afresh, by perl, which Debian always has. nohup's SIGHUP stays ignored.
if [[ $(trap -p INT QUIT TERM) == *"''"* ]]; then
    # shellcheck disable=SC2016
    exec perl -e '$SIG{$_} = "DEFAULT" for qw(INT QUIT TERM); exec @ARGV' -- "$BASH" "$0" "$@"
fi

ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
readonly ROOT
readonly NOETIC=/opt/ros/noetic

say() { printf '== %s\n' "$*"; }

# die MESSAGE [STATUS]
die() {
    printf '%s: %s\n' "$(basename "$0")" "$1" >&2
    exit "${2:-1}"
}

# source_setup FILE: catkin's setup files read unset variables.
source_setup() {
    set +u
    # shellcheck source=/dev/null
    source "$1"
    set -u
}

# can_write DIR: makes it, and its parents; the message of mkdir tells why not.
can_write() { mkdir -p "$1" && { [[ -w $1 ]] || ! echo "$1: Permission denied" >&2; }; }

# own_environment DIR: the system's python and ROS, a master of our own, and every file that
# ROS, python or matplotlib writes under DIR; what a home is needed for, too, where there is none.
own_environment() {
    unset PYTHONPATH PYTHONHOME ROS_IP ROS_IPV6 ROS_NAMESPACE ROS_PACKAGE_PATH CMAKE_PREFIX_PATH
    unset LD_LIBRARY_PATH PKG_CONFIG_PATH # of a workspace that the shell has sourced
    export PATH=/usr/bin:/bin:$PATH
    [[ ! -f $NOETIC/setup.bash ]] || source_setup "$NOETIC/setup.bash"
    export ROS_HOSTNAME=localhost
    ROS_MASTER_URI=http://localhost:$(free_port)
    export ROS_MASTER_URI
    mkdir -p "$1"
    [[ -d ${HOME:-} && -w $HOME ]] || export HOME=$1
    export ROS_HOME=$1/ros ROS_LOG_DIR=$1/ros/log MPLCONFIGDIR=$1/matplotlib
    export PYTHONDONTWRITEBYTECODE=1
    export PYTHONUTF8=1 # names of folders are, also where the locale has another encoding
}

# Below those that Linux hands out: nobody gets it before it is used.
free_port() {
    /usr/bin/python3 -c 'import random, socket
for port in random.sample(range(20000, 32768), 100):
    if socket.socket().connect_ex(("localhost", port)): break
print(port)'
}

# build DIR [CMAKE OPTION]...: configures once, then builds what has changed. A tree of another
# place (a clone that was moved) or that was left half configured is configured afresh.
build() {
    local dir=$1
    shift
    if ! is_configured "$dir"; then
        rm -rf "$dir/CMakeCache.txt" "$dir/CMakeFiles" "$dir/devel" "$dir/Makefile" "$dir/build.ninja"
        cmake -S "$ROOT" -B "$dir" -DPYTHON_EXECUTABLE=/usr/bin/python3 "$@" || return
    fi
    cmake --build "$dir" -- -j "$(nproc)"
}

# build_or_die DIR: and installs, because rosrun sees no program in a folder build/ of the package itself; into a hidden
# folder, because roslaunch would find each launch file twice. Its programs are then on the path.
build_or_die() {
    say "building in $1: minutes, the first time"
    start build_and_install "$1" >"$1/log/build.log" 2>&1
    while [[ -t 1 ]] && is_running "$CHILD"; do
        printf '\r%s\r' "$(grep -o '^\[ *[0-9]*%\]' "$1/log/build.log" | tail -n 1)"
        sleep 0.5
    done
    finish "$CHILD" ||
        die "the build failed; its log is $1/log/build.log:
$(tail -n 20 "$1/log/build.log")"
    echo "source \"\$(dirname \"\${BASH_SOURCE[0]}\")/.install/setup.bash\"" >"$1/setup.bash"
    source_setup "$1/setup.bash"
}

build_and_install() {
    build "$1" -DCATKIN_ENABLE_TESTING=OFF -DHDLYAP_CORE_TESTS=OFF "-DCMAKE_INSTALL_PREFIX=$1/.install" &&
        cmake --install "$1"
}

is_configured() {
    [[ -f $1/Makefile || -f $1/build.ninja ]] && grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$ROOT" "$1/CMakeCache.txt"
}

CHILDREN=() # what start() began and finish() has not seen end

# start COMMAND...: in the background, in a process group of its own; its id is then in CHILD.
start() {
    set -m
    "$@" </dev/null &
    set +m
    CHILD=$!
    CHILDREN+=("$CHILD")
}

# finish PID: waits for it; its exit status.
finish() {
    local status=0 pid
    local -a others=()
    wait "$1" || status=$?
    for pid in "${CHILDREN[@]}"; do
        [[ $pid == "$1" ]] || others+=("$pid")
    done
    CHILDREN=("${others[@]}")
    return "$status"
}

# run COMMAND...: like the command alone, but a signal to this script reaches it at once.
run() {
    start "$@"
    finish "$CHILD"
}

# stop PID: asks as Ctrl-C does, and after roslaunch's own patience of 17 s insists.
stop() {
    local pid deadline=$((SECONDS + 20))
    local -a tree
    mapfile -t tree < <(descendants "$1")
    kill -INT -- "-$1" 2>/dev/null || true
    for pid in "${tree[@]}"; do
        while is_running "$pid" && ((SECONDS < deadline)); do sleep 0.1; done
        kill -KILL "$pid" 2>/dev/null || true
    done
    kill -KILL -- "-$1" 2>/dev/null || true # what it has begun meanwhile, where signals are ignored
}

# Not for a zombie, which the first process of a container may leave.
is_running() { [[ $(ps -o stat= -p "$1") == [!Z]* ]]; }

# descendants PID: it and all below it. roslaunch gives each node a session of its own.
descendants() {
    local child
    echo "$1"
    for child in $(pgrep -P "$1"); do
        descendants "$child"
    done
}

# stop_at_exit: however this script ends, what it started ends with it.
stop_at_exit() {
    trap 'for child in "${CHILDREN[@]}"; do stop "$child"; done' EXIT
    trap 'exit 129' HUP
    trap 'exit 130' INT
    trap 'exit 143' TERM
}
