#!/usr/bin/env bash
# hdlyap as other packages and people meet it: installed below a prefix, in a build folder, in a catkin workspace.
#   ros.sh WORK_FOLDER ROS_BUILD INSTALLED_PREFIX
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../launch/common.sh"

readonly WORK=$1 BUILD=$2 PREFIX=$3 PACKAGE=$ROOT/tests/downstream
readonly SPACE="$WORK/a workspace" STAGE=$WORK/stage ELSEWHERE=/opt/hdlyap_elsewhere # which never exists
readonly ALONE=$WORK/alone # messages and Python tools
mkdir -p "$WORK"
# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

# in_space SETUP COMMAND...: as in a fresh terminal that has sourced nothing else.
in_space() (
    unset CMAKE_PREFIX_PATH ROS_PACKAGE_PATH PYTHONPATH LD_LIBRARY_PATH PKG_CONFIG_PATH
    [[ ! -f $NOETIC/setup.bash ]] || source_setup "$NOETIC/setup.bash"
    source_setup "$1"
    "${@:2}"
)

in_prefix() { in_space "$PREFIX/setup.bash" "$@"; }

# ---- the downstream package ------------------------------------------------------------------

# builds_against SETUP FOLDER [CMAKE OPTION]...
builds_against() {
    in_space "$1" cmake -S "$PACKAGE" -B "$2" -DPYTHON_EXECUTABLE=/usr/bin/python3 "-DCMAKE_INSTALL_PREFIX=$2/installed" "${@:3}" &&
        cmake --build "$2" -- -j "$(nproc)" && cmake --install "$2"
}

# Four disks have (16 - 6) / 2 positive exponents; the largest is 3.35 (tests/core: N = 4, rho = 0.5).
is_spectrum() { [[ $(wc -l <"$1") == 5 && $(head -n 1 "$1") == 3.* ]]; }

# they_talk SETUP [SETUP OF THE LISTENERS]: C through core and wrapper to C++ and Python.
they_talk() {
    local talker failed=0 name
    start in_space "$1" rosrun hdlyap_downstream talker
    talker=$CHILD
    for name in listener listener.py; do
        run in_space "${2:-$1}" timeout 60 rosrun hdlyap_downstream "$name" >"$WORK/heard" || failed=1
        is_spectrum "$WORK/heard" || failed=1
    done
    stop "$talker"
    finish "$talker" && ((!failed))
}

# ---- a node of one's own ----------------------------------------------------------------------

# own_launch SETUP NAME ARGUMENT...: run.launch with the downstream package's node, which moves a chain.
own_launch() { in_space "$1" timeout 100 roslaunch hdlyap run.launch package:=hdlyap_downstream program:=chain_node "scene:=$WORK/ring.yaml" "${@:2}"; }

# own_tools SETUP FOLDER: a sweep over the chain's own parameter, of two seeds, and a run of two ranks, which is that of one.
own_tools() {
    local -a own=(--package hdlyap_downstream --program chain_node)
    in_space "$1" hdlyap sweep "${own[@]}" --scene "$WORK/ring.yaml" --over 'beta 1 2' --seeds '1 2' --duration 200 --folder "$2/sweep" &&
        [[ $(sed -n '2,4s/ .*//p' "$2/sweep/sweep.txt" | tr '\n' ' ') == 'beta 1 2 ' ]] || return 1
    in_space "$1" env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 2 hdlyap run "$WORK/ring.yaml" --out "$2/ranks.bag" "${own[@]}" duration:=200.0 &&
        in_space "$1" hdlyap compare "$2/ranks.bag" "$2/sweep/beta_2_seed_1.bag"
}

