// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/enumeration.h"
#include "signal/savitzky_golay.h"
#include "text/column.h"
#include "text/lines.h"
#include "text/number.h"

namespace rolling {

static_assert(polynomial.holds(SavitzkyGolay::most_order) &&
              !polynomial.holds(SavitzkyGolay::most_order + 1));
namespace {

constexpr std::string_view version = "1.0.0";
constexpr std::size_t page_width = 79, help_column = 30;

/// Refuses a text that is not a number of the domain.
void require(bool is_number, double value, const Domain& domain, const std::string& text) {
  if (!is_number) fail("'{}' is not a number (decimal point, no unit)", shown(text));
  if (!domain.holds(value)) fail("'{}' must be {}", shown(text), domain.text);
}

bool to_bool(const std::string& text) {
  if (text != "true" && text != "false") fail("'{}' is neither true nor false", shown(text));
  return text == "true";
}

/// The keys of a scene. A tool ignores those that it does not need.
constexpr std::array<std::string_view, 12> keys = {
    "mass",     "radius", "shape-factor", "gravity", "slope",  "coefficient",
    "exponent", "exact",  "v0",           "x0",      "memory", "damping"};

/// What a scene file assigns, as CLI11 reads TOML.
std::vector<CLI::ConfigItem> read_scene(const std::string& file) {
  Lines lines(file);
  lines.separate_by('\0');
  std::string text;
  while (lines.next()) (text += lines.text()) += '\n';
  std::istringstream scene(text);
  scene.exceptions(std::ios::badbit);  // so that memory that has run out does not end it in silence
  return CLI::ConfigTOML().from_config(scene);
}

/// Appends the line of an option or operand, with its explanation from help_column on, wrapped.
void append_item(std::string& page, const std::string& names, std::string_view words) {
  std::string line = "  " + names;
  if (line.size() + 2 > help_column) {
    page += line + '\n';
    line.clear();
  }
  line.resize(help_column, ' ');
  while (line.size() + words.size() > page_width) {
    const std::size_t blank = words.rfind(' ', page_width - line.size());
    (page += line) += words.substr(0, blank);
    page += '\n';
    line.assign(help_column, ' ');
    words.remove_prefix(blank + 1);
  }
  ((page += line) += words) += '\n';
}

bool may_repeat(const CLI::Option& option) { return option.get_items_expected_max() > 1; }

/// `-w,--width N`, with ` ...` behind where the option may be repeated.
std::string synopsis(const CLI::Option& option) {
  std::string text;
  for (const std::string& name : option.get_snames()) text += '-' + name + ',';
  text += "--" + option.get_lnames().front();
  if (option.get_items_expected_max() == 0) return text;
  text += ' ' + option.get_type_name();
  if (may_repeat(option)) text += " ...";
  return text;
}

}  // namespace

double to_number(const std::string& text, const Domain& domain) {
  double value = 0;
  const bool is_number = parse_number(text, value);
  require(is_number, value, domain, text);
  return value;
}

Estimate Options::to_estimate(const std::string& text, const Domain& domain) {
  Estimate estimate;
  const bool is_number = parse_estimate(text, estimate);
  require(is_number, estimate.value, domain, text);
  if (estimate.value > domain.doubted)
    doubts_.insert(fmt::format("R = {} m: if that is millimetres, write {}", estimate.value,
                               estimate.value / 1000));
  return estimate;
}

Options::Options(const std::string& name, const std::string& purpose)
    : app_(new CLI::App(purpose, name)) {
  app_->set_help_flag("-h,--help", "print this and exit")->disable_flag_override();
  app_->set_version_flag("--version", "", "print the version and exit")->disable_flag_override();
}

Options::~Options() = default;

void Options::add(const std::string& names, const std::string& type, const std::string& help,
                  Set set, Values values) {
  CLI::callback_t take = [names, set = std::move(set)](const std::vector<std::string>& texts) {
    try {
      for (const std::string& text : texts) set(text);
    } catch (const Error& error) {
      fail("{}: {}", names, error.what());
    }
    return true;
  };
  app_->add_option(names, std::move(take), help)
      ->type_name(type)
      ->expected(values == Values::many ? CLI::detail::expected_max_vector_size
                                        : static_cast<int>(values))
      ->allow_extra_args(!names.starts_with('-'))
      ->disable_flag_override();
}

void Options::flag(const std::string& names, bool& value, const std::string& help) {
  add(
      names, "", help, [&value](const std::string& text) { value = to_bool(text); }, Values::none);
}

void Options::number(const std::string& names, double& value, const Domain& domain,
                     const std::string& help, double* sigma) {
  add(names, "NUMBER", help, [this, &value, domain, sigma](const std::string& text) {
    const Estimate read = sigma ? to_estimate(text, domain) : Estimate{to_number(text, domain)};
    value = read.value;
    if (sigma) *sigma = read.sigma;
  });
}

void Options::numbers(const std::string& names, std::vector<Estimate>& values, const Domain& domain,
                      const std::string& help) {
  add(names, "NUMBER,...", help, [this, &values, domain](const std::string& text) {
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
  });
}

void Options::text(const std::string& names, std::string& value, const std::string& type,
                   const std::string& help) {
  add(names, type, help, [&value](const std::string& text) {
    if (text.empty()) fail("'' is no value");
    value = text;
  });
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
  add(
      "--exact", "", "keep A = sqrt(1 - D^2/R^2) (the paper sets A = 1)",
      [&geometry](const std::string& text) {
    geometry = to_bool(text) ? Geometry::exact : Geometry::approximate;
      },
      Values::none);
}

void Options::scene() {
  text("--scene", scene_file_, "FILE",
       "TOML file with the long names of a scene's options; the command line wins");
}

std::string Options::parse(const std::string& name, int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return help(name);
  } catch (const CLI::CallForVersion&) {
    return fmt::format("{} (rolling) {}\n", name, version);
  } catch (const CLI::ExtrasError&) {
    fail("no such option or operand: {} (see --help)", shown(app_->remaining().front()));
  } catch (const CLI::ParseError& error) {
    fail("{} (see --help)", error.what());
  }
  if (const CLI::Option* const files = app_->get_option_no_throw("FILE"))
    for (const std::string& file : files->results())
      if (std::count(argv, argv + argc, file) == 0)  // CLI11 reads an operand [a,b] as a and b
        fail("'{}' is from a name in brackets: write ./ before it", shown(file));
  return {};
}

