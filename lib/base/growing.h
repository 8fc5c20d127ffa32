// SPDX-License-Identifier: GPL-3.0-or-later
// An array that grows at its end. Unlike std::vector it moves a large array to a larger place
// without a copy, and hands out uninitialised space.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string_view>
#include <type_traits>

namespace rolling {

template <typename T>
class Growing {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  Growing() = default;
  ~Growing() { std::free(data_); }
  Growing(const Growing&) = delete;
  Growing& operator=(const Growing&) = delete;

  T* data() { return data_; }
  const T* data() const { return data_; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  std::size_t size() const { return static_cast<std::size_t>(end_ - data_); }
  bool empty() const { return end_ == data_; }

  void append(const T* from, const T* to) {
    end_ = std::copy(from, to, reserve(static_cast<std::size_t>(to - from)));
  }
  void append(T one) { *reserve(1) = one, ++end_; }
  /// Makes space for `count` more elements and returns where it begins. The caller writes there and
  /// then passes the end of what it has written to set_end().
  T* reserve(std::size_t count) {
    if (static_cast<std::size_t>(limit_ - end_) < count) grow(count);
    return end_;
  }
  void set_end(T* end) { end_ = end; }

  /// Keeps the first `size` elements only.
  void truncate(std::size_t size) { end_ = data_ + size; }
  /// Removes the first `count` elements.
  void erase_front(std::size_t count) { end_ = std::copy(data_ + count, end_, data_); }

 private:
  [[gnu::noinline]] void grow(std::size_t count) {
    const std::size_t held = size(), capacity = 2 * (held + count);
    T* const larger = static_cast<T*>(std::realloc(data_, capacity * sizeof(T)));
    if (!larger) throw std::bad_alloc();
    data_ = larger;
    end_ = larger + held;
    limit_ = larger + capacity;
  }

  T *data_ = nullptr, *end_ = nullptr, *limit_ = nullptr;
};

/// Text that grows at its end.
class Bytes : public Growing<char> {
 public:
  using Growing::append;
  void append(std::string_view text) { append(text.data(), text.data() + text.size()); }
};

}  // namespace rolling
