#include "host_sim/configure/friction/inverse_design.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "firmware/control/friction/tabulated_feedforward.hpp"
#include "firmware/numeric/fixed.hpp"
#include "followed_friction.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/controller_parameters.hpp"
#include "host_sim/configure/friction/mean_friction.hpp"
#include "tests/common/dice/dice.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::configure::inverse_design_test {
namespace {

using tests::Dice;
using tests::followed_ratio;
using tests::pi;
using tests::table_1_closed_loop;
using tests::vibration_velocity_m_per_s;

const std::vector<scene::FrictionLaw> tabulated_laws = {
    scene::laws::LuGre{}, scene::laws::Iwan{}, scene::laws::Stribeck{},
    scene::laws::TransverseCoulomb{}, scene::laws::NormalCoulomb{}};

/// One call for each law: one that is added is drawn here as well, or this does not compile.
struct OwnKeys {
  Dice& dice;
  const scene::Friction& contact;
  double sliding_m_per_s;
  double full_m_per_s;

  void operator()(scene::laws::None& /*law*/) const {}
  void operator()(scene::laws::Coulomb& /*law*/) const {}
  void operator()(scene::laws::Dahl& /*law*/) const {}
  void operator()(scene::laws::TransverseCoulomb& /*law*/) const {}
  void operator()(scene::laws::Iwan& law) const {
    law.elements = static_cast<int>(dice.between(1.0, 8.99));
  }
  void operator()(scene::laws::LuGre& law) const {
    law.static_coefficient = contact.coefficient * dice.between(1.0, 2.0);
    law.stribeck_velocity_m_per_s = sliding_m_per_s * dice.decades(0.3, 10.0);
    law.viscous_friction_N_s_per_m = contact.limit_N() / full_m_per_s * dice.between(0.0, 0.3);
  }
  void operator()(scene::laws::Stribeck& law) const {
    law.fall_s_per_m = contact.coefficient / sliding_m_per_s * dice.between(0.0, 0.4);
    law.rise_s3_per_m3 = 4.0 / 27.0 * std::pow(law.fall_s_per_m, 3) /
                         std::pow(contact.coefficient, 2) * dice.between(1.0, 3.0);
  }
  void operator()(scene::laws::NormalCoulomb& law) const {
    const double full_m = full_m_per_s / (2.0 * pi * tests::carrier_Hz);
    law.normal_contact_stiffness_N_per_m = contact.normal_force_N / full_m * dice.between(0.4, 1.2);
  }
};

scene::Scene random_loop(Dice& dice, const scene::FrictionLaw& law) {
  scene::Scene scene = table_1_closed_loop();
  const double full_m_per_s =
      vibration_velocity_m_per_s(scene.plant, scene.drive->max_force_amplitude_N);
  const double sliding_m_per_s = full_m_per_s / dice.decades(2.0, 40.0);
  scene.sliding.profile = {{0.0, sliding_m_per_s}};
  scene.friction.law = law;
  const double full_m = full_m_per_s / (2.0 * pi * tests::carrier_Hz);
  scene.friction.contact_stiffness_N_per_m =
      dice.decades(0.1, 200.0) * scene.friction.limit_N() / full_m;
  std::visit(OwnKeys{dice, scene.friction, sliding_m_per_s, full_m_per_s}, scene.friction.law);
  if (const auto* normal = std::get_if<scene::laws::NormalCoulomb>(&scene.friction.law)) {
    scene.friction.contact_stiffness_N_per_m =
        scene.friction.coefficient * normal->normal_contact_stiffness_N_per_m * full_m_per_s /
        sliding_m_per_s * dice.decades(0.05, 0.5);
  }
  scene.sensor.force_full_scale_N =
      3.0 * scene::undriven_friction_N(scene.friction.law, scene.friction, sliding_m_per_s);
  scene.controller->target_friction_ratio = {{0.0, 0.9}};
  return scene;
}

struct Loop {
  scene::Scene scene;
  ControlDesign design;
  std::string name;
};

constexpr int contacts = 10;

/// Of each tabulated law, with the rest of the scene as a test has it.
template <class Change>
std::vector<Loop> random_loops(unsigned seed, const Change& change) {
  std::vector<Loop> all;
  Dice dice(seed);
  for (const scene::FrictionLaw& law : tabulated_laws) {
    for (int i = 0; i < contacts; ++i) {
      scene::Scene scene = random_loop(dice, law);
      change(scene);
      all.push_back({scene, design_control(scene),
                     std::string(scene::name_of(law)) + ' ' + std::to_string(i)});
    }
  }
  return all;
}

/// The friction force times a factor, as a controller that learns its level takes it.
scene::Friction at_level(const scene::Scene& scene, double factor) {
  scene::Friction contact = scene.friction;
  const double sliding_m_per_s = scene.sliding.profile.front().velocity_m_per_s;
  if (scene::is<scene::laws::NormalCoulomb>(contact.law)) {
    contact.coefficient *= factor;
  } else if (const auto* lugre = std::get_if<scene::laws::LuGre>(&contact.law)) {
    const double viscous_N = lugre->viscous_friction_N_s_per_m * sliding_m_per_s;
    const double all_N = scene::undriven_friction_N(contact.law, contact, sliding_m_per_s);
    contact.normal_force_N *= (factor * all_N - viscous_N) / (all_N - viscous_N);
  } else {
    contact.normal_force_N *= factor;
  }
  return contact;
}

/// What the controller asks for, and what comes of it.
struct Answer {
  double vibration_m_per_s;
  double ratio;  ///< of the contact, followed
  bool most;     ///< all that there is
};

template <class Scalar>
class Feedforward {
 public:
  explicit Feedforward(const Loop& loop)
      : scene_(loop.scene),
        design_(loop.design),
        parameters_(parameters(design_, Type<control::TabulatedFeedforward<Scalar>>{})),
        feedforward_(parameters_) {
    learn(1.0);
  }

