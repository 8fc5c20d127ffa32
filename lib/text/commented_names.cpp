#include "text/commented_names.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "base/error.h"
#include "text/delimiters.h"
#include "text/number.h"

namespace rolling {
namespace {

/// Removes blank names at the ends while there are more than `width`: a separator stands there.
void drop_blank_ends(std::vector<std::string>& names, std::size_t width) {
  while (names.size() > width && names.back().empty()) names.pop_back();
  const auto extra =
      names.begin() + static_cast<std::ptrdiff_t>(names.size() - std::min(names.size(), width));
  names.erase(names.begin(), std::find_if(names.begin(), extra,
                                          [](const std::string& name) { return !name.empty(); }));
}

/// The word is `a` before another word, as in a sentence; behind a symbol it is an acceleration.
bool is_article(const std::string& word, const std::string& next) {
  return word == "a" && next.size() > 1 &&
         std::ranges::all_of(next, [](unsigned char c) { return std::isalpha(c) != 0; });
}

/// A number, a date or a time, which is no name of a column.
bool is_figure(std::string_view text) { return is_number(text) || is_date(text); }

/// The text without separators at its end.
std::string_view without_end(std::string_view text) {
  return text.substr(0, text.find_last_not_of(filling) + 1);
}

/// A text of names between these separators, 0 for blanks; without names if it has another number.
CommentedNames names_between(char separator, std::string_view text, std::size_t width,
                             const std::vector<Column>& before) {
  CommentedNames found{split_names(text, separator)};
  auto& names = found.names;
  const bool as_it_is = names.size() == width;
  found.tabs = separator == '\t' && width > 1;
  found.words = separator == '\0';
  drop_blank_ends(names, width);
  found.article = found.words && std::ranges::adjacent_find(names, is_article) != names.end();
  for (const std::string& name : names) {
    if (found.article && name == "a") continue;
    const Column column = read_column(name);
    found.known += is_known(column) || std::ranges::count(before, column.name, &Column::name);
    found.units += is_known(column) && !column.unit.empty();
  }
  if (names.size() != width || !(as_it_is || found.tabs || found.known > 0)) return {};
  return found;
}

/// The names between the first separators that give the right number, without blank ones if
/// possible. What separates otherwise belongs to a name at the end only if that is not known
/// without it.
CommentedNames names_of(std::string_view text, std::size_t width,
                        const std::vector<Column>& before) {
  CommentedNames with_blanks;
  for (const char separator : std::string(separators) + '\0') {
    CommentedNames found = names_between(separator, text, width, before);
    CommentedNames without = names_between(separator, without_end(text), width, before);
    if (without.known > found.known) found = std::move(without);
    if (found.names.empty()) continue;
    const bool known = found.known > 0, whole = std::ranges::count(found.names, "") == 0;
    if ((found.tabs && known) || (whole && (known || !with_blanks.tabs))) return found;
    if (with_blanks.names.empty()) with_blanks = std::move(found);
  }
  return with_blanks;
}

/// The words of a line, whatever separates them: `t [ms]`, `time` and `x [cm]` of `t [ms]: time, x
/// [cm]`.
std::vector<Column> words_of(std::string_view line) {
  std::string text(line);
  for (const char separator : separators) std::ranges::replace(text, separator, ' ');
  std::vector<Column> words;
  for (std::string& word : split_names(text, '\0')) {
    word.erase(word.find_last_not_of(",;:=") + 1);
    words.push_back(read_column(word));
  }
  return words;
}

/// False for a line in which no run of letters is the name of a known quantity: at little cost, for
/// there may be millions.
bool may_hold_known_name(std::string_view line) {
  const auto is_letter = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (auto at = line.begin(); at != line.end();) {
    const auto end = std::find_if_not(at, line.end(), is_letter);
    if (end - at == 1 ? !si_unit({at, end}).empty()
                      : end - at >= 4 && !si_unit(short_name({at, end})).empty())
      return true;
    at = end == line.end() ? end : end + 1;
  }
  return false;
}

/// The number of known quantities with units in a comment.
std::size_t names_with_units(std::string_view comment) {
  return static_cast<std::size_t>(std::ranges::count_if(
      words_of(without_marks(comment)),
      [](const Column& word) { return is_known(word) && !word.unit.empty(); }));
}

/// The number of known quantities in a comment of nothing else, or 0. One word without a unit may
/// be a label.
std::size_t known_alone(std::string_view comment) {
  const std::vector<Column> words = words_of(without_marks(comment));
  const bool named = words.size() > 1 || names_with_units(comment) > 0;
  return named && std::ranges::all_of(words, is_known) ? words.size() : 0;
}

/// True if each known quantity is in the same place in both, in the same unit.
bool agree(const std::vector<std::string>& one, const std::vector<std::string>& other) {
  const auto same = [](const std::string& x, const std::string& y) {
    const auto unit = [](const Column& of) {
      return of.unit.empty() ? std::string(si_unit(of.name)) : of.unit;
    };
    const Column a = read_column(x), b = read_column(y);
    return !(is_known(a) || is_known(b)) || (a.name == b.name && unit(a) == unit(b));
  };
  return std::ranges::equal(one, other, same);
}

/// True if a known quantity is not in the same place in these names and in the columns before.
bool moves_known(const std::vector<std::string>& names, const std::vector<Column>& before) {
  for (std::size_t i = 0; i < std::min(names.size(), before.size()); ++i) {
    const Column now = read_column(names[i]);
    if (now.name != before[i].name && (is_known(now) || is_known(before[i]))) return true;
  }
  return false;
}

/// The comments of a head, each as the names of its columns.
class Choice {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  Choice(const std::vector<Comment>& comments, const UnnamedColumns& columns, std::string_view file)
      : comments_(comments), columns_(columns), file_(file) {
    for (const Comment& comment : comments) all_.push_back(names_in_comment(comment.text, columns));
  }

