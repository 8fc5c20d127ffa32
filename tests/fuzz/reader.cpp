// SPDX-License-Identifier: GPL-3.0-or-later
// The reader on any bytes: every row has as many fields as there are columns, finite numbers,
// rising times.
#include "text/reader.h"

#include <cmath>
#include <cstdint>

#include "streams.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rolling;
  if (size == 0) return 0;
  const unsigned choice = data[0];
  const MemoryFile file({reinterpret_cast<const char*>(data) + 1, size - 1});
  ReaderOptions options;
  options.files.assign(1 + choice % 2, file.path());
  options.strict = choice & 2;
  if (choice & 4) options.run = std::to_string(choice >> 6);
  if (choice & 8) options.use = {"v=2"};
  try {
    Reader in(options, {"t", "v"});
    const auto t = in.need("t"), v = choice & 16 ? in.want("v") : in.need(choice & 32 ? "2" : "v");
    double last = 0;
    while (in.next_run()) {
      bool first = true;
      while (in.next()) {
        require(std::isfinite(in[t]) && (first || in[t] > last), "times do not rise");
        require(std::isfinite(in[v]) || (choice & 16), "a number is not finite");
        first = false, last = in[t];
        Bytes row;
        require(in.append_text(row, in.column_of(v)) <= row.size(),
                "a column stands outside its row", {row.data(), row.size()});
      }
    }
  } catch (const Error& error) {
    require(error.what()[0] != '\0', "an error without words");
  }
  return 0;
}
