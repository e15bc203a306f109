#!/usr/bin/env bash
# One more observable is these files and two lines; tests that go over rows hold for it as they are. It is the core's file, its
# message, what fills that, and a figure.
#   run.sh WORK_FOLDER
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../launch/common.sh"

readonly WORK=$1 TREE=$1/tree HERE=$ROOT/tests/one_more
readonly CORE=(all_kept checkpoint checkpoint_contents madeup observables out_of_memory)
mkdir -p "$TREE"
# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

add() {
    tar -C "$ROOT" --exclude=./build --exclude=./.git -c . | tar -C "$TREE" -x
    cp "$HERE/momenta_row.c" "$TREE/hdlyap_core/src/observe/"
    cp "$HERE/Momenta.msg" "$TREE/msg/"
    cp "$HERE/momenta.c" "$TREE/hdlyap_ros/src/topics/"
    cp "$HERE/momenta.py" "$TREE/hdlyap_ros/python/hdlyap/plots/figures/"
    sed -i 's|^#undef HD_OBSERVABLE|HD_OBSERVABLE(momenta, MOMENTA, 2048, 0, const double)\n&|' "$TREE/hdlyap_core/include/hdlyap/observables.inc"
    sed -i 's|^TOPIC(state, |TOPIC(momenta, momenta, HD_OBSERVE_MOMENTA, TOPIC_OBSERVABLE \| TOPIC_OF_VECTORS)\n&|' \
        "$TREE/hdlyap_ros/src/topics/rows.inc"
}

# Memory that runs out, checkpoints, resets, what nobody looks at.
in_core() {
    cmake -S "$TREE" -B "$WORK/core" -DHDLYAP_ROS=OFF -DHDLYAP_BENCH=OFF -DCMAKE_DISABLE_FIND_PACKAGE_catkin=ON
    cmake --build "$WORK/core" --target "${CORE[@]/#/hdlyap_test_}" -- -j "$(nproc)"
    cd "$WORK/core"
    ctest --output-on-failure -j "$(nproc)" -R "core_($(IFS='|' && echo "${CORE[*]}"))\$"
}

built_for_ros() {
    cmake -S "$TREE" -B "$WORK/ros" -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCATKIN_ENABLE_TESTING=ON -DHDLYAP_CORE_TESTS=OFF \
        "-DCMAKE_INSTALL_PREFIX=$WORK/installed"
    cmake --build "$WORK/ros" --target all tests -- -j "$(nproc)"
    cmake "$WORK/ros"
    cmake --build "$WORK/ros" -- -j "$(nproc)"
}

# Its figure in a user's axes, each of its fields once in CSV, npz and xarray; odd messages.
in_python() {
    source_setup "$WORK/ros/devel/setup.bash"
    cd "$TREE/tests/ros"
    python3 -m pytest -m 'not second_tier' test_axes.py test_data_tools.py test_dataset.py test_strangers.py
}

# Live and in a bag, of the size that --check says, at each report, resumed.
published() {
    source_setup "$WORK/ros/devel/setup.bash"
    cd "$WORK/ros"
    ctest --output-on-failure -LE second_tier -j "$(nproc)" -R '(check|checkpoint|synchronized|bags)_f'
}

check 'an observable is four files and two lines' add
check 'the core tests hold for it' in_core
check 'it is built for ROS' built_for_ros
check 'its figure, tables and arrays are there' in_python
check 'it is published, recorded and resumed' published
exit "$FAILED"
