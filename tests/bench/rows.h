// SPDX-License-Identifier: GPL-3.0-or-later
// Tables whose rows take long: they are computed by as many threads as there are processors, and
// printed in order, each as soon as it and those before it are there.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <functional>
#include <future>
#include <string>
#include <thread>
#include <vector>

namespace bench {

/// Each function returns the text of a row, with the ends of its lines.
inline void print_rows(std::vector<std::function<std::string()>> rows) {
  std::vector<std::packaged_task<std::string()>> tasks;
  std::vector<std::future<std::string>> texts;
  for (auto& row : rows) texts.push_back(tasks.emplace_back(std::move(row)).get_future());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < tasks.size();) tasks[i]();
  };
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
    threads.emplace_back(work);
  for (auto& text : texts) {
    std::fputs(text.get().c_str(), stdout);
    std::fflush(stdout);
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace bench
