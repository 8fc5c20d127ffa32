// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/law_file.h"

#include <unistd.h>

#include <cmath>
#include <set>
#include <vector>

#include "cli/history.h"
#include "unit/catch.h"
#include "unit/text/files.h"

using namespace rolling;

namespace {

struct Given {
  LawOptions options{};
  PowerLaw law{};
  std::vector<LawOfFile> files{1};
  const LawOfFile& file() const { return files.front(); }
  double v0 = not_given;
  int status = 0;
  std::string said;
};

const std::vector<std::string> body_words{"-K", "0.5", "-R", "0.04"};

/// What a file with this text sets, beside these words on the command line.
Given law_of(const std::string& text, std::vector<std::string> words = {}, bool with_errors = false,
             const std::vector<std::string>& body = body_words) {
  const TemporaryFile file(text), errors;
  Given given;
  Tool tool("tool", "");
  Body given_body{};
  tool.body(given_body, {&Body::R, &Body::K, &Body::g, &Body::slope});
  tool.geometry(given_body.exact);
  add_options(tool, given.options);
  tool.number("--v0", given.v0, any_number, "");
  words.insert(words.begin(), body.begin(), body.end());
  words.insert(words.begin(), "tool");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  {
    const Redirect to_file(STDERR_FILENO, errors.name());
    given.status = tool.run(static_cast<int>(words.size()), arguments.data(), [&] {
      given.options.file = file.name();
      given.files = read_laws(tool, given.options, given_body, with_errors);
      given.law = given.file().law.power().value_or(given.options.power);
      return 0;
    });
  }
  given.said = errors.text();
  return given;
}

}  // namespace

TEST_CASE("law file: a row of fitpower, in its units; the command line wins", "[cli]") {
  const std::string row = "# a[mm]\tsigma_a[mm]\tb\tv0[cm/s]\tslope\n1.5\t0.1\t0.25\t50\t0.001\n";
  const Given all = law_of(row);
  CHECK((all.status == 0 && all.said.empty() && !all.file().law.has_points()));
  CHECK((all.law.a == 1.5e-3 && all.law.b == 0.25 && all.file().v0 == 0.5));
  CHECK(all.file().body.slope == 0.001);
  const Given some = law_of(row, {"-a", "2e-3", "-b", "0.5", "--slope", "0.1"});
  CHECK((some.law.a == 2e-3 && some.law.b == 0.5 && some.file().body.slope == 0.1));
  for (const char* half : {"-a", "-b"}) {
    const Given one = law_of(row, {half, "1"});
    CHECK((one.status == 2 && one.said.find("neither given nor in a scene") != std::string::npos));
  }
  const Given none = law_of("a b\n2e-3 0\n", {"-a", "2e-3", "-b", "0"});
  CHECK(none.said == "tool: --law adds nothing to the command line: leave it out\n");
  const Given bare = law_of("a b\n2e-3 0\n");
  CHECK((bare.law.a == 2e-3 && bare.law.b == 0 && std::isnan(bare.file().v0)));
  CHECK(bare.file().body.slope == 0);
}

TEST_CASE("law file: where the roll of a row begins", "[cli]") {
  const std::string row = "# a[m]\tb\tv0[m/s]\tx0[cm]\tt0[ms]\n1e-3\t0\t-0.5\t50\t1720\n";
  const Given all = law_of(row);
  CHECK((all.file().v0 == -0.5 && all.file().x0 == 0.5 && all.file().t0 == 1.72));
  CHECK(law_of("# a[m]\tb\tt0[m]\n1e-3\t0\t1\n").status == 2);
}

