#!/bin/sh
# slurm.sh CAROM: runs the script of `carom submit` by a separate Slurm on 127.0.0.1 (Debian's slurm-wlm and munge; as
# root). A sweep in two parts and a gather, one part requeued while it runs, has the bytes of the sweep in one part.
set -eu
carom=$1
work=$(mktemp -d)
export SLURM_CONF="$work/slurm.conf"
stop() {
  kill $(cat "$work"/*.pid 2> /dev/null) 2> /dev/null || true
  sleep 0.5
  rm -rf "$work"
}
trap stop EXIT
cd "$work"

die() {
  echo "$*" >&2
  tail -n 20 ./*.log >&2
  exit 1
}

# Munge and Slurm: one machine, two processors, no state kept.
mkdir state spool
head -c 1024 /dev/urandom > munge.key
chown -R munge: munge.key 2> /dev/null || true
chmod 400 munge.key
chmod 755 .
chown root: munge.key
/usr/sbin/munged --force --socket="$work/munge.socket" --key-file="$work/munge.key" --pid-file="$work/munged.pid" \
  --seed-file="$work/munge.seed" --log-file="$work/munged.log"
cat > slurm.conf << END
ClusterName=carom
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CredType=cred/munge
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
JobRequeue=1
NodeName=localhost NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
END
slurmctld -f "$work/slurm.conf" -c
slurmd -f "$work/slurm.conf" -N localhost
i=0
until sinfo -h -o %t 2> /dev/null | grep -q idle; do
  i=$((i + 1))
  [ $i -lt 60 ] || die 'Slurm does not come up'
  sleep 0.5
done

cat > balls.yaml << 'END'
scene: 1
gravity: [0, 0, 0]
defaults: {ball: {mass: 1, radius: 0.02}}
room: {min: [-1, -1, -1], max: [1, 1, 1]}
groups:
  gas: {count: 200, ball: {}, in: {min: [-1, -1, -1], max: [1, 1, 1]}, speed: 1}
simulate: {duration: 4}
END
cat > gases.yaml << 'END'
sweep: 1
base: balls.yaml
grid:
  restitution.default: {from: 0.9, to: 1.0, count: 11}
repeat: {seeds: 4}
compare: {measures: [collisions, energy_lost_J]}
END
"$carom" sweep gases.yaml -o whole --quiet --progress none

"$carom" submit gases.yaml --slurm --parts 2 -o parts > job.sh
said=$(sh job.sh)
echo "$said"
parts=$(echo "$said" | sed 's/.*parts: job \([0-9]*\).*/\1/')
gather=$(echo "$said" | sed 's/.*gather: job \([0-9]*\).*/\1/')

# The first part is requeued as soon as it has finished a run.
i=0
until ls parts/runs/*/manifest.json > /dev/null 2>&1; do
  i=$((i + 1))
  [ $i -lt 600 ] || die 'no run was made'
  sleep 0.1
done
scontrol requeue "${parts}_1" || die 'the first part was done too early to be requeued'
# (Slurm delays a requeued task by two minutes.)
sleep 1
scontrol update JobId="${parts}_1" StartTime=now || true

i=0
until [ "$(scontrol show job "$gather" | sed -n 's/.*JobState=\([A-Z]*\).*/\1/p')" = COMPLETED ]; do
  i=$((i + 1))
  [ $i -lt 600 ] || { squeue >&2; die 'the parts are not gathered'; }
  sleep 0.5
done
scontrol show job "${parts}_1" | grep -q 'Restarts=1' || die 'the first part was not requeued'

# The manifests of runs have times; all else is equal, and no file is left over.
diff -r -x manifest.json whole parts
cmp whole/manifest.json parts/manifest.json
[ "$(ls whole/runs | wc -l)" = 44 ]
echo "44 runs in two parts, one requeued: the bytes of one sweep"
