// The deepest stack against the compiler's own figure for every frame.
#include "host_sim/boards/emulated/image.hpp"

#include <gtest/gtest.h>

#include <string>

#include "compiled.hpp"
#include "host_sim/process/regular_expression.hpp"

namespace sonoglide::emulated::stack_bound_test {
namespace {

constexpr const char* calls = R"(
extern "C" {
volatile int sink;
[[gnu::noinline]] void leaf() { volatile char room[40]; room[0] = 1; sink = room[0]; }
[[gnu::noinline]] void deep() { volatile char room[400]; room[sink] = 1; leaf(); sink = room[1]; }
[[gnu::noinline]] void shallow() { volatile char room[4]; room[sink] = 1; leaf(); sink = room[1]; }
[[gnu::noinline]] void reset() { shallow(); deep(); sink = 0; }
}
)";

class StackBoundTest : public testing::TestWithParam<Compiler> {};

TEST_P(StackBoundTest, IsTheSumOfTheCompilersFramesAlongTheDeepestPath) {
  const Compiled compiled(GetParam(), calls);
  const StackBound bound = stack_bound(compiled.disassembly(), "reset");
  EXPECT_EQ(bound.unbounded_by, "");
  EXPECT_GE(compiled.frame_bytes("deep"), 400U);
  EXPECT_EQ(bound.bytes, compiled.frame_bytes("reset") + compiled.frame_bytes("deep") +
                             compiled.frame_bytes("leaf"));
}

TEST(Veneer, LeadsToItsFunction) {
  const std::string veneer =
      "08000000 <reset>:\n 8000000:\tb570      \tpush\t{r4, r5, r6, lr}\n"
      " 8000002:\tf000 f805 \tbl\t8000010 <__far_veneer>\n 8000006:\tbd70      \tpop\t{r4, r5, r6, pc}\n\n"
      "08000010 <__far_veneer>:\n 8000010:\tf85f f000 \tldr.w\tpc, [pc]\t@ 8000014 <__far_veneer+0x4>\n"
      " 8000014:\t10000001 \t.word\t0x10000001\n\n";
  const std::string there =
      "10000000 <far>:\n10000000:\tb500      \tpush\t{lr}\n10000002:\tbd00      \tpop\t{pc}\n";
  const StackBound bound = stack_bound(veneer + there, "reset");
  EXPECT_EQ(bound.unbounded_by, "");
  EXPECT_EQ(bound.bytes, 20U);
  EXPECT_EQ(stack_bound(veneer, "reset").unbounded_by, "far is not in the image");
}

// Of one function, which the veneer calls by its second name.
TEST(Veneer, LeadsToAConstructorByEitherOfItsNames) {
  const auto code = [](const char* called, const char* there) {
    return process::RegularExpression("CALLED").replace(
               "08000000 <reset>:\n 8000000:\tf000 f805 \tbl\t8000010 <__CALLED_veneer>\n\n"
               "08000010 <__CALLED_veneer>:\n 8000010:\tf85f f000 \tldr.w\tpc, [pc]\n"
               " 8000014:\t10000001 \t.word\t0x10000001\n\n",
               called) +
           "10000000 <" + there +
           ">:\n10000000:\tb500      \tpush\t{lr}\n10000002:\tbd00      \tpop\t{pc}\n";
  };
  EXPECT_EQ(stack_bound(code("_ZN5BoardC2Em", "_ZN5BoardC1Em"), "reset").unbounded_by, "");
  EXPECT_EQ(stack_bound(code("_ZN5BoardD2Ev", "_ZN5BoardD1Ev"), "reset").unbounded_by, "");
  EXPECT_EQ(stack_bound(code("_ZN5BoardC2Em", "_ZN5OtherC1Em"), "reset").unbounded_by,
            "_ZN5BoardC1Em is not in the image");
}

TEST_P(StackBoundTest, LooksIntoTheCompilersLibrary) {
  const Compiled compiled(GetParam(), R"(
extern "C" {
volatile double x;
[[gnu::noinline]] void reset() { x = x / (x * x); }
}
)");
  const StackBound bound = stack_bound(compiled.disassembly(), "reset");
  EXPECT_EQ(bound.unbounded_by, "");
  EXPECT_GT(bound.bytes, compiled.frame_bytes("reset"));
}

TEST_P(StackBoundTest, PassesASwitch) {
  const Compiled compiled(GetParam(), R"(
extern "C" {
volatile int x;
[[gnu::noinline]] void other() { volatile char room[100]; room[x] = 1; }
[[gnu::noinline]] void reset() {
  switch (x) {
    case 0: x = 7; break;
    case 1: other(); break;
    case 2: x = 3; x = 4; break;
    case 3: x = 1; break;
    case 4: x = x + 1; break;
    case 5: x = x * 5; break;
    case 6: other(); x = 8; break;
  }
}
}
)");
  const StackBound bound = stack_bound(compiled.disassembly(), "reset");
  EXPECT_EQ(bound.unbounded_by, "");
  EXPECT_GE(bound.bytes, compiled.frame_bytes("other"));
}

TEST_P(StackBoundTest, KnowsAFrameThatNoInstructionsConstantReaches) {
  for (const char* room : {"600", "1024"}) {
    const Compiled compiled(GetParam(), std::string(R"(
extern "C" {
volatile int x;
[[gnu::noinline]] void reset() { volatile char room[)") +
                                            room + R"(]; room[x] = 1; x = room[x + 1]; }
}
)");
    const StackBound bound = stack_bound(compiled.disassembly(), "reset");
    EXPECT_EQ(bound.unbounded_by, "");
    EXPECT_EQ(bound.bytes, compiled.frame_bytes("reset"));
  }
}

TEST_P(StackBoundTest, PassesAReturnFromUnderSpilledArguments) {
  const Compiled compiled(GetParam(), R"(
extern "C" {
struct Many { int of[8]; };
volatile int x;
[[gnu::noinline]] int sum(int first, Many many) {
  volatile char room[100];
  room[x] = 1;
  const Many* volatile all = &many;
  return first + all->of[x] + room[x];
}
[[gnu::noinline]] void reset() { x = sum(1, Many{{1, 2, 3, 4, 5, 6, 7, 8}}) + 1; }
}
)");
  const StackBound bound = stack_bound(compiled.disassembly(), "reset");
  EXPECT_EQ(bound.unbounded_by, "");
  EXPECT_GE(bound.bytes, compiled.frame_bytes("reset") + compiled.frame_bytes("sum"));
}

TEST_P(StackBoundTest, IsNoneForACallThroughAPointer) {
  const Compiled compiled(GetParam(), R"(
extern "C" {
void (*volatile pointer)();
volatile int x;
[[gnu::noinline]] void through() { pointer(); x = 1; }
[[gnu::noinline]] void reset() { through(); x = 2; }
}
)");
  EXPECT_EQ(stack_bound(compiled.disassembly(), "reset").unbounded_by,
            "through jumps through a pointer");
}

TEST_P(StackBoundTest, IsNoneForARecursion) {
  const Compiled compiled(GetParam(), R"(
extern "C" {
volatile int x;
void ping();
[[gnu::noinline]] void pong() { if (x) { ping(); } x = 1; }
[[gnu::noinline]] void ping() { pong(); x = 2; }
[[gnu::noinline]] void reset() { ping(); x = 3; }
}
)");
  EXPECT_EQ(stack_bound(compiled.disassembly(), "reset").unbounded_by, "ping calls itself");
}

TEST_P(StackBoundTest, IsNoneForAFrameOfVariableSize) {
  const Compiled compiled(GetParam(), R"(
extern "C" {
volatile unsigned x;
[[gnu::noinline]] void reset() {
  volatile char* room = static_cast<char*>(__builtin_alloca(x));
  room[0] = 1;
  x = room[x];
}
}
)");
  EXPECT_EQ(stack_bound(compiled.disassembly(), "reset").unbounded_by,
            "reset takes a variable amount of stack");
}

INSTANTIATE_TEST_SUITE_P(Compilers, StackBoundTest, testing::Values(arm, small_arm, riscv),
                         [](const auto& compiler) {
                           const std::string& target = compiler.param.flags.front();
                           return target == "-mcpu=cortex-m4"   ? "CortexM4F"
                                  : target == "-mcpu=cortex-m0" ? "CortexM0"
                                                                : "RiscV";
                         });

TEST(StackBound, IsNoneForWhatIsMissing) {
  EXPECT_EQ(stack_bound("", "reset").unbounded_by, "reset is not in the image");
}

}  // namespace
}  // namespace sonoglide::emulated::stack_bound_test
