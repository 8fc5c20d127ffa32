#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What is not a number, in every column that each tool needs (a tenth of them, each with LONG=1); and
# what is not a file of columns.
. "$(dirname "$0")/tools"

# token <tab> how the message shows it
long=$(printf 'x%.0s' {1..3000})
tokens=$(cat <<END
abc	abc
0.5abc	0.5abc
1,5	1,5
1.5.2	1.5.2
1e400	1e400
-1e400	-1e400
1e-400	1e-400
0x10	0x10
0x1p3	0x1p3
inf	inf
-inf	-inf
Infinity	Infinity
-nan	-nan
nan(1)	nan(1)
1e	1e
e5	e5
1e+	1e+
1d5	1d5
.	.
-	-
+	+
+-1	+-1
--1	--1
1_000	1_000
1'000	1'000
٣	??
½	??
−1	???1
1\\f	1?
1\\v2	1?2
\\e[31m1	?[31m1
\\a1	?1
%s%n	%s%n
$long	${long:0:40}...
tt	tt
END
)
names=('' t v a D)
for tool in $tools; do
  for column in ${needs[$tool]}; do
    while IFS=$'\t' read -r token shown; do
      in_turn || continue
      bad=(0.2 0.45 -0.14 8.5e-4) bad[column-1]=$token
      printf "# t v a D\\n0 .5 -.1 1e-3\\n.1 .47 -.12 9e-4\\n.15 .46 -.1 9e-4\\n${bad[*]//%/%%}\\n.3 .4 -.1 8e-4\\n" >"$scratch/in"
      # shellcheck disable=SC2086
      attempt ${command[$tool]} - <"$scratch/in"
      refused "$tool '$token'" "-:5: field $column (${names[column]}): '$shown' is not a number"
    done <<<"$tokens"
  done
done
# Numbers of the same alphabet that are none the worse.
for token in 1 +1 1. .5e0 5E-1 010 1e+0 00.5; do
  printf '0 %s\n1 %s\n' $token $token >"$scratch/in"
  attempt smooth "$scratch/in"
  accepted "smooth $token"
done

# name <tab> what the message holds <tab> the file, whose bad row begins with 77
while IFS=$'\t' read -r name says file; do
  printf '%b' "$file" >"$scratch/in"
  for tool in $tools; do
    # shellcheck disable=SC2086
    attempt ${command[$tool]} - <"$scratch/in"
    refused "$tool $name" "$says"
    ! grep -q '^77' "$scratch/out" ||
      complain "$tool: $name: a bad row went out: $(cat "$scratch/out")"
  done
done <<'END'
empty	standard input is empty: did the tool before this one fail?	
a line end	standard input is empty: did the tool before this one fail?	\n
only blank lines	standard input is empty: did the tool before this one fail?	\n\n \t\n\n
only names	-:1: no rows: no field of 't v a D' is a number	t v a D\n
only a comment	-: no rows	# t v a D
only a history	-: no rows	## smooth v mean width 11\n# t[s]\tv[m/s]\ta\tD\n
a row cut short	-:4: 2 fields where the first row has 4	# t v a D\n0 .5 -.1 1e-3\n1 .4 -.1 1e-3\n77 .7\n
a row cut short without its end	-:4: 3 fields where the first row has 4	# t v a D\n0 .5 -.1 1e-3\n1 .4 -.1 1e-3\n77 .7 -7
a row too long	-:4: 5 fields where the first row has 4	# t v a D\n0 .5 -.1 1e-3\n1 .4 -.1 1e-3\n77 .7 -.7 7 7\n
a second header	is the header again	t v a D\n0 .5 -.1 1e-3\n1 .4 -.1 1e-3\nt v a D\n77 .7 -.7 7\n
fewer names than fields	-:2: 4 fields under a line of 3 names	t,v,a\n7,.5,-.1,1e-3\n1,.4,-.1,1e-3\n
lines that end in CR	-:1: a carriage return	0 .5 -.1 1e-3 1\r1 .4 -.1 1e-3 1\r77 .7 -.7 7 1\r
names and lines that end in CR	-:1: a carriage return	t,v,a,D\r0,.5,-.1,1e-3\r1,.4,-.1,1e-3\r77,.7,.7,7\r
an HTML page	-:1: this is HTML or XML	<!DOCTYPE html>\n<html>\n<body>\n<table border=7><tr><td>7</td></tr></table>\n<p>About 77 pages</p>\n</body></html>\n
a packed file, such as a workbook of a spreadsheet	-:1: a NUL byte: this is no text of columns; export a spreadsheet as CSV	PK\003\004\024\0\010\0a\n0 1\n
a NUL in a field	-:2: a NUL byte	0 .5 -.1 1e-3 1\n77 .7\0 -.7 7 1\n
a NUL in a comment	-:2: a NUL byte	0 .5 -.1 1e-3 1\n# a\0\n77 .7 -.7 7 1\n
a carriage return in a text	-:2: a carriage return	0 .5 -.1 1e-3 a\n77 .7 -.7 7 a\rb\n
a UTF-16 file	-:1: a NUL byte	\xff\xfe#\0 \0t\0 \0v\0 \0a\0 \0D\0\n\0001\0 \0002\0 \0003\0 \0004\0\n\0
a UTF-16 file of the other order	-:1: a NUL byte	\xfe\xff\0#\0 \0t\0 \0v\0 \0a\0 \0D\0\n\0001\0 \0002\0 \0003\0 \0004\0\n
a quote that is not closed	a quote that is not closed	t,v,a,D\n0,.5,-.1,1e-3\n1,.4,-.1,1e-3\n"77,.7,.7,7\n
two decimal marks	mark	t;v;a;D\n0,5;,5;-,1;1e-3\n1.5;.4;-.1;1e-3\n77;7;7;7\n
END

# Large things of the wrong kind.
large() {  # NAME SAYS: over $scratch/in
  for tool in $tools; do
    # shellcheck disable=SC2086
    attempt ${command[$tool]} - <"$scratch/in"
    refused "$tool $1" "$2"
  done
}
head -c 16777216 /dev/zero | tr '\0' 7 >"$scratch/in"
large 'a token of 16 MiB' '-:1: a line of more than 1048576 bytes'
{ good 3; head -c 16777216 /dev/zero | tr '\0' 7; } >"$scratch/in"
large 'a token of 16 MiB in the fifth line' '-:5: a line of more than 1048576 bytes'
head -c 400000 /dev/urandom | LC_ALL=C tr -d '0-9#"\n\r\0' >"$scratch/in"
large 'random bytes' '-:1: no rows: no field of '
# A hundred thousand columns are a line of columns.
awk 'BEGIN { for (i = 0; i < 2; i++) { printf "%d 1e-3 1e-3 1e-3", i; for (k = 4; k < 100000; k++) printf " 1"; print "" } }' >"$scratch/in"
for tool in $tools; do
  # shellcheck disable=SC2086
  attempt ${command[$tool]} - <"$scratch/in"
  case $tool in
    fitpower) refused 'fitpower 100000 columns' 'cannot determine' ;;  # two equal shifts say nothing of b
    simulate) accepted 'simulate 100000 columns' ;;
    *)
      accepted "$tool 100000 columns"
      [ "$(awk -F'\t' '!/^#/ && NF >= 100000 && NF <= 100010' "$scratch/out" | wc -l)" = 2 ] ||
        complain "$tool: 100000 columns do not come out" ;;
  esac
done

# Times that do not rise; for each tool that reads them.
for tool in smooth differentiate simulate energy-ledger 'fitpower --route velocity -K 0.5 -R 0.04'; do
  for time in 1 0.5 -1 0 0.99999999999999999; do
    # shellcheck disable=SC2086
    printf '# t v a D\n0 .5 -.1 1e-3\n1 .4 -.1 1e-3\n%s .3 -.1 1e-3\n' $time >"$scratch/in"
    case $tool in fitpower*) run=$tool ;; *) run=${command[$tool]} ;; esac
    # shellcheck disable=SC2086
    attempt $run - <"$scratch/in"
    refused "$tool and time $time" "-:4: field 1 (t): '$time' does not come after 1"
  done
done
finish
