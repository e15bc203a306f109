#!/usr/bin/env bash
# Builds the packages of debian/ in a fresh minimal system, from a clean clone of what is committed, and tries them in another
# one: installed, used by an ordinary user, removed, after which no file may be left. As root, with debootstrap; no part of the
# suite.
#   packages.sh [RELEASE [FOLDER]]    of Debian (bookworm); packages of FOLDER are only tried. Those built are in build/packages
# HDLYAP_MIRROR and HDLYAP_RELEASES: see tests/fresh_system.sh.
# shellcheck disable=SC2016
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"
# shellcheck source=tests/fresh_system.sh
source "$ROOT/tests/fresh_system.sh"

readonly RELEASE=${1:-bookworm} WORK=$ROOT/build/packages
readonly PACKAGES=${2:-$WORK}
# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

# as_user LINE: of a shell, in a network of its own.
as_user() {
    inside unshare --net bash -ec 'ip link set lo up
        exec setpriv --reuid=user --regid=user --init-groups env HOME=/home/user ROS_HOSTNAME=localhost bash -ec "cd; $0"' "$1"
}

# beside_a_master LINE: of a shell, as the user.
beside_a_master() {
    as_user "roscore >/dev/null & timeout 120 bash -c 'until rostopic list; do sleep 0.2; done' >/dev/null 2>&1; $1"
}

# ---- what is built ----------------------------------------------------------------------------

prepare_builder() {
    inside apt-get update -q &&
        inside apt-get install -y -q --no-install-recommends build-essential lintian &&
        inside apt-get build-dep -y -q --no-install-recommends "$CLONE"
}

build_packages() {
    inside env "DEB_BUILD_OPTIONS=parallel=$(nproc) noautodbgsym" dpkg-buildpackage -us -uc -b &&
        cp "$SYSTEM${CLONE%/*}"/*.deb "$WORK"
}

warns_of_nothing() { ! grep -n ': warning:' "$(log_of build)"; }

lintian_is_content() { inside bash -c 'lintian --allow-root --fail-on error,warning --tag-display-limit 0 ../*.changes'; }

# Nor a file that Python has compiled there.
names_no_build_folder() {
    local package
    mkdir -p "$WORK/unpacked"
    for package in "$WORK"/*.deb; do
        dpkg-deb -x "$package" "$WORK/unpacked/$(basename "$package" .deb)" || return
    done
    ! find "$WORK/unpacked" -name '*.py[co]' | grep . && ! grep -rlF "${CLONE%/*}" "$WORK/unpacked"
}

# ---- what is installed ------------------------------------------------------------------------

# of_packages FIELD: of all of them, without their own names.
of_packages() {
    local package
    for package in "$PACKAGES"/*.deb; do dpkg-deb -f "$package" "$1"; done | tr ',' '\n' | sed '/hdlyap/d; s/^ *//; /^$/d' | sort -u | paste -sd ,
}

# What they need is there before: all that they bring, and nothing else, has to go with them.
prepare_user() {
    mkdir "$SYSTEM/packages" && cp "$PACKAGES"/*.deb "$SYSTEM/packages" &&
        inside apt-get update -q &&
        inside apt-get satisfy -y -q --no-install-recommends "$(of_packages Depends)" &&
        inside apt-get install -y -q --no-install-recommends g++ cmake make pkg-config openmpi-bin iproute2 python3-rosmsg &&
        inside useradd -m user &&
        (cd "$SYSTEM$CLONE" && cp -r --parents -t "$SYSTEM/home/user" tests doc/findings) && chown -R --reference="$SYSTEM/home/user" "$SYSTEM/home/user"
}

# files: all of the system, with their kinds and rights, but for logs, lists of packages and homes.
files() {
    find "$SYSTEM" -xdev \( -path "$SYSTEM/home" -o -path "$SYSTEM/tmp" -o -path "$SYSTEM/var/log" -o -path "$SYSTEM/var/cache" \
        -o -path "$SYSTEM/var/lib/dpkg" -o -path "$SYSTEM/var/lib/apt" \) -prune -o -printf '%P %y %m %l\n' | sort
}

installs() { inside bash -c 'apt-get install -y -q --no-install-recommends /packages/*.deb'; }

finds_package() { [[ $(as_user 'rospack find hdlyap') == /usr/share/hdlyap ]]; }

node_runs() { beside_a_master 'rosrun hdlyap hdlyap_node _number:=20 _aspect:=1.0 _equilibration:=1.0 _warmup:=1.0 _duration:=5.0'; }

# launches ARGUMENT...: to the result.
launches() {
    as_user "roslaunch hdlyap run.launch scene:=quick $* | tee said
        grep -q ': result: averaged ' said
        ! grep 'process has died' said"
}

draws_bag() { as_user 'hdlyap plot quick.bag --out figures | grep "^lambda_max" && test -s figures/spectrum.png'; }

python_imports() {
    as_user 'python3 -c "import hdlyap, hdlyap.msg, hdlyap.data; print(hdlyap.__file__, hdlyap.msg.Spectrum._md5sum)"
        rosmsg show hdlyap/Spectrum | grep "float64\[\] exponents"'
}

# Each program in Python answers, found by rosrun.
scripts_answer() {
    as_user 'for name in $(grep -lE "^#!.*python3" /usr/lib/hdlyap/*); do rosrun hdlyap $(basename $name) --help >/dev/null; done
        for name in $(hdlyap | sed -n "s/^  \([a-z]*\)  .*/\1/p"); do hdlyap $name --help >/dev/null; done'
}

core_in_c() { as_user 'tests/install/check.sh /usr $PWD/consumer'; }

# A catkin package with core, wrapper and messages in C, C++ and Python.
downstream_talks() {
    as_user 'cmake -S tests/downstream -B downstream -DCMAKE_INSTALL_PREFIX=$PWD/installed
        cmake --build downstream && cmake --install downstream' &&
        beside_a_master '. downstream/devel/setup.bash
            rosrun hdlyap_downstream talker & talker=$!
            for name in listener listener.py; do timeout 60 rosrun hdlyap_downstream $name | head -n 1 | grep "^3\."; done
            kill $talker'
}

leaves_nothing() {
    inside bash -c 'apt-get purge -y -q $(dpkg-query -W -f "\${Package}\n" "*hdlyap*")'
    files >"$WORK/files.after"
    diff "$WORK/files.before" "$WORK/files.after"
}

stop_at_exit
[[ -n ${2:-} ]] || rm -rf "$WORK"
mkdir -p "$WORK"
if [[ -z ${2:-} ]]; then
    fresh_system "$RELEASE" builder
    step prepare prepare_builder || die "the builder is not ready"
    step build build_packages || die "the build failed"
    check warnings warns_of_nothing
    check lintian lintian_is_content
    check build_folder names_no_build_folder
    leave_system
fi
fresh_system "$RELEASE" user
step prepare prepare_user || die "the user's system is not ready"
files >"$WORK/files.before"
check installs installs
check finds_package finds_package
check node node_runs
check launches launches record:=true 'bag:=$PWD/quick.bag'
check draws draws_bag
check ranks launches ranks:=2
check python python_imports
check scripts scripts_answer
check core_in_c core_in_c
check downstream downstream_talks
check leaves_nothing leaves_nothing
for package in "$PACKAGES"/*.deb; do
    printf '%9d bytes, %5d kB installed: %s\n' "$(stat -c %s "$package")" "$(dpkg-deb -f "$package" Installed-Size)" "$(basename "$package")"
done
leave_system
exit "$FAILED"
