// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "base/error.h"

/// The kind of the Error that `work` throws; nothing if it throws none.
template <typename Work>
std::optional<rolling::ErrorKind> kind_of_error(const Work& work) {
  try {
    work();
  } catch (const rolling::Error& error) {
    return error.kind;
  }
  return {};
}