bool Options::take_scene() {
  if (scene_file_.empty()) return false;
  for (const CLI::ConfigItem& item : read_scene(scene_file_)) try {
      if (!item.parents.empty() || std::ranges::count(keys, item.name) == 0)
        fail("a scene has no '{}'; it has mass, radius, shape-factor, ...", shown(item.fullname()));
      if (item.inputs.size() != 1) fail("{} is not one value", item.name);
      CLI::Option* const option = app_->get_option_no_throw("--" + item.name);
      if (!option || on_command_line(item.name)) continue;
      if (!in_scene_.insert(item.name).second) fail("{} is there twice", item.name);
      option->add_result(item.inputs.front());
      option->run_callback();
    } catch (const Error& error) {
      fail("{}: {}", scene_file_, error.what());
    }
  return scene_file_ == "-";
}

bool Options::given(const std::string& option) const {
  return app_->get_option("--" + option)->count() > 0;
}

void Options::need(const std::vector<std::string>& options) const {
  std::vector<std::string> missing;
  for (const std::string& option : options)
    if (!given(option)) missing.push_back("--" + option);
  if (!missing.empty()) fail<OptionError>("neither given nor in a scene: {}", enumeration(missing));
}

void Options::refuse(std::initializer_list<const char*> options, std::string_view why) const {
  for (const char* option : options)
    if (on_command_line(option)) fail<OptionError>("--{} {}", option, why);
}

std::string Options::help(const std::string& name) const {
  const CLI::App& app = *app_;
  std::string operands = "\n", options = "\nOptions:\n";
  for (const CLI::Option* option : app.get_options()) {
    if (option->nonpositional()) append_item(options, synopsis(*option), option->get_description());
    else append_item(operands, option->get_name() + "...", option->get_description());
  }
  const bool reads = operands.size() > 1;
  return "Usage: " + name + " [OPTION...]" + (reads ? " [FILE...]" : "") + "\n" +
         app.get_description() + '\n' + (reads ? operands : "") + options + "\nIn full: man " +
         name + ". A tutorial: man rolling.\n";
}

}  // namespace rolling
