/// A closed loop as an FMU, and what `run` makes of it.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/acceptance/fmu/importer/fmu3.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance::one_loop {

inline constexpr std::uint64_t periods = 120;

inline const std::string scene = table_1_closed_loop + R"([run]
duration_s = 2e-3
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4], [1e-3, 0.6]]
)";

/// One FMU for all tests of a suite: they do not change it.
class OneLoop : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new ScratchFolder();
    folder->write("scene.toml", scene);
    make_fmu(*folder, "scene.toml", "--kind loop", "loop");
    fmu = new Fmu3(*folder, "loop");
  }
  static void TearDownTestSuite() {
    delete fmu;
    delete folder;
  }

  static std::string hash_of_run(const std::string& options = "") {
    const Outcome ran = folder->run("run scene.toml --json " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return nlohmann::json::parse(ran.out)["control"]["trace_hash"];
  }

  static double step_s() { return fmu->description().step_s(); }

  inline static ScratchFolder* folder = nullptr;
  inline static Fmu3* fmu = nullptr;
};

}  // namespace sonoglide::acceptance::one_loop
