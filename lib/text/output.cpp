#include "text/output.h"

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

namespace rolling {

void Output::names(const std::vector<Column>& columns) {
  const char* before = "# ";
  for (const Column& column : columns) text(before), text(to_text(column)), before = "\t";
  end_line();
}

void Output::cell(double value) {
  if (!std::isfinite(value)) fail("the result is not a finite number");
  separate();
  number(value);
}

void Output::row(std::span<const double> values) {
  for (const double value : values) cell(value);
  end_line();
}

void Output::flush() {
  if (before_write && buffer_.size() > 0) before_write();
  for (std::string_view left(buffer_.data(), buffer_.size()); !left.empty();) {
    const ssize_t count = ::write(STDOUT_FILENO, left.data(), left.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int reason = errno;
      buffer_.clear();
      whole_ = cells_ = 0;
      fail<OutputError>("standard output: {}", std::strerror(reason));
    }
    left.remove_prefix(static_cast<std::size_t>(count));
  }
  buffer_.clear();
  whole_ = 0;
}

}  // namespace rolling
