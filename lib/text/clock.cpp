// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/clock.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>

#include "text/number.h"

namespace rolling {
namespace {

constexpr std::int64_t seconds_of_day = 86400;

/// Takes one of these characters from the beginning of a text.
bool take(std::string_view& text, std::string_view characters) {
  if (text.empty() || characters.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

/// Takes the digits at the beginning of a text, if there are `least` to `most` of them.
std::optional<int> take_digits(std::string_view& text, std::size_t least, std::size_t most) {
  const std::size_t count = std::min(text.find_first_not_of(decimal_digits), text.size());
  if (count < least || count > most) return {};
  int number = 0;
  for (const char digit : text.substr(0, count)) number = 10 * number + (digit - '0');
  text.remove_prefix(count);
  return number;
}

/// Takes `2026-11-24T`, or with a blank behind it; returns its days since an epoch.
std::optional<std::int64_t> take_date(std::string_view& text) {
  std::string_view rest = text;
  const auto year = take_digits(rest, 4, 4);
  if (!take(rest, "-")) return {};
  const auto month = take_digits(rest, 2, 2);
  if (!take(rest, "-")) return {};
  const auto day = take_digits(rest, 2, 2);
  if (!year || !month || !day || !take(rest, "T ")) return {};
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return {};
  text = rest;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

/// The seconds in `Z`, `+01:00`, `+0100` or `+01`.
std::optional<std::int64_t> read_offset(std::string_view text) {
  if (text == "Z") return 0;
  const std::int64_t sign = text.starts_with('-') ? -1 : 1;
  if (!take(text, "+-")) return {};
  const std::string digits = replace_all(text, {{":", ""}});
  if (!is_whole(digits) || (digits.size() != 2 && digits.size() != 4)) return {};
  const int number = std::stoi(digits);
  const int minutes = digits.size() == 2 ? 60 * number : 60 * (number / 100) + number % 100;
  return sign * 60 * minutes;
}

}  // namespace

bool is_clock_unit(std::string_view unit) {
  constexpr std::string_view known[] = {"hh:mm:ss", "h:mm:ss", "h:m:s", "mm:ss",
                                        "m:ss",     "m:s",     "min:s", digits_of_clock};
  const std::string small = lower(unit.substr(0, unit.find_first_of(".,")));  // hh:mm:ss.fff
  return std::ranges::count(known, small) > 0;
}

std::string with_colons(std::string_view digits) {
  const std::string_view whole = digits.substr(0, digits.find('.'));
  if (!is_number(digits) || !is_whole(whole) || whole.size() > 6) return std::string(digits);
  std::string text(6 - whole.size(), '0');
  text += digits;
  return text.insert(4, ":").insert(2, ":");
}

std::optional<Clock::Moment> Clock::read(std::string_view text) {
  Moment moment;
  const auto date = take_date(text);
  moment.midnight = date.value_or(0) * seconds_of_day;
  if (const auto blank = text.rfind(' '); blank != std::string_view::npos) {
    moment.form = text.substr(0, blank + 1);
    text.remove_prefix(blank + 1);
  }
  if (date) moment.form += 'T';
  std::size_t parts = 0;
  do {
    const bool first = parts == 0;
    const auto part = take_digits(text, 1, first ? 6 : 2);
    if (!part || (!first && *part >= 60)) return {};
    moment.seconds = 60 * moment.seconds + *part;
    ++parts;
  } while (take(text, ":"));
  const bool has_hours = parts == 3;
  if (!has_hours && (parts != 2 || date)) return {};
  moment.form.append(parts, ':');
  moment.begins_anew = has_hours && !date;
  if (take(text, ".,")) {
    moment.fraction = text.substr(0, text.find_first_not_of(decimal_digits));
    text.remove_prefix(moment.fraction.size());
    if (moment.fraction.empty()) return {};
  }
  if (text.empty()) return moment;
  const auto offset = read_offset(text);
  if (!offset || !has_hours) return {};
  moment.form += 'Z';
  moment.midnight -= *offset;
  return moment;
}

std::optional<double> Clock::seconds(std::string_view text) {
  const auto moment = read(text);
  if (!moment || (!form_.empty() && form_ != moment->form)) return {};
  if (form_.empty()) {
    form_ = moment->form;
    midnight_ = moment->midnight;
  }
  std::int64_t time = moment->midnight - midnight_ + moment->seconds;
  if (moment->begins_anew && time < last_ - seconds_of_day / 2) {
    midnight_ -= seconds_of_day;
    time += seconds_of_day;
  }
  last_ = time;
  double number;
  if (time < 0 || !parse_number(fmt::format("{}.{}", time, moment->fraction), number)) return {};
  return number;
}

}  // namespace rolling
