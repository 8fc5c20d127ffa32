#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws where the energy of a roll goes. Points: the energy stored at the measured velocities, and the
# energy that the fitted shift dissipates at them. Lines: the same for the fitted trajectory. If the law
# is right, the sum is constant.
#
#   energy.sh [OPTION]... [FILE] >energy.svg      the cylinder on rubber, or your own run
#
#   --slope S          slope tan(theta) of the mat, above 0 if x grows uphill (0)
#   --seconds S        window of the parabolas whose slope is the velocity (0.84)
takes='--slope --seconds' seconds=0.84 needs='-K 0.5 -R 0.04 -m 1.375'
. "$(dirname "$0")/draw.sh"
prepare CR
balance
title='Energy of a roll against time: translation, rotation, dissipated, and their sum'
draw 520 500 "start = $start; parts = $parts" <<<"set bmargin at screen 0.23; load 'energies.gp'"
