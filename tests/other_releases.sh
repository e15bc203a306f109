#!/usr/bin/env bash
# The two commands of README in a fresh minimal system of another Debian release, from a clean clone of what is committed. Ends
# with a row for doc/platforms.md; fails if anything did. As root, with debootstrap; no part of the suite.
#   other_releases.sh bullseye|bookworm|trixie [demo] [tests] [compilers] [noetic]    which steps; demo and tests if none is named
# compilers: core, its tests, node and viewer with each gcc and clang of the release; a warning fails. noetic: see
# tests/noetic.sh, on bullseye alone and as the last step.
# The mirror is that of apt, or HDLYAP_MIRROR. HDLYAP_RELEASES (/var/tmp/hdlyap_releases) keeps the base system and the
# packages for the next time, the logs, and the system itself if something failed in it.
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly RELEASE=${1:-} FOLDER=${HDLYAP_RELEASES:-/var/tmp/hdlyap_releases}
readonly BASE=$FOLDER/$RELEASE.base SYSTEM=$FOLDER/$RELEASE DEBS=$FOLDER/$RELEASE.debs
readonly CLONE=/root/hdlyap # in the system
FAILED=0

mirror() {
    # shellcheck disable=SC2016
    apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | head -n 1
}

make_base() {
    [[ ! -d $BASE ]] || return 0
    local from=${HDLYAP_MIRROR:-$(mirror)}
    [[ -n $from ]] || die "apt names no mirror of Debian: set HDLYAP_MIRROR"
    say "base system of $RELEASE in $BASE"
    rm -rf "$BASE.new"
    debootstrap --variant=minbase "$RELEASE" "$BASE.new" "$from" >"$FOLDER/$RELEASE.base.log" 2>&1 ||
        die "debootstrap failed; its log is $FOLDER/$RELEASE.base.log: $(tail -n 1 "$FOLDER/$RELEASE.base.log")"
    echo '127.0.0.1 localhost' >"$BASE.new/etc/hosts"
    mv "$BASE.new" "$BASE"
}

make_system() {
    rm -rf --one-file-system "$SYSTEM"
    cp -a --reflink=auto "$BASE" "$SYSTEM"
    cp -L /etc/resolv.conf "$SYSTEM/etc"
    git clone -q --no-hardlinks "$ROOT" "$SYSTEM$CLONE"
}

# inside COMMAND...: in the system, with mounts and processes of its own, which all end with it.
inside() {
    # shellcheck disable=SC2016
    unshare --mount --pid --ipc --fork --kill-child bash -ec '
        mount --rbind /dev "$0/dev"
        mount -t tmpfs tmpfs "$0/dev/shm"
        mount -t tmpfs tmpfs "$0/run"
        mount -t proc proc "$0/proc"
        mount --rbind /sys "$0/sys"
        mount --bind "$1" "$0/var/cache/apt/archives"
        exec chroot "$0" env -i -C "$2" HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin "${@:3}"' \
        "$SYSTEM" "$DEBS" "$CLONE" "$@"
}

# step NAME COMMAND...: with a log; then SAID is what the row says of it.
step() {
    local name=$1 log=$FOLDER/$RELEASE.$1.log began=$SECONDS status=0
    shift
    say "$name, to $log"
    run "$@" >"$log" 2>&1 || status=$?
    SAID=$((SECONDS - began))
    ((!status)) || { FAILED=1 && tail -n 20 "$log"; }
    return "$status"
}

demo() {
    local ended=passed
    step demo inside launch/demo.sh --scene quick || ended=failed
    grep -q '^lambda_max ' "$FOLDER/$RELEASE.demo.log" || { ended='no table' && FAILED=1; }
    DEMO="$ended, $SAID s"
}

suite() {
    step tests inside tests/run.sh || true
    TESTS="$(tail -n 1 "$FOLDER/$RELEASE.tests.log"), $SAID s"
}

# What the release has, and what clang needs of the same version for OpenMP, one after the other: they exclude each other.
compilers_of_release() {
    inside apt-cache search --names-only '^(gcc|clang)-[0-9]+$' | sed 's/ .*//' | sort -V
}

