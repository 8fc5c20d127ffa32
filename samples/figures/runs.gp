# SPDX-License-Identifier: GPL-3.0-or-later
# What figures of several runs share. draw.sh says how many there are, count, and whether they are
# somebody's own.
array label[4] = ['C on rubber', 'S on rubber', 'C on felt', 'S on felt']
# Runs by their number: those of somebody's own each in another colour.
array style[8] = [1, 3, 5, 7, 2, 4, 6, 8]
line(i) = own ? style[(i - 1)%8 + 1] : i
named = count > 16 ? 16 : count
name(i) = own ? cut(system(sprintf('sed -n %dp names', i)), 24) : label[i]
# The key of runs of somebody's own, outside of the axes, in rows of two.
outside = 'horizontal maxcols 2 width -1 samplen 1 font ",11"'
# A long name loses its middle.
cut(name, room) = strlen(name) <= room ? name : \
  substr(name, 1, (room - 1)/2).'…'.substr(name, strlen(name) - room/2 + 1, strlen(name))
min(x, y) = x < y ? x : y; max(x, y) = x > y ? x : y
# Every so many rows of a file, so that some `most` are drawn.
thin(file, most) = int(system(sprintf("grep -c '^[^#]' %s", file)))/most + 1
