/// The recorded benchmarks: bytes, steps and errors are those of this build. Times are times.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sonoglide::measured_test {
namespace {

using Json = nlohmann::json;

constexpr const char* renew =
    "If this is meant, cmake --build --preset release --target write_benchmarks_measured and "
    "commit the change.";

Json read(const std::string& path) {
  std::ifstream file(path);
  return Json::parse(file);
}

/// Each benchmark under its name.
std::map<std::string, Json> benchmarks(const Json& report) {
  std::map<std::string, Json> named;
  for (const Json& benchmark : report.at("benchmarks")) {
    named[benchmark.at("name")] = benchmark;
  }
  return named;
}

/// What the program measures now, in the least time.
Json measured_again() {
  const std::string command = SONOGLIDE_BENCHMARKS
      " --benchmark_min_time=1e-9 --benchmark_out_format=json --benchmark_out='" SONOGLIDE_AGAIN
      "' >'" SONOGLIDE_AGAIN ".log' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return read(SONOGLIDE_AGAIN);
}

TEST(Measured, BytesStepsAndErrorsAreThoseOfThisBuild) {
  const std::vector<const char*> repeatable = {"model_bytes",      "solver_bytes", "state_bytes",
                                               "controller_bytes", "steps",        "worst_error"};
  const std::map<std::string, Json> then = benchmarks(read(SONOGLIDE_MEASURED));
  const std::map<std::string, Json> now = benchmarks(measured_again());
  ASSERT_EQ(then.size(), now.size()) << renew;
  for (const auto& [name, benchmark] : now) {
    ASSERT_EQ(then.count(name), 1U) << name << ". " << renew;
    for (const char* figure : repeatable) {
      EXPECT_EQ(then.at(name).value(figure, Json()), benchmark.value(figure, Json()))
          << name << " " << figure << ". " << renew;
    }
  }
}

TEST(Measured, TimesAreTimes) {
  for (const auto& [name, benchmark] : benchmarks(read(SONOGLIDE_MEASURED))) {
    const bool is_rate = name.rfind("sweep/", 0) == 0 || name.rfind("loops/", 0) == 0;
    const std::vector<const char*> timings =
        is_rate ? std::vector<const char*>{"items_per_second"}
                : std::vector<const char*>{"composed_ns", "by_hand_ns", "ratio"};
    for (const char* timing : timings) {
      const double value = benchmark.at(timing);
      EXPECT_TRUE(std::isfinite(value) && value > 0.0) << name << " " << timing;
    }
    if (!is_rate) {
      const double composed = benchmark.at("composed_ns");
      const double by_hand = benchmark.at("by_hand_ns");
      EXPECT_DOUBLE_EQ(benchmark.at("ratio"), composed / by_hand) << name;
    }
  }
}

TEST(Measured, NamesItsMachine) {
  const Json context = read(SONOGLIDE_MEASURED).at("context");
  EXPECT_NE(context.at("processor"), "");
  EXPECT_GT(context.at("num_cpus"), 0);
}

}  // namespace
}  // namespace sonoglide::measured_test
