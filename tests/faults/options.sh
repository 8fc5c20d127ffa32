#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every option of --help with values that are none (a tenth of them, each with LONG=1), twice, and
# without a value; then values that mean nothing.
. "$(dirname "$0")/tools"
good 9 >"$scratch/good"

values=('' abc 0.5abc 1e400 -1e400 1e-400 0x10 inf nan '1 ' ' 1' '1,5e' 1e 1d3 -- '٣' $'1\n2' $'\e[31m')
declare -A names=()  # option, tools
for tool in $tools; do
  operand=$scratch/good
  [ "$tool" != simulate ] || operand=  # it takes none
  # "  -w,--width N  text": names and type; a type that ends in ... may be repeated
  while read -r option type rest; do
    long=${option##*,}
    names[$long]+="$tool "
    case $type in
      NUMBER | NUMBER,... | 'NUMBER,...|fit' | N)
        for value in "${values[@]}"; do
          in_turn || continue
          [[ $type != NUMBER,* || $value != *' '* ]] || continue  # a list may have blanks around its numbers
          attempt "$tool" "$long" "$value" $operand
          refused "$tool $long '$value'" "$option: '"
        done
        attempt "$tool" "$long=abc" $operand
        refused "$tool $long=abc" "$option: 'abc'" ;;
      NAME=*)
        # shellcheck disable=SC2086
        attempt ${command[$tool]} "$scratch/good" "$long" ''
        refused "$tool $long ''" "$long: ''" ;;
      NAME | FILE | COLUMN | RUN | NAME,...)
        attempt "$tool" "$long" '' $operand
        refused "$tool $long ''" "$long: ''" ;;
      *)  # a flag: true
        case $long in --help | --version) ;; *)
          attempt "$tool" "$long" "$long" $operand
          refused "$tool $long twice" "$long" ;;
        esac
        for value in false 0 1 abc; do
          attempt "$tool" "$long=$value" $operand
          refused "$tool $long=$value" ''
        done
        continue ;;
    esac
    attempt "$tool" $operand "$long"
    refused "$tool $long without a value" "$long"
    [[ $rest == ...* ]] && continue
    attempt "$tool" "$long" 1 "$long" 1 $operand
    refused "$tool $long twice" "$long"
  done < <("$tool" --help | awk '/^ +-/ { print }')
  for arguments in --no-such -Z --no-such=3; do
    attempt "$tool" $arguments $operand
    refused "$tool $arguments" "$arguments"
  done
