// Prints the table of tests/bench/coverage.h: coverage [RUNS [WORD]], only the cases whose name has
// WORD. `make coverage`.
#include "bench/coverage.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "cli/progress.h"

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  const char* const route_names[] = {"loglog", "shift", "velocity", "position"};
  struct Job {
    coverage::Case what;
    coverage::Scene scene;
    coverage::Row row;
    std::atomic<bool> done = false;
  };
  std::vector<std::unique_ptr<Job>> jobs;
  for (const auto& what : coverage::cases()) {
    if (argc > 2 && !std::strstr(what.name, argv[2])) continue;
    for (const auto& scene : {coverage::CR, coverage::CF})
      jobs.emplace_back(new Job{what, scene, {}});
    if (what.record)
      for (const auto& scene : {coverage::SR, coverage::SF})
        jobs.emplace_back(new Job{what, scene, {}});
    if (what.name == std::string("white x") || what.name == std::string("D from x, mean 11"))
      for (const auto& scene : coverage::exponents) jobs.emplace_back(new Job{what, scene, {}});
  }
  std::printf(
      "# %d runs each; biases in sd; sigma/sd: standard errors over the spread; 95 %% intervals; "
      "told: "
      "errors of the autocorrelation or of uneven noise; differ: joint runs that are said to "
      "disagree; far: beyond 6 standard errors\n",
      runs);
  std::printf("%-31s %-8s %-5s %7s %7s %7s %8s %9s %7s %7s %7s %7s %5s %6s %4s %8s %6s\n", "# case",
              "route", "scene", "bias_a", "%_of_a", "bias_b", "sd_b", "sd/bound", "sigma_a",
              "sigma_b", "cover_a", "cover_b", "told", "differ", "far", "refused", "ms");
  std::atomic<std::size_t> next = 0;
  std::size_t finished = 0;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < jobs.size();) {
      Job& job = *jobs[i];
      job.row = coverage::measure(job.what, job.scene, runs, 20261121);
      job.done = true;
      job.done.notify_one();
    }
  };
  rolling::Progress progress;
  if (!::isatty(STDOUT_FILENO)) progress.start("coverage");  // else its rows show it
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
    threads.emplace_back(work);
  for (const auto& job : jobs) {
    progress.at("cases", static_cast<double>(finished++) / static_cast<double>(jobs.size()));
    job->done.wait(false);
    const auto& r = job->row;
    char bound[16] = "-";
    if (job->what.bound) std::snprintf(bound, sizeof bound, "%.3f", r.over_bound);
    std::printf(
        "%-31s %-8s %-5s %+7.2f %+7.2f %+7.2f %8.5f %9s %7.3f %7.3f %7.3f %7.3f %5.2f %6.3f %4d "
        "%8d "
        "%6.2f\n",
        job->what.name, route_names[static_cast<int>(job->what.route)], job->scene.name, r.bias_a,
        r.percent_a, r.bias_b, r.sd_b, bound, r.sigma_a, r.sigma_b, r.cover_a, r.cover_b, r.told,
        r.differ, r.far, r.refused, 1e3 * r.seconds);
    std::fflush(stdout);
  }
  for (auto& thread : threads) thread.join();
}