// Of a v^b: (sigma_D/D)^2 = (sigma_a/a)^2 + (sigma_b ln v)^2 + 2 corr (sigma_a/a) sigma_b ln v. Of
// d0 + d2 v^2, which is linear: C00 + 2 C02 v^2 + C22 v^4.
TEST_CASE("law file: the standard uncertainty of D at a speed, from a row", "[cli]") {
  const Given power =
      law_of("# a[mm]\tsigma_a[mm]\tb\tsigma_b\tcorr\n2\t0.04\t0.2\t0.01\t0.8\n", {}, true);
  const Given square = law_of(
      "# d0[mm]\tsigma_d0[mm]\td2[s^2/m]\tsigma_d2[s^2/m]\tcorr_d0_d2\n1\t0.02\t4e-4\t1e-4\t-0.7\n",
      {}, true);
  for (const double v : {0.02, 0.5, 1.0, -3.0}) {
    CAPTURE(v);
    const double log = std::log(std::abs(v)), D = 2e-3 * std::pow(std::abs(v), 0.2);
    CHECK(
        power.file().sigma(v) ==
        Approx(D * std::sqrt(4e-4 + 1e-4 * log * log + 2 * 0.8 * 0.02 * 0.01 * log)).epsilon(1e-6));
    const double square_v = v * v;
    CHECK(square.file().sigma(v) ==
          Approx(std::sqrt(4e-10 - 2 * 0.7 * 2e-9 * square_v + 1e-8 * square_v * square_v))
              .epsilon(1e-6));
  }
  const Given both = law_of(
      "d0[mm] sigma_d0[mm] a[mm] sigma_a[mm] b sigma_b corr_d0_a corr_d0_b corr_a_b\n"
      "1 0.02 0.5 0.03 1.5 0.1 -0.6 0.5 -0.8\n",
      {}, true);
  for (const double v : {0.02, 0.5, 3.0}) {
    const double part[]{2e-5, 3e-5 * std::pow(v, 1.5), 5e-5 * std::pow(v, 1.5) * std::log(v)};
    const double variance = part[0] * part[0] + part[1] * part[1] + part[2] * part[2] -
                            1.2 * part[0] * part[1] + part[0] * part[2] - 1.6 * part[1] * part[2];
    CHECK(both.file().sigma(v) == Approx(std::sqrt(variance)).epsilon(1e-6));
  }
  const std::string bare = "a b\n2e-3 0\n";
  CHECK(std::isnan(law_of(bare).file().sigma(1)));
  CHECK(law_of(bare, {}, true).status == 2);
}

TEST_CASE("law file: a table of v and D", "[cli]") {
  const Given given = law_of("# v[cm/s]\tD[mm]\n100\t2\n0\t1\n");
  REQUIRE(given.file().law.has_points());
  CHECK((given.file().law(1) == 2e-3 && given.file().law.highest() == 1));
}

// Every set of up to four of the coefficients: a law of the table, or refused.
TEST_CASE("law file: a row is a law as a whole or not at all", "[cli]") {
  const std::vector<std::string> names{"a", "b", "d0", "d1", "d2", "d3", "p", "w"};
  const std::set<std::string> known{"a b", "d0", "d0 d1", "d0 d1 d2", "d0 d2", "a b d0", "d0 p w"};
  std::size_t accepted = 0;
  for (std::size_t set = 1; set < 256; ++set) {
    std::string header;
    std::string row;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if ((set >> i & 1) == 0) continue;
      add_item(header, names[i], " ");
      add_item(row, "1", " ");
    }
    CAPTURE(header);
    const Given given = law_of(header + '\n' + row + '\n');
    CHECK((given.status == 0) == known.contains(header));
    accepted += given.status == 0;
  }
  CHECK(accepted == known.size());
  CHECK(law_of("a b chi2 dof p\n1 0 1 2 0.5\n").status == 0);
  const std::string row = "a sigma_a b sigma_b corr\n1 0.1 0 0.1 0\n";
  CHECK(law_of(row, {"-a", "1", "-b", "1"}, true).status == 2);
  CHECK(law_of(row, {}, true).status == 0);
}

