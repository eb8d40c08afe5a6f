/// The words of states, limits and the like are keys of files: each code has one of its own.
#include "firmware/control/interface/names.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <string>

namespace sonoglide::control::names_test {
namespace {

/// @return how many words the codes from first to last have
template <class Code>
std::size_t words(Code first, Code last) {
  std::set<std::string> words;
  for (auto code = static_cast<int>(first); code <= static_cast<int>(last); ++code) {
    const std::string word = name(static_cast<Code>(code));
    EXPECT_EQ(word.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << word;
    EXPECT_FALSE(word.empty()) << code;
    words.insert(word);
  }
  return words.size();
}

TEST(Names, EveryCodeHasAWordOfItsOwn) {
  EXPECT_EQ(words(State::off, State::relearning), 6U);
  EXPECT_EQ(words(Limit::none, static_cast<Limit>(limit_count - 1)), limit_count);
  EXPECT_EQ(words(Settling::pending, Settling::clamped), 5U);
  EXPECT_EQ(words(Fault::measurement_not_finite, Fault::velocity_stuck), 10U);
}

TEST(Names, NoLimitAndNoFaultAreNone) {
  EXPECT_STREQ(name(Limit::none), "none");
  EXPECT_STREQ(name(Fault::none), "none");
}

}  // namespace
}  // namespace sonoglide::control::names_test
