#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The completions offer what --help lists: in bash (the function, called as bash calls it, and typed
# at a terminal), in zsh and in fish.
set -u
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.." || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
wrong=0
complain() { echo "$*" && wrong=1; }

# offered WORD...: what bash offers for the last word, sorted, on one line.
offered() {
  bash --norc -c 'source "$1"; shift; COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); $(complete -p "$1" | sed "s/.* -F \([^ ]*\) .*/\1/")
    printf "%s\n" "${COMPREPLY[@]}" | sort | xargs' - "$scratch/$1" "$@"
}
fish_offers() {  # TOOL LINE: what fish offers for its last word, sorted, on one line
  HOME=$scratch fish --private -c "source '$scratch/$1.fish'; complete -C '$2'" | cut -f 1 | sort | xargs
}
expect() { [ "$1" = "$2" ] || complain "$3: '$1' instead of '$2'"; }

for source in cmd/*.cpp; do
  tool=$(basename "$source" .cpp)
  for shell in bash zsh fish; do
    case $shell in bash) file=$tool ;; zsh) file=_$tool ;; fish) file=$tool.fish ;; esac
    "bin/$tool" --help | awk -v shell=$shell -v name="$tool" -f cmd/install/completion.awk >"$scratch/$file"
  done
  bash -n "$scratch/$tool" || complain "$tool: bash does not read it"
  # Independently of the program above: whatever begins with -- in --help before its explanation.
  long=$("bin/$tool" --help | sed -nE 's/^  (-.,)?(--[a-z0-9-]+).*/\2/p' | sort | xargs)
  [ "$(wc -w <<<"$long")" -ge 8 ] || complain "$tool --help: only $long"
  expect "$(offered "$tool" --)" "$long" "$tool --"
  ! command -v fish >/dev/null || expect "$(fish_offers "$tool" "$tool --")" "$long" "fish, $tool --"
done
if command -v fish >/dev/null; then
  expect "$(fish_offers smooth 'smooth -M ')" 'mean median savgol' 'fish, smooth -M'
  expect "$(fish_offers smooth 'smooth --method=s')" '--method=savgol' 'fish, smooth --method=s'
  expect "$(fish_offers smooth 'smooth --width ')" '' 'fish, smooth --width'
  expect "$(fish_offers simulate 'simulate ')" '' 'fish, simulate takes no file'
  expect "$(fish_offers energy-ledger 'energy-ledger --scene samples/SF.t')" samples/SF.toml 'fish, --scene'
fi
expect "$(offered smooth -M '')" 'mean median savgol' 'smooth -M'
expect "$(offered smooth input --method me)" 'mean median' 'smooth --method me'
expect "$(offered smooth --method =)" 'mean median savgol' 'smooth --method='
expect "$(offered smooth --method = s)" savgol 'smooth --method=s'
expect "$(offered smooth --width '')" '' 'smooth --width'
expect "$(offered smooth samp)" '' 'smooth samp'  # left to readline
expect "$(offered fitpower --route '')" 'fits loglog position shift velocity' 'fitpower --route'
expect "$(offered simulate --sensor '')" pasco 'simulate --sensor'
grep -q rk8pd <<<"$(offered simulate --method r)" ||
  complain "simulate --method r: $(offered simulate --method r)"

# Keys at a terminal, tabs among them, and then what the command line has become: the tools are
# stand-ins that tell it.
touch "$scratch/run of CR.csv" "$scratch/SF.toml"
await() { for _ in {1..100}; do [ ! -e "$1" ] || return; sleep 0.1; done; }
typed() {  # SHELL KEYS: what the stand-in saw
  rm -f "$scratch"/{ready,saw}
  case $1 in
    bash) set -- "$2" 'bash --norc -i' "$(cat "$scratch/smooth" "$scratch/energy-ledger")" ;;
    zsh) set -- "$2" 'zsh -f -i' "zstyle ':completion:*' list-prompt ''; fpath=($scratch \$fpath); autoload -U compinit; compinit -D -u" ;;
  esac
  printf '%s\n' "$3" 'smooth() { printf "%s|" "$@" >seen; mv seen saw; exit; }' 'energy-ledger() { smooth "$@"; }' ': >ready' >"$scratch/start"
  (cd "$scratch" && { printf '. ./start\n'; await ready; printf '%s\n' "$1"; await saw; } |
    HOME=$scratch TERM=dumb timeout 60 script -qec "$2" /dev/null >"$scratch/terminal" 2>&1)
  cat "$scratch/saw" 2>/dev/null || cat -v "$scratch/terminal"
}
tab=$(printf '\t')
script -qec 'test -t 2' /dev/null </dev/null >/dev/null 2>&1 || exit $wrong  # no terminal can be made here
for shell in bash zsh; do
  command -v $shell >/dev/null || continue
  between=$([ $shell = zsh ] && echo '=' || echo '|')  # --method=savgol, --method savgol
  expect "$(typed $shell "smooth --coa${tab}--meth${tab}sav${tab}run${tab}")" "--coast|--method${between}savgol|run of CR.csv|" "$shell, smooth"
  expect "$(typed $shell "energy-ledger --scene S${tab}")" '--scene|SF.toml|' "$shell, energy-ledger"
done
exit $wrong