TEST_CASE("law file: the line of fitpower has the body, unless the options have it", "[cli]") {
  const std::string rows = "# a[m]\tb\trun\n1e-3\t0\tone\n2e-3\t0\ttwo\n";
  const std::string line = "## fitpower 1.1.0 position K 0.5+-0.005,0.83 R 0.04 g 9.8 slope 0";
  const Given all = law_of(line + '\n' + rows, {}, false, {});
  REQUIRE((all.status == 0 && all.said.empty() && all.files.size() == 2));
  const Body& one = law_of(all.files, "one").body;
  const Body& two = law_of(all.files, "two").body;
  CHECK((one.K == 0.5 && one.sigma_K == 0.005 && one.R == 0.04 && one.g == 9.8));
  CHECK((two.K == 0.83 && two.sigma_K == 0 && two.R == 0.04 && two.g == 9.8));
  CHECK_FALSE(all.files[0].body.exact);
  CHECK_THROWS_AS(law_of(all.files, "three"), Error);

  const Given exact = law_of(line + " exact\n" + rows, {"-g", "9.8"}, false, {});
  CHECK(exact.files[1].body.exact);
  CHECK(exact.said.empty());
  const Given other = law_of(line + '\n' + rows, {"-K", "0.83", "--exact"}, false, {});
  CHECK(other.files[0].body.K == 0.83);
  CHECK(other.files[0].body.exact);
  CHECK(other.said.find("K 0.5+-0.005 (here 0.83)") != std::string::npos);
  CHECK(other.said.find("A = 1 (here --exact)") != std::string::npos);

  // A run that was not fitted has a row without numbers.
  const Given blank = law_of(
      "## fitpower 1 position K 1,2,3 R 1 g 1 slope 0\n# a[m]\tb\trun\n1e-3\t0\tone\n"
      "NaN\tNaN\ttwo\n2e-3\t0\tthree\n",
      {}, false, {});
  REQUIRE(blank.files.size() == 2);
  CHECK((blank.files[0].body.K == 1 && blank.files[1].body.K == 3));

  // One row of two bodies is of neither.
  const std::string row = "# a[m]\tb\n1e-3\t0\n";
  CHECK(law_of(line + '\n' + row, {}, false, {}).status == 2);
  CHECK(law_of(line + '\n' + row, {"-K", "1", "-R", "1"}, false, {}).status == 0);
  for (const char* damaged : {"## fitpower", "## fitpower 1 position K 0.5 R 0.04",
                              "## fitpower 1 position K x R 0.04 g 9.8 slope 0",
                              "## fitpower 1 position R 0.04 K 0.5 g 9.8 slope 0"}) {
    CAPTURE(damaged);
    const Given bad = law_of(std::string(damaged) + '\n' + row);
    CHECK((bad.status == 2 && bad.said.find("not what fitpower writes") != std::string::npos));
  }
}

// What line_of_fit() writes, bodies_of_rows() reads.
TEST_CASE("law file: a line of bodies is read back", "[cli]") {
  Body one{NAN, 0.04, 0.5, 9.81, 0.001};
  one.sigma_K = 0.01;
  const Body two{NAN, 0.04, 0.83, 9.81, -0.001};
  for (const bool fits_slope : {false, true}) {
    FitOptions options;
    options.law = &laws()[2];
    options.fit_slope = fits_slope;
    const std::string line = line_of_fit("velocity", options, {one, two});
    CHECK(line.find(" velocity d0+d1*v K 0.5+-0.01,0.83 R 0.04 g 9.81 slope ") < 40);
    const auto read = bodies_of_rows({line}, 2);
    REQUIRE(read.size() == 2);
    CHECK((read[0].sigma_K == 0.01 && read[1].K == 0.83));
    if (fits_slope) CHECK(std::isnan(read[0].slope));
    else CHECK((read[0].slope == 0.001 && read[1].slope == -0.001));
    one.wind = 2.5;
    options.law = &laws()[4];
    const auto in_wind = bodies_of_rows({line_of_fit("velocity", options, {one, two})}, 2);
    CHECK((in_wind.at(0).wind == 2.5 && in_wind.at(1).wind == 0));
    options.fit_wind = true;
    const std::string fitted = line_of_fit("velocity", options, {one, two});
    CHECK(std::isnan(bodies_of_rows({fitted}, 2).at(0).wind));
  }
  CHECK(bodies_of_rows({line_of_fit("shift", {}, {one, {}})}, 2).empty());
}

TEST_CASE("law file: what is neither is refused", "[cli]") {
  for (const char* text : {"a b\n", "a b\n1 0\n1 0\n", "a b\n-1 0\n", "a[s] b\n1 0\n",
                           "v0[kg] a b\n1 1 0\n", "v D\n1 -1\n", "t x\n1 1\n", ""}) {
    CAPTURE(text);
    const Given given = law_of(text);
    CHECK(given.status == 2);
    CHECK(given.said.size() > 10);
  }
  CHECK(law_of("v D\n1 1\n", {"-a", "1", "-b", "0"}).status == 2);
}