# chain_runs SETUP: recorded, figures drawn, gone on from; its own parameters are read, refused and recorded as all others.
chain_runs() {
    local folder=$WORK/ring
    rm -rf "$folder" && mkdir -p "$folder"
    printf '%s: %s\n' number 8 beta 2.0 exponents all duration 2000.0 observables '[spectrum, localization]' >"$WORK/ring.yaml"
    own_launch "$1" record:=true "bag:=$folder/one.bag" "checkpoint:=$folder/kept" pace:=400 || return 1 # 5 s: it is examined
    in_space "$1" hdlyap plot "$folder/one.bag" --out "$folder" && [[ -s $folder/spectrum.png ]] || return 1
    own_launch "$1" "resume:=$folder/kept" duration:=4000.0 scene:= record:=true "bag:=$folder/two.bag" || return 1
    rosparam delete /hdlyap # the master is everybody's here
    in_space "$1" python3 "$ROOT/tests/install/chain.py" "$folder/one.bag" "$folder/two.bag" || return 1
    own_tools "$1" "$folder" || return 1
    in_space "$1" hdlyap repeat "$folder/one.bag" >"$folder/again.yaml" && is_valid "$1" "$folder/again.yaml" || return 1
    in_space "$1" rosrun hdlyap_downstream chain_node --parameters >"$folder/all.yaml" && is_valid "$1" "$folder/all.yaml" number:=8 || return 1
    refused "$1" 'beta = -1: must be from 0 to 1000' beta:=-1 &&
        refused "$1" 'betta = 1: no such parameter; is beta meant?' betta:=1 &&
        refused "$1" 'particles = rods: must be disks or spheres or dumbbells or soft_disks or soft_spheres or chain' particles:=rods &&
        refused "$1" 'density = 0.5: must not be given with particles = chain, which have no positions in a box' density:=0.5 &&
        refused "$1" 'observables = [gas]: must be a list out of spectrum, covariant, localization, fluctuations, state when particles = chain' 'observables:=[gas]' &&
        refused "$1" 'observables = [spectrum, localization]: must be a list out of state when exponents = none' exponents:=none
}

# is_valid SETUP SCENE [ARGUMENT]...
is_valid() { in_space "$1" rosrun hdlyap_downstream chain_node --check "${@:2}"; }

# refused SETUP LINE ARGUMENT
refused() {
    local said
    said=$(in_space "$1" rosrun hdlyap_downstream chain_node --check "$WORK/ring.yaml" "$3" 2>&1) && return 1
    [[ $said == *"$2"* ]] || { echo "$said" && return 1; }
}

# ---- what an installed hdlyap consists of ----------------------------------------------------

# has_every_file PREFIX: of the folders whose files people open.
has_every_file() {
    local share=$1/share/hdlyap include=$1/include file folder
    cd "$ROOT"
    for folder in launch/scenes launch msg doc hdlyap_ros/rviz hdlyap_ros/examples; do
        for file in "$folder"/*; do
            [[ ! -f $file || $file == *.sh || -s $share/${file#hdlyap_ros/} ]] || { echo "no $share/$file" && return 1; }
        done
    done
    for file in hdlyap_core/include/*/*.h hdlyap_ros/include/*/*.h; do
        [[ -s $include/${file#*/include/} ]] || { echo "no $include/${file#*/include/}" && return 1; }
    done
}

# Programs and scripts of an installed package.
programs() { find "$PREFIX/lib/hdlyap" -maxdepth 1 -type f -perm /111 -printf '%f\n'; }

# finds_programs SETUP FOLDER: each exactly once, there. rosrun counts scripts of the sources too, if they are executable: they
# are not.
finds_programs() {
    local name found
    for name in $(programs); do
        found=$(in_space "$1" rosrun --prefix echo hdlyap "$name" </dev/null)
        [[ $found == "$2/$name" ]] || { echo "$name: '$found'" && return 1; }
    done
    [[ $(programs) == *hdlyap_node* && $(in_space "$1" which hdlyap) == "${2%/lib/hdlyap}/bin/hdlyap" ]]
}

# commands: of hdlyap, as it lists them.
commands() { in_prefix hdlyap | sed -n 's/^  \([a-z]\{1,\}\)  .*/\1/p'; }

# Each answers by itself; a folder above the package's own on PYTHONPATH would be another one's.
scripts_run() {
    local name
    for name in $(programs); do
        [[ $(head -c 2 "$PREFIX/lib/hdlyap/$name") == '#!' ]] || continue
        head -n 1 "$PREFIX/lib/hdlyap/$name" | grep -qxE '#!/usr/bin/(env )?python3' || return 1
        in_prefix timeout 60 rosrun hdlyap "$name" --help || return 1
    done
    for name in $(commands); do in_prefix timeout 60 hdlyap "$name" --help || return 1; done
}

