#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# html.sh FOLDER: the manual pages as one site of HTML in FOLDER, made by mandoc: NAME.SECTION.html
# for each page and index.html. A page of another project (awk, sed, ...) is linked at
# manpages.debian.org.
set -euo pipefail
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.."
command -v mandoc >/dev/null ||
  { echo "html: mandoc is not installed; make setup html installs it" >&2; exit 2; }
mkdir -p -- "$1"
to=$(cd -- "$1" && pwd)
pages=(man/*.[157])

cat >"$to/pages.css" <<'END'
body { max-width: 52rem; margin: 0 auto; padding: 1rem; font: 1rem/1.5 system-ui, sans-serif;
  color: #1a1a1a; background: #fff; }
a { color: #005a9c; }
pre, code, .Fl, .Cm, .Ql { font-family: ui-monospace, monospace; font-size: .92em; }
pre { background: #f3f1ec; padding: .6rem .8rem; overflow-x: auto; }
table { border-collapse: collapse; }
td, th { padding: .1rem .8rem .1rem 0; vertical-align: top; text-align: left; }
.head, .foot { width: 100%; color: #555; }
h1 { font-size: 1.2rem; margin-top: 1.8rem; }
h2 { font-size: 1.05rem; }
dd { margin-left: 2rem; }
@media (max-width: 36rem) { body { padding: .7rem; } dd { margin-left: 1rem; } }
@media (prefers-color-scheme: dark) {
  body { color: #e6e3dd; background: #16181b; }
  a { color: #7cb8ef; }
  pre { background: #23262b; }
  .head, .foot { color: #a8a49c; }
}
END
# mandoc links to a page of this site where it finds its source in the folder that it runs in.
for page in "${pages[@]}"; do
  name=${page#man/}
  (cd man && mandoc -Thtml \
    -O 'style=pages.css,man=%N.%S.html;https://manpages.debian.org/%N.%S' "$name") |
    sed 's/^<html>/<html lang="en">/
      s/<body>/<body><p><a href="index.html">rolling: all pages<\/a><\/p>/' >"$to/$name.html"
done

{
  cat <<'END'
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<title>rolling: the manual pages</title>
<link rel="stylesheet" href="pages.css" type="text/css"/>
</head>
<body>
<h1>rolling: the manual pages</h1>
<table>
END
  for page in "${pages[@]}"; do
    name=${page#man/}
    about=$(sed -n 's/^\.Nd //p' "$page" | sed 's/\\-/-/g; s/&/\&amp;/g; s/</\&lt;/g')
    printf '<tr><td><a href="%s.html">%s(%s)</a></td><td>%s</td></tr>\n' \
      "$name" "${name%.*}" "${name##*.}" "$about"
  done
  printf '</table>\n</body>\n</html>\n'
} >"$to/index.html"
