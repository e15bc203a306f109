#!/usr/bin/env bash
# The paper's figures and tables, measured again by one command from a clean clone: doc/reproduction.md.
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../launch/common.sh"

usage() {
    cat <<END
usage: reproduce.sh [--no-install] [--quick] [--only "RUN .."] [--part N].. [--folder DIR]
Installs what is missing, builds, does the runs of runs.yaml that are not done, under a ROS master of its own, and draws.
  --no-install    do not install packages
  --quick         shorter runs, larger errors: a quarter of an hour, not forty minutes
  --only "RUN .." only these runs
  --part N        draw only this part; may be given several times
  --folder DIR    of bags and results (default: build/reproduction, or build/reproduction_quick)
END
}

parse() {
    install=yes folder='' usual=$ROOT/build/reproduction runs=() parts=()
    while (($#)); do
        case $1 in
            --no-install) install=no && shift ;;
            --quick) runs+=("$1") usual=$ROOT/build/reproduction_quick && shift ;;
            --only | --part | --folder)
                (($# > 1)) || die "$1 needs a value; --help lists the options" 2
                case $1 in
                    --only) runs+=("$1" "$2") ;;
                    --part) parts+=("$1" "$2") ;;
                    --folder) folder=$2 ;;
                esac
                shift 2
                ;;
            --help) usage && exit 0 ;;
            *) die "unknown option $1; --help lists the options" 2 ;;
        esac
    done
    folder=$(realpath -m -- "${folder:-$usual}")
}

parse "$@"
HERE=$ROOT/doc/reproduction BUILD=$ROOT/build
can_write "$BUILD/log" || die "the folder of the build must be one that can be written: copy the clone"
stop_at_exit
[[ $install == no ]] || "$ROOT/launch/install.sh" run
own_environment "$BUILD/home"
build_or_die "$BUILD"
status=0
run hdlyap sweep --plan "$HERE/runs.yaml" --folder "$folder" "${runs[@]}" || status=$?
((status < 2)) || exit "$status"
run /usr/bin/python3 "$HERE/reproduce.py" --folder "$folder" "${parts[@]}" || status=1
exit "$status"
