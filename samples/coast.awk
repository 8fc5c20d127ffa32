# The free roll of a sensor's record: awk -f samples/coast.awk samples/CR.csv
# The push ends where the speed is greatest; three records later the sensor's rule for v, which looks two records around,
# has left it behind. The roll is taken down to a fifth of the greatest speed: the bulge's memory bends what comes after.
BEGIN { FS = "," }
FNR == 1 { print; next }
{ row[FNR] = $0; v[FNR] = $3; if ($3 != "" && $3 + 0 > most) { most = $3 + 0; peak = FNR } }
END {
  for (i = peak + 3; i in row; i++) {
    if (v[i] != "" && v[i] + 0 < most / 5) break
    print row[i]
  }
}
