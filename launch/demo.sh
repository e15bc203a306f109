#!/usr/bin/env bash
# One command from a clean clone to a recorded run with its table and figures.
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
    cat <<END
usage: demo.sh [--scene NAME] [--duration T] [--out DIR] [--build DIR] [--no-install]
Installs what is missing, builds, runs a scene under a ROS master of its own, records a bag and
draws the figures.
  --scene NAME    one of: $(scenes)
                  (default: paper_periodic)
  --duration T    time units to average over (default: 200)
  --out DIR       folder of the bag and the figures (default: demo/NAME in that of the build)
  --build DIR     folder of the build (default: build, in the clone)
  --no-install    do not install packages
END
}

scenes() {
    local -a names=("$ROOT"/launch/scenes/*.yaml)
    names=("${names[@]##*/}")
    echo "${names[@]%.yaml}"
}

parse() {
    scene=paper_periodic duration=200 out='' build=$ROOT/build install=yes
    while (($#)); do
        case $1 in
            --scene | --duration | --out | --build)
                (($# > 1)) || die "$1 needs a value; --help lists the options" 2
                printf -v "${1#--}" %s "$2"
                shift 2
                ;;
            --no-install) install=no && shift ;;
            --help) usage && exit 0 ;;
            *) die "unknown option $1; --help lists the options" 2 ;;
        esac
    done
    [[ -f $ROOT/launch/scenes/$scene.yaml ]] || die "unknown scene '$scene', choose from: $(scenes)" 2
    [[ $duration =~ ^[0-9]+(\.[0-9]+)?$ && $duration =~ [1-9] ]] ||
        die "--duration is '$duration', must be a positive number of time units" 2
    BUILD=$(realpath -m -- "$build")
    out=$(realpath -m -- "${out:-$BUILD/demo/$scene}")
}

# What tells a bag from another of its name, which the recorder would rename; empty if there is none.
stamp() { stat -c '%i %y' "$out/run.bag" 2>/dev/null || true; }

# check_run STAMP: ends with the log's last words if the node or its recorder did not end well. STAMP: of the bag before.
check_run() {
    local died
    died=$(grep -a 'process has died' "$LOG" | head -n 1) || true
    [[ -z $died && $(stamp) != "$1" ]] && return
    grep -aE 'FATAL|ERROR|died|Exception' "$LOG" | tail -n 5 >&2 || true
    die "the run failed; everything it said is in $LOG"
}

run_scene() {
    local launch follow seen=0 before
    before=$(stamp)
    start roslaunch hdlyap run.launch "scene:=$scene" "duration:=$duration" \
        record:=true "bag:=$out/run.bag" >"$LOG" 2>&1
    launch=$CHILD
    while is_running "$launch" && ! grep -aqs ': scene ' "$LOG"; do sleep 0.2; done
    if is_running "$launch"; then
        start hdlyap follow --line
        follow=$CHILD
        while is_running "$launch" && is_running "$follow"; do sleep 0.2; done
        finish_soon "$follow" || seen=$?
        ((seen != 1)) || stop "$launch" # the node is gone
    fi
    finish "$launch" || true
    check_run "$before"
}

# finish_soon PID: a follower sees by itself that its node has gone, given a few seconds.
finish_soon() {
    local waited
    for ((waited = 0; waited < 80; waited++)); do
        is_running "$1" || break
        sleep 0.1
    done
    stop "$1"
    finish "$1"
}

parse "$@"
LOG=$BUILD/log/demo_$scene.log
can_write "$BUILD/log" || die "the folder of the build must be one that can be written; --build DIR takes another"
can_write "$out" || die "the folder of the results must be one that can be written; --out DIR takes another"
stop_at_exit

[[ $install == no ]] || "$ROOT/launch/install.sh" run
own_environment "$BUILD/home"
build_or_die "$BUILD"

say "running scene $scene, $duration time units"
run_scene
run hdlyap plot "$out/run.bag" --out "$out"
say "bag and figures are in $out; source $BUILD/setup.bash makes all commands known to a shell"
