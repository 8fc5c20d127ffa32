#include "text/layout.h"

#include <algorithm>
#include <map>

#include "base/error.h"

namespace rolling {
namespace {

/// Adds the column of `field` to the run `r`, or to all runs if `r` is their number.
void add(Layout& layout, const std::vector<Column>& line, std::size_t field, std::size_t r) {
  const auto put = [&](Layout::Run& run) {
    run.fields.push_back(field);
    run.columns.push_back(line[field]);
  };
  layout.shared[field] = r == layout.runs.size();
  if (!layout.shared[field]) put(layout.runs[r]);
  else std::for_each(layout.runs.begin(), layout.runs.end(), put);
}

/// Refuses a quantity that occurs fewer times than t: it is not clear to which t it belongs.
void refuse_unclear(const std::vector<Column>& line, std::map<std::string, std::size_t>& count,
                    bool labelled) {
  std::size_t times = 0;
  for (const Column& c : line) times += c.name == "t" && (!labelled || !c.run.empty());
  if (times < 2) return;
  for (const Column& c : line)
    if (c.name != "t" && !si_unit(c.name).empty() &&
        (labelled ? c.run.empty() : count[c.name] < times))
      fail("of {} columns t, which one {} goes with is not clear: say --use t=N, by number", times,
           c.name);
}

}  // namespace

Layout Layout::one(const std::vector<Column>& line) {
  Layout layout{{Run()}, line.size(), std::vector<bool>(line.size())};
  for (std::size_t i = 0; i < line.size(); ++i) {
    add(layout, line, i, 0);
    if (layout.runs.front().label.empty()) layout.runs.front().label = line[i].run;
  }
  return layout;
}

Layout Layout::of(const std::vector<Column>& line) {
  Layout layout{{}, line.size(), std::vector<bool>(line.size())};
  std::map<std::string, std::size_t> place, count;  // of a label; of a name
  for (const Column& column : line) {
    ++count[column.name];
    if (!column.run.empty() && place.emplace(column.run, place.size()).second)
      layout.runs.push_back({column.run, {}, {}});
  }
  if (place.size() > 1) {
    refuse_unclear(line, count, true);
    for (std::size_t i = 0; i < line.size(); ++i)
      add(layout, line, i, line[i].run.empty() ? layout.runs.size() : place[line[i].run]);
  } else if (count["t"] > 1) {
    refuse_unclear(line, count, false);
    layout.runs = std::vector<Layout::Run>(count["t"]);
    std::map<std::string, std::size_t> seen;
    for (std::size_t i = 0; i < line.size(); ++i)
      add(layout, line, i,
          count[line[i].name] == 1 ? layout.runs.size()
                                   : std::min(seen[line[i].name]++, layout.runs.size() - 1));
  } else {
    return one(line);
  }
  return layout;
}

}  // namespace rolling
