// A buffer of text that grows at its end. Unlike std::string it hands out uninitialised space, into
// which numbers are written directly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string_view>

namespace rolling {

class Bytes {
 public:
  Bytes() = default;
  ~Bytes() { std::free(data_); }
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;

  char* data() { return data_; }
  const char* data() const { return data_; }
  std::size_t size() const { return static_cast<std::size_t>(end_ - data_); }
  bool empty() const { return end_ == data_; }

  void append(std::string_view text) {
    end_ = std::copy(text.begin(), text.end(), reserve(text.size()));
  }
  void append(char c) { *reserve(1) = c, ++end_; }
  /// Makes space for `count` more bytes and returns where it begins. The caller writes there and
  /// then passes the end of what it has written to set_end().
  char* reserve(std::size_t count) {
    if (static_cast<std::size_t>(limit_ - end_) < count) grow(count);
    return end_;
  }
  void set_end(char* end) { end_ = end; }

  /// Keeps the first `size` bytes only.
  void truncate(std::size_t size) { end_ = data_ + size; }
  /// Removes the first `count` bytes.
  void erase_front(std::size_t count) { end_ = std::copy(data_ + count, end_, data_); }

 private:
  [[gnu::noinline]] void grow(std::size_t count) {
    const std::size_t held = size(), capacity = 2 * (held + count);
    // realloc moves a large buffer without a copy.
    char* const larger = static_cast<char*>(std::realloc(data_, capacity));
    if (!larger) throw std::bad_alloc();
    data_ = larger;
    end_ = larger + held;
    limit_ = larger + capacity;
  }

  char *data_ = nullptr, *end_ = nullptr, *limit_ = nullptr;
};

}  // namespace rolling
