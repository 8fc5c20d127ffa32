// SPDX-License-Identifier: GPL-3.0-or-later
// Each remark on a fit begins at its level: a hair below it and a hair above it.
#include <unistd.h>

#include <cmath>
#include <functional>

#include "report/fit_runs.h"
#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

namespace {

/// A fit of positions on which there is nothing to remark, and what is done with it.
struct Case {
  FitOptions options = {};
  bool check = false;
  std::size_t fits = 1;
  FitOfRuns fit{.route = Route::position, .runs = std::vector<Run>(1)};
  FitResult& result;

  Case()
      : result(fit.result.emplace(FitResult{.law = PowerLaw{0, 0},
                                            .rms = 1e-3,
                                            .n = 99,
                                            .freedom = 95,
                                            .negative = 0,
                                            .whiteness = 0.5,
                                            .errors = Errors::autocorrelation})) {
    options.robust = true;  // the beginning is then not searched
    Run& run = fit.runs.front();
    run.body.K = 0.5;
    run.body.R = 0.04;
    for (int i = 0; i < 30; ++i) {
      run.t.push_back(i);
      run.x.push_back(std::sqrt(i));  // on no grid
    }
    result.v0 = {{1, 1e-3}};
    law(1e-3, 1e-6, 0.2, 1e-3);
  }
  void law(double a, double sigma_a, double b, double sigma_b) {
    result.law = PowerLaw{a, b};
    result.a = a;
    result.sigma_a = sigma_a;
    result.b = b;
    result.sigma_b = sigma_b;
    result.corr = 0;
  }
  /// Another law is better by so much in AICc.
  void another(double against) {
    fit.laws = LawComparison{.fits = {}, .other = &laws()[1], .against = against};
  }
  /// Millimetres; before each of so many readings one is repeated.
  void millimetres(int readings, int repeated) {
    fit.runs.front().x = {0};
    for (int i = 1; i < readings; ++i) {
      if (i <= repeated) fit.runs.front().x.push_back(1e-3 * (i - 1));
      fit.runs.front().x.push_back(1e-3 * i);
    }
    fit.runs.front().t.resize(fit.runs.front().x.size());
  }
};

/// What a tool says while it does this.
std::string said_by(const std::function<void(Tool&)>& work) {
  const TemporaryFile file;
  Tool tool("tool", "");
  std::string name = "tool";
  char* arguments[] = {name.data(), nullptr};
  {
    const Redirect to_file(STDERR_FILENO, file.name());
    tool.run(1, arguments, [&] {
      work(tool);
      return 0;
    });
  }
  return file.text();
}

/// What is said of a good fit in which this is otherwise.
std::string said(const std::function<void(Case&)>& change) {
  Case one;
  change(one);
  return said_by([&](Tool& tool) {
    tool.checks = one.check;
    remark(tool, one.fit, one.options, one.fits);
  });
}

/// The change brings a remark with these words where its number is `told`, and none at `not_told`.
void begins(const std::string& words, double not_told, double told,
            const std::function<void(Case&, double)>& change) {
  INFO(words);
  CHECK(said([&](Case& c) { change(c, not_told); }).empty());
  CHECK(said([&](Case& c) { change(c, told); }).find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("fit report: each remark on a fit begins at its level", "[cli]") {
  CHECK(said([](Case&) {}).empty());
  CHECK(said([](Case& c) { c.check = true; }).empty());
  begins("less than a ten-thousandth of the radius", 4.04e-6, 3.96e-6,
         [](Case& c, double D) { c.law(D, 1e-3 * D, 0.2, 1e-3); });
  begins("beyond the radius", 0.0396, 0.0404,
         [](Case& c, double D) { c.law(D, 1e-3 * D, 0.2, 1e-3); });
  begins("too much for the interval a +- sigma_a", 2.99e-4, 3.01e-4,
         [](Case& c, double sigma) { c.law(1e-3, sigma, 0.2, 1e-3); });
  begins("no mat does this", 0.0337, 0.0333,
         [](Case& c, double sigma) { c.law(1e-3, 1e-6, -0.601, sigma); });
  begins("the readings look like medians", 0.101, 0.099,
         [](Case& c, double p) { c.result.reversals = p; });
  begins("the noise is correlated", 0.00505, 0.00495,
         [](Case& c, double p) { c.result.whiteness = p; });
  begins("the noise is correlated", 0.00505 / 3, 0.00495 / 3, [](Case& c, double p) {
    c.check = true;  // of one of three fits
    c.fits = 3;
    c.result.whiteness = p;
  });
  // Residuals that are rounding errors have no noise: 1e-9 of the radius.
  begins("the noise is correlated", 3.96e-11, 4.04e-11, [](Case& c, double rms) {
    c.result.whiteness = 1e-4;
    c.result.rms = rms;
  });
}

TEST_CASE("fit report: another law counts from 10 in AICc on, and is better from 2 on", "[cli]") {
  begins("is better than a v^b by", 9.95, 10.05, [](Case& c, double against) {
    c.check = true;
    c.another(against);
  });
  // A check of three fits: a ratio of likelihoods that is three times as large.
  begins("is better than a v^b by", 9.95 + 2 * std::log(3), 10.05 + 2 * std::log(3),
         [](Case& c, double against) {
    c.check = true;
    c.fits = 3;
    c.another(against);
  });
  // It is the cause of what the residuals show.
  begins("the noise is correlated", 10.05, 9.95, [](Case& c, double against) {
    c.result.whiteness = 1e-4;
    c.another(against);
  });
  for (const auto& [against, words] :
       {std::pair(1.95, "no law that was tried is better"), {2.05, "another law is better"}}) {
    Case one;
    one.another(against);
    one.fit.laws->fits.resize(1, {.law = laws().data()});
    CHECK(said_by([&](Tool& tool) { report(tool, one.fit, laws().front()); }).find(words) !=
          std::string::npos);
  }
}

TEST_CASE("fit report: logarithms are biased by one D <= 0 in a hundred, or by rms^2/2", "[cli]") {
  begins("biases its logarithms", 99, 98, [](Case& c, double n) {
    c.fit.route = Route::loglog;
    c.result.negative = 1;
    c.result.n = static_cast<std::size_t>(n);
  });
  begins("biases its logarithms", 0.0995, 0.1005, [](Case& c, double rms) {
    c.fit.route = Route::loglog;
    c.law(1e-3, 5e-6, 0.2, 1e-3);
    c.result.rms = rms;
  });
}

TEST_CASE("fit report: readings repeat, or have hardly any noise, from some share of their grid on",
          "[cli]") {
  const auto repeats = [](double not_told, double told, const auto& change) {
    begins("the positions repeat, or have hardly any noise but their rounding", not_told, told,
           change);
  };
  // Hardly any noise but rounding, which makes an rms of 0.29 mm; differences add two errors.
  for (const double unit : {1.0, std::sqrt(2)})
    for (const auto& [not_told, told] : {std::pair(0.198e-3, 0.202e-3), {0.322e-3, 0.318e-3}})
      repeats(unit * not_told, unit * told, [&](Case& c, double rms) {
        c.millimetres(30, 0);
        c.result.rms = rms;
        if (unit > 1) c.result.errors = Errors::differences;
      });
  repeats(0.505e-3, 0.495e-3, [](Case& c, double rms) {
    c.millimetres(20, 10);
    c.result.rms = rms;
  });
  // More than a third of the rows that follow another: 10 of 30 and of 29.
  repeats(21, 20, [](Case& c, double readings) {
    c.millimetres(static_cast<int>(readings), 10);
    c.result.rms = 0.4e-3;
  });
  // Ten of them at least.
  repeats(9, 10, [](Case& c, double repeated) {
    c.millimetres(16, static_cast<int>(repeated));
    c.result.rms = 0.4e-3;
  });
}
