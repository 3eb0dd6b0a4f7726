#!/bin/bash
# Renders a sequence by a Slurm of one machine, which it starts and stops: an array of jobs, of which one is requeued and one is
# cancelled and submitted again. All frames must be there, whole, and rendered once but for those two.
#   slurm.sh PROGRAM MODEL
# Slurm runs as the user who calls this, with configuration, key, sockets, state and logs of its own in a temporary folder.
set -euo pipefail
program=$1
model=$2
frames=8

folder=$(mktemp -d)
cd "$folder"
mkdir state spool frames
fail() {
  echo "slurm.sh: $1" >&2
  tail -n 20 slurmctld.log slurmd.log munged.log >&2 2>/dev/null || true
  exit 1
}
stop() {
  local daemon pid
  for daemon in slurmd slurmctld munged; do
    [ -f $daemon.pid ] || continue
    pid=$(cat $daemon.pid)
    kill "$pid" 2>/dev/null || true
    # What it still writes is in the folder.
    for _ in $(seq 100); do kill -0 "$pid" 2>/dev/null || break; sleep 0.1; done
  done
  cd /
  rm -rf "$folder"
}
trap stop EXIT

# A free port for each daemon.
port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }
dd if=/dev/urandom of=munge.key bs=1 count=1024 status=none
chmod 600 munge.key
cat > slurm.conf <<END
ClusterName=one
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$(port)
SlurmdPort=$(port)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
JobRequeue=1
KillWait=2
SchedulerParameters=requeue_setup_env_fail,sched_interval=1,batch_sched_delay=0,defer_batch
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=2 RealMemory=500 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$folder/slurm.conf
/usr/sbin/munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
  --log-file="$folder/munged.log" --seed-file="$folder/munge.seed" || fail "munged does not start"
/usr/sbin/slurmctld -c || fail "slurmctld does not start"
/usr/sbin/slurmd || fail "slurmd does not start"
wait_for() { # what, seconds, command: until it succeeds
  local what=$1 seconds=$2
  shift 2
  for _ in $(seq $((seconds * 5))); do
    "$@" >/dev/null 2>&1 && return
    sleep 0.2
  done
  fail "$what"
}
is_up() { sinfo --noheader --format=%t | grep -q idle; }
wait_for "the machine does not come up" 30 is_up

# A job says when it begins, and what it has rendered: a line each for a frame that was rendered.
cat > job.sh <<END
#!/bin/bash
echo "begin \$SLURM_ARRAY_TASK_ID \${SLURM_RESTART_COUNT:-0}" >> $folder/begun
exec "$program" render "$model" --turntable $frames --size 400x300 --backend oracle --spp 4 --resume \
  --frames "\$SLURM_ARRAY_TASK_ID" -o "$folder/frames/{frame}.png"
END
submit() { sbatch --parsable --array="$1" --requeue --ntasks=1 --output="$folder/out-%a-%j.txt" job.sh; }
job=$(submit 0-$((frames - 1)))
has_begun() { grep -q "begin $1 ${2:-0}" begun; }
wait_for "no job begins" 30 has_begun 0
scontrol requeue "${job}_0" || fail "a job cannot be requeued"
wait_for "the second job does not begin" 60 has_begun 1
scancel "${job}_1"
is_done() { [ -z "$(squeue --noheader --states=all --format=%T | grep -v -E 'COMPLETED|CANCELLED')" ]; }
wait_for "the jobs do not end" 300 is_done
has_begun 0 1 || fail "the requeued job has not begun again"
again=$(submit 0-$((frames - 1)))
[ -n "$again" ] || fail "the jobs cannot be submitted again"
again_begun() { [ "$(grep -c begin begun)" -ge $((2 * frames + 1)) ]; }
wait_for "the jobs do not begin again" 60 again_begun
wait_for "the jobs do not end again" 300 is_done

# All frames, nothing else, all of them whole; each rendered once but for the one that was cancelled, if it was in time.
[ "$(ls frames)" = "$(seq -f %04g.png 0 $((frames - 1)))" ] || fail "the folder holds $(ls frames | tr '\n' ' ')"
for frame in frames/*.png; do
  "$program" compare "$frame" "$frame" --quiet || fail "$frame is torn"
  [ "$(cat out-*.txt | grep -c "^$frame\|^$folder/$frame: .*pixels hit")" = 1 ] || fail "$frame was not rendered once"
done
echo "$frames frames by Slurm: all there, whole, each rendered to its end once"
