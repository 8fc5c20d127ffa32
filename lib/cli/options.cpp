// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/options.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/enumeration.h"
#include "cli/scene.h"
#include "signal/savitzky_golay.h"
#include "text/column.h"
#include "text/input.h"
#include "text/number.h"

namespace rolling {

static_assert(polynomial.holds(SavitzkyGolay::most_order) &&
              !polynomial.holds(SavitzkyGolay::most_order + 1));
namespace {

void require(const Domain& domain, double value, std::string_view text) {
  if (!domain.holds(value)) fail("'{}' must be {}", shown(text), domain.text);
}

[[noreturn]] void refuse_number(const std::string& text) {
  Estimate estimate;
  const std::string with_points = replace_all(text, ",", ".");
  const bool has_comma = with_points != text && parse_estimate(with_points, estimate);
  const std::string number = text.substr(0, text.find_last_of("0123456789") + 1);
  const bool has_unit = number != text && parse_estimate(number, estimate);
  fail("'{}' is not a number{}", shown(text),
       has_comma  ? "; its decimal mark has to be a point"
       : has_unit ? ": write it alone, in the unit of --help"
                  : "");
}

std::string long_name(const std::string& names) {
  const auto at = names.find("--");
  return at == std::string::npos ? std::string() : names.substr(at + 2);
}

/// A setter whose Errors name the option.
CommandLine::Set named(const std::string& names, const CommandLine::Set& set) {
  return [names, set](const std::string& text) {
    try {
      set(text);
    } catch (const Error& error) {
      fail("{}: {}", names, error.what());
    }
  };
}

}  // namespace

double to_number(const std::string& text, const Domain& domain) {
  double value;
  if (!parse_number(text, value)) refuse_number(text);
  require(domain, value, text);
  return value;
}

Estimate Options::to_estimate(const std::string& text, const Domain& domain) {
  Estimate estimate;
  if (!parse_estimate(text, estimate)) refuse_number(text);
  require(domain, estimate.value, text);
  if (estimate.value > domain.doubted)
    doubts_.insert(fmt::format("R = {} m: if that is millimetres, write {}", estimate.value,
                               estimate.value / 1000));
  return estimate;
}

Options::Options(const std::string& name, const std::string& purpose)
    : command_line_(name, purpose) {}

void Options::add(const std::string& names, const std::string& type, const std::string& help,
                  Set set, std::function<bool()> missing) {
  command_line_.option(names, type, help, named(names, set));
  options_[long_name(names)] = {std::move(set), std::move(missing)};
}

void Options::add_flag(const std::string& names, const std::string& help,
                       const std::function<void(bool)>& set) {
  command_line_.flag(names, help, [set] { set(true); });
  const auto set_from_text = [set](const std::string& text) {
    if (text != "true" && text != "false") fail("'{}' is neither true nor false", shown(text));
    set(text == "true");
  };
  options_[long_name(names)] = {set_from_text, {}};
}

void Options::flag(const std::string& names, bool& value, const std::string& help) {
  add_flag(names, help, [&value](bool on) { value = on; });
}

void Options::number(const std::string& names, double& value, const Domain& domain,
                     const std::string& help, double* sigma) {
  add(
      names, "NUMBER", help,
      [this, &value, domain, sigma](const std::string& text) {
    const Estimate read = sigma ? to_estimate(text, domain) : Estimate{to_number(text, domain)};
    value = read.value;
    if (sigma) *sigma = read.sigma;
      },
      [&value] { return std::isnan(value); });
}

void Options::numbers(const std::string& names, std::vector<Estimate>& values, const Domain& domain,
                      const std::string& help) {
  add(
      names, "NUMBER,...", help,
      [this, &values, domain](const std::string& text) {
    const auto parts = split_names(text, ',');
    const auto is_whole = [](const std::string& part) {
      return part.find_first_not_of("0123456789") == std::string::npos;
    };
    const auto both_whole = [&](const auto& a, const auto& b) {
      return is_whole(a) && is_whole(b);
    };
    if (std::ranges::adjacent_find(parts, both_whole) != parts.end())
      fail(
          "'{}' can be read in two ways: if its comma is a decimal one, make it a point; else "
          "write whole numbers with one, as 1.0,2.0",
          shown(text));
    values.clear();
    for (const std::string& part : parts) values.push_back(to_estimate(part, domain));
      },
      [&values] { return values.empty(); });
}

void Options::text(const std::string& names, std::string& value, const std::string& type,
                   const std::string& help) {
  add(names, type, help, [&value](const std::string& text) {
    if (text.empty()) fail("'' is no value");
    value = text;
  });
}

void Options::list(const std::string& names, const std::string& type, const std::string& help,
                   const Set& set) {
  command_line_.list(names, type, help, named(names, set));
}

void Options::body(Body& body, std::initializer_list<BodyOption> options,
                   BodyUncertainty* uncertainty) {
  body = {not_given, not_given, not_given};
  BodyUncertainty& u = uncertainty ? *uncertainty : ignored_;
  static constexpr struct {
    const char* names;
    double Body::*value;
    double BodyUncertainty::*sigma;
    Domain domain;
    const char* help;
  } all[] = {// in the order of BodyOption
             {"-m,--mass", &Body::m, nullptr, positive, "mass m [kg]"},
             {"-R,--radius", &Body::R, &BodyUncertainty::R, radius_in_metres, "radius R [m]"},
             {"-K,--shape-factor", &Body::K, &BodyUncertainty::K, not_negative,
              "shape factor K of J = K m R^2"},
             {"-g,--gravity", &Body::g, &BodyUncertainty::g, positive, "gravity g [m/s^2] (9.81)"},
             {"--slope", &Body::slope, &BodyUncertainty::slope, any_number,
              "rise of the mat in metres per metre of growing x (0)"}};
  for (const BodyOption option : options) {
    const auto& [names, value, sigma, domain, help] = all[static_cast<std::size_t>(option)];
    number(names, body.*value, domain, help, sigma ? &(u.*sigma) : nullptr);
  }
}

void Options::law(PowerLaw& law) {
  law = {not_given, not_given};
  number("-a,--coefficient", law.a, positive, "coefficient a of the law D = a v^b [m (s/m)^b]");
  number("-b,--exponent", law.b, any_number, "exponent b of the law");
}

void Options::geometry(Geometry& geometry) {
  geometry = Geometry::approximate;
  add_flag("--exact", "keep A = sqrt(1 - D^2/R^2) (the paper sets A = 1)",
           [&geometry](bool on) { geometry = on ? Geometry::exact : Geometry::approximate; });
}

void Options::scene() {
  text("--scene", scene_file_, "FILE",
       "TOML file with the long names of a scene's options; the command line wins");
}

bool Options::take_scene() {
  if (scene_file_.empty()) return false;
  refuse_output(scene_file_);
  for (const SceneValue& scene : read_scene(scene_file_)) {
    const auto option = options_.find(scene.key);
    if (option == options_.end() || on_command_line(scene.key)) continue;
    try {
      option->second.set(scene.value);
      in_scene_.insert(scene.key);
    } catch (const Error& error) {
      fail("{}:{}: {}: {}", scene_file_, scene.line, scene.key, error.what());
    }
  }
  return scene_file_ == "-";
}

void Options::need(const std::vector<std::string>& options) const {
  std::vector<std::string> missing;
  for (const std::string& option : options)
    if (options_.at(option).missing()) missing.push_back("--" + option);
  if (missing.size() == 1)
    fail<OptionError>("{} is not given, nor is it in a scene", missing.front());
  if (missing.size() > 1)
    fail<OptionError>("{} are not given, nor are they in a scene", enumeration(missing));
}

void Options::refuse(std::initializer_list<const char*> options, std::string_view why) const {
  for (const char* option : options)
    if (on_command_line(option)) fail<OptionError>("--{} {}", option, why);
}

}  // namespace rolling
