#!/bin/bash
# fit.sh RECORD: the row that fitpower finds for one record, under its names, the record's name before it. K and R are those of make.sh.
set -euo pipefail
smooth -q --coast -c x -w 1 "$1" | fitpower -q --route position -K 0.5 -R 0.04 |
  sed "s/^# /# record\t/; t; s/^/$(basename "$1" .csv)\t/"
