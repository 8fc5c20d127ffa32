#include "text/unit_words.h"

#include <string>
#include <utility>
#include <vector>

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("unit words: a unit in a name without brackets", "[text]") {
  struct Case {
    const char *quantity, *name, *unit;
  };
  const Case cases[] = {
      {"t", "t_ms", "ms"},
      {"t", "t/ms", "ms"},
      {"t", "Zeit_in_ms", "ms"},
      {"t", "Zeit_/_ms_(raw)", "ms"},
      {"t", "\xE6\x97\xB6\xE9\x97\xB4\xEF\xBC\x88\xC2\xB5s\xEF\xBC\x89", "us"},
      {"x", "cm", "cm"},
      {"x", "Weg_{mm}", "mm"},
      {"v", "v_km/h", "km/h"},
      {"v", "v/km/h", "km/h"},
      {"v", "Tempo_kmh", "km/h"},
      {"a", "a_cm/s\xC2\xB2", "cm/s^2"},
      {"t", "TIME_MS", "ms"},
      {"t", "T_MS", "ms"},
      {"t", "timeMs", "ms"},
      {"t", "tms", "ms"},
      {"t", "msec", "ms"},
      {"t", "time_usec", "us"},
      {"t", "millis", "ms"},
      {"t", "micros", "us"},
      {"t", "Time in minutes", "min"},
      {"x", "dist_CM", "cm"},
      {"x", "Dist_Cm", "cm"},
      {"x", "distMM", "mm"},
      {"x", "xcm", "cm"},
      {"x", "posmm", "mm"},
      {"x", "distance_rawcm", "cm"},
      {"t", "clockms", "ms"},
      {"t", "time_days", "days"},
      {"v", "velKmh", "km/h"},
      {"v", "velcms", "cm/s"},
      {"x", "distance_inch", "in"},
      {"x", "dist_feet", "ft"},
      {"x", "dist centimeters", "cm"},
      {"x", "x_pixels", "px"},
      {"x", "v_mm/s", "mm/s"},
      {"D", "Dmm", "mm"},
      {"v", "speed_cm_s", "cm/s"},
      {"v", "speed_cm_per_s", "cm/s"},
      {"v", "speed_ft_per_s", "ft/s"},
      {"v", "speed km h-1", "km/h"},
      {"v", "Speed in cm s^-1", "cm/s"},
      {"v", "Speed cm\xC2\xB7s\xE2\x81\xBB\xC2\xB9", "cm/s"},
      {"v", "vel_cms", "cm/s"},
      {"v", "speed_mms", "mm/s"},
      {"v", "v_fps", "ft/s"},
      {"v", "v_knots", "knots"},
      {"v", "Speed_kmph", "km/h"},
      {"v", "speedKmh", "km/h"},
      {"v", "speed_m_min", "m/min"},
      {"v", "v_in/s", "in/s"},
      {"v", "meters per hour", "m/h"},
      {"v", "wheel_rpm", "rpm"},
      {"a", "a_cm_s2", "cm/s^2"},
      {"a", "accel cm s-2", "cm/s^2"},
      {"a", "accel in cm\xC2\xB7s\xE2\x81\xBB\xC2\xB2", "cm/s^2"},
      {"a", "cm per second per second", "cm/s^2"},
      {"v", "Velocidad cm/seg", "cm/seg"},
      {"v", "H\xC4\xB1z cm/sn", "cm/sn"},
      {"v", "\xD0\xA1\xD0\xBA\xD0\xBE\xD1\x80, \xD1\x81\xD0\xBC/\xD1\x81",
       "\xD1\x81\xD0\xBC/\xD1\x81"},
      {"t", "\xE6\x97\xB6\xE9\x97\xB4/\xE6\xAF\xAB\xE7\xA7\x92",
       "\xE6\x97\xB6\xE9\x97\xB4/\xE6\xAF\xAB\xE7\xA7\x92"},
      {"t", "Zeit_/_Std", "Std"},
      {"t", "Zeit_/_Millisek", "millisek"},
      {"v", "m/min_or_m/s", "m/min"},
      {"t", "Zeit Millisekunden", "millisekunden"},
      {"t", "zaman_milisaniye", "milisaniye"},
      {"t", "Zeit Minuten", "minuten"},
      {"x", "Weg in Zentimetern", "zentimetern"},
      {"x", "position centim\xC3\xA8tres", "cm"},
      {"v", "n 1/s", "1/s"},
      {"v", "n U/min", "U/min"},
      {"a", "v_m/s", "m/s"},
      {"x", "v_m/s", "m/s"},
      {"a", "ax_g", "g"},
      {"a", "gForceX", "g"},
      {"t", "t_in_s", ""},
      {"t", "times", ""},
      {"x", "x_in", ""},
      {"x", "x_in_m", ""},
      {"x", "x_s", ""},
      {"w", "w_ms", ""},
  };
  for (const Case& c : cases) {
    INFO(c.quantity << " of " << c.name);
    CHECK(unit_in_name(c.quantity, c.name) == c.unit);
  }
}