finds_package() {
    local name
    [[ $(in_prefix rospack find hdlyap) == "$PREFIX/share/hdlyap" ]] || return 1
    for name in msg plots follow sweep; do
        [[ $(in_prefix python3 -c "import hdlyap.$name as one; print(one.__file__)") == "$PREFIX"/lib/* ]] || return 1
    done
}

finds_messages() {
    local -a names=("$ROOT"/msg/*.msg)
    names=("${names[@]##*/}")
    in_prefix python3 "$ROOT/tests/install/messages.py" "$PREFIX" "${names[@]%.msg}" &&
        [[ $(in_prefix rosmsg show hdlyap/Spectrum) == *'float64[] exponents'* ]] &&
        [[ $(in_prefix rosmsg md5 hdlyap/Spectrum) == ???????????????????????????????? ]]
}

# Every launch file is found by name, has all files that it includes, and documents its arguments.
finds_launch_files() {
    local file name
    for file in "$ROOT"/launch/*.launch; do
        name=$(basename "$file")
        in_prefix roslaunch --files hdlyap "$name" | grep -Fx "$PREFIX/share/hdlyap/launch/$name" &&
            in_prefix roslaunch --nodes hdlyap "$name" && in_prefix roslaunch --ros-args hdlyap "$name" || return 1
    done
}

# headers_compile PREFIX: each of them, as C and as C++.
headers_compile() {
    local header
    [[ -s $1/include/hdlyap_ros/messages.h ]] || return 1
    while read -r header; do
        printf '#include <%s>\nint main(void) { return 0; }\n' "${header#"$1"/include/}" >"$WORK/header.c"
        cc -std=c11 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$1/include" "$WORK/header.c" || return 1
        c++ -x c++ -std=c++14 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$1/include" "$WORK/header.c" || return 1
    done < <(find "$1/include/hdlyap" "$1/include/hdlyap_ros" -name '[a-z]*.h')
}

# ---- messages and Python tools alone, where nothing of the rest is there -------------

builds_alone() {
    local name
    local -a hidden
    for name in OpenMP PkgConfig ZLIB roscpp diagnostic_msgs std_srvs tf2_msgs tf2_ros visualization_msgs; do
        hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$name=ON")
    done
    mkdir -p "$ALONE/hidden"
    for name in rviz std_srvs tf2_msgs tf2_ros visualization_msgs; do
        echo 'raise ImportError("hidden")' >"$ALONE/hidden/$name.py"
    done
    PKG_CONFIG_LIBDIR=$ELSEWHERE cmake -S "$ROOT" -B "$ALONE/build" -DHDLYAP_MESSAGES_ONLY=ON "${hidden[@]}" \
        -DPYTHON_EXECUTABLE=/usr/bin/python3 "-DCMAKE_INSTALL_PREFIX=$ALONE/installed" &&
        cmake --build "$ALONE/build" && cmake --install "$ALONE/build" &&
        [[ -z $(find "$ALONE/installed" -name 'libhdlyap*' -o -name hdlyap_node -o -name hdlyap_ros) ]]
}

# What needs a node says that there is none.
says_what_it_lacks() {
    local said status=0
    for said in launch 'run quick --out none.bag' 'sweep --seeds 1'; do
        # shellcheck disable=SC2086
        said=$(in_alone hdlyap $said 2>&1) || status=$?
        [[ $status == 2 && $said == 'hdlyap '*': hdlyap was built without hdlyap_node, as messages and tools alone'* && $said != *$'\n'* ]] ||
            { echo "$status $said" && return 1; }
    done
}

# shellcheck disable=SC2016
in_alone() { in_space "$ALONE/installed/setup.bash" sh -c 'PYTHONPATH=$0:$PYTHONPATH exec "$@"' "$ALONE/hidden" "$@"; }

# Every module is imported but the one that draws for rviz; figures and a comparison are made of a bag.
tools_alone() {
    local bag=$ALONE/run.bag
    in_alone python3 -c 'import importlib.util, pkgutil, hdlyap
for one in pkgutil.walk_packages(hdlyap.__path__, "hdlyap."):
    if one.name != "hdlyap.commands.view": importlib.import_module(one.name)
    print(importlib.util.find_spec(one.name).origin)' >"$ALONE/modules" &&
        diff <(sed -n '/\/hdlyap\/\(msg\|srv\)\//d; s|.*/dist-packages/||p' "$ALONE/modules" | sort) \
            <(cd "$ROOT/hdlyap_ros/python" && find hdlyap -name '*.py' ! -path hdlyap/__init__.py | sort) || return 1
    in_alone env --chdir="$ROOT/tests/ros" python3 -c 'import sys, made, test_compare
made.write(sys.argv[1], test_compare.run())' "$bag" &&
        in_alone hdlyap plot "$bag" --out "$ALONE" && [[ -s $ALONE/spectrum.png && -s $ALONE/steps.png ]] &&
        [[ $(in_alone hdlyap compare "$bag" "$bag") == *identical* && $(in_alone hdlyap view 2>&1) == 'hdlyap view: '* ]] && in_alone hdlyap repeat "$bag"
}

# A node of the whole package, which waits for those who follow it.
follows_alone() {
    local node status=0
    start in_prefix rosrun hdlyap hdlyap_node _number:=20 _aspect:=1.0 _equilibration:=1.0 _warmup:=1.0 _duration:=5.0 \
        '_wait_for_subscribers:=[cost, spectrum]'
    node=$CHILD
    run in_alone timeout 60 hdlyap follow --line || status=$?
    stop "$node"
    finish "$node" && ((!status))
}

# ---- a workspace: catkin_make, ninja, Debug, a space in its path, DESTDIR ---------------------

workspace_builds() {
    rm -rf "$SPACE"
    mkdir -p "$SPACE/src/hdlyap"
    # the build folder of a clone is not part of it
    find "$ROOT" -mindepth 1 -maxdepth 1 ! -name build ! -name '.git' -exec cp -r -t "$SPACE/src/hdlyap" {} + &&
        cp -r "$PACKAGE" "$SPACE/src/downstream" && cd "$SPACE" &&
        catkin_make --use-ninja -j"$(nproc)" -DPYTHON_EXECUTABLE=/usr/bin/python3 -DCMAKE_BUILD_TYPE=Debug \
        -DCMAKE_DISABLE_FIND_PACKAGE_rostest=ON "-DCMAKE_INSTALL_PREFIX=$ELSEWHERE" </dev/null
}

# Configured once more, nothing is compiled again.
workspace_builds_once() {
    cmake "$SPACE/build" && cmake --build "$SPACE/build" >"$WORK/again" &&
        cat "$WORK/again" && ! grep -E 'Building|Linking' "$WORK/again" | grep -v hdlyap_downstream # a user's own is not ours
}

# shellcheck disable=SC2016
compiles_by_hand() {
    in_space "$SPACE/devel/setup.bash" bash -o pipefail -c 'pkg-config --cflags --libs hdlyap | xargs cc -o "$0" "$1"' \
        "$WORK/watch_phase" "$SPACE/src/hdlyap/hdlyap_ros/examples/watch_phase.c"
}

installs_below_destdir() {
    DESTDIR=$STAGE cmake --install "$SPACE/build" &&
        [[ ! -e $ELSEWHERE && $(ls -A "$STAGE") == opt && $(ls -A "$STAGE/opt") == "${ELSEWHERE##*/}" ]] &&
        has_every_file "$STAGE$ELSEWHERE"
}

# Python's caches name the folder that they were made in, as those of every catkin package; debug information has to.
names_no_build_folder() {
    find "$STAGE" -type f \( -perm /111 -o -name '*.so*' \) -exec sh -c 'strip --strip-debug "$1" 2>/dev/null; true' - {} \;
    ! grep -rlF --exclude='*.pyc' "$WORK" "$STAGE"
}

# Before anything is built: catkin would give the path to a shell.
refuses_a_folder() {
    ! cmake -S "$ROOT" -B "$WORK/build (1)" >"$WORK/refused.log" 2>&1 &&
        tr -s ' \n' ' ' <"$WORK/refused.log" | grep -qF 'build (1): must be without ( )'
}

own_environment "$WORK/home"
stop_at_exit
start roscore -p "${ROS_MASTER_URI##*:}" >"$WORK/roscore.log" 2>&1
until rostopic list >/dev/null 2>&1; do sleep 0.2; done
check package finds_package
check messages finds_messages
check launch_files finds_launch_files
check files has_every_file "$PREFIX"
check headers headers_compile "$PREFIX"
check programs finds_programs "$PREFIX/setup.bash" "$PREFIX/lib/hdlyap"
check scripts scripts_run
check builds_against_install run builds_against "$PREFIX/setup.bash" "$WORK/installed"
check talks_from_install they_talk "$WORK/installed/installed/setup.bash"
check builds_against_devel run builds_against "$BUILD/devel/setup.bash" "$WORK/devel"
check talks_from_devel they_talk "$WORK/devel/devel/setup.bash"
check own_node run chain_runs "$WORK/installed/installed/setup.bash"
check builds_alone run builds_alone
check says_what_it_lacks says_what_it_lacks
check tools_alone tools_alone
check follows_alone follows_alone
check builds_against_alone run builds_against "$ALONE/installed/setup.bash" "$WORK/against_alone" -Dhdlyap_downstream_LISTENERS_ONLY=ON
check talks_to_alone they_talk "$WORK/installed/installed/setup.bash" "$WORK/against_alone/installed/setup.bash"
check workspace run workspace_builds
check workspace_builds_once workspace_builds_once
check workspace_programs finds_programs "$SPACE/devel/setup.bash" "$SPACE/devel/lib/hdlyap"
check talks_in_workspace they_talk "$SPACE/devel/setup.bash"
check compiles_by_hand compiles_by_hand
check destdir installs_below_destdir
check no_build_folder names_no_build_folder
check refuses_a_folder refuses_a_folder
exit "$FAILED"
