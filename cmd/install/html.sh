#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# html.sh FOLDER: the manual pages as one site of HTML in FOLDER, made by mandoc: NAME.SECTION.html
# for each page, and index.html with them, README.md as text, and the report if it stands above
# FOLDER. A page of another project (awk, sed, ...) is linked at manpages.debian.org.
set -euo pipefail
export LC_ALL=C
unset CDPATH
cd "$(dirname "$0")/../.."
command -v mandoc >/dev/null ||
  { echo "html: mandoc is not installed; make setup html installs it" >&2; exit 2; }
[ $# = 1 ] || { echo 'html.sh FOLDER' >&2; exit 2; }
site='rolling: the law of a rolling body, with uncertainties'
[ ! -e "$1/index.html" ] || grep -qF "$site" "$1/index.html" ||
  { echo "html: $1/index.html is not of this site: choose another folder" >&2; exit 2; }
mkdir -p -- "$1"
. cmd/install/scratch.sh
own scratch "$(cd -- "$1" && pwd)/.new.$$"
# In the order in which one reads them.
pages=(man/rolling.7 man/smooth.1 man/differentiate.1 man/shift-from-accel.1 man/fitpower.1
  man/simulate.1 man/energy-ledger.1 man/rolling-recipes.7 man/rolling-columns.5 man/rolling-fits.7
  man/rolling-motion.7)

# about PAGE: what its title says, as HTML.
about() {
  sed -n 's/^\.Nd //p' "$1" | sed 's/\\-/-/g; s/\\(ha/^/g; s/&/\&amp;/g; s/</\&lt;/g'
}

cat >"$scratch/pages.css" <<'END'
:root { --text: #1a1a1a; --page: #fff; --box: #f3f1ec; --link: #005a9c; --faint: #555;
  --edge: rgba(0, 0, 0, .35); }
@media (prefers-color-scheme: dark) {
  :root { --text: #e6e3dd; --page: #16181b; --box: #23262b; --link: #7cb8ef; --faint: #a8a49c;
    --edge: rgba(255, 255, 255, .45); }
}
body { max-width: 52rem; margin: 0 auto; padding: 1rem; font: 1rem/1.5 system-ui, sans-serif;
  color: var(--text); background: var(--page); }
a { color: var(--link); }
h1 > a, h2 > a, dt > a, td > a.permalink { color: inherit; text-decoration: none; }
pre, code { font-family: ui-monospace, monospace; font-size: .92em; }
.Fl, .Xr, .option { white-space: nowrap; }
.Li, .Pa { overflow-wrap: anywhere; }
/* What is wider than the page scrolls, and a shadow at an edge shows that there is more. */
pre, .Bl-column { display: block; overflow-x: auto; --ground: var(--page);
  background:
    linear-gradient(to right, var(--ground) 40%, transparent) 0 0 / 2rem 100%,
    linear-gradient(to left, var(--ground) 40%, transparent) 100% 0 / 2rem 100%,
    linear-gradient(to right, var(--edge), transparent) 0 0 / .6rem 100%,
    linear-gradient(to left, var(--edge), transparent) 100% 0 / .6rem 100%,
    var(--ground);
  background-repeat: no-repeat; background-attachment: local, local, scroll, scroll, local; }
pre { --ground: var(--box); padding: .6rem .8rem; }
.Bl-column td { white-space: nowrap; }
table { border-collapse: collapse; }
td, th { padding: .1rem .8rem .1rem 0; vertical-align: top; text-align: left; }
.head, .foot { width: 100%; color: var(--faint); }
.head td:last-child { text-align: right; }
h1 { font-size: 1.2rem; margin-top: 1.8rem; }
h2 { font-size: 1.05rem; }
dd { margin-left: 2rem; }
@media (max-width: 36rem) {
  body { padding: .7rem; }
  dd { margin-left: 1rem; }
  .head-vol { display: none; }
}
END
# mandoc links to a page of this site where it finds its source in the folder that it runs in. No
# line breaks within an option.
for page in "${pages[@]}"; do
  name=${page#man/}
  title="${name%.*}(${name##*.}): $(about "$page")"
  (cd man && mandoc -Thtml \
    -O 'style=pages.css,man=%N.%S.html;https://manpages.debian.org/%N.%S' "$name") |
    sed -E "s|^  <title>.*|  <title>${title//&/\\&}</title>|"'
      s/^<html>/<html lang="en">/
      s|<body>|<body><p><a href="index.html">rolling: all pages</a></p>|
      s/(<code class="Li">|[ (])(--?[a-z][a-z0-9-]*)/\1<span class="option">\2<\/span>/g' \
      >"$scratch/$name.html"
done
cp README.md "$scratch/README.txt"

{
  cat <<END
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<title>$site</title>
<link rel="stylesheet" href="pages.css" type="text/css"/>
</head>
<body>
<h1>$site</h1>
<p>Begin with the tutorial, <a href="rolling.7.html">rolling(7)</a>. The <a href="README.txt">README</a> is plain text.</p>
<table>
END
  [ ! -e "$1/../report.html" ] ||
    echo '<tr><td><a href="../report.html">report</a></td><td>Table 1 and the figures</td></tr>'
  for page in "${pages[@]}"; do
    name=${page#man/}
    printf '<tr><td><a href="%s.html">%s(%s)</a></td><td>%s</td></tr>\n' \
      "$name" "${name%.*}" "${name##*.}" "$(about "$page")"
  done
  printf '</table>\n</body>\n</html>\n'
} >"$scratch/index.html"
mv -f -- "$scratch"/* "$1"
