#!/usr/bin/env bash
# Builds the packages of debian/ in a fresh minimal system, and tries them in another one: installed, used by an ordinary user,
# removed, after which no file may be left. As root, with debootstrap; no part of the suite.
#   packages.sh [RELEASE [FOLDER]]    of Debian (bookworm); packages of FOLDER are only tried. They are then in build/packages
# shellcheck disable=SC2016
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"
# shellcheck source=tests/minimal.sh
source "$ROOT/tests/minimal.sh"

readonly RELEASE=${1:-bookworm} WORK=$ROOT/build/packages TREE=/hdlyap_was_built_here/hdlyap
readonly BUILDER=$FOLDER/$RELEASE.builder SYSTEM=$FOLDER/$RELEASE.user DEBS=$FOLDER/$RELEASE.debs
# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

as_builder() { inside "$BUILDER" "$DEBS" "$@"; }
as_admin() { inside "$SYSTEM" "$DEBS" "$@"; }

# as_user LINE: of a shell, beside a ROS master, in a network of its own.
as_user() {
    # shellcheck disable=SC2016
    as_admin unshare --net bash -ec 'ip link set lo up
        exec setpriv --reuid=user --regid=user --init-groups env HOME=/home/user ROS_HOSTNAME=localhost bash -ec "cd; $0"' "$1"
}

# beside_a_master LINE: of a shell, as the user.
beside_a_master() { as_user "roscore >/dev/null & until rostopic list >/dev/null 2>&1; do sleep 0.2; done; $1"; }

# ---- what is built ----------------------------------------------------------------------------

prepare_builder() {
    make_system "$RELEASE" "$BUILDER"
    mkdir -p "$BUILDER$TREE"
    tar -C "$ROOT" --exclude=./build --exclude=./.git -c . | tar -C "$BUILDER$TREE" -x --no-same-owner
    as_builder apt-get update -q
    as_builder apt-get install -y -q --no-install-recommends build-essential lintian
    as_builder apt-get build-dep -y -q --no-install-recommends "$TREE"
}

