/// The recorded verdicts and residuals are those of this build, digit by digit.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "host_sim/studies/stability/extremes.hpp"
#include "host_sim/studies/stability/report.hpp"

namespace sonoglide::stability {
namespace {

std::vector<std::string> lines(std::istream& text) {
  std::vector<std::string> all;
  for (std::string line; std::getline(text, line);) {
    all.push_back(line);
  }
  return all;
}

TEST(Measured, VerdictsAndResidualsAreThoseOfThisBuild) {
  std::ifstream file(SONOGLIDE_STABILITY_MEASURED);
  std::istringstream table(
      extremes_csv(extremes(SONOGLIDE_STABILITY_MEASURED_SCENES, [](double) {})));
  const std::vector<std::string> recorded = lines(file);
  const std::vector<std::string> computed = lines(table);
  ASSERT_EQ(recorded.size(), computed.size());
  for (std::size_t i = 0; i < computed.size(); ++i) {
    EXPECT_EQ(recorded[i], computed[i])
        << "recorded and computed. If this is meant, cmake --build --preset release --target "
           "write_stability_measured and commit the change.";
  }
}

}  // namespace
}  // namespace sonoglide::stability
