#include "host_sim/scene_file/key_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sonoglide::scene_file {
namespace {

/// Its bounds alone.
std::string bounds(const Range& range) {
  return Range{range.low, range.high, "", range.low_open}.text();
}

struct AllowedText {
  std::string operator()(const Number& number) const { return bounds(number.range); }
  std::string operator()(const Integer& integer) const {
    return fmt::format("integer, {} to {}", integer.low, integer.high);
  }
  std::string operator()(const Word& word) const {
    return fmt::format("\"{}\"", fmt::join(word.allowed, "\", \""));
  }
  std::string operator()(const WordList& list) const {
    return fmt::format("list of \"{}\"", fmt::join(list.allowed, "\", \""));
  }
  std::string operator()(const Profile& profile) const {
    return fmt::format("`[[time in s, value], ...]`; time {}, value {}", bounds(profile.time),
                       bounds(profile.value));
  }
};

struct AbsentText {
  std::string operator()(const Required& /*required*/) const { return "required"; }
  std::string operator()(const Instead& instead) const {
    return fmt::format("required, or {}", instead.other);
  }
  std::string operator()(double number) const { return fmt::format("{}", number); }
  std::string operator()(std::string_view word) const { return fmt::format("\"{}\"", word); }
  std::string operator()(const Rule& rule) const { return rule.words; }
};

}  // namespace

std::string allowed_text(const Key& key) {
  return std::visit(AllowedText{}, key.allowed);
}

std::string absent_text(const Key& key) {
  return std::visit(AbsentText{}, key.absent);
}

std::string sentence(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  return text + ".";
}

}  // namespace sonoglide::scene_file
