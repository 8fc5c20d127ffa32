// SPDX-License-Identifier: GPL-3.0-or-later
// For tests of the reader: what it gives of files of these texts.
#pragma once

#include <fmt/format.h>

#include <memory>

#include "text/reader.h"
#include "unit/text/files.h"

namespace rolling {

using Texts = std::vector<std::string>;

/// All that a reader gives of t and v (or `wanted`) in files of these texts: rows as "t v", " |
/// " between them, " || " between runs; or the message that refuses them.
inline std::string rows(const Texts& texts, ReaderOptions options = {},
                        const std::vector<std::string>& wanted = {"t", "v"}) {
  std::vector<std::unique_ptr<TemporaryFile>> files;
  for (const std::string& text : texts) {
    files.push_back(std::make_unique<TemporaryFile>(text));
    options.files.push_back(files.back()->name());
  }
  std::string all;
  const std::string message = refusal([&] {
    Reader in(options, {"t", "v"});
    std::vector<std::size_t> slots;
    for (const std::string& name : wanted) slots.push_back(in.need(name));
    for (bool first_run = true; in.next_run(); first_run = false) {
      if (!first_run) all += " || ";
      for (bool first = true; in.next(); first = false) {
        if (!first) all += " | ";
        for (std::size_t i = 0; i < slots.size(); ++i)
          all += fmt::format("{}{}", i ? " " : "", in[slots[i]]);
      }
    }
  });
  return message.empty() ? all : anonymous(message);
}

/// What a reader says that it took in SI units although no name said so; or the refusal.
inline std::string told(const std::string& text, ReaderOptions options = {}) {
  const TemporaryFile file(text);
  options.files = {file.name()};
  std::string said;
  const std::string message = refusal([&] {
    Reader in(options, {"t", "v"});
    in.need("t");
    in.need("v");
    while (in.next_run())
      while (in.next()) continue;
    said = in.warnings().empty() ? "" : in.warnings().front();
  });
  return message.empty() ? said : anonymous(message);
}

/// The rows as they would pass through, lines in < >.
inline std::string copies(const std::string& text, ReaderOptions options = {},
                          const std::vector<std::string>& wanted = {"t", "v"}) {
  const TemporaryFile file(text);
  options.files = {file.name()};
  Bytes all;
  Reader in(options, {"t", "v"});
  for (const std::string& name : wanted) in.need(name);
  while (in.next_run())
    while (in.next()) {
      all.push_back('<');
      in.append_text(all);
      all.push_back('>');
    }
  return {all.data(), all.size()};
}

/// The columns of the first run.
inline std::string names(const std::string& text) {
  const TemporaryFile file(text);
  Reader in({.files = {file.name()}}, {"t", "v"});
  std::string all;
  for (const Column& column : in.columns()) all += (all.empty() ? "" : " ") + to_text(column);
  return all;
}

inline ReaderOptions use(const Texts& what) { return {.use = what}; }
inline ReaderOptions run(int number) { return {.run = std::to_string(number)}; }
inline const ReaderOptions strict{.strict = true};

}  // namespace rolling