TEST_CASE("unit words: SI units, and words that are no units", "[text]") {
  const std::pair<const char*, std::vector<const char*>> cases[] = {
      {"t",
       {"Time_elapsed", "Zeit_/_s", "t / s (raw)", "t/(s)", "time_sec", "Time in seconds", "times",
        "Run 1", "in", "stamp"}},
      {"x",
       {"x_m", "x2", "Position_1", "distance to motion sensor", "Distance in meters", "rms",
        "Mass A", "x_s", "x_min", "items", "sum", "left", "origin", "radius", "xMax", "frame A"}},
      {"v",
       {"v_in",
        "v_ms",
        "v_mps",
        "v_m_s",
        "v m s^-1",
        "speedMS",
        "meters per second",
        "vms",
        "min speed",
        "v_min",
        "v_h",
        "v_us",
        "v_cm",
        "velocity of the c.m.",
        "v_smoothed",
        "percent",
        "Wheel Speed",
        "foot speed",
        "second run",
        "Speed meter",
        "v/(m/s)",
        "speed of the microscope stage"}},
      {"a",
       {"a_ms2", "a_m_s_2", "a m/s/s", "Acceleration y", "a_cm", "acc_without_g", "acc with g"}},
  };
  for (const auto& [quantity, names] : cases)
    for (const char* const name : names) {
      INFO(quantity << " of " << name);
      CHECK(unit_in_name(quantity, name).empty());
    }
}

TEST_CASE("unit words: a unit in a comment", "[text]") {
  struct Case {
    const char *quantity, *comment, *unit;
  };
  const Case cases[] = {
      {"t", "# times are in ms", "ms"},
      {"t", "# the times are milliseconds", "ms"},
      {"t", "# Milliseconds since the start", "ms"},
      {"t", "# time unit: ms", "ms"},
      {"t", "# t is ms", "ms"},
      {"t", "# t [ms]: time, x [cm]", "ms"},
      {"t", "# t/ms x/cm", "ms"},
      {"t", "# Time ms Velocity cm/s", "ms"},
      {"t", "# t and v: ms and cm/s", "ms"},
      {"t", "# units: ms cm/s", "ms"},
      {"t", "# [ms] [cm/s] [N] [m]", "ms"},
      {"t", "# duration in min", "min"},
      {"t", "# time = fortnight, in days", ""},
      {"x", "# position: centimetres", "cm"},
      {"x", "# 3 marks, all in feet", "ft"},
      {"x", "# x in px", "px"},
      {"x", "# time in ms, x in mm", "mm"},
      {"x", "# D in mm", ""},
      {"D", "# D in mm", "mm"},
      {"D", "# x, D: mm", "mm"},
      {"v", "# all speeds in km/h", "km/h"},
      {"v", "# all speeds in kilometres per hour", "km/h"},
      {"v", "# speed in MPH", "mph"},
      {"v", "# v in cm s^-1", "cm/s"},
      {"v", "# v in cm\xC2\xB7s\xE2\x81\xBB\xC2\xB9", "cm/s"},
      {"v", "# units: s, cm\xE2\x8B\x85s^-1", "cm/s"},
      {"v", "# v [cm*s-1]", "cm/s"},
      {"v", "# v (cm . s-1)", "cm/s"},
      {"v", "# v in km\xC2\xB7h\xE2\x81\xBB\xC2\xB9", "km/h"},
      {"v", "# v in m\xC2\xB7min\xE2\x81\xBB\xC2\xB9", "m/min"},
      {"v", "# speed_in_cm_per_s", "cm/s"},
      {"v", "# speed in knots", "knots"},
      {"v", "# times are in ms", ""},
      {"v", "# all velocities in knots", "knots"},
      {"a", "# a in cm/s\xC2\xB2", "cm/s^2"},
      {"a", "# a in cm\xC2\xB7s\xE2\x81\xBB\xC2\xB2", "cm/s^2"},
      {"a", "# accelerations in g", "g"},
      {"t", "# times in days", "days"},
      {"x", "# positions: pixels", "px"},
      {"t", "# min ft", "min"},
      {"x", "# min ft", "ft"},
      {"x", "# (s)\t(ft)", "ft"},
      {"x", "# units: s ft", "ft"},
      {"x", "# [s] [in]", "in"},
      {"x", "# t in s, x in in", "in"},
      {"t", "# Einheiten;min;m", "min"},
      {"x", "# Position Units;inch", "in"},
  };
  for (const Case& c : cases) {
    INFO(c.quantity << " of " << c.comment);
    CHECK(units_in_comment(c.comment)[c.quantity] == c.unit);
  }
}

TEST_CASE("unit words: values, and words that are no units, in a comment", "[text]") {
  for (const char* comment : {"# every 40 ms, 3 cm apart, at 5 km/h",
                              "# exposure (ms): 20",
                              "# radius in cm: 4",
                              "# time in min: 5",
                              "# speed: min 0, time: 40 ms",
                              "# time: in the morning",
                              "# Ms. Smith, MS Excel",
                              "# t min, t max, x min",
                              "# us, them; in a min or an h",
                              "# a shell in felt",
                              "# t: s; v = m/s, x in m",
                              "# time in s, speed in m s^-1",
                              "# t in s, v in m\xC2\xB7s\xE2\x81\xBB\xC2\xB9, a in m*s-2",
                              "# every 0.5 ms, at .5 cm.s-1",
                              "## smooth t from 1 ms",
                              "## times in ms",
                              "# g = 981 cm/s^2",
                              "# mass in g",
                              "# every 40 ms m by m",
                              "# s, m, in that order",
                              "# x in m, v_in",
                              "# roll 3 m, h",
                              "# t s x in",
                              "# the sum of two forms is a status",
                              "#"})
    CHECK(units_in_comment(comment) == UnitsOf());
}