  const std::vector<std::string>& names(std::size_t i) const { return all_[i].names; }

  /// The place of the last comment with known names or with tabs, or with words if `first`.
  std::size_t likeliest(bool first) const {
    const auto last = [&](auto&& serves) {
      std::size_t i = all_.size();
      while (i-- > 0)
        if (!all_[i].names.empty() && !comments_[i].is_history() && serves(all_[i])) break;
      return i;
    };
    const std::size_t named = last([](auto& of) { return of.known > 0 || of.tabs; });
    if (named != none || !first) return named;
    return last([](auto& of) { return std::ranges::none_of(of.names, is_figure); });
  }

  /// Refuses a comment that may be names as well as the chosen one.
  void refuse_others(std::size_t chosen) const {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (chosen != none && agree(all_[i].names, all_[chosen].names)) continue;
      if (comments_[i].is_history() && names_in_history(i) > 1)
        refuse(i,
               "names of columns in a line that begins with ##, as history does; leave one # "
               "there");
      if (comments_[i].is_history()) continue;
      if (chosen == none && names_with_units(comments_[i].text) > 1) refuse_units(i);
      if (names_others(i, chosen))
        refuse(i, "'{}' names known quantities, but not one for each of {}",
               shown(comments_[i].text), columns_in_words());
      if (chosen != none && all_[i].known > 1 && weight(i) + !is_complete(chosen) > weight(chosen))
        refuse(i,
               "'{}' can be the names of the columns, and so can line {}: give one of them another "
               "number of words",
               shown(comments_[i].text), comments_[chosen].line);
    }
  }

  /// Refuses the chosen comment if it may be no names.
  void refuse_sentence(std::size_t chosen) const {
    const CommentedNames& of = all_[chosen];
    if ((of.words || columns_.count == 1) &&
        names_with_units(comments_[chosen].text) > std::max<std::size_t>(of.units, 1))
      refuse_units(chosen);
    if (of.article && of.known == 0)
      refuse(chosen,
             "'{}' can be the names of the columns or a sentence: write a[m/s^2] if it is names, "
             "else give it another number of words",
             shown(comments_[chosen].text));
    if (of.words && of.units == 0 && !is_complete(chosen) && moves_known(of.names, columns_.before))
      refuse(chosen,
             "'{}' can be new names of the columns or a sentence: put tabs between names, or give "
             "the sentence another number of words",
             shown(comments_[chosen].text));
  }

 private:
  /// What speaks for names: those that are known, and their units.
  std::size_t weight(std::size_t i) const { return all_[i].known + all_[i].units; }
  bool is_complete(std::size_t i) const {
    return all_[i].known + columns_.blank_end >= columns_.count;
  }
  /// True for nothing but known quantities, as many as the chosen comment has or more, but not one
  /// for each column, where the chosen one has not one for each either.
  bool names_others(std::size_t i, std::size_t chosen) const {
    const std::size_t known = known_alone(comments_[i].text);
    return known > 0 && all_[i].names.empty() &&
           (chosen == none || (!is_complete(chosen) && known >= all_[chosen].known));
  }
  /// The number of known names in a history line, of all columns or of all but one, or of nothing
  /// but known ones. One may be the column of a filter, `smooth v mean width 11`.
  std::size_t names_in_history(std::size_t i) const {
    const std::string& text = comments_[i].text;
    return std::max({all_[i].known, names_in_comment(text, {columns_.count - 1}).known,
                     names_with_units(text), known_alone(text)});
  }
  template <typename... Args>
  [[noreturn]] void refuse(std::size_t i, fmt::format_string<Args...> what, Args&&... args) const {
    fail<InputError>("{}:{}: {}", file_, comments_[i].line,
                     fmt::format(what, std::forward<Args>(args)...));
  }
  [[noreturn]] void refuse_units(std::size_t i) const {
    refuse(i, "a comment with units, but not the names of {}", columns_in_words());
  }
  std::string columns_in_words() const {
    return fmt::format("{} column{}", columns_.count, columns_.count == 1 ? "" : "s");
  }

  const std::vector<Comment>& comments_;
  const UnnamedColumns& columns_;
  std::string_view file_;
  std::vector<CommentedNames> all_;
};

}  // namespace

std::string_view without_marks(std::string_view comment) {
  return comment.substr(std::min(comment.find_first_not_of('#'), comment.size()));
}

bool is_date(std::string_view text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) &&
         text.find_first_not_of("0123456789+-.:/ TZ") == std::string_view::npos;
}

bool holds_known_name(std::string_view line) {
  return may_hold_known_name(line) && std::ranges::any_of(words_of(line), is_known);
}

CommentedNames names_in_comment(std::string_view comment, const UnnamedColumns& columns) {
  const std::string_view text = without_marks(comment);
  CommentedNames found = names_of(text, columns.count, columns.before);
  if (found.names.empty() && columns.blank_end) {
    found = names_of(text, columns.count - 1, columns.before);
    if (found.known == 0) return {};
    found.names.emplace_back();
  }
  return found;
}

std::optional<ChosenNames> choose_names(const std::vector<Comment>& comments,
                                        const UnnamedColumns& columns, bool first,
                                        std::string_view file) {
  Choice choice(comments, columns, file);
  const std::size_t chosen = choice.likeliest(first);
  choice.refuse_others(chosen);
  if (chosen == Choice::none) return {};
  choice.refuse_sentence(chosen);
  return ChosenNames{chosen, choice.names(chosen)};
}

}  // namespace rolling
