#include "hal/kept_exception.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace sonoglide::hal::kept_exception_test {
namespace {

TEST(KeptException, HasItsWordsInOneOrder) {
  const ExceptionWords words = {1, 2, 3, 4, 5, 6, 7};
  const KeptException exception = exception_of(words);
  EXPECT_EQ(words_of(exception), words);
  std::vector<std::uint32_t> visited;
  KeptException::visit_words(
      exception, [&](const char* /*name*/, std::uint32_t word) { visited.push_back(word); });
  EXPECT_EQ(visited, std::vector<std::uint32_t>(words.begin(), words.end()));
}

}  // namespace
}  // namespace sonoglide::hal::kept_exception_test
