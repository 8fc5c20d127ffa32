#!/bin/bash
# Flags that fuse a multiplication and an addition (-march with FMA, arm64 by itself) change no bit of a roll: the project's own
# flags, behind them, forbid it. build/fused/ has the same sources without them and with them.
set -eu
[ -x build/fused/fused ] || { echo 'this processor has no x86-64-v3'; exit 77; }
trap 'rm -f "$plain"' EXIT
plain=$(mktemp)
build/fused/plain >"$plain"
[ "$(wc -l <"$plain")" -gt 8000 ]
build/fused/fused | cmp - "$plain"
