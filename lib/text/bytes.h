// Text that grows at its end: the rows of a block, the texts of rows that wait.
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
    end_ = std::copy(text.begin(), text.end(), room(text.size()));
  }
  void append(char c) { *room(1) = c, ++end_; }
  /// Where up to `count` more bytes may be written; then they end at end().
  char* room(std::size_t count) {
    if (static_cast<std::size_t>(limit_ - end_) < count) grow(count);
    return end_;
  }
  void end(char* end) { end_ = end; }

  /// Forgets all but the first `size` bytes.
  void cut(std::size_t size) { end_ = data_.get() + size; }
  /// Forgets the first `count` bytes.
  void drop(std::size_t count) { end_ = std::copy(data_.get() + count, end_, data_.get()); }

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
