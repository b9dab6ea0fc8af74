#!/bin/sh
# slurm.sh FOLDER: starts Slurm (Debian's slurm-wlm) with one node on the loopback address, as the current user and without
# munge. All its files are in FOLDER. Prints the variable that Slurm's commands need. slurm.sh FOLDER stop: stops it.
set -eu
mkdir -p "$1"
folder=$(cd "$1" && pwd)

stop() {
    for daemon in slurmd slurmctld; do
        [ ! -f "$folder/$daemon.pid" ] || kill "$(cat "$folder/$daemon.pid")" 2>/dev/null || true
    done
}

if [ "${2:-}" = stop ]; then
    stop
    exit
fi

host=$(hostname -s)
mkdir -p "$folder/state" "$folder/spool"
cat > "$folder/slurm.conf" <<END
ClusterName=loopback
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/none
CredType=cred/none
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
SwitchType=switch/none
MpiDefault=none
SchedulerParameters=sched_interval=1
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF="$folder/slurm.conf"
trap stop EXIT
PATH=$PATH:/usr/sbin
slurmctld -c
slurmd
for _ in $(seq 60); do
    ! sinfo --noheader --format=%T 2>/dev/null | grep -q idle || {
        trap - EXIT
        echo "export SLURM_CONF=$SLURM_CONF"
        exit
    }
    sleep 1
done
cat "$folder"/*.log >&2
echo "The cluster did not start." >&2
exit 1
