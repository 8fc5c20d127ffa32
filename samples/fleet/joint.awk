# awk -f joint.awk table.txt: the fits of all records as one. The laws of the mats scatter: (ln a,
# b) of a record is the mean law, plus the scatter T, plus the error C of its fit. T is the
# covariance of the rows less the mean C (0 if that is negative). The mean law is the generalised
# least squares of the rows with T + C; if nothing scatters (T = 0) it is that of all records at
# once. The last three columns say whether the records agree: chi2 of the rows about their mean with
# C alone, its degrees of freedom, and the probability P of as much or more if they have one law.
BEGIN { FS = "\t" }
/^#/ { next }
{
  ++n
  x[n] = log($2); y[n] = $4
  sx = $3 / $2; sy = $5
  Cxx[n] = sx ^ 2; Cyy[n] = sy ^ 2; Cxy[n] = $6 * sx * sy
  mx += x[n]; my += y[n]; cxx += Cxx[n]; cxy += Cxy[n]; cyy += Cyy[n]
}
END {
  if (n < 2) { print "fewer than two rows" >"/dev/stderr"; exit 2 }
  mx /= n; my /= n
  for (i = 1; i <= n; ++i) {
    Txx += (x[i] - mx) ^ 2; Txy += (x[i] - mx) * (y[i] - my); Tyy += (y[i] - my) ^ 2
  }
  Txx = Txx / (n - 1) - cxx / n; Txy = Txy / (n - 1) - cxy / n; Tyy = Tyy / (n - 1) - cyy / n
  if (Txx <= 0 || Tyy <= 0) Txx = Txy = Tyy = 0
  if (Txy ^ 2 > Txx * Tyy) Txy = (Txy > 0 ? 1 : -1) * sqrt(Txx * Tyy)
  for (i = 1; i <= n; ++i) {  # W = sum of (T + C)^-1, r = sum of (T + C)^-1 (x, y)
    p = Txx + Cxx[i]; q = Txy + Cxy[i]; s = Tyy + Cyy[i]; d = p * s - q ^ 2
    Wxx += s / d; Wxy -= q / d; Wyy += p / d
    rx += (s * x[i] - q * y[i]) / d; ry += (p * y[i] - q * x[i]) / d
  }
  # The same with T = 0, for chi2.
  for (i = 1; i <= n; ++i) {
    d = Cxx[i] * Cyy[i] - Cxy[i] ^ 2
    Vxx += Cyy[i] / d; Vxy -= Cxy[i] / d; Vyy += Cxx[i] / d
    qx += (Cyy[i] * x[i] - Cxy[i] * y[i]) / d; qy += (Cxx[i] * y[i] - Cxy[i] * x[i]) / d
  }
  d = Vxx * Vyy - Vxy ^ 2
  x0 = (Vyy * qx - Vxy * qy) / d; y0 = (Vxx * qy - Vxy * qx) / d
  for (i = 1; i <= n; ++i) {
    u = x[i] - x0; w = y[i] - y0
    chi2 += (Cyy[i] * u ^ 2 - 2 * Cxy[i] * u * w + Cxx[i] * w ^ 2) / (Cxx[i] * Cyy[i] - Cxy[i] ^ 2)
  }
  # P of chi2 with 2 (n - 1) degrees of freedom: exp(-h) times the sum of h^k/k!, h = chi2/2.
  term = exp(-chi2 / 2)
  for (k = 0; k < n - 1; ++k) { P += term; term *= chi2 / 2 / (k + 1) }

  d = Wxx * Wyy - Wxy ^ 2
  lna = (Wyy * rx - Wxy * ry) / d; b = (Wxx * ry - Wxy * rx) / d
  sx = sqrt(Wyy / d); sy = sqrt(Wxx / d)
  print "# a[m]\tsigma_a[m]\tb\tsigma_b\tcorr\tscatter_ln_a\tscatter_b\tn\tchi2\tdof\tP"
  printf "%.6g\t%.2g\t%.5g\t%.2g\t%.4f\t%.3g\t%.3g\t%d\t%.4g\t%d\t%.2g\n",
    exp(lna), exp(lna) * sx, b, sy, -Wxy / d / (sx * sy), sqrt(Txx), sqrt(Tyy), n,
    chi2, 2 * n - 2, P
}
