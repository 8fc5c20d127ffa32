#!/bin/bash
# install.sh install | uninstall: the tools, their pages and completions, and the samples, into
# PREFIX below DESTDIR; PROGRAM_PREFIX goes before the name of each tool. The three come from the
# environment. `uninstall` removes the files that `install` puts there, and the folders of the
# samples if nothing else is in them.
set -euo pipefail
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.."

root=${DESTDIR-}${PREFIX?} prefix=${PROGRAM_PREFIX-}
case $root in -*) root=./$root ;; esac
[[ $prefix =~ ^([A-Za-z0-9_][A-Za-z0-9._+-]*)?$ ]] || {
  printf "install: PROGRAM_PREFIX is '%s'; it may have letters, digits and . _ + -\n" "$prefix" >&2
  exit 2
}
tools=(cmd/*.cpp)
tools=("${tools[@]#cmd/}")
tools=("${tools[@]%.cpp}")
doc=$root/share/doc/rolling

# each ACTION: calls ACTION KIND SOURCE DESTINATION for every file.
each() {
  local tool page sample
  for tool in "${tools[@]}"; do
    "$1" program "bin/$tool" "$root/bin/$prefix$tool"
    "$1" page "man/$tool.1" "$root/share/man/man1/$prefix$tool.1"
    "$1" bash "bin/$tool" "$root/share/bash-completion/completions/$prefix$tool"
    "$1" zsh "bin/$tool" "$root/share/zsh/site-functions/_$prefix$tool"
  done
  for page in man/*.[57]; do "$1" page "$page" "$root/share/man/man${page##*.}/${page#man/}"; done
  while IFS= read -r sample; do
    "$1" sample "$sample" "$doc/$sample"
  done < <(find samples -name results -prune -o -type f ! -name '.*' -print | sort)
}

put() {
  case $1 in
    program) install -D -s -m 755 "$2" "$3" ;;
    page)
      install -D -m 644 "$2" "$3"
      cmd/install/rename-page.sh "$prefix" "$3" "${tools[@]}" ;;
    bash | zsh)
      install -D -m 644 /dev/null "$3"
      "$2" --help | awk -v shell="$1" -v name="$prefix${2#bin/}" -f cmd/install/completion.awk >"$3" ;;
    sample)
      if [ -x "$2" ]; then install -D -m 755 "$2" "$3"; else install -D -m 644 "$2" "$3"; fi ;;
  esac
}
take() { rm -f "$3"; }

case ${1-} in
  install)
    each put
    echo "installed below $root" ;;
  uninstall)
    each take
    while IFS= read -r folder; do
      rmdir "$doc/$folder" 2>/dev/null || true  # unless it holds something else
    done < <(find samples -depth -type d)
    rmdir "$doc" 2>/dev/null || true
    echo "removed what was installed below $root" ;;
  *) echo 'install.sh install | uninstall' >&2; exit 2 ;;
esac
