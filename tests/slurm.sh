#!/usr/bin/env bash
# Runs of several ranks: by mpirun, and on a Slurm of its own, as on a cluster; a sweep as an array of jobs, a job that is
# requeued.
# Controller and two nodes are this machine, as root, in one folder, without systemd or munge.
#   slurm.sh WORK_FOLDER INSTALLED_SETUP
set -euo pipefail
# shellcheck source=launch/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/../launch/common.sh"

readonly WORK=$1 SETUP=$2 NODES=(one two)
export SLURM_CONF=$WORK/slurm.conf
mkdir -p "$WORK"/{state,log}
# shellcheck source=tests/check.sh
source "$ROOT/tests/check.sh"


configure() {
    local node
    {
        cat <<END
ClusterName=check
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmUser=root
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=pmix
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
JobRequeue=1
StateSaveLocation="$WORK/state"
SlurmdSpoolDir="$WORK/spool.%n"
SlurmctldPidFile="$WORK/slurmctld.pid"
SlurmdPidFile="$WORK/slurmd.%n.pid"
SlurmctldLogFile="$WORK/log/slurmctld"
SlurmdLogFile="$WORK/log/slurmd.%n"
END
        for node in "${NODES[@]}"; do
            echo "NodeName=$node NodeAddr=127.0.0.1 Port=$(free_port) CPUs=2 RealMemory=4000"
        done
        echo "PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP"
    } >"$SLURM_CONF"
    [[ $(slurmctld -V) == *' 20.'* ]] || echo 'CgroupPlugin=cgroup/v1' >"$WORK/cgroup.conf" # 20.11 has no such word
}

idle() { [[ $(sinfo -h -N -o '%N %T' 2>/dev/null | grep -c ' idle$') == "${#NODES[@]}" ]]; }

begin() {
    local node
    configure
    start slurmctld -D -f "$SLURM_CONF"
    for node in "${NODES[@]}"; do start slurmd -D -f "$SLURM_CONF" -N "$node"; done
    wait_for 30 idle
}

# ranks_of BAG: that its run says it had.
ranks_of() {
    /usr/bin/python3 -c 'import sys; from hdlyap.data import reader; print(list(reader.run_infos(sys.argv[1]).values())[-1].ranks)' "$1"
}

runs_by_mpirun() {
    mpirun --bind-to none --oversubscribe -n 2 rosrun hdlyap hdlyap_node _number:=20 _aspect:=1.0 _equilibration:=1.0 _warmup:=1.0 \
        _duration:=5.0 | tee "$WORK/mpirun.txt" && [[ $(grep -c 'finished at' "$WORK/mpirun.txt") == 1 ]]
}

has_a_master() { rostopic list >/dev/null 2>&1; }

runs_together() {
    srun -N 1 -n 2 hdlyap run quick --out "$WORK/two.bag" duration:=30 && [[ $(ranks_of "$WORK/two.bag") == 2 ]]
}

refuses_what_is_no_argument() { ! srun -N 1 -n 1 hdlyap run quick --out "$WORK/none.bag" duration=30 && [[ ! -e $WORK/none.bag ]]; }

gone() { [[ -z $(squeue -h -j "$1" 2>/dev/null) ]]; }

sweep() {
    hdlyap sweep --seeds "1 2" --duration 20 --params "{number: 60, aspect: 0.2, equilibration: 5.0, warmup: 20.0}" --folder "$WORK/array" "$@"
}

# As doc/many_machines.md says.
runs_an_array() {
    local job
    cd "$WORK"
    sweep --write >names.txt && [[ $(wc -l <names.txt) == 2 ]] &&
        job=$(sbatch --parsable --array=1-2 --mem-per-cpu=500M "$ROOT/launch/runs.sbatch" "$WORK/array" names.txt) &&
        wait_for 90 gone "$job" && [[ -z $(sweep --write) ]]
}

# A job that goes on from its checkpoint, if there is one; requeued in the middle.
goes_on() {
    local job
    cd "$WORK"
    cat >job.sh <<END
#!/usr/bin/env bash
exec srun -n 2 hdlyap run quick --out run.bag duration:=3000 params:="{checkpoint_interval: 1}" checkpoint:=run.checkpoint resume:=auto
END
    job=$(sbatch --parsable -N 1 -n 2 --mem-per-cpu=500M --requeue --open-mode=append job.sh) &&
        wait_for 60 test -s run.checkpoint && sleep 5 && scontrol requeue "$job" && wait_for 30 pending "$job" &&
        scontrol update "JobId=$job" StartTime=now && wait_for 60 resumed "$job" && scancel "$job" && wait_for 60 gone "$job"
}

pending() { [[ $(squeue -h -o %T -j "$1") == PENDING ]]; }

resumed() { grep -q 'goes on from simulated time [1-9]' "$WORK/slurm-$1.out"; }

stop_at_exit
source_setup "$SETUP"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
ROS_MASTER_URI=http://localhost:$(free_port) # that of the suite may be in use beside this
export ROS_MASTER_URI
start roscore -p "${ROS_MASTER_URI##*:}" >"$WORK/log/roscore" 2>&1
wait_for 30 has_a_master
check 'mpirun of two ranks' runs_by_mpirun
check 'a Slurm of two nodes' begin
check 'srun of two ranks' runs_together
check 'srun of what is no argument' refuses_what_is_no_argument
check 'sbatch of a sweep' runs_an_array
check 'a requeued job goes on' goes_on
exit "$FAILED"
