// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/edit_distance.h"

#include <random>
#include <string>

#include "unit/catch.h"

using namespace rolling;

TEST_CASE("edit distance: that of words whose letters are known", "[base]") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("rolling", "") == 7);
  CHECK(edit_distance("ab", "ba") == 2);
}

TEST_CASE("edit distance: a metric, and at most the number of changes that were made", "[base]") {
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return random() % n; };
  for (int i = 0; i < 300; ++i) {
    std::string word;
    for (std::size_t n = below(8); word.size() < n;) word += static_cast<char>('a' + below(3));
    std::string changed = word;
    std::string other = word + "abc";
    std::shuffle(other.begin(), other.end(), random);
    const std::size_t changes = below(4);
    for (std::size_t k = 0; k < changes; ++k) {
      const auto at = static_cast<std::ptrdiff_t>(below(changed.size() + 1));
      if (below(2) == 0 || changed.empty()) changed.insert(changed.begin() + at, 'b');
      else changed.erase(changed.begin() + at / 2);
    }
    CHECK(edit_distance(word, changed) <= changes);
    CHECK((edit_distance(word, changed) == 0) == (word == changed));
    CHECK(edit_distance(word, other) == edit_distance(other, word));
    CHECK(edit_distance(word, other) <=
          edit_distance(word, changed) + edit_distance(changed, other));
  }
}
