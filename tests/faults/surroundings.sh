#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The same rows whatever the surroundings: how the input arrives, the locale, the environment, the
# folder, the limits. And refusals where there is no input to be had.
. "$(dirname "$0")/tools"
exec 3>&- 4>&- 5>&- 6>&- 7>&- 8>&- 9>&-  # those that the caller has left open
good 400 >"$scratch/good"
top=$PWD
localedef -i de_DE -f UTF-8 "$scratch/de_DE.UTF-8" 2>/dev/null || :  # where the sources of locales are installed

same() {  # NAME: the last attempt gave $scratch/whole
  [ "$status" = 0 ] && cmp -s "$scratch/out" "$scratch/whole" ||
    complain "$1: exit $status, $(head -c 200 "$scratch/err")"
}
for tool in $tools; do
  run=${command[$tool]}
  # shellcheck disable=SC2086
  {
    attempt $run "$scratch/good"
    accepted "$tool"
    mv "$scratch/out" "$scratch/whole"

    attempt $run - < <(while IFS= read -r line; do printf '%s' "${line:0:9}"; printf '%s\n' "${line:9}"; done <"$scratch/good")
    same "$tool from a slow writer, numbers split"
    if preloads; then
      FAULT_READ=1 LD_PRELOAD=$shim attempt $run - <"$scratch/good"
      same "$tool, one byte a read and interrupted"
    fi
    for locale in C.UTF-8 de_DE.UTF-8 nowhere; do
      attempt env LOCPATH="$scratch" LC_ALL=$locale LANG=$locale $run "$scratch/good"
      same "$tool under $locale"
    done
    attempt env -i "$top/bin/"$run "$scratch/good"
    same "$tool without an environment"
    (exec -a '' env -i "$top/bin/"$run "$scratch/good") >"$scratch/out" 2>"$scratch/err"; status=$?
    same "$tool by another name"
    (mkdir "$scratch/removed" && cd "$scratch/removed" && rmdir "$scratch/removed" && attempt $run - <"$scratch/good"; exit $status); status=$?
    same "$tool in a folder that is gone"
    (ulimit -n 3; exec $run "$scratch/good") >"$scratch/out" 2>"$scratch/err"; status=$?
    [ $status = 127 ] || refused "$tool with three descriptors" ''  # 127: not even its libraries
    grep -q __asan_init "bin/$tool" || {  # which needs memory, and descriptors, of its own
      (ulimit -n 4; attempt $run "$scratch/good"; exit $status); status=$?
      same "$tool with four descriptors"
      (ulimit -v 65536; attempt $run "$scratch/good"; exit $status); status=$?
      same "$tool in 64 MB"
    }
    tried=$((tried + 4))

    $run - <&- >"$scratch/out" 2>"$scratch/err"; status=$?
    refused "$tool with standard input closed" '-: Bad file descriptor'
    $run - 0>/dev/null >"$scratch/out" 2>"$scratch/err"; status=$?
    refused "$tool with standard input for writing only" '-: Bad file descriptor'
    attempt $run - <.
    refused "$tool from a directory" '-: Is a directory'
    attempt $run .
    refused "$tool with a directory" '.: Is a directory'
    attempt $run "$scratch/no
where"
    refused "$tool without a file" 'where: No such file or directory'
    if [ "$(id -u)" != 0 ]; then
      touch "$scratch/secret"; chmod 0 "$scratch/secret"
      attempt $run "$scratch/secret"
      refused "$tool with a file that may not be read" ': Permission denied'
    fi
    attempt $run - </proc/self/mem
    refused "$tool with a read that fails" '-: Input/output error'
  }
done

# Start-up code that a flag links in may take the denormal numbers away.
if preloads; then
  printf '# t[s]\tv[m/s]\ta[m/s^2]\tD[m]\n0\t1e-310\t-1e-310\t1e-312\n1\t2e-310\t-1e-310\t1e-312\n2\t3e-310\t-1e-310\t1e-312\n' >"$scratch/denormal"
  for tool in smooth differentiate shift-from-accel energy-ledger; do
    # shellcheck disable=SC2086
    {
      attempt ${command[$tool]} "$scratch/denormal"
      accepted "$tool of denormal numbers"
      mv "$scratch/out" "$scratch/whole"
      FAULT_DENORMALS=1 LD_PRELOAD=$shim attempt ${command[$tool]} "$scratch/denormal"
      same "$tool where denormal numbers were 0"
    }
  done
fi

# More than fits into 64 MB: a tool that streams does not care, one that keeps its runs says so.
if ! grep -q __asan_init bin/smooth; then
  good 1200000 >"$scratch/large"
  (ulimit -v 65536; exec fitpower --route velocity -K 0.5 -R 0.04 "$scratch/large") >"$scratch/out" 2>"$scratch/err"; status=$?
  refused 'fitpower 1200000 rows in 64 MB' 'out of memory'
  [ ! -s "$scratch/out" ] || complain 'fitpower out of memory prints something'
  for tool in smooth shift-from-accel simulate energy-ledger; do
    # shellcheck disable=SC2086
    (ulimit -d 8192; exec ${command[$tool]} "$scratch/large") 2>"$scratch/err" | tail -n 1 >"$scratch/out"; status=${PIPESTATUS[0]}
    accepted "$tool 1200000 rows in 8 MB of data"
    rm -f "$scratch/out"
  done
fi

# -u on a live source: a row goes out as soon as its window allows, before the next row comes.
live() {  # RECORDS-AHEAD COMMAND...
  local ahead=$1 i line rows=0
  shift
  coproc "$@"
  { for ((i = 1; i <= ahead + 3; ++i)); do
      printf '%s 0.5 -0.14 8.7e-4\n' "$i" >&"${COPROC[1]}"
      while [ $((i - rows)) -gt "$ahead" ]; do
        IFS= read -r -t 20 -u "${COPROC[0]}" line || { complain "$*: after $i rows row $((rows + 1)) has not come" && break 2; }
        [[ $line == '#'* ]] || rows=$((rows + 1))
      done
    done; } 2>/dev/null
  kill "$COPROC_PID" && wait "$COPROC_PID" 2>/dev/null
  tried=$((tried + 1))
}
live 0 smooth -u -w 1
live 1 smooth -u -w 3
live 2 smooth -u -w 5
live 1 smooth -u -w 3 -M median
live 85 smooth -u -w 1 --outliers 9  # five neighbours twice, and the scatter over 151 rows
live 4 differentiate -u -M savgol -w 5  # its first rows wait for a whole window
live 2 differentiate -u  # the first row is of second order too: it takes three
live 0 shift-from-accel -u -K 0.5 -R 0.04 --use a=3
live 0 energy-ledger -u -m 1 -K 0.5 -R 0.04 --use D=4
live 0 simulate -u -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 0.5 --at -
finish
