// Lines of one input file, in blocks.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rolling {

/// A record of motion data has tens of bytes; a line of more than a megabyte is of another kind of
/// file.
inline constexpr std::size_t longest_line = 1 << 20;

/// Throws InputError where standard output goes into this regular file: what is written there would
/// be read, or would stand behind what has been read.
void refuse_output(const std::string& name);

/// Told after each block of a file whose size is known: its name, and which part of it has been
/// read.
using BlockHook = std::function<void(const std::string& name, double part)>;

class Input {
 public:
  /// Opens a file; `-` is standard input. Throws Error when it cannot be read.
  explicit Input(std::string name, BlockHook = {});
  ~Input();
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  /// The next line without its end (LF or CR LF), valid until the next call; false at the end of
  /// the file.
  bool next(std::string_view& line);
  /// What has been read and not taken: lines, and perhaps a part of one.
  std::string_view ahead() const { return {at_, end_}; }
  /// Takes the line that begins ahead() and is `size` bytes long with its end, as next() does.
  void skip(std::size_t size) {
    at_ += size;
    ++line_number_;
  }

  /// About as many lines as are left, and an eighth more: by those that come next, and the size of
  /// a file (else of what has been read).
  std::size_t lines_ahead() const;

  /// A regular file of which a blank line, and more below it, is in what has been read and not
  /// taken.
  bool another_run() const;

  const std::string& name() const { return name_; }  ///< as the user gave it
  std::size_t line_number() const { return line_number_; }
  bool quotes() const { return quotes_; }  ///< a " is in what has been read so far

 private:
  bool fill();
  const char* end_of_line();

  std::string name_;
  BlockHook on_block_;
  int fd_;
  double size_ = 0, read_ = 0;  // bytes; no size: not known
  std::vector<char> buffer_;
  const char *at_, *end_;  // what has been read of it and not taken
  std::size_t line_number_ = 0;
  bool at_end_ = false, quotes_ = false;
};

}  // namespace rolling
