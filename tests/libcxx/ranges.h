// SPDX-License-Identifier: GPL-3.0-or-later
// The algorithms of std::ranges that this project uses, for libc++ 14, which has none of them:
// `make check-libcxx` puts this in front of every source. Projections are as in the standard,
// overloads that nobody calls are left out.
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <ranges>

namespace std::ranges {

template <class F, class P>
constexpr auto projected(F f, P p) {
  return [f, p](auto&&... x) { return std::invoke(f, std::invoke(p, x)...); };
}

#define ROLLING_OF_PREDICATE(name)                                                 \
  template <class R, class F, class P = std::identity>                             \
  constexpr auto name(R&& range, F f, P p = {}) {                                  \
    return std::name(std::begin(range), std::end(range), ranges::projected(f, p)); \
  }
ROLLING_OF_PREDICATE(all_of)
ROLLING_OF_PREDICATE(any_of)
ROLLING_OF_PREDICATE(none_of)
ROLLING_OF_PREDICATE(count_if)
ROLLING_OF_PREDICATE(find_if)

#define ROLLING_OF_VALUE(name)                                                   \
  template <class R, class T, class P = std::identity>                           \
  constexpr auto name(R&& range, const T& value, P p = {}) {                     \
    return std::name##_if(std::begin(range), std::end(range),                    \
                          [&](auto&& x) { return std::invoke(p, x) == value; }); \
  }
ROLLING_OF_VALUE(count)
ROLLING_OF_VALUE(find)

#define ROLLING_OF_ORDER(name)                                                           \
  template <class R, class C = std::less<>, class P = std::identity>                     \
  constexpr auto name(R&& range, C compare = {}, P p = {}) {                             \
    return std::name(std::begin(range), std::end(range), ranges::projected(compare, p)); \
  }
ROLLING_OF_ORDER(sort)
ROLLING_OF_ORDER(min_element)
ROLLING_OF_ORDER(max_element)

template <class R, class C = std::less<>, class P = std::identity>
constexpr auto min(R&& range, C compare = {}, P p = {}) {
  return *ranges::min_element(range, compare, p);
}
template <class R, class C = std::less<>, class P = std::identity>
constexpr auto max(R&& range, C compare = {}, P p = {}) {
  return *ranges::max_element(range, compare, p);
}
template <class R, class C = std::less<>, class P = std::identity>
constexpr auto minmax(R&& range, C compare = {}, P p = {}) {
  return std::pair(ranges::min(range, compare, p), ranges::max(range, compare, p));
}

template <class R, class F = std::equal_to<>, class P = std::identity>
constexpr auto adjacent_find(R&& range, F same = {}, P p = {}) {
  return std::adjacent_find(std::begin(range), std::end(range), ranges::projected(same, p));
}

#define ROLLING_OF_ARGUMENTS(name)                                 \
  template <class R, class... T>                                   \
  constexpr auto name(R&& range, T&&... rest) {                    \
    return std::name(std::begin(range), std::end(range), rest...); \
  }
ROLLING_OF_ARGUMENTS(copy)
ROLLING_OF_ARGUMENTS(move)
ROLLING_OF_ARGUMENTS(nth_element)
ROLLING_OF_ARGUMENTS(replace)
ROLLING_OF_ARGUMENTS(replace_if)
ROLLING_OF_ARGUMENTS(reverse)
ROLLING_OF_ARGUMENTS(shuffle)

template <class I, class T, class P>
constexpr auto find(I from, I to, const T& value, P p) {
  return std::find_if(from, to, [&](auto&& x) { return std::invoke(p, x) == value; });
}
template <class R, class T, class C = std::less<>, class P = std::identity>
constexpr auto lower_bound(R&& range, const T& value, C compare = {}, P p = {}) {
  return std::lower_bound(std::begin(range), std::end(range), value, [&](auto&& x, auto&& limit) {
    return std::invoke(compare, std::invoke(p, x), limit);
  });
}
template <class R, class T, class C = std::less<>, class P = std::identity>
constexpr auto upper_bound(R&& range, const T& value, C compare = {}, P p = {}) {
  return std::upper_bound(std::begin(range), std::end(range), value, [&](auto&& limit, auto&& x) {
    return std::invoke(compare, limit, std::invoke(p, x));
  });
}

struct Permuted {
  bool found;
};
template <class R>
Permuted next_permutation(R&& range) {
  return {std::next_permutation(std::begin(range), std::end(range))};
}

template <class R, class Out, class F>
constexpr auto transform(R&& range, Out to, F f) {
  return std::transform(std::begin(range), std::end(range), to, f);
}
template <class R, class S, class Out, class F>
constexpr auto transform(R&& one, S&& other, Out to, F f) {
  return std::transform(std::begin(one), std::end(one), std::begin(other), to, f);
}
template <class R, class S, class F = std::equal_to<>>
constexpr bool equal(R&& one, S&& other, F same = {}) {
  return std::equal(std::begin(one), std::end(one), std::begin(other), std::end(other), same);
}
template <class R, class S>
constexpr bool lexicographical_compare(R&& one, S&& other) {
  return std::lexicographical_compare(std::begin(one), std::end(one), std::begin(other),
                                      std::end(other));
}
using not_equal_to = std::not_equal_to<>;

}  // namespace std::ranges
