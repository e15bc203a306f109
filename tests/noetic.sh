#!/usr/bin/env bash
# What of Ubuntu 20.04 with ROS Noetic can be had on Debian 11: GCC 9, packages named ros-noetic-* (empty ones, which need
# Debian's), and a prefix /opt/ros/noetic that catkin made and that has Debian's ROS in it. There: the demo, then an
# install, overlays and a workspace with catkin_make. Changes the system for good: run by 'other_releases.sh bullseye noetic'.
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly WORK=/opt/hdlyap_noetic DEBS=/opt/hdlyap_noetic/debs
export DEBIAN_FRONTEND=noninteractive CC=gcc-9 CXX=g++-9

# packages of ROS' keys: NAME of Noetic, then those of Debian
table() {
    python3 -c '
import sys
sys.path.insert(0, "tests/ros")
import test_packaging
for key, packages in test_packaging.OF_ROS.items():
    print("ros-noetic-" + key.replace("_", "-"), packages)'
}

# Each needs Debian's packages of the same key; a repository of them, for apt.
empty_packages() {
    local name needs folder
    mkdir -p "$DEBS"
    while read -r name needs; do
        folder=$WORK/$name
        mkdir -p "$folder/DEBIAN"
        printf '%s\n' "Package: $name" 'Version: 1' 'Architecture: all' 'Maintainer: nobody <nobody@localhost>' "Depends: ${needs// /, }" \
            'Description: stands for one of Noetic' >"$folder/DEBIAN/control"
        dpkg-deb --build "$folder" "$DEBS" >/dev/null
    done < <(table)
    (cd "$DEBS" && dpkg-scanpackages . >Packages)
    echo "deb [trusted=yes] file:$DEBS ./" >/etc/apt/sources.list.d/noetic.list
}

# Setup files by catkin itself; every ROS package of Debian and its programs below it.
prefix() {
    local name
    mkdir -p "$WORK/base"
    echo '<package format="2"><name>base</name><version>1.0.0</version><description>b</description><maintainer email="a@localhost.org">a</maintainer>
        <license>none</license><buildtool_depend>catkin</buildtool_depend></package>' >"$WORK/base/package.xml"
    printf '%s\n' 'cmake_minimum_required(VERSION 3.16)' 'project(base C)' 'find_package(catkin REQUIRED)' 'catkin_package()' \
        >"$WORK/base/CMakeLists.txt"
    cmake -S "$WORK/base" -B "$WORK/base/build" "-DCMAKE_INSTALL_PREFIX=$NOETIC" -DPYTHON_EXECUTABLE=/usr/bin/python3
    cmake --install "$WORK/base/build"
    for name in /usr/share/*/package.xml; do
        name=$(basename "$(dirname "$name")")
        ln -sfn "/usr/share/$name" "$NOETIC/share/$name"
        [[ ! -d /usr/lib/$name ]] || ln -sfn "/usr/lib/$name" "$NOETIC/lib/$name"
    done
    mkdir -p "$NOETIC/etc/catkin/profile.d"
    cp /etc/catkin/profile.d/* "$NOETIC/etc/catkin/profile.d"
    sed -i 's/Debian/noetic/' "$NOETIC/etc/catkin/profile.d/1.ros_distro.sh"
    grep -q noetic "$NOETIC/etc/catkin/profile.d/1.ros_distro.sh"
}

cd "$ROOT"
apt-get update -q
apt-get install -y -q --no-install-recommends dpkg-dev python3-yaml g++-9 ninja-build
empty_packages
mkdir -p "$NOETIC"
launch/install.sh run # for Noetic, as the folder is there
[[ -n $(dpkg-query -W 'ros-noetic-*') ]]
prefix
launch/demo.sh --scene quick --build "$WORK/build"
grep '^CMAKE_C_COMPILER:.*gcc-9$' "$WORK/build/CMakeCache.txt"
grep "$NOETIC" "$WORK/build/.install/_setup_util.py" # what is sourced chains it

own_environment "$WORK/home"
build "$WORK/ros" -DCATKIN_ENABLE_TESTING=OFF "-DCMAKE_INSTALL_PREFIX=$WORK/ros/.install"
cmake --install "$WORK/ros"
exec tests/install/ros.sh "$WORK/downstream" "$WORK/ros" "$WORK/ros/.install"
