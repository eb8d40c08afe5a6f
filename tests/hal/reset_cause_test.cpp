#include "hal/reset_cause.hpp"

#include <gtest/gtest.h>

namespace sonoglide::hal {
namespace {

bool kept = false;

}  // namespace

/// In place of hal/exception, whose word in .noinit a workstation has not.
bool ram_was_kept() {
  return kept;
}

namespace reset_cause_test {
namespace {

struct PlainWatchdog {
  bool ran_out;
  bool caused_reset() const { return ran_out; }
};

struct CrystalWatchdog : PlainWatchdog {
  static inline bool failed = false;
  static bool crystal_failed() { return failed; }
};

constexpr KeptException exception{};

TEST(ResetCause, WithoutANoteOfTheBoardIsToldByTheRam) {
  for (const bool there : {false, true}) {
    kept = there;
    const ResetCause expected = there ? ResetCause::reset : ResetCause::power_on;
    EXPECT_EQ(reset_cause(PlainWatchdog{false}, nullptr), expected);
    EXPECT_EQ(reset_cause(CrystalWatchdog{{false}}, nullptr), expected);
  }
}

/// The watchdog resets the board after an exception and after the crystal fails, and the latter may end in an exception.
TEST(ResetCause, IsTheFirstOfItsChain) {
  EXPECT_EQ(reset_cause(PlainWatchdog{true}, nullptr), ResetCause::watchdog);
  EXPECT_EQ(reset_cause(PlainWatchdog{true}, &exception), ResetCause::exception);
  EXPECT_EQ(reset_cause(CrystalWatchdog{{true}}, &exception), ResetCause::exception);
  CrystalWatchdog::failed = true;
  EXPECT_EQ(reset_cause(CrystalWatchdog{{true}}, &exception), ResetCause::crystal);
  EXPECT_EQ(reset_cause(CrystalWatchdog{{false}}, nullptr), ResetCause::crystal);
  CrystalWatchdog::failed = false;
}

}  // namespace
}  // namespace reset_cause_test
}  // namespace sonoglide::hal
