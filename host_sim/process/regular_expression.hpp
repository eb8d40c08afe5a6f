/// Regular expressions, compiled in one place: each file that includes <regex> itself compiles its templates
/// anew, for 2 to 3 seconds.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace sonoglide::process {

/// What matched, then each group of it; a group that took no part is empty. Without elements if nothing
/// matched.
using Match = std::vector<std::string>;

/// A regular expression of ECMAScript.
class RegularExpression {
 public:
  /// @throws std::regex_error if the pattern is none.
  explicit RegularExpression(const std::string& pattern);

  /// The whole of a text.
  Match match(const std::string& text) const;
  /// The first place of a text.
  Match search(const std::string& text) const;
  /// All places of a text, from left to right. They do not overlap.
  std::vector<Match> search_all(const std::string& text) const;
  /// The text with `by` in place of each of them; in `by` $1 is the first group.
  std::string replace(const std::string& text, const std::string& by) const;

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace sonoglide::process
