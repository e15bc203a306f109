#!/usr/bin/env bash
# The system packages of hdlyap: those of package.xml, and tools. Installs those that are missing.
#   install.sh messages|run|test   what messages and Python tools alone need (cmake -DHDLYAP_MESSAGES_ONLY=ON);
#                                  run: what building and running all needs; test: what the tests need on top
#   install.sh list debian|noetic  only prints both; A|B is the first of them that the release has
#   install.sh keys FLAVOUR KEY..  prints what these keys of package.xml stand for
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# The keys of package.xml, and the packages of Debian 12 that hdlyap uses of what each stands for: those of rosdep's base.yaml and
# python.yaml, the same on Ubuntu; below the line, of ROS, those of Debian's python3-rosdep2, and on Noetic ros-noetic-KEY.
# libopenblas-openmp-dev is the one of libopenblas-dev's alternatives that hdlyap is tested with.
readonly KEYS='
ccache                  ccache
ffmpeg                  ffmpeg
gtest                   libgtest-dev
liblapacke-dev          liblapacke-dev
libopenblas-dev         libopenblas-openmp-dev
mpi                     libopenmpi-dev openmpi-bin
ninja-build             ninja-build
pkg-config              pkg-config
python3-matplotlib      python3-matplotlib
python3-numpy           python3-numpy
python3-pandas          python3-pandas
python3-paramiko        python3-paramiko
python3-pytest          python3-pytest
python3-rospkg          python3-rospkg
python3-scipy           python3-scipy
python3-setuptools      python3-setuptools
python3-tk              python3-tk
python3-yaml            python3-yaml
yaml-cpp                libyaml-cpp-dev
zlib                    zlib1g-dev
--
catkin                  catkin
diagnostic_msgs         libdiagnostic-msgs-dev python3-diagnostic-msgs ros-diagnostic-msgs
message_filters         libmessage-filters-dev python3-message-filters
message_generation      ros-message-generation
message_runtime         ros-message-runtime
ros_environment         ros-environment
rosbag                  python3-rosbag
rosbash                 rosbash
roscpp                  libroscpp-dev
rosgraph                python3-rosgraph
rosgraph_msgs           python3-rosgraph-msgs
roslaunch               python3-roslaunch
roslib                  python3-roslib
rosmaster               python3-rosmaster
rosmsg                  python3-rosmsg
rosnode                 python3-rosnode
rospack                 rospack-tools
rospy                   python3-rospy
rosservice              python3-rosservice
rostest                 librostest-dev python3-rostest
rostopic                python3-rostopic
rviz                    rviz
std_msgs                libstd-msgs-dev python3-std-msgs ros-std-msgs
std_srvs                libstd-srvs-dev python3-std-srvs ros-std-srvs
tf2_msgs                libtf2-msgs-dev python3-tf2-msgs
visualization_msgs      libvisualization-msgs-dev python3-visualization-msgs ros-visualization-msgs
'
# without node and libraries: python3-diagnostic-msgs is what tools import
readonly OF_MESSAGES='catkin ffmpeg message_generation message_runtime python3-matplotlib python3-numpy python3-pandas python3-rospkg
    python3-scipy python3-setuptools python3-yaml ros_environment rosbag rosbash roscpp rosgraph roslaunch roslib rospy std_msgs'

# packages_of FLAVOUR KEY...
packages_of() {
    awk -v flavour="$1" -v keys="${*:2}" '
        BEGIN { split(keys, each, " "); for (k in each) wanted[each[k]] = 1 }
        $1 == "--" { of_ros = 1; next }
        !($1 in wanted) { next }
        { key = $1; delete wanted[key]; sub(/^[^ ]+ +/, "") }
        of_ros && flavour == "noetic" { gsub(/_/, "-", key); $0 = "ros-noetic-" key }
        { print }
        END { for (key in wanted) { print "no package is known of " key >"/dev/stderr"; failed = 1 } exit failed }' <<<"$KEYS"
}

# keys_of KIND: of package.xml, what has that kind of dependency: test, or all others
keys_of() {
    sed -nE 's/^ *<(\w*depend)>(.*)<.*/\1 \2/p' "$ROOT/package.xml" |
        awk -v kind="$1" '(kind == "test") == ($1 == "test_depend") { print $2 }' | sort -u
}

message_packages() {
    echo build-essential cmake "$([[ $1 == debian ]] && echo python3-diagnostic-msgs || echo ros-noetic-diagnostic-msgs)"
    # shellcheck disable=SC2086
    packages_of "$1" $OF_MESSAGES
}

run_packages() {
    echo build-essential cmake procps
    # shellcheck disable=SC2046
    packages_of "$1" $(keys_of run)
}

test_packages() {
    echo python3-xarray libcmocka-dev shellcheck strace valgrind clang libomp-dev xvfb libxtst6 imagemagick libgl1-mesa-dri \
        black flake8 clang-format doxygen slurmctld slurmd slurm-client openssh-server iproute2
    [[ $1 == noetic ]] && echo python3-catkin-lint || echo 'libclang-rt-dev|libclang-common-11-dev' catkin-lint
    # shellcheck disable=SC2046
    packages_of "$1" $(keys_of test)
}

ros_flavour() {
    if [[ -d $NOETIC ]]; then
        echo noetic
    elif grep -qx 'ID=debian' /etc/os-release; then
        echo debian
    else
        die "neither Debian nor $NOETIC: install ROS 1 by hand and use --no-install"
    fi
}

is_installed() {
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

# Sets missing; of alternatives, the first that apt knows by now.
find_missing() {
    local names name
    missing=()
    for names in $wanted; do
        for name in ${names//|/ }; do
            ! is_installed "$name" || continue 2
        done
        for name in ${names//|/ }; do
            [[ $names != *'|'* || -z $(apt-cache madison "$name" 2>/dev/null) ]] || break
        done
        missing+=("$name")
    done
}

as_root() {
    if [[ $(id -u) == 0 ]]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        echo "neither root nor sudo" >&2
        return 1
    fi
}

# A user's own umask would be that of what the scripts of packages write, for everybody.
install_missing() {
    umask 022
    as_root apt-get update -q || return
    find_missing # of alternatives, what apt has heard of just now
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
}

if [[ ${1:-} == list && ${2:-} == @(debian|noetic) ]]; then
    run_packages "$2"
    test_packages "$2"
    exit
fi
if [[ ${1:-} == keys && $# -gt 2 ]]; then
    packages_of "${@:2}"
    exit
fi
flavour=$(ros_flavour)
case ${1:-} in
    messages) wanted=$(message_packages "$flavour") ;;
    run) wanted=$(run_packages "$flavour") ;;
    test) wanted="$(run_packages "$flavour") $(test_packages "$flavour")" ;;
    *) die "usage: install.sh messages|run|test|list debian|list noetic" 2 ;;
esac
find_missing
((${#missing[@]})) || exit 0

say "installing ${missing[*]}"
install_missing || die "${#missing[@]} packages are missing. Who may install them types, as root, this line:
apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
