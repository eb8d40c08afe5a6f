/// What every solver in the list is held to, by its own description.

#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/scene/solver_facts.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host_sim/scene_file/echo.hpp"

namespace sonoglide::scene::solver_methods_test {
namespace {

/// Of the law that every solver takes.
std::string scene_text(const std::string& solver_keys) {
  return fmt::format(
      "[plant]\nmass_kg = 0.02\nstiffness_N_per_m = 133e6\n[friction]\nlaw = \"dahl\"\n"
      "coefficient = 0.1\ncontact_stiffness_N_per_m = 0.056e6\n"
      "[sliding]\nvelocity_m_per_s = 0.02\n[run]\nduration_s = 1e-3\n[solver]\n{}",
      solver_keys);
}

std::string error_of(const std::string& text) {
  try {
    experiment::read_text(text, "scene.toml");
  } catch (const scene_file::SceneError& error) {
    return error.what();
  }
  return "";
}

template <class Described>
class SolverMethodTest : public testing::Test {
 public:
  static std::string keys() {
    return fmt::format("method = \"{}\"\n{}", Described::name,
                       Described::adaptive ? "" : "step_s = 1e-8\n");
  }
};

template <class Tuple>
struct TypesOf;
template <class... Described>
struct TypesOf<std::tuple<Described...>> {
  using Types = testing::Types<Described...>;
};
struct NameOf {
  template <class Described>
  static std::string GetName(int /*index*/) {
    return std::string(Described::name);
  }
};
TYPED_TEST_SUITE(SolverMethodTest, TypesOf<SolverMethods>::Types, NameOf);

TYPED_TEST(SolverMethodTest, IsReadAndEchoedByItsName) {
  const scene::Scene scene = experiment::read_text(scene_text(this->keys()), "scene.toml").plant;
  EXPECT_EQ(scene.solver.method, method_of<TypeParam>);
  EXPECT_EQ(scene_file::to_json(scene)["solver"]["method"], TypeParam::name);
  EXPECT_EQ(scene::is_adaptive(scene.solver.method), TypeParam::adaptive);
}

TYPED_TEST(SolverMethodTest, TakesItsOwnKeysAlone) {
  const auto refused = [this](const std::string& key) {
    return error_of(scene_text(this->keys() + key)).find("not used with solver.method") !=
           std::string::npos;
  };
  EXPECT_EQ(refused("tolerance = 1e-6"), !TypeParam::adaptive);
  if constexpr (TypeParam::takes_order) {
    EXPECT_FALSE(refused(fmt::format("order = {}", TypeParam::orders[0])));
  } else {
    EXPECT_TRUE(refused("order = 8"));
  }
  if constexpr (TypeParam::adaptive) {
    EXPECT_EQ(refused("step_s = 1e-8"), !TypeParam::takes_step);
  }
}

TYPED_TEST(SolverMethodTest, IsBuiltInTheOrderThatItPicks) {
  for (double tolerance = 1e-2; tolerance > 1e-15; tolerance /= 10.0) {
    const int order = TypeParam::order_for(tolerance);
    EXPECT_NE(std::find(TypeParam::orders.begin(), TypeParam::orders.end(), order),
              TypeParam::orders.end())
        << tolerance;
  }
}

}  // namespace
}  // namespace sonoglide::scene::solver_methods_test