  void learn(double factor) {
    contact_ = at_level(scene_, factor);
    feedforward_.set_friction(control::FrictionLevel<Scalar>(
        numeric::from_real<Scalar>(factor * design_.friction_force)));
  }

  Answer answer(double ratio, double sliding_m_per_s) const {
    const double full_m_per_s = design_.scales.velocity_m_per_s;
    const double amplitude = numeric::to_real(
        feedforward_.amplitude(numeric::from_real<Scalar>(0.5 * ratio),
                               numeric::from_real<Scalar>(sliding_m_per_s / full_m_per_s)));
    const double vibration_m_per_s = std::min(amplitude, 1.0) * full_m_per_s;
    return {vibration_m_per_s,
            followed_ratio(contact_, {sliding_m_per_s, vibration_m_per_s,
                                      2.0 * pi * scene_.drive->frequency_Hz}),
            amplitude > 0.9999};
  }
  /// In 16 bits z is coarse too.
  static constexpr double coarseness() { return sizeof(Scalar) > 2 ? 1.0 : 2.0; }
  /// A slow sliding is coarser.
  bool resolves(double sliding_m_per_s) const {
    return sizeof(Scalar) > 2 || sliding_m_per_s > 0.05 * design_.scales.velocity_m_per_s;
  }
  Answer answer(double ratio) const { return answer(ratio, fastest_m_per_s()); }
  double fastest_m_per_s() const { return scene_.sliding.profile.front().velocity_m_per_s; }

