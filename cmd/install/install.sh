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
. cmd/install/scratch.sh
own scratch "${TMPDIR:-/tmp}/rolling.$$"
: >"$scratch/files"

# stage PATH: standard input is to become this file.
stage() {
  [ -d "$scratch/stage${1%/*}" ] || mkdir -p "$scratch/stage${1%/*}"
  cat >"$scratch/stage$1"
  printf '%s\n' "$1" >>"$scratch/files"
}
# put FOLDER FILE...: they come to stand there, all or none, also where one runs or is a link.
put() {
  to=$1
  shift
  mkdir -p "$to"
  own new "$to/.new.$$"
  cp -p "$@" "$new"
  mv -f "$new"/* "$to"
  rmdir "$new"
  new=''
}
# What belongs to the source: runs and results of somebody's own stay where they are. A name that
# fits no pattern here fails tests/install/install.sh.
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
    stage "$bindir/$prefix$tool" <"$TOOLS/$tool"
    ${STRIP:-strip} "$scratch/stage$bindir/$prefix$tool"
    # shellcheck disable=SC2086  # tools are words
    cmd/install/rename-page.sh "$prefix" $tools <"man/$tool.1" | stage "$mandir/man1/$prefix$tool.1"
    "bin/$tool" --help >"$scratch/help"
    for shell in bash:bash-completion/completions/ zsh:zsh/site-functions/_ \
      fish:fish/vendor_completions.d/; do
      awk -v shell="${shell%%:*}" -v name="$prefix$tool" -f cmd/install/completion.awk "$scratch/help" |
        stage "$datadir/${shell#*:}$prefix$tool$([ "${shell%%:*}" != fish ] || echo .fish)"
    done
  done
  for page in man/*.[57]; do
    # shellcheck disable=SC2086
    cmd/install/rename-page.sh "$prefix" $tools <"$page" | stage "$mandir/man${page##*.}/${page#man/}"
  done
  awk -f cmd/install/citation.awk samples/rolling.bib | stage "$docdir/CITATION.cff"
  samples >"$scratch/samples"
  tar -cf - -T "$scratch/samples" | tar -xf - -C "$scratch/stage$docdir"
  while IFS= read -r sample; do printf '%s\n' "$docdir/$sample"; done <"$scratch/samples" >>"$scratch/files"
  chmod +x "$scratch/stage$bindir"/*
  chmod -R u=rwX,go=rX "$scratch/stage"
}

exists() { [ -e "$1" ] || [ -L "$1" ]; }
zeros() { tr '\n' '\0'; }
# described FOLDER <PATHS: the line in a list of each that is a plain file below FOLDER.
described() {
  [ ! -d "$1/" ] || (cd "$1/" && while IFS= read -r path; do
    [ ! -f ".$path" ] || [ -L ".$path" ] || printf '.%s\n' "$path"
  done | zeros | xargs -0 cksum | sed -n 's|^\([0-9]* [0-9]*\) \./|\1 /|p')
}
# without FILE, only FILE: the lines of standard input that are not in it, that are.
without() { grep -vxF -f "$1" || [ $? = 1 ]; }
only() { grep -xF -f "$1" || [ $? = 1 ]; }
paths() { cut -d ' ' -f 3-; }
# as_installed <PATHS: those that are as they were installed, by this prefix or by another one, and those
# that are as the file $1 says.
as_installed() {
  cat "$lists"* "$1" >"$scratch/known" 2>/dev/null || true
  described "$root" | only "$scratch/known" | paths
}

# Removes what the list names and the file $1 does not.
remove_listed() {
  [ -f "$list" ] || return 0
  for other in "$lists"*; do [ "$other" = "$list" ] || paths <"$other"; done | cat - "$1" >"$scratch/kept"
  paths <"$list" | without "$scratch/kept" >"$scratch/listed"
  sed -n '/\/$/p' "$scratch/listed" | sort -r >"$scratch/old-folders"
  sed '/\/$/d' "$scratch/listed" >"$scratch/old"
  as_installed /dev/null <"$scratch/old" >"$scratch/unchanged"
  (cd "$root/" && sed 's/^/./' "$scratch/unchanged" | zeros | xargs -0 rm -f)
  without "$scratch/unchanged" <"$scratch/old" | while IFS= read -r path; do
    ! exists "$root$path" || printf 'install: %s is not as it was installed: it stays\n' "$root$path" >&2
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
  described "$scratch/stage" <"$scratch/files" >"$scratch/list"
  as_installed "$scratch/list" <"$scratch/files" >"$scratch/ours"
  without "$scratch/ours" <"$scratch/files" | while IFS= read -r path; do
    ! exists "$root$path" || printf '  %s\n' "$root$path"
  done >"$scratch/strangers"
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
  folders "$scratch/files" >>"$scratch/list"
  # The list comes first: where a copy fails, what is there can be removed.
  mv "$scratch/list" "$scratch/${list##*/}"
  put "$root$docdir" "$scratch/${list##*/}"
  sed 's|/[^/]*$||' "$scratch/files" | sort -u >"$scratch/folders"
  while IFS= read -r folder; do
    set --
    for file in "$scratch/stage$folder"/*; do [ ! -f "$file" ] || set -- "$@" "$file"; done
    put "$root$folder" "$@"
  done <"$scratch/folders"
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
