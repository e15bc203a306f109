#!/usr/bin/env bash
# The paper's figures and tables, measured again by one command from a clean clone: doc/reproduction.md.
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

BUILD=$ROOT/build
OPTIONS=$ROOT/hdlyap_ros/python/hdlyap/reproduce/options.py

usage() {
    cat <<END
usage: reproduce.sh [--no-install] [OPTION]...
Installs what is missing, builds, and does what rosrun hdlyap reproduce does, in build/reproduction
(build/reproduction_quick) and under a ROS master of its own.
  --no-install    do not install packages

END
    # shellcheck disable=SC2015
    [[ -x $PYTHON ]] && "$PYTHON" -B "$OPTIONS" --help || echo "Its options: $ROOT/doc/reproduction.md"
}

parse() {
    local argument
    install=yes out=$BUILD/reproduction options=()
    for argument in "$@"; do
        case $argument in
            --no-install) install=no && continue ;;
            --help | -h) usage && exit 0 ;;
            --quick) out=$BUILD/reproduction_quick ;;
        esac
        options+=("$argument")
    done
    # by the program's own eyes, unless python is still to be installed
    [[ ! -x $PYTHON ]] || "$PYTHON" -B "$OPTIONS" "${options[@]}" || exit
}

PYTHON=/usr/bin/python3
parse "$@"
can_write "$BUILD/log" || die "the folder of the build must be one that can be written: copy the clone"
stop_at_exit
[[ $install == no ]] || "$ROOT/launch/install.sh" run
own_environment "$BUILD/home"
build_or_die "$BUILD"
HDLYAP_COMMIT=$(commit_here)
export HDLYAP_COMMIT
run rosrun hdlyap reproduce --out "$out" "${options[@]}"
