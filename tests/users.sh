#!/usr/bin/env bash
# launch/demo.sh and the builds of README as users of all kinds meet them: with sudo and without, in folders with odd names,
# in other locales, without a network... Each case is a fresh clone of what is committed, by an ordinary user, in a throw-away
# copy of this system: an overlay in memory with processes of its own, of which nothing stays but logs and a compiler's cache
# in build/users. Prints a table. Not part of the suite: needs root, overlayfs and about a minute a case.
#   users.sh [CASE]...     otherwise all but suite, which is tests/run.sh and takes half an hour
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly WORK=$ROOT/build/users SIZE=8G
readonly DEMO='launch/demo.sh --scene quick'
readonly ODD='Läufe mit σ/硬盘 ıİ'
readonly REMOVED='liblapacke-dev python3-paramiko' # where a package is to be missing

# ---- the cases -------------------------------------------------------------------------------

case_plain() { typed u hdlyap "$DEMO"; }
case_spaces() { typed u 'my work/hard disks' "$DEMO"; }
case_unicode() { typed u "$ODD" "$DEMO"; }
case_unicode_C() { typed u "$ODD" "LC_ALL=C $DEMO"; }
case_unicode_latin1() { typed u "$ODD" "LC_ALL=de_DE.ISO-8859-1 $DEMO"; }
case_umask() { typed u hdlyap "umask 077; $DEMO"; }
case_de() { typed u hdlyap "LC_ALL=de_DE.UTF-8 $DEMO"; }
case_C() { typed u hdlyap "LC_ALL=C $DEMO"; }
case_tr() { typed u hdlyap "LC_ALL=tr_TR.UTF-8 $DEMO"; }
case_latin1() { typed u hdlyap "LC_ALL=de_DE.ISO-8859-1 $DEMO"; }
case_unknown_locale() { typed u hdlyap "LC_ALL=xx_XX.UTF-8 $DEMO"; }
case_no_home() { typed u hdlyap "unset HOME; $DEMO"; }
case_home_not_there() { typed u hdlyap "HOME=/nowhere/u $DEMO"; }
case_home_not_writable() { typed u hdlyap "HOME=/ $DEMO"; }
case_tmpdir() { typed u hdlyap "mkdir ~/'my tmp'; TMPDIR=~/'my tmp' $DEMO"; }
case_read_only() { typed u hdlyap "chmod -R a-w .; $(refused "$DEMO" 'build DIR takes another'); $DEMO --build ../b"; }
case_no_network() { offline && typed u hdlyap "$DEMO"; }
case_no_network_by_hand() { offline && typed u hdlyap "$(by_cmake . build); $(used build/.install)"; }
case_cmake() { typed u 'my work/hard disks' "$(by_cmake . build); $(used build/.install)"; }
case_cmake_read_only() { typed u work/hdlyap "chmod -R a-w .; cd ..; $(by_cmake hdlyap b); $(used b/.install)"; }
case_catkin() { typed u 'cat ws/src/hdlyap' "cd ../..; catkin_make; $(used devel)"; }
case_suite() { typed u "${ODD// /_}" "tests/run.sh --no-install"; }
case_suite_refused() { typed u "$ODD" "$(refused 'tests/run.sh --no-install' 'with a blank')"; }
case_catkin_unicode() { typed u 'Läufe σ/src/hdlyap' "cd ../..; catkin_make; $(used devel)"; }

case_sudo() {
    echo 'u ALL=(ALL) NOPASSWD: ALL' >/etc/sudoers.d/u
    removed && typed u hdlyap "umask 077; $DEMO"
}

# The line that the user is told is what the administrator types.
case_no_sudo() {
    rm -f /etc/sudoers.d/u
    removed && typed u hdlyap "$(refused "$DEMO" 'packages are missing')" &&
        sh -ec "$(grep '^apt-get .* install ' ~u/said)" &&
        typed u hdlyap "$DEMO --no-install"
}

case_second() {
    local pid status=0
    local -a pids=()
    for user in u v; do
        typed "$user" one "$DEMO" &
        pids+=($!)
        typed "$user" two "$DEMO" &
        pids+=($!)
    done
    for pid in "${pids[@]}"; do wait "$pid" || status=1; done
    return $status
}

# typed USER FOLDER COMMANDS: what the user types after logging in, in a fresh clone.
IN=()
typed() {
    "${IN[@]}" su - "$1" -c "set -e
        export CCACHE_DIR=$WORK/ccache CCACHE_UMASK=000 CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=\"\$HOME/$2\"
        export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
        [[ -e '$2' ]] || git clone -q -c advice.detachedHead=false '$WORK/bundle' '$2'
        cd '$2'
        $3"
}

