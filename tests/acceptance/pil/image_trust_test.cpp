/// An image is believed only as far as it can be checked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image_cache.hpp"
#include "tests/acceptance/program/odd_names.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::image_trust_test {
namespace {

namespace fs = std::filesystem;

const std::string scene = "'" SONOGLIDE_SCENES "/target_step.toml'";
const std::string other = "'" SONOGLIDE_SCENES "/target_step_unshaped.toml'";

class ImageTrustTest : public testing::Test {
 protected:
  ImageTrustTest() { setenv("XDG_CACHE_HOME", cache_.path().c_str(), 1); }
  ~ImageTrustTest() override { use_image_cache(); }

  nlohmann::json pil(const std::string& which) const {
    fs::remove_all(folder_.path() / "out");
    const Outcome outcome = folder_.run("pil " + which + " --board mps2-an386 --quiet --out out");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(folder_.read("out/summary.json"));
  }
  fs::path images() const { return cache_.path() / "sonoglide"; }
  /// The only one.
  fs::path image() const {
    const std::vector<fs::directory_entry> entries{fs::directory_iterator(images()),
                                                   fs::directory_iterator()};
    EXPECT_EQ(entries.size(), 1U);
    return entries.front().path();
  }

  ScratchFolder folder_;
  ScratchFolder cache_;
};

TEST_F(ImageTrustTest, WhatIsCutShortOrForeignIsBuiltAnew) {
  const nlohmann::json whole = pil(scene);
  EXPECT_EQ(whole.at("pil").at("same_as_workstation"), true);
  EXPECT_EQ(whole.at("pil").at("trace_hash_workstation"), whole.at("control").at("trace_hash"));
  const fs::path ours = image();
  const auto bytes = fs::file_size(ours);

  // Beside it, what is no image under such a name.
  const std::string stem = ours.stem().string();
  const fs::path odd_folder = images() / (stem.substr(0, stem.rfind('-') + 1) + "folder.elf");
  fs::resize_file(ours, bytes / 2);
  fs::create_directory(odd_folder);
  EXPECT_EQ(pil(scene).at("control"), whole.at("control"));
  EXPECT_TRUE(fs::remove(odd_folder));
  EXPECT_EQ(fs::file_size(image()), bytes);

  const fs::path kept = cache_.path() / "kept.elf";
  fs::rename(image(), kept);
  const nlohmann::json unlike = pil(other);
  EXPECT_NE(unlike.at("control").at("trace_hash"), whole.at("control").at("trace_hash"));
  // The whole image of the other scene under this one's name.
  fs::rename(image(), ours);
  EXPECT_EQ(pil(scene).at("control"), whole.at("control"));
  EXPECT_EQ(fs::file_size(image()), bytes);
}

TEST_F(ImageTrustTest, ACacheThatIsNoFolderIsNamed) {
  std::ofstream(images()) << "mine";
  const Outcome outcome = folder_.run("pil " + scene + " --board mps2-an386");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find(images().string() + ": "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("; allowed: "), std::string::npos) << outcome.err;
}

/// None of them finds an image at the start.
TEST_F(ImageTrustTest, SeveralMayBuildOneImageAtOnce) {
  constexpr int programs = 3;
  std::string line = "true";
  for (int i = 0; i < programs; ++i) {
    line += " & '" SONOGLIDE_PROGRAM "' pil " + scene + " --board mps2-an386 --quiet --out o" +
            std::to_string(i) + " || touch failed";
  }
  EXPECT_EQ(folder_.run_program("sh", "-c " + shell_word(line + " & wait")).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "failed"));
  for (int i = 0; i < programs; ++i) {
    const auto summary =
        nlohmann::json::parse(folder_.read("o" + std::to_string(i) + "/summary.json"));
    EXPECT_EQ(summary.at("pil").at("same_as_workstation"), true);
  }
}

/// An image that answers otherwise: a cache cannot tell, its seal being in order.
TEST_F(ImageTrustTest, AnImageThatAnswersOtherwiseIsTold) {
  const fs::path sources = folder_.path() / "sources";
  fs::create_directory(sources);
  for (const char* part : {"CMakeLists.txt", "CMakePresets.json", "firmware", "hal", "tools"}) {
    fs::copy(fs::path(SONOGLIDE_SOURCE_TREE) / part, sources / part, fs::copy_options::recursive);
  }
  // The last bit of every answer turned round.
  const std::string seam = "sources/hal/lockstep/frame.hpp";
  std::string text = folder_.read(seam);
  const std::string line = "static_cast<std::uint32_t>(drive.amplitude)";
  ASSERT_NE(text.find(line), std::string::npos);
  text.replace(text.find(line), line.size(), line + " ^ 1U");
  folder_.write(seam, text);
  setenv("SONOGLIDE_SOURCE", sources.c_str(), 1);
  const Outcome outcome = folder_.run("pil " + scene + " --board mps2-an386 --out out");
  unsetenv("SONOGLIDE_SOURCE");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("gave other drive commands"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("NOT THE SAME as on the workstation"), std::string::npos);
  const auto summary = nlohmann::json::parse(folder_.read("out/summary.json"));
  EXPECT_EQ(summary.at("pil").at("same_as_workstation"), false);
  EXPECT_NE(summary.at("pil").at("trace_hash_workstation"), summary.at("control").at("trace_hash"));
}

TEST_F(ImageTrustTest, AFolderThatCMakeCannotTakeIsRefusedBeforeIt) {
  for (const std::string name :
       {"a;b", "a\"b", "a\\b", "a<b", "a>b", "a|b", "a${b}", "a$(b)", "a\nb", "caf\xe9"}) {
    const fs::path odd = folder_.path() / name;
    fs::create_directory(odd);
    const std::vector<std::string> before = folder_.entries();
    setenv("XDG_CACHE_HOME", odd.c_str(), 1);
    const Outcome outcome = folder_.run("pil " + scene + " --board mps2-an386");
    EXPECT_EQ(outcome.exit_code, 1) << name;
    EXPECT_NE(outcome.err.find(": cannot be used by CMake; allowed: "), std::string::npos)
        << outcome.err;
    EXPECT_TRUE(is_printable(outcome.err));
    EXPECT_EQ(folder_.entries(), before);
  }
}

TEST_F(ImageTrustTest, AnyOtherFolderServes) {
  const fs::path odd = cache_.path() / "it's a (false) `x` #&@%~!^[y]{z}*?:=é";
  fs::create_directory(odd);
  setenv("XDG_CACHE_HOME", odd.c_str(), 1);
  EXPECT_EQ(folder_.run("pil " + scene + " --board mps2-an386 --quiet").exit_code, 0);
}

TEST_F(ImageTrustTest, ASceneOfAnyNameIsOnlyShown) {
  const std::string name = "x'; system(\"touch pwned\") #\n#error \x1b\xff.toml";
  fs::copy_file(SONOGLIDE_SCENES "/target_step.toml", folder_.path() / name);
  for (const std::string command : {"pil ", "arithmetic "}) {
    const Outcome outcome = folder_.run(command + shell_word(name) + " --board mps2-an386");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(is_printable(outcome.out + outcome.err));
  }
  const std::vector<std::string> entries = folder_.entries();
  EXPECT_EQ(std::count(entries.begin(), entries.end(), "pwned"), 0);
  EXPECT_NE(folder_
                .read("out/x'; system(\"touch pwned\") #\\x0a#error \\x1b\\xff_arithmetic/"
                      "arithmetic.svg")
                .find("</svg>"),
            std::string::npos);
}

}  // namespace
}  // namespace sonoglide::acceptance::image_trust_test
