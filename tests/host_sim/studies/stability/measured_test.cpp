/// The recorded verdicts and residuals are those of this build, digit by digit.

#include <gtest/gtest.h>

#include <cstddef>

#include "host_sim/studies/stability/study.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::stability::measured_test {
namespace {

TEST(Measured, VerdictsAndResidualsAreThoseOfThisBuild) {
  const csv::Table recorded = csv::read_file(SONOGLIDE_STABILITY_MEASURED);
  const csv::Table computed(
      extremes_csv(extremes(SONOGLIDE_STABILITY_MEASURED_SCENES, [](double) {})));
  ASSERT_EQ(recorded.columns(), computed.columns());
  ASSERT_EQ(recorded.rows().size(), computed.rows().size());
  for (std::size_t i = 0; i < computed.rows().size(); ++i) {
    EXPECT_EQ(recorded.rows()[i].cells(), computed.rows()[i].cells())
        << "recorded and computed. If this is meant, cmake --build --preset release --target "
           "write_stability_measured and commit the change.";
  }
}

}  // namespace
}  // namespace sonoglide::stability::measured_test
