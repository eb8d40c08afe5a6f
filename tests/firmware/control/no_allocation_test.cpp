/// The controller asks for no memory: every allocator in this program ends it while steps run.
///
/// operator new is replaced; malloc, calloc, realloc and aligned_alloc, as this program's own code
/// calls them, are wrapped by the linker (see CMakeLists.txt).

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <new>

#include "design.hpp"
#include "scalars.hpp"

namespace {

bool forbidden = false;

void* checked(void* memory) {
  if (forbidden) {
    std::abort();
  }
  return memory;
}

}  // namespace

extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* memory, std::size_t size);
void* __real_aligned_alloc(std::size_t alignment, std::size_t size);

void* __wrap_malloc(std::size_t size) {
  return checked(__real_malloc(size));
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  return checked(__real_calloc(count, size));
}
void* __wrap_realloc(void* memory, std::size_t size) {
  return checked(__real_realloc(memory, size));
}
void* __wrap_aligned_alloc(std::size_t alignment, std::size_t size) {
  return checked(__real_aligned_alloc(alignment, size));
}
}

// Out of line, or the compiler takes the pair apart and finds malloc freed by delete.
__attribute__((noinline)) void* operator new(std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) {
    std::abort();
  }
  return memory;
}
__attribute__((noinline)) void operator delete(void* memory) noexcept {
  std::free(memory);
}
__attribute__((noinline)) void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

namespace sonoglide::control::no_allocation_test {
namespace {

constexpr int steps = 50'000;

/// Calibrates, runs, reverses, limits, faults and starts again; returns how many steps drove.
template <class PartsT>
int drive_for_long() {
  using Scalar = typename PartsT::Scalar;
  Controller<PartsT> controller(parameters<PartsT>(Design{}));
  int driven = 0;
  forbidden = true;
  for (int i = 0; i < steps; ++i) {
    if (i % 1000 == 0) {
      controller.start();
      controller.set_target(scaled<Scalar>(0.02 + 0.009 * (i / 1000)));
    }
    const double velocity = 0.4 - 0.8 * (i % 997) / 997.0;
    const double ratio = 0.1 + 0.8 * ((i * 37) % 101) / 101.0;
    const Quality quality = i % 1000 == 990 ? Quality::missing : Quality::good;
    const auto command =
        controller.step({scaled<Scalar>(velocity < 0.0 ? -0.5 * ratio : 0.5 * ratio),
                         scaled<Scalar>(velocity), quality});
    driven += Scalar{} < command.amplitude ? 1 : 0;
  }
  forbidden = false;
  return driven;
}

template <class Scalar>
class NoAllocation : public testing::Test {};
using Arithmetics = testing::Types<double, float, Saturated>;
TYPED_TEST_SUITE(NoAllocation, Arithmetics);

TYPED_TEST(NoAllocation, WhileTheControllerSteps) {
  EXPECT_GT(drive_for_long<FullParts<TypeParam>>(), steps / 2);
  EXPECT_GT(drive_for_long<ShapedParts<TypeParam>>(), steps / 2);
  EXPECT_GT(drive_for_long<BareParts<TypeParam>>(), steps / 2);
}

// The check itself: either way of asking for memory would have been noticed.
TEST(NoAllocationDeathTest, WouldBeNoticed) {
  EXPECT_DEATH(
      {
        forbidden = true;
        void* volatile memory = ::operator new(16);
        ::operator delete(memory);
      },
      "");
  EXPECT_DEATH(
      {
        forbidden = true;
        void* volatile memory = std::malloc(16);
        std::free(memory);
      },
      "");
}

}  // namespace
}  // namespace sonoglide::control::no_allocation_test
