#!/bin/sh
# single_node_slurm.sh DIR COMMAND...: starts a Slurm cluster on this machine, as root, with its key, state and
# logs in DIR; runs COMMAND with SLURM_CONF set, stops the daemons, exits like COMMAND. Exit code 77: the cluster did
# not start (the logs say why).
set -u
dir=$1
shift
mkdir -p "$dir/state" "$dir/spool"
chmod 755 "$dir"
host=$(hostname -s)
cpus=$(getconf _NPROCESSORS_ONLN)
# Ports of this process only, because another such cluster may be running.
port=$((20000 + $$ % 20000 * 2))

dd if=/dev/urandom of="$dir/munge.key" bs=128 count=1 2>/dev/null
chmod 400 "$dir/munge.key"
munged --foreground --force --socket="$dir/munge.socket" --key-file="$dir/munge.key" --num-threads=1 \
  --pid-file="$dir/munge.pid" --log-file="$dir/munged.log" --seed-file="$dir/munge.seed" >"$dir/munged.out" 2>&1 &
munge=$!

cat >"$dir/slurm.conf" <<CONF
ClusterName=touchstone
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cpus State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF="$dir/slurm.conf"

slurmctld -D -c >"$dir/slurmctld.out" 2>&1 &
controller=$!
slurmd -D -N "$host" >"$dir/slurmd.out" 2>&1 &
daemon=$!

end() {
  kill "$daemon" "$controller" 2>/dev/null
  wait "$daemon" "$controller" 2>/dev/null
  kill "$munge" 2>/dev/null
  wait "$munge" 2>/dev/null
}
trap 'end; exit 130' INT TERM

tries=0
until sinfo -h -o %T 2>/dev/null | grep -q idle; do
  tries=$((tries + 1))
  if [ "$tries" -gt 300 ] || ! kill -0 "$controller" 2>/dev/null || ! kill -0 "$daemon" 2>/dev/null; then
    end
    tail -n 5 "$dir"/*.log "$dir"/*.out >&2
    exit 77
  fi
  sleep 0.2
done
"$@"
status=$?
end
exit "$status"
