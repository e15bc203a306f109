#!/usr/bin/env bash
# runs.launch on two machines over ssh, as doc/many_machines.md says. The machines are network namespaces of this one, on a
# bridge, with an sshd and a key of the test's own. As root.
#   ssh.sh WORK_FOLDER INSTALLED_SETUP
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly WORK=$1 SETUP=$2 NET=10.213.$(($$ % 254 + 1)) BRIDGE=hdlyap$$
readonly MACHINES=("hdlyap$$a" "hdlyap$$b")
mkdir -p "$WORK/out"
# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"

address() { echo "$NET.$(($1 + 2))"; } # of machine number 0, 1 ..

network() {
    local k name
    ip link add "$BRIDGE" type bridge && ip address add "$NET.1/24" dev "$BRIDGE" && ip link set "$BRIDGE" up || return 1
    for k in "${!MACHINES[@]}"; do
        name=${MACHINES[k]}
        ip netns add "$name" && ip link add "$name" type veth peer name eth0 netns "$name" &&
            ip link set "$name" master "$BRIDGE" up && ip -n "$name" address add "$(address "$k")/24" dev eth0 &&
            ip -n "$name" link set eth0 up && ip -n "$name" link set lo up || return 1
    done
}

no_network() {
    local name
    for name in "${MACHINES[@]}"; do ip netns del "$name" 2>/dev/null || true; done
    ip link del "$BRIDGE" 2>/dev/null || true
}

listening() { (: >"/dev/tcp/$1/22") 2>/dev/null; }

daemons() {
    local k
    ssh-keygen -q -t ed25519 -N '' -f "$WORK/host" && ssh-keygen -q -t ed25519 -N '' -f "$WORK/key" || return 1
    cp "$WORK/key.pub" "$WORK/authorized"
    mkdir -p /run/sshd # sshd wants it, for its child without rights
    for k in "${!MACHINES[@]}"; do
        start ip netns exec "${MACHINES[k]}" /usr/sbin/sshd -D -E "$WORK/sshd.$k" -f /dev/null -h "$WORK/host" -o PidFile=none \
            -o "AuthorizedKeysFile=\"$WORK/authorized\"" -o PermitRootLogin=yes -o StrictModes=no -o "ListenAddress=$(address "$k")"
        wait_for 20 listening "$(address "$k")" || return 1
    done
}

# What a shell on a machine must know: where hdlyap is, and which address others reach it at.
environment() {
    cat >"$WORK/env.sh" <<END
#!/usr/bin/env bash
export ROS_IP=\$(hostname -I | tr ' ' '\n' | grep -F $NET.) ROS_HOME="$WORK/ros" TMPDIR="$TMPDIR"
unset ROS_HOSTNAME
source "$SETUP"
exec "\$@"
END
    chmod +x "$WORK/env.sh"
    {
        echo '<launch>'
        for k in "${!MACHINES[@]}"; do
            echo "<machine name=\"m$k\" address=\"$(address "$k")\" user=\"$(id -un)\" env-loader=\"'$WORK/env.sh'\" timeout=\"30\"/>"
        done
        echo '</launch>'
    } >"$WORK/machines.launch"
}

missing() {
    hdlyap sweep --seeds "1 2" --duration 600 --params "{number: 60, aspect: 0.2, equilibration: 5.0, warmup: 20.0}" --folder "$WORK/out" --write
}

# The key is offered by an agent: roslaunch asks for no other.
launched() {
    local status=0
    eval "$(ssh-agent -s)" && ssh-add -q "$WORK/key" && "$@" || status=1
    ssh-agent -k
    return "$status"
}

runs_on_both() {
    local runs
    cd "$WORK"
    unset ROS_HOSTNAME
    export ROS_IP=$NET.1 ROSLAUNCH_SSH_UNKNOWN=1
    runs=$(missing | tr '\n' ' ') && [[ $runs == 'seed_1 seed_2 ' ]] &&
        launched roslaunch -p "$(free_port)" hdlyap runs.launch "runs:=$runs" "folder:=$WORK/out" \
            machine_file:=machines.launch machines:="m0 m1" &&
        [[ -z $(missing) ]] && went_to_both
}

# Their daemons let somebody in.
went_to_both() {
    local k
    for k in "${!MACHINES[@]}"; do
        grep -q "Accepted publickey .* from $NET.1" "$WORK/sshd.$k" || return 1
    done
}

stop_at_exit
trap 'for child in "${CHILDREN[@]}"; do stop "$child"; done; no_network' EXIT
source_setup "$SETUP"
environment
check 'two machines' network
check 'an sshd on each' daemons
check 'runs.launch on both' runs_on_both
exit "$FAILED"
