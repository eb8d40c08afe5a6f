/// An image is believed only as far as it can be checked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
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
  std::vector<fs::path> files(const std::string& ending) const {
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(cache_.path() / "sonoglide")) {
      if (entry.path().extension() == ending) {
        found.push_back(entry.path());
      }
    }
    return found;
  }
  /// The only one.
  fs::path image() const {
    EXPECT_EQ(files(".elf").size(), 1U);
    EXPECT_EQ(files(".seal").size(), 1U);
    return files(".elf").front();
  }

  ScratchFolder folder_;
  ScratchFolder cache_;
};

TEST_F(ImageTrustTest, WhatIsCutShortOrForeignIsBuiltAnew) {
  const nlohmann::json whole = pil(scene);
  EXPECT_EQ(whole.at("pil").at("same_as_workstation"), true);
  EXPECT_EQ(whole.at("pil").at("trace_hash_workstation"), whole.at("control").at("trace_hash"));
  const fs::path ours = image();
  const fs::path seal = files(".seal").front();
  const auto bytes = fs::file_size(ours);
  const fs::path kept_image = cache_.path() / "kept.elf";
  const fs::path kept_seal = cache_.path() / "kept.seal";

  fs::resize_file(ours, bytes / 2);
  EXPECT_EQ(pil(scene).at("control"), whole.at("control"));
  EXPECT_EQ(fs::file_size(image()), bytes);

  fs::copy_file(ours, kept_image);
  fs::copy_file(seal, kept_seal);
  fs::remove(ours);
  fs::remove(seal);
  const nlohmann::json unlike = pil(other);
  EXPECT_NE(unlike.at("control").at("trace_hash"), whole.at("control").at("trace_hash"));
  const fs::path foreign = image();
  const fs::path foreign_seal = files(".seal").front();
  // The whole image of the other scene, with its own seal, under this one's name.
  fs::rename(kept_image, foreign.string() + ".old");
  fs::copy_file(foreign, ours);
  fs::copy_file(foreign_seal, seal);
  EXPECT_EQ(pil(scene).at("control"), whole.at("control"));
  EXPECT_EQ(fs::file_size(ours), bytes);
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
