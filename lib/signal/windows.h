// The window about each sample of a run in turn, as soon as the samples are there; in the memory of
// one window.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rolling {

struct Sample {
  double t, y;
};

/// An odd number of samples; or, if seconds > 0, a duration of which half lies on either side [s].
///
/// A sample lies within a duration if it is late for it by no more than a sixteenth of the step
/// between it and its neighbour inside. Times are rounded, so whether a sample lies exactly on the
/// edge cannot be asked; a share of the step is the same at every offset of the times (at 25 Hz and
/// times since 1970, a step is 170 000 times their rounding).
struct Width {
  std::size_t samples = 11;
  double seconds = 0;
  std::size_t least = 1;  ///< samples, odd, that a window of seconds has all the same if it is cut
};

/// A window about a sample of a run with these times reaches at most this many samples to either
/// side; one at an end of the run that stays wide, at most twice as many.
std::size_t samples_within(Width, std::span<const double> t);

class Windows {
 public:
  /// What a window does at the end of a run: `shrink` on both sides alike; be `cut` off there; or
  /// `stay` as wide as it is, the first or the last whole one, so that the sample is not in its
  /// middle.
  enum class Ends { shrink, cut, stay };
  /// Throws Error for an even width.
  Windows(Width, Ends);

  void push(double t, double y) {
    if (count_ - first_ == ring_.size()) make_room();
    if (count_ == 0) start_ = t;
    ring_[count_++ & mask_] = {t, y};
  }
  void finish() { finished_ = true; }
  /// Goes to the next sample whose window is complete; false when there is none yet.
  bool next() {
    if (next_ < half_ || finished_) return next_ < count_ && near_end();
    if (next_ + half_ >= count_) return false;
    begin_ = next_ - half_;
    end_ = ++next_ + half_;
    return true;
  }

  /// The samples of the window are those from begin() to before end(), counted from the start of
  /// the run; at() is among them.
  std::size_t begin() const { return begin_; }
  std::size_t end() const { return end_; }
  std::size_t size() const { return end_ - begin_; }
  std::size_t at() const { return next_ - 1; }
  const Sample& sample(std::size_t i) const { return ring_[i & mask_]; }

  /// Moves [from, to), a former window, to the present one, one sample at a time.
  template <typename Add, typename Remove>
  void slide(std::size_t& from, std::size_t& to, Add add, Remove remove) const {
    while (from > begin_) add(sample(--from));
    while (to < end_) add(sample(to++));
    while (from < begin_) remove(sample(from++));
    while (to > end_) remove(sample(--to));
  }

 private:
  void make_room();
  bool near_end();
  bool by_count(std::size_t i);
  bool by_time(std::size_t i);

  Width width_;
  Ends ends_;
  bool finished_ = false;
  std::size_t half_;  // of the width in samples; in seconds it is none, and every sample counts as
                      // near an end
  std::vector<Sample>
      ring_;  // sample i at i modulo its size, a power of two; those from first_ on are there
  std::size_t mask_;  // its size - 1
  std::size_t first_ = 0, count_ = 0, next_ = 0;
  std::size_t begin_ = 0, end_ = 0;   // the present window
  std::size_t left_ = 0, right_ = 0;  // the samples within reach in time
  double start_ = 0;                  // time of the first sample
};

}  // namespace rolling
