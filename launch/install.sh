#!/usr/bin/env bash
# The one list of the system packages of hdlyap. Installs those that are missing.
#   install.sh messages|run|test   what messages and Python tools alone need (cmake -DHDLYAP_MESSAGES_ONLY=ON);
#                                  run: what building and running all needs; test: what the tests need on top
#   install.sh list debian|noetic  only prints both; A|B is the first of them that the release has
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

message_packages() {
    echo build-essential cmake python3-setuptools python3-numpy python3-scipy python3-matplotlib python3-pandas python3-yaml python3-rospkg ffmpeg
    case $1 in
        debian)
            echo catkin ros-message-generation ros-message-runtime libroscpp-dev \
                ros-std-msgs libstd-msgs-dev python3-std-msgs python3-diagnostic-msgs \
                python3-rospy python3-rosbag python3-rosgraph python3-roslaunch python3-roslib rosbash ros-environment
            ;;
        noetic)
            printf 'ros-noetic-%s\n' catkin message-generation message-runtime roscpp std-msgs diagnostic-msgs \
                rospy rosbag rosgraph roslaunch roslib rosbash ros-environment
            ;;
    esac
}

run_packages() {
    message_packages "$1"
    echo pkg-config procps python3-paramiko python3-tk libopenblas-openmp-dev liblapacke-dev libyaml-cpp-dev zlib1g-dev
    case $1 in
        debian)
            echo ros-std-srvs libstd-srvs-dev python3-std-srvs ros-diagnostic-msgs libdiagnostic-msgs-dev \
                ros-visualization-msgs libvisualization-msgs-dev python3-visualization-msgs libtf2-msgs-dev python3-tf2-msgs rviz
            ;;
        noetic) printf 'ros-noetic-%s\n' std-srvs visualization-msgs tf2-msgs rviz ;;
    esac
}

test_packages() {
    echo ccache python3-xarray libcmocka-dev libgtest-dev ninja-build shellcheck strace valgrind clang libomp-dev xvfb libxtst6 imagemagick libgl1-mesa-dri \
        black flake8 clang-format doxygen libopenmpi-dev openmpi-bin slurmctld slurmd slurm-client openssh-server iproute2
    case $1 in
        debian)
            echo 'libclang-rt-dev|libclang-common-11-dev' libmessage-filters-dev python3-message-filters librostest-dev python3-rostest python3-rostopic python3-rosnode \
                python3-rosservice python3-rosmaster python3-rosmsg rospack-tools \
                python3-rosgraph-msgs catkin-lint
            ;;
        noetic)
            printf 'ros-noetic-%s\n' message-filters rostest rostopic rosnode rosservice rosmaster rosmsg rospack rosgraph-msgs
            echo python3-catkin-lint
            ;;
    esac
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