 private:
  const scene::Scene& scene_;
  const ControlDesign& design_;
  typename control::TabulatedFeedforward<Scalar>::Parameters parameters_;
  control::TabulatedFeedforward<Scalar> feedforward_;
  scene::Friction contact_;
};

template <class Scalar>
class InverseDesignTest : public testing::Test {};
using Arithmetics =
    testing::Types<double, float, numeric::Q31<numeric::Saturating>,
                   numeric::Q31<numeric::Trapping>, numeric::Q15<numeric::Saturating>>;
TYPED_TEST_SUITE(InverseDesignTest, Arithmetics);

/// At the ends of the map the answer is the nearest ratio that there is. Near the least one the vibration
/// that gives a ratio changes fast.
void expect_ratio(const Answer& answer, double ratio, const ControlDesign& design, double bound,
                  const std::string& what) {
  constexpr double near = 0.1;
  const double least = design.inverse->least_ratio.value_or(-1.0);
  bound *= ratio < least + near ? 2.0 : 1.0;
  if (answer.most) {
    EXPECT_GE(answer.ratio, ratio - bound) << what << ' ' << ratio;
  } else {
    EXPECT_NEAR(answer.ratio, std::max(ratio, least), bound) << what << ' ' << ratio;
  }
}

// Drawn once for all arithmetics: designing them takes long.

const std::vector<Loop>& steady_loops() {
  static const std::vector<Loop> all = random_loops(1, [](scene::Scene& /*scene*/) {});
  return all;
}

const std::vector<Loop>& learning_loops() {
  static const std::vector<Loop> all = random_loops(2, [](scene::Scene& scene) {
    scene.controller->calibration_s = 5e-2;
    scene.run.duration_s = 0.2;
  });
  return all;
}

const std::vector<Loop>& slowing_loops() {
  static const std::vector<Loop> all = random_loops(3, [](scene::Scene& scene) {
    scene.sliding.profile.push_back({1.0, 0.0});
  });
  return all;
}

TYPED_TEST(InverseDesignTest, GivesTheRatioOfAContactThatIsFollowed) {
  constexpr double bound = 0.008;
  for (const Loop& loop : steady_loops()) {
    const Feedforward<TypeParam> feedforward(loop);
    if (!feedforward.resolves(feedforward.fastest_m_per_s())) {
      continue;
    }
    for (const double ratio : {0.1, 0.25, 0.4, 0.55, 0.7, 0.8, 0.9, 0.97}) {
      expect_ratio(feedforward.answer(ratio), ratio, loop.design, bound * feedforward.coarseness(),
                   loop.name);
    }
  }
}

TYPED_TEST(InverseDesignTest, FollowsTheLevelThatIsLearnt) {
  constexpr double bound = 0.01;
  for (const Loop& loop : learning_loops()) {
    Feedforward<TypeParam> feedforward(loop);
    for (const double level : {0.55, 0.75, 1.0, 1.3, 1.9}) {
      feedforward.learn(level);
      if (!feedforward.resolves(feedforward.fastest_m_per_s())) {
        continue;
      }
      for (const double ratio : {0.25, 0.55, 0.8, 0.95}) {
        const Answer answer = feedforward.answer(ratio);
        if (level == 1.0 || !loop.design.inverse->least_ratio) {
          expect_ratio(answer, ratio, loop.design, bound * feedforward.coarseness(),
                       loop.name + ' ' + std::to_string(level));
        }
      }
    }
  }
}

TYPED_TEST(InverseDesignTest, FollowsTheSpeed) {
  constexpr double bound = 0.01;
  for (const Loop& loop : slowing_loops()) {
    const Feedforward<TypeParam> feedforward(loop);
    if (loop.design.inverse->least_ratio) {
      continue;  // what cannot be reached is another at each speed
    }
    for (const double part : {0.9, 0.6, 0.35, 0.2}) {
      const double sliding_m_per_s = part * feedforward.fastest_m_per_s();
      if (!feedforward.resolves(sliding_m_per_s)) {
        continue;
      }
      for (const double ratio : {0.25, 0.55, 0.8, 0.95}) {
        expect_ratio(feedforward.answer(ratio, sliding_m_per_s), ratio, loop.design,
                     bound * feedforward.coarseness(), loop.name + ' ' + std::to_string(part));
      }
    }
  }
}

/// Of several vibrations that give a ratio, the smallest; of none, the one that comes nearest.
TEST(InverseDesignOfStribeckTest, StaysThisSideOfTheLeastRatio) {
  scene::Scene scene = table_1_closed_loop();
  scene.friction.law = scene::laws::Stribeck{0.3, 200.0};
  scene.sliding.profile = {{0.0, 0.01}};
  scene.controller->target_friction_ratio = {{0.0, 0.9}};
  const double omega = 2.0 * pi * scene.drive->frequency_Hz;
  const auto ratio_at = [&](double vibration_m_per_s) {
    return mean_friction_ratio(scene.friction, omega, 0.01, vibration_m_per_s);
  };
  double lowest = 1.0;
  double lowest_m_per_s = 0.0;
  for (double v = 0.01; v < 0.2; v *= 1.0005) {
    if (ratio_at(v) < lowest) {
      lowest = ratio_at(v);
      lowest_m_per_s = v;
    }
  }
  const Loop loop{scene, design_control(scene), "stribeck"};
  const Feedforward<double> feedforward(loop);
  ASSERT_TRUE(loop.design.inverse->least_ratio);
  EXPECT_NEAR(*loop.design.inverse->least_ratio, lowest, 1e-4);
  for (const double above : {0.02, 0.1, 0.3}) {
    const Answer answer = feedforward.answer(lowest + above);
    EXPECT_LT(answer.vibration_m_per_s, lowest_m_per_s);
    EXPECT_NEAR(answer.ratio, lowest + above, 0.01);
  }
  for (const double below : {0.5 * lowest, 0.9 * lowest}) {
    EXPECT_NEAR(feedforward.answer(below).ratio, lowest, 0.01);
  }
  EXPECT_TRUE(design_notes(design_control(scene)).empty());
  scene.controller->target_friction_ratio = {{0.0, 0.5 * lowest}};
  const auto notes = design_notes(design_control(scene));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes.front().find("falls no lower than"), std::string::npos) << notes.front();
}

}  // namespace
}  // namespace sonoglide::configure::inverse_design_test
