// A buffer of text that grows at its end. Unlike std::string it hands out uninitialised space, into
// which numbers are written directly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string_view>

namespace rolling {

class Bytes {
 public:
  const char* data() const { return data_.get(); }
  std::size_t size() const { return static_cast<std::size_t>(end_ - data_.get()); }
  bool empty() const { return end_ == data_.get(); }

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
  void truncate(std::size_t size) { end_ = data_.get() + size; }
  /// Removes the first `count` bytes.
  void erase_front(std::size_t count) { end_ = std::copy(data_.get() + count, end_, data_.get()); }

 private:
  [[gnu::noinline]] void grow(std::size_t count) {
    const std::size_t capacity = 2 * (size() + count);
    auto larger = std::make_unique_for_overwrite<char[]>(capacity);
    end_ = std::copy(data_.get(), end_, larger.get());
    limit_ = larger.get() + capacity;
    data_ = std::move(larger);
  }

  std::unique_ptr<char[]> data_;
  char *end_ = nullptr, *limit_ = nullptr;
};

}  // namespace rolling
