#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Standard output that takes nothing, or not all: every tool, in every form of its output.
. "$(dirname "$0")/tools"
good 9 >"$scratch/good"
good 3000 >"$scratch/long"
mkfifo "$scratch/fifo"
# Behind `&` in a script the suite ignores SIGINT, under nohup SIGHUP, and no trap changes that.
signals=''
for signal in TERM INT HUP; do
  case $(trap -p $signal) in *"''"*) ;; *) signals+=" $signal" ;; esac
done

for tool in $tools; do
  for operands in "${command[$tool]} $scratch/good" "${command[$tool]} $scratch/good -u" "${command[$tool]} $scratch/long" "$tool --help" "$tool --version"; do
    # shellcheck disable=SC2086
    {
      attempt $operands
      accepted "$operands"
      mv "$scratch/out" "$scratch/whole"
      $operands >/dev/full 2>"$scratch/err"; status=$?; : >"$scratch/out"
      refused "$operands" 'standard output: No space left on device'
      $operands >&- 2>"$scratch/err"; status=$?
      refused "$operands" 'standard output: Bad file descriptor'
      $operands >&- 2>&-; status=$?
      [ $status = 2 ] || complain "$operands with no streams: exit $status"
      $operands </dev/null 1</dev/null 2>"$scratch/err"; status=$?
      refused "$operands" 'standard output: Bad file descriptor'
      # The reader has gone: SIGPIPE, quietly; where that is ignored, one line.
      exec 8<>"$scratch/fifo" 7>"$scratch/fifo" 8<&-
      $operands >&7 2>"$scratch/err"; status=$?
      [ "$status" = 141 ] && [ ! -s "$scratch/err" ] ||
        complain "$operands into a closed pipe: exit $status, $(cat "$scratch/err")"
      (trap '' PIPE; exec $operands >&7 2>"$scratch/err"); status=$?
      exec 7>&-
      refused "$operands" 'standard output: Broken pipe'
      tried=$((tried + 6))
      if preloads; then
        FAULT_WRITE=1 LD_PRELOAD=$shim attempt $operands
        cmp -s "$scratch/out" "$scratch/whole" ||
          complain "$operands: other output through short and interrupted writes"
      fi
    }
  done
  # A file may not grow beyond a limit: the write fails.
  # shellcheck disable=SC2086
  [ "$tool" = fitpower ] || {
    (ulimit -f 8; exec ${command[$tool]} "$scratch/long") >"$scratch/out" 2>"$scratch/err"; status=$?
    sed -i '$d' "$scratch/out"  # the file ends at the limit, in the middle of a row
    refused "$tool" 'standard output: File too large'
  }

  # An input that is the output too is refused before anything is written.
  # shellcheck disable=SC2086
  for redirect in '>>' '<>' '1<>'; do
    cp "$scratch/good" "$scratch/both"
    case $redirect in
      '>>') ${command[$tool]} "$scratch/both" >>"$scratch/both" 2>"$scratch/err" ;;
      '<>') ${command[$tool]} - <"$scratch/both" >>"$scratch/both" 2>"$scratch/err" ;;
      '1<>') ${command[$tool]} "$scratch/both" 1<>"$scratch/both" 2>"$scratch/err" ;;
    esac
    status=$? tried=$((tried + 1))
    : >"$scratch/out"
    refused "$tool $redirect" 'this input is the output too'
    cmp -s "$scratch/both" "$scratch/good" || complain "$tool $redirect wrote into its input"
  done

  # A signal in mid-stream: what has gone out is whole rows. The reader is slow, so that it comes in
  # the middle of a write.
  [ "$tool" = fitpower ] || for signal in $signals; do
    { sleep 0.1; cat >"$scratch/out"; } <"$scratch/fifo" &
    reader=$!
    # shellcheck disable=SC2086
    (trap - INT; while cat "$scratch/long"; do echo; done 2>/dev/null) | (trap - INT; exec ${command[$tool]} - >"$scratch/fifo") &
    writer=$!
    sleep 0.05
    kill -$signal $writer
    wait $writer $reader 2>/dev/null
    tried=$((tried + 1))
    [ -z "$(tail -c 1 "$scratch/out")" ] ||
      complain "$tool: SIG$signal leaves half a row: $(tail -n 1 "$scratch/out")"
    sed '$d' "$scratch/out" | grep -q 'ended with an error' &&
      complain "$tool: SIG$signal, and the error is not the last line"
  done
done
finish
