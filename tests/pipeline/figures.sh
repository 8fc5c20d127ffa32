#!/bin/bash
# Each figure's script makes a picture with its curves and labels in it.
set -eu
command -v gnuplot >/dev/null || { echo "skipped: gnuplot is not installed"; exit 77; }
cd samples
picture() {  # NAME CURVES TEXT...: at least so many gnuplot plots, and these texts
  local name=$1 curves=$2 svg
  shift 2
  svg=$("figures/$name.sh" svg)
  [ "$(grep -c 'gnuplot_plot_' <<<"$svg")" -ge "$curves" ] || { echo "$name: too few curves"; exit 1; }
  for text in "$@"; do grep -q "$text" <<<"$svg" || { echo "$name: no '$text'"; exit 1; }; done
}
picture fig1 8 'velocity v' 'time t / s' 'C on rubber' 'S on felt'
picture fig4 12 'shift D / mm' 'C on rubber' 'S on felt'
picture energy 4 'energy / J' 'dissipated'
