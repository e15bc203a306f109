#!/usr/bin/env bash
# The paper's figures and tables, measured again by one command from a clean clone.
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

BUILD=$ROOT/build
install=yes
arguments=()
out=$BUILD/reproduction
while (($#)); do
    case $1 in
        --no-install) install=no ;;
        --out) (($# > 1)) || die "--out needs a value; --help lists the options" 2
            out=$(realpath -m -- "$2") && shift ;;
        *) arguments+=("$1") ;;
    esac
    shift
done
mkdir -p "$BUILD/log"
stop_at_exit
[[ $install == no ]] || "$ROOT/launch/install.sh" run
own_environment "$BUILD/home"
build_or_die "$BUILD"
HDLYAP_COMMIT=$(commit_here)
export HDLYAP_COMMIT
run rosrun hdlyap reproduce --out "$out" "${arguments[@]}"
