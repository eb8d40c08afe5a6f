// The memory that an image takes against GNU size.
#include "host_sim/boards/emulated/image.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

#include "compiled.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::emulated::image_cost_test {
namespace {

constexpr const char* data_of_each_kind = R"(
extern "C" {
extern const int table[50] = {1, 2, 3};
int started[25] = {7};
int cleared[200];
int reset() { return table[cleared[0]] + started[cleared[1]]; }
}
)";

std::map<std::string, std::uint64_t> section_sizes(const std::string& text) {
  std::map<std::string, std::uint64_t> sizes;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    std::uint64_t size = 0;
    if (words >> name >> size) {
      sizes[name] = size;
    }
  }
  return sizes;
}

TEST(ImageSize, AgreesWithGnuSize) {
  for (const Compiler& compiler : {arm, riscv}) {
    const Compiled compiled(compiler, data_of_each_kind);
    auto sections = section_sizes(compiled.sections());
    const ImageSize size = image_size(content(compiled.image()));
    EXPECT_EQ(size.ram_bytes, sections[".data"] + sections[".bss"]);
    EXPECT_EQ(size.ram_bytes, 900U);
    EXPECT_GE(size.flash_bytes, sections[".text"] + sections[".rodata"] + sections[".data"]);
    EXPECT_GE(sections[".rodata"], 200U);
    EXPECT_LE(size.flash_bytes, sections[".text"] + sections[".rodata"] + sections[".data"] + 64);
  }
}

TEST(ImageSize, KnowsWhatAnExceptionPushes) {
  const auto pushed = [](const Compiler& compiler) {
    return exception_frame_bytes(content(Compiled(compiler, data_of_each_kind).image()));
  };
  EXPECT_EQ(pushed(arm), 108U);
  EXPECT_EQ(pushed(small_arm), 36U);
  EXPECT_EQ(pushed(riscv), 0U);
}

TEST(ImageSize, RefusesWhatIsNoImage) {
  EXPECT_THROW(image_size(""), process::ProcessError);
  EXPECT_THROW(image_size(std::string(1000, 'x')), process::ProcessError);
  const std::string whole = content(Compiled(arm, data_of_each_kind).image());
  EXPECT_THROW(image_size(std::string_view(whole).substr(0, whole.size() / 2)),
               process::ProcessError);
}

}  // namespace
}  // namespace sonoglide::emulated::image_cost_test