# with_compiler NAME: all of the tree; a warning is an error, but not in headers of the system. Then the hash of the event log.
# shellcheck disable=SC2016
with_compiler() {
    inside bash -euc '
        export DEBIAN_FRONTEND=noninteractive
        version=${1#*-}
        case $1 in
            gcc-*) cxx=g++-$version needs="$1 g++-$version" ;;
            clang-*) cxx=clang++-$version needs="$1 libomp-$version-dev" ;;
        esac
        apt-get install -y -q --no-install-recommends ninja-build libcmocka-dev $needs
        rm -rf "build/$1"
        set -- "$1" "-DCMAKE_C_COMPILER=$1" "-DCMAKE_CXX_COMPILER=$cxx" -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCATKIN_ENABLE_TESTING=OFF
        cmake -S . -B "build/$1" -G Ninja "${@:2}" -DHDLYAP_CORE_TESTS=ON -DCMAKE_C_FLAGS=-Werror -DCMAKE_CXX_FLAGS=-Werror
        cmake --build "build/$1" -- -k 0
        golden=$(find "build/$1" -name test_golden -type f)
        "$golden"' -- "$1"
}

compilers() {
    local name list
    list=$(inside launch/install.sh run >"$FOLDER/$RELEASE.compilers.log" 2>&1 && compilers_of_release)
    [[ -n $list ]] || die "no compilers; the log is $FOLDER/$RELEASE.compilers.log"
    COMPILERS=
    for name in $list; do
        if step "$name" with_compiler "$name"; then COMPILERS+="$name "; else COMPILERS+="$name (failed) "; fi
    done
}

noetic() {
    NOETIC_CHECKS=failed
    step noetic inside tests/noetic.sh || return 0
    NOETIC_CHECKS="$(grep -c '^ok ' "$FOLDER/$RELEASE.noetic.log") passed, $SAID s"
}

# version PACKAGE: installed in the system, as its authors count it.
# shellcheck disable=SC2016
version() { inside dpkg-query -W -f '${source:Upstream-Version}' "$1" 2>/dev/null | sed 's|+.*||' || echo '?'; }

# first_number COMMAND...: the first version that it prints.
first_number() { inside "$@" 2>/dev/null | grep -oE '[0-9]+(\.[0-9]+)+' | head -n 1; }

row() {
    printf '| %s ' "$RELEASE ($(cat "$SYSTEM/etc/debian_version"))" "$(version libroscpp-dev)" "$(first_number gcc -dumpfullversion)" \
        "$(first_number cmake --version)" "$(first_number python3 --version)" "$(version libopenblas-openmp-dev)" \
        "${DEMO:-not run}" "${TESTS:-not run}" "${COMPILERS:-not run}" "${NOETIC_CHECKS:-not run}" "$(date +%F)" "$(git -C "$ROOT" rev-parse --short HEAD)"
    echo '|'
}

[[ $RELEASE == @(bullseye|bookworm|trixie) ]] || die "usage: other_releases.sh bullseye|bookworm|trixie [demo] [tests] [compilers] [noetic]" 2
((EUID == 0)) || die "needs root, for debootstrap and chroot"
for word in debootstrap unshare git; do command -v "$word" >/dev/null || die "needs $word"; done
STEPS=("${@:2}")
((${#STEPS[@]})) || STEPS=(demo tests)
for word in "${STEPS[@]}"; do
    [[ $word == @(demo|tests|compilers|noetic) ]] || die "unknown step $word, choose from: demo tests compilers noetic" 2
    [[ $word != noetic || $RELEASE == bullseye ]] || die "noetic needs GCC 9, which bullseye has" 2
done
git -C "$ROOT" diff --quiet HEAD || say "what is not committed is not tested"
stop_at_exit
mkdir -p "$DEBS/partial"
make_base
make_system
for word in "${STEPS[@]}"; do
    case $word in tests) suite ;; *) "$word" ;; esac
done
echo '| release | roscpp | GCC | CMake | Python | OpenBLAS | demo | tests | without warnings | as Noetic | date | commit |'
row
if ((FAILED)); then
    say "the system is kept in $SYSTEM"
else
    rm -rf --one-file-system "$SYSTEM"
fi
exit "$FAILED"
