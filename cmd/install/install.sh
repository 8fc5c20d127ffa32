#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# install.sh install | uninstall: the tools in TOOLS, their pages and completions, the samples and
# CITATION.cff, into bindir, mandir, datadir and docdir below DESTDIR; PROGRAM_PREFIX goes before the
# name of each tool. All come from the environment; `make install` sets them.
#
# docdir/installed-files says what was installed, a line `CKSUM SIZE PATH` for each file, and `0 0 PATH/`
# for each folder that was made. `install` replaces a file only if it is in that list and as it was
# installed; if a single one is not, nothing is written. `uninstall` removes what is in the list and as
# it was installed, and the folders that are then empty.
set -eu
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.."

prefix=${PROGRAM_PREFIX-}
refuse() { printf 'install: %s\n' "$*" >&2; exit 2; }
case $prefix in
  [!A-Za-z0-9_]* | *[!A-Za-z0-9._+-]*)
    refuse "PROGRAM_PREFIX is '$prefix'; it may have letters, digits and . _ + -" ;;
esac
for folder in "${bindir?}" "${mandir?}" "${datadir?}" "${docdir?}"; do
  case $folder in
    *"
"*) refuse "'$folder': a name of two lines" ;;
    /*) ;;
    *) refuse "'$folder' has to begin with /" ;;
  esac
done
case ${DESTDIR-} in '' | /*) root=${DESTDIR-} ;; *) root=$PWD/$DESTDIR ;; esac
docdir=${docdir%/}
lists=$root$docdir/installed-files
list=$lists${prefix:+-}$prefix
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'exit 130' INT TERM
: >"$scratch/files"

# stage MODE PATH: standard input is to become this file.
stage() {
  mkdir -p "$scratch/stage${2%/*}"
  cat >"$scratch/stage$2"
  chmod "$1" "$scratch/stage$2"
  printf '%s\n' "$2" >>"$scratch/files"
}
# What belongs to the source: runs and results of somebody's own stay where they are. A name that
# no pattern here fits is told by tests/house/install.sh.
samples() {
  set -- samples/*.sh samples/*.svg samples/README.md samples/*.txt samples/rolling.bib \
    samples/[CS][FR].csv samples/[CS][FR].toml \
    samples/exports/capstone.csv samples/exports/phyphox.csv samples/exports/tracker.txt \
    samples/exports/vernier.csv
  for folder in exports figures lab; do
    folder=samples/$folder
    set -- "$@" $folder/*.sh $folder/*.gp $folder/README.md
  done
  for sample; do [ ! -f "$sample" ] || printf '%s\n' "$sample"; done
}
stage_all() {
  tools=''
  for source in cmd/*.cpp; do
    tool=${source#cmd/}
    tools="$tools ${tool%.cpp}"
  done
  for tool in $tools; do
    stage 755 "$bindir/$prefix$tool" <"$TOOLS/$tool"
    ${STRIP:-strip} "$scratch/stage$bindir/$prefix$tool"
    # shellcheck disable=SC2086  # tools are words
    cmd/install/rename-page.sh "$prefix" $tools <"man/$tool.1" |
      stage 644 "$mandir/man1/$prefix$tool.1"
    for shell in bash:bash-completion/completions/ zsh:zsh/site-functions/_ \
      fish:fish/vendor_completions.d/; do
      "bin/$tool" --help |
        awk -v shell="${shell%%:*}" -v name="$prefix$tool" -f cmd/install/completion.awk |
        stage 644 "$datadir/${shell#*:}$prefix$tool$([ "${shell%%:*}" != fish ] || echo .fish)"
    done
  done
  for page in man/*.[57]; do
    # shellcheck disable=SC2086
    cmd/install/rename-page.sh "$prefix" $tools <"$page" |
      stage 644 "$mandir/man${page##*.}/${page#man/}"
  done
  awk -f cmd/install/citation.awk samples/rolling.bib | stage 644 "$docdir/CITATION.cff"
  samples >"$scratch/samples"
  while IFS= read -r sample; do
    mode=644
    [ ! -x "$sample" ] || mode=755
    stage $mode "$docdir/$sample" <"$sample"
  done <"$scratch/samples"
}

described() { printf '%s %s\n' "$(cksum <"$1")" "$2"; }  # FILE PATH: its line in a list
exists() { [ -e "$1" ] || [ -L "$1" ]; }
as_installed() {  # PATH: by this prefix or by another one
  [ ! -L "$root$1" ] && [ -f "$root$1" ] && described "$root$1" "$1" >"$scratch/line" &&
    cat "$lists"* 2>/dev/null | grep -qxF -f "$scratch/line"
}

# Removes what the list names and the file $1 does not.
remove_listed() {
  [ -f "$list" ] || return 0
  cut -d ' ' -f 3- "$list" >"$scratch/listed"
  for other in "$lists"*; do [ "$other" = "$list" ] || cut -d ' ' -f 3- "$other"; done \
    >"$scratch/of-others"
  grep '/$' "$scratch/listed" | sort -r >"$scratch/old-folders" || true
  grep -v '/$' "$scratch/listed" | while IFS= read -r path; do
    ! printf '%s\n' "$path" | grep -qxF -f - "$1" "$scratch/of-others" || continue
    exists "$root$path" || continue
    if as_installed "$path"; then rm -f "$root$path"
    else printf 'install: %s is not as it was installed: it stays\n' "$root$path" >&2
    fi
  done
}
# Removes the folders of the list, the innermost first, unless they hold something.
remove_folders() {
  [ ! -f "$scratch/old-folders" ] ||
    while IFS= read -r folder; do rmdir "$root$folder" 2>/dev/null || true; done <"$scratch/old-folders"
}
# The folders that have to be made for these files, and those that were made before or are docdir's.
folders() {
  while IFS= read -r path; do
    folder=${path%/*}
    while [ -n "$folder" ]; do
      printf '%s\n' "$folder"
      folder=${folder%/*}
    done
  done <"$1" | sort -u | while IFS= read -r folder; do
    case $folder/ in "$docdir"/*) ;; *)
      [ ! -d "$root$folder" ] || cat "$lists"* 2>/dev/null | grep -qxF "0 0 $folder/" || continue ;;
    esac
    printf '0 0 %s/\n' "$folder"
  done
}

install_all() {
  stage_all
  while IFS= read -r path; do
    exists "$root$path" || continue
    cmp -s "$root$path" "$scratch/stage$path" && [ ! -L "$root$path" ] || as_installed "$path" ||
      printf '  %s\n' "$root$path"
  done <"$scratch/files" >"$scratch/strangers"
  if [ -s "$scratch/strangers" ]; then
    {
      echo 'install: these files exist, and are none that this has installed:'
      cat "$scratch/strangers"
      echo 'Nothing was installed. Move them, or install the tools under other names:'
      echo '  make install PROGRAM_PREFIX=roll-'
    } >&2
    exit 1
  fi
  remove_listed "$scratch/files"
  remove_folders
  folders "$scratch/files" >"$scratch/folders"
  # The list comes first: where a copy fails, what is there can be removed.
  mkdir -p "$root$docdir"
  while IFS= read -r path; do described "$scratch/stage$path" "$path"; done <"$scratch/files" |
    cat - "$scratch/folders" >"$scratch/list"
  cp "$scratch/list" "$list"
  while IFS= read -r path; do
    mkdir -p "$root${path%/*}"
    rm -f "$root$path"  # it may run, or be a link
    cp -p "$scratch/stage$path" "$root$path"
  done <"$scratch/files"
  printf 'installed: %s and what is listed in %s\n' "$root$bindir" "$list"
}

uninstall_all() {
  if [ ! -f "$list" ]; then
    printf 'uninstall: there is no list %s: nothing was removed\n' "$list"
    exit 0
  fi
  : >"$scratch/nothing"
  remove_listed "$scratch/nothing"
  rm -f "$list"
  remove_folders
  printf 'removed what was listed in %s\n' "$list"
}

case ${1-} in
  install) umask 022 && install_all ;;
  uninstall) uninstall_all ;;
  *) echo 'install.sh install | uninstall' >&2; exit 2 ;;
esac