build_packages() {
    as_builder env -C "$TREE" "DEB_BUILD_OPTIONS=parallel=$(nproc) noautodbgsym" dpkg-buildpackage -us -uc -b
    cp "$BUILDER${TREE%/*}"/*.deb "$WORK"
}

warns_of_nothing() { ! grep -n ': warning:' "$WORK/build.log"; }

lintian_is_content() { as_builder env -C "${TREE%/*}" bash -c 'lintian --allow-root --fail-on error,warning --tag-display-limit 0 *.changes'; }

# Nor a file that Python has compiled there.
names_no_build_folder() {
    local package
    for package in "$WORK"/*.deb; do
        dpkg-deb -x "$package" "$WORK/unpacked/$(basename "$package" .deb)"
    done
    ! find "$WORK/unpacked" -name '*.py[co]' | grep . && ! grep -rlF "${TREE%/*}" "$WORK/unpacked" && ! grep -rlF /obj- "$WORK/unpacked"
}

# ---- what is installed ------------------------------------------------------------------------

# of_packages FIELD: of all of them, without their own names.
of_packages() {
    local package
    for package in "$WORK"/*.deb; do dpkg-deb -f "$package" "$1"; done | tr ',' '\n' | grep -v hdlyap | sort -u | paste -sd ,
}

# What they need is there before: all that they bring, and nothing else, has to go with them.
prepare_user() {
    make_system "$RELEASE" "$SYSTEM"
    mkdir "$SYSTEM/packages"
    cp "$WORK"/*.deb "$SYSTEM/packages"
    as_admin apt-get update -q
    as_admin apt-get satisfy -y -q --no-install-recommends "$(of_packages Depends)"
    as_admin apt-get install -y -q --no-install-recommends g++ cmake make pkg-config openmpi-bin iproute2 python3-rostopic
    as_admin useradd -m user
    cp -r "$ROOT/tests" "$SYSTEM/home/user"
    chown -R --reference="$SYSTEM/home/user" "$SYSTEM/home/user"
}

# files: all of the system, with their kinds and rights, but for logs, lists of packages and homes.
files() {
    find "$SYSTEM" -xdev \( -path "$SYSTEM/home" -o -path "$SYSTEM/tmp" -o -path "$SYSTEM/var/log" -o -path "$SYSTEM/var/cache" \
        -o -path "$SYSTEM/var/lib/dpkg" -o -path "$SYSTEM/var/lib/apt" \) -prune -o -printf '%P %y %m %l\n' | sort
}

installs() { as_admin bash -c 'apt-get install -y -q --no-install-recommends /packages/*.deb'; }

finds_package() { [[ $(as_user 'rospack find hdlyap') == /usr/share/hdlyap ]]; }

node_runs() { beside_a_master 'rosrun hdlyap hdlyap_node _disks:=20 _aspect:=1.0 _equilibration:=1.0 _warmup:=1.0 _duration:=5.0'; }

# Its table, its result, a bag and figures of it.
launches() {
    as_user 'roslaunch hdlyap run.launch scene:=quick record:=true bag:=$PWD/quick.bag | tee said
        grep -q "^result of /hdlyap, quick: " said
        ! grep "has died" said
        rosrun hdlyap plot_bag quick.bag --out figures | grep "^lambda_max"
        test -s figures/spectrum.png'
}

launches_ranks() {
    as_user 'roslaunch hdlyap run.launch scene:=quick ranks:=2 | tee said
        grep -q "^result of /hdlyap, quick: " said
        ! grep "has died" said'
}

python_imports() {
    as_user 'python3 -c "import hdlyap, hdlyap.msg, hdlyap.data; print(hdlyap.__file__, hdlyap.msg.Spectrum._md5sum)"
        rosmsg show hdlyap/Spectrum | grep "float64\[\] exponents"'
}

# Each program in Python answers, found by rosrun.
scripts_answer() {
    as_user 'for name in $(grep -lE "^#!.*python3" /usr/lib/hdlyap/*); do rosrun hdlyap $(basename $name) --help >/dev/null; done'
}

core_in_c() { as_user 'tests/install/check.sh /usr $PWD/consumer'; }

# A catkin package with core, wrapper and messages in C, C++ and Python.
downstream_talks() {
    as_user 'cmake -S tests/downstream -B downstream && cmake --build downstream && cmake --install downstream --prefix $PWD/installed' &&
        beside_a_master '. downstream/devel/setup.bash
            rosrun hdlyap_downstream talker & talker=$!
            for name in listener listener.py; do timeout 60 rosrun hdlyap_downstream $name | tee /dev/stderr | head -n 1 | grep "^3\."; done
            kill $talker'
}

leaves_nothing() {
    as_admin bash -c 'apt-get purge -y -q $(dpkg-query -W -f "\${Package}\n" "*hdlyap*")'
    files >"$WORK/files.after"
    diff "$WORK/files.before" "$WORK/files.after"
}

((EUID == 0)) || die "needs root, for debootstrap and chroot"
for word in debootstrap unshare dpkg-deb; do command -v "$word" >/dev/null || die "needs $word"; done
rm -rf "$WORK"
mkdir -p "$WORK"
stop_at_exit
make_base "$RELEASE"
if [[ -n ${2:-} ]]; then
    cp "$2"/*.deb "$WORK"
else
    prepare_builder >"$WORK/builder.log" 2>&1 || die "the builder is not ready; its log is $WORK/builder.log"
    build_packages >"$WORK/build.log" 2>&1 || die "the build failed; its log is $WORK/build.log"
    check warnings warns_of_nothing
    check lintian lintian_is_content
    check build_folder names_no_build_folder
fi
prepare_user >"$WORK/user.log" 2>&1 || die "the user's system is not ready; its log is $WORK/user.log"
files >"$WORK/files.before"
check installs installs
check finds_package finds_package
check node node_runs
check launches launches
check ranks launches_ranks
check python python_imports
check scripts scripts_answer
check core_in_c core_in_c
check downstream downstream_talks
check leaves_nothing leaves_nothing
for package in "$WORK"/*.deb; do
    printf '%9d %s\n' "$(stat -c %s "$package")" "$(basename "$package")"
done
((FAILED)) || rm -rf --one-file-system "$BUILDER" "$SYSTEM"
exit "$FAILED"
