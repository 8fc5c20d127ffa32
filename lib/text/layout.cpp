#include "text/layout.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

/// The runs of a line: by label, else by the how-manieth of its name a column is.
std::vector<Layout::Run> runs_of(const std::vector<Column>& line) {
  std::vector<std::string> labels;
  for (const Column& column : line)
    if (!column.run.empty() && std::find(labels.begin(), labels.end(), column.run) == labels.end())
      labels.push_back(column.run);
  std::map<std::string, std::size_t> count;
  for (const Column& column : line) ++count[column.name];

  std::vector<Layout::Run> runs;
  if (labels.size() > 1) {
    for (const std::string& label : labels) {
      Layout::Run& run = runs.emplace_back(Layout::Run{label, {}});
      for (std::size_t i = 0; i < line.size(); ++i)
        if (line[i].run.empty() || line[i].run == label) run.fields.push_back(i);
    }
  } else if (count["t"] > 1) {
    std::map<std::string, std::size_t> seen;
    runs.resize(count["t"]);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::size_t nth = seen[line[i].name]++;
      for (std::size_t r = 0; r < runs.size(); ++r)
        if (count[line[i].name] == 1 || r == nth) runs[r].fields.push_back(i);
    }
  }
  return runs;
}

}  // namespace

Layout Layout::one(const std::vector<Column>& line) {
  Layout layout;
  layout.width = line.size();
  layout.shared.assign(line.size(), true);
  layout.runs.push_back({line.empty() ? "" : line.front().run, {}});
  for (std::size_t i = 0; i < line.size(); ++i) {
    layout.runs.front().fields.push_back(i);
    layout.columns.push_back({line[i].name, line[i].unit, ""});
  }
  return layout;
}

Layout Layout::of(const std::vector<Column>& line, const std::string& run) {
  auto runs = runs_of(line);
  if (runs.empty()) return one(line);
  Layout layout;
  layout.side_by_side = true;
  layout.width = line.size();
  for (std::size_t i = 0; i < line.size(); ++i)
    layout.shared.push_back(std::all_of(runs.begin(), runs.end(), [i](const Run& r) {
      return std::count(r.fields.begin(), r.fields.end(), i) > 0;
    }));

  if (!run.empty()) {
    auto picked =
        std::find_if(runs.begin(), runs.end(), [&](const Run& r) { return r.label == run; });
    const bool numbered =
        std::any_of(runs.begin(), runs.end(), [](const Run& r) { return is_number(r.label); });
    if (double place; picked == runs.end() && !numbered && parse_number(run, place) &&
                      place <= static_cast<double>(runs.size()))
      picked = runs.begin() + static_cast<std::ptrdiff_t>(place) - 1;
    if (picked == runs.end()) {
      std::string labels;
      for (const Run& r : runs) (labels += labels.empty() ? "" : ", ") += shown(r.label);
      fail("there is no run {} among the {} side by side{}{}", run, runs.size(),
           numbered ? ": " : "", numbered ? labels : "");
    }
    runs = {Run(*picked)};
  }
  layout.runs = std::move(runs);
  for (const std::size_t i : layout.runs.front().fields)
    layout.columns.push_back({line[i].name, line[i].unit, ""});
  for (Run& other : layout.runs) {  // every run in the order of the first
    std::vector<std::size_t> fields;
    for (const Column& column : layout.columns)
      for (const std::size_t i : other.fields)
        if (line[i].name == column.name && line[i].unit == column.unit &&
            std::find(fields.begin(), fields.end(), i) == fields.end()) {
          fields.push_back(i);
          break;
        }
    if (fields.size() != layout.columns.size() || fields.size() != other.fields.size())
      fail("the runs side by side have different columns: pick one with --run");
    other.fields = std::move(fields);
  }
  return layout;
}

}  // namespace rolling