done
[ ${#names[@]} -gt 40 ] || complain "only ${#names[@]} options were read from --help"

# Arguments | what the message holds; @ is a file of columns that is in order.
while IFS='|' read -r arguments says; do
  arguments=${arguments//@/$scratch/good}
  # shellcheck disable=SC2086
  attempt $arguments
  refused "$arguments" "$says"
done <<'END'
smooth -w 0 @|'0' must be a whole number from 1 to 1e9
smooth -w 2 @|is an odd number of samples, not 2
smooth -w -3 @|'-3' must be a whole number from 1 to 1e9
smooth -w 2.5 @|'2.5' must be a whole number from 1 to 1e9
smooth -w 1e10 @|'1e10' must be a whole number from 1 to 1e9
simulate --seed 1e10|'1e10' must be a whole number from 1 to 1e9
smooth -w 010 @|is an odd number of samples, not 10
smooth --seconds 0 @|'0' must be greater than 0
smooth --seconds -1 @|'-1' must be greater than 0
smooth -w 3 --seconds 1 @|--width does not go with --seconds
smooth --outliers 0 @|'0' must be greater than 0
smooth --order 2 @|--order goes with --method savgol
smooth -M savgol -w 3 --order 3 @|order
smooth -M savgol --order 0 @|'0' must be a whole number from 1 to 1e9
smooth -M savgol -w 75 --order 11 @|a polynomial of order 11: at most 10
smooth --seconds 0,5 @|'0,5' is not a number (decimal point, no unit)
smooth -w 3 -w 5 @|--width is given twice
smooth -q @ -q|--quiet is given twice
smooth @ -w|-w,--width needs a value
smooth --quiet=yes @|--quiet takes no value
smooth -M nothing @|'nothing' is not one of
smooth -c w @|there is no column 'w' among
smooth -c 5 @|there is no column '5' among
smooth -c 0 @|there is no column '0' among
smooth --use v=5 @|there is no column '5' among
smooth --use v=t @|cannot serve as both
smooth --use v=D --use v=a @|comes after another for v
smooth --use v= @|is not NAME=COLUMN
smooth --use =v @|is not NAME=COLUMN
smooth --from 5 --to 1 @|is after --to
smooth --run 0 @|there is no run 0 (runs: 1)
smooth --run 1.5 @|there is no run 1.5 (runs: 1)
smooth --run 2 @|there is no run 2
smooth --digits 0 @|from 1 to 17
smooth --digits 18 @|from 1 to 17
smooth --digits 1.5 @|from 1 to 17
differentiate -w 4 -M savgol @|is an odd number of samples, not 4
differentiate -w 5 @|goes with --method savgol
differentiate -w 3 --order 3 -M savgol @|order
differentiate -M mean @|'mean' is not one of
shift-from-accel -R 0 -K 0.5 @|'0' must be greater than 0
shift-from-accel -R -1 -K 0.5 @|'-1' must be greater than 0
shift-from-accel -R 1 -K -1 @|'-1' must be 0 or more
shift-from-accel -R 1 -K 0.5 -g 0 @|'0' must be greater than 0
shift-from-accel -R 1 -K 0.5 -g -9.81 @|'-9.81' must be greater than 0
shift-from-accel -q --exact -R 1 -K 100 @|within the radius
shift-from-accel -q --exact -R 1e-300 -K 1e308 @|
shift-from-accel -K 0.5 @|neither given nor in a scene: --radius
shift-from-accel -R 1 @|neither given nor in a scene: --shape-factor
fitpower --route velocity -K -1 -R 1 @|'-1' must be 0 or more
fitpower --route velocity -K 0.5, -R 1 @|'' is not a number
fitpower --route velocity -K 0.5,0.8 -R 1 @|gives 2 values for 1 run: give one
fitpower --route velocity -K 0.5 -R 0 @|'0' must be greater than 0
fitpower --fix a=1 --fix a=2 @|--fix: 'a=2' comes after another
fitpower --fix a @|'a' is not NAME=VALUE
fitpower --fix a= @|the value in 'a=' is not a number
fitpower --fix a=1e400 @|the value in 'a=1e400' is not a number
fitpower --fix a=0x1 @|the value in 'a=0x1' is not a number
fitpower --fix c=1 @|'c=1' is not NAME=VALUE
fitpower --min-speed -1 @|'-1' must be 0 or more
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --dt 0|'0' must be greater than 0
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --dt -1|'-1' must be greater than 0
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --dt 1e-10|these are 7.65e+10 rows
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --dt 1e-300 --until 1e300|rows; the most is 1e9
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --until 1e8|these are 1e+10 rows
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --until -1|--until -1 is before the roll, which begins at 0
simulate -K 0.5 -R 0.04 -a 0 -b 0.2 --v0 1|'0' must be greater than 0
simulate -K 0.5 -R 0.04 -a -1 -b 0.2 --v0 1|'-1' must be greater than 0
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --columns t,t|t is there twice
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --columns t,|is none of t, x, v, a, D
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --rtol 1|from 1e-12 to 0.1
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --rtol 0|from 1e-12 to 0.1
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --method none|'none' is not one of
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --memory 0|'0' must be greater than 0
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --damping 1|--damping goes with --memory
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1e308|is beyond the radius
simulate -K 0.5 -R 0.04 -a 1e-3 -b -1e300 --v0 0.5|is beyond -1000 to 1000
simulate -K 0.5 -R 0.04 -a 1e-3 -b 1.5 --v0 1|the body does not stop
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --sensor pasco --rate 0|'0' must be greater than 0
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --sensor pasco --rate 1e10|the sensor would make
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --sensor pasco --noise 1e308|not a finite number
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --sensor pasco --seed 0|'0' must be a whole number
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 --sensor pasco --lost 1|from 0 to below 1
simulate -K 0.5 -R 0.04 -a 1e-3 -b 0.2 --v0 1 @|
energy-ledger -m 0 -K 0.5 -R 0.04 @|'0' must be greater than 0
energy-ledger -m -1 -K 0.5 -R 0.04 @|'-1' must be greater than 0
energy-ledger -q -m 1e308 -K 1e308 -R 0.04 @|not a finite number
energy-ledger -m 1 -K 0.5 -R 0.04 --check -1 @|'-1' must be from 0 to 1
energy-ledger -m 1 -K 0.5 -R 0.04 -a 1e-3 @|neither given nor in a scene: --exponent
smooth /nowhere|/nowhere: No such file or directory
smooth .|.: Is a directory
simulate -K 0.5 -R 0.04 --v0 1 --law /nowhere|/nowhere: No such file or directory
simulate -K 0.5 -R 0.04 --v0 1 -a 1e-3 -b 0.2 --at .|.: Is a directory
END

# A scene's values follow the same rule: each of these as the radius.
for value in '' abc 1e400 1e-400 0x10 inf nan true '[1,2]' '1,5' '1 2' 1_000 '"1' -1 0; do
  for key in 'radius = ' '[scene]\nradius = ' 'radius = 1\nradius = ' 'Radius = ' 'radius = 1\nnothing = '; do
    in_turn || continue
    printf '%b%s\nshape-factor = 0.5\n' "$key" "$value" >"$scratch/scene"
    attempt shift-from-accel --scene "$scratch/scene" "$scratch/good"
    refused "shift-from-accel scene $key$value" "$scratch/scene:"
  done
done
for tool in shift-from-accel fitpower simulate energy-ledger; do
  for file in . /nowhere; do
    # shellcheck disable=SC2086
    attempt ${command[$tool]} "$scratch/good" --scene $file
    refused "$tool scene $file" "$file:"
  done
done
finish