# what is typed has this machine alone to talk to
offline() { IN=(unshare -n sh -c 'ip link set lo up && exec "$@"' -); }

# refused COMMAND MESSAGE: it must be, in words that are then in the file ../said.
refused() {
    echo "if $1 >../said 2>&1; then exit 1; fi
        cat ../said
        grep -q '$2' ../said"
}

# by_cmake SOURCE BUILD, used PREFIX: what README says for a build by hand, and what is tried with it.
by_cmake() {
    echo "cmake -S $1 -B $2 -DPYTHON_EXECUTABLE=/usr/bin/python3 \"-DCMAKE_INSTALL_PREFIX=\$PWD/$2/.install\"
        cmake --build $2 && cmake --install $2"
}

used() {
    echo "source $1/setup.bash
        roslaunch hdlyap run.launch scene:=quick duration:=200 record:=true \"bag:=\$PWD/../run.bag\"
        hdlyap plot ../run.bag --out ../figures"
}

removed() {
    # shellcheck disable=SC2086
    DEBIAN_FRONTEND=noninteractive apt-get purge -y -q $REMOVED
}

# ---- one after the other, in a copy of the system ----------------------------------------------

# Known lines of the table of hdlyap plot: the same for all users, whatever they have typed.
result() { grep -E '^(lambda_max|averaged time) ' "$1" | sort -u; }

try() {
    local name=$1 log=$WORK/log/$1.log begin=$SECONDS status=0 said=ok
    (set -e; "case_$name") >"$log" 2>&1 || status=$?
    if ((status)); then
        said="FAILED ($status)"
    elif [[ $name != suite* ]] && ! result "$log" | cmp -s - "$WORK/expected"; then
        if [[ -s $WORK/expected ]]; then said='other numbers'; else result "$log" >"$WORK/expected"; fi
    fi
    [[ $said == ok ]] || FAILED=1
    printf '%-22s %-14s %5d s   %s\n' "$name" "$said" $((SECONDS - begin)) \
        "$(grep -E '^(lambda_max |[0-9]+ passed, )' "$log" | tail -n 1)"
    rm -rf /home/u/* /home/v/*
}

# as the first process below the copy's root
inside() {
    FAILED=0
    useradd -m -s /bin/bash u
    useradd -m -s /bin/bash v
    local place
    for place in de_DE.UTF-8 tr_TR.UTF-8 de_DE.ISO-8859-1; do
        localedef -i "${place%.*}" -f "${place#*.}" "$place"
    done
    command -v sudo >/dev/null || { apt-get update && apt-get install -y sudo; } >"$WORK/log/sudo.log" 2>&1
    for name in "$@"; do try "$name"; done
    exit $FAILED
}

# Root's mounts here are its own, and end with it.
outside() {
    local there=$WORK/copy
    mkdir -p "$there"
    mount -t tmpfs -o "size=$SIZE" tmpfs "$there"
    mkdir "$there"/{upper,work,system}
    mount -t overlay -o "lowerdir=/,upperdir=$there/upper,workdir=$there/work" overlay "$there/system"
    mount -t proc proc "$there/system/proc"
    mount --rbind /dev "$there/system/dev"
    mount --rbind /sys "$there/system/sys"
    mount -t tmpfs tmpfs "$there/system/tmp" -o mode=1777
    mkdir -p "$there/system/$ROOT" # below /tmp it is gone
    mount --bind "$ROOT" "$there/system/$ROOT"
    exec chroot "$there/system" "$ROOT/tests/users.sh" --inside "$@"
}

mapfile -t all < <(declare -F | sed -n 's/^declare -f case_//p')
case ${1:-} in
    --inside) inside "${@:2}" ;;
    --outside) outside "${@:2}" ;;
esac
((EUID == 0)) || die "needs root"
for name in "$@"; do
    [[ " ${all[*]} " == *" $name "* ]] || die "unknown case '$name', choose from: ${all[*]}" 2
done
(($#)) || mapfile -t all < <(printf '%s\n' "${all[@]}" | grep -vx suite)
(($#)) || set -- "${all[@]}"
rm -rf "$WORK/log" "$WORK/expected"
mkdir -p "$WORK/log" "$WORK/ccache"
chmod 1777 "$WORK/ccache"
git -C "$ROOT" bundle create -q "$WORK/bundle" HEAD
exec unshare --mount --pid --fork --kill-child "$ROOT/tests/users.sh" --outside "$@"
