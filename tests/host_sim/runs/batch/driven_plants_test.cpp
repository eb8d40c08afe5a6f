#include "host_sim/runs/batch/run_dahl_plants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "firmware/friction/dahl.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/ramped_cosine.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/taylor/event_taylor.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/host_sim/runs/batch/runs/instruction_sets.hpp"
#include "tests/host_sim/runs/batch/runs/plants.hpp"

namespace sonoglide::batch::driven_plants_test {
namespace {

/// Amplitudes that leap about; of a plant always the same ones.
double amplitude_in(std::size_t plant, std::size_t period) {
  const auto turn = static_cast<double>(7 * plant + 3 * period);
  return 0.5 + 0.5 * std::sin(turn * turn);
}

/// How the amplitude goes from one period to the next.
enum class Way {
  leaps,       ///< at once
  flat_ramps,  ///< at once, in lanes in which it may have a slope
  ramps,       ///< along a straight line, over the period
};

DriveAmplitude drive_in(std::size_t plant, std::size_t period, Way way) {
  const double amplitude = amplitude_in(plant, period);
  const double before = period > 0 ? amplitude_in(plant, period - 1) : amplitude;
  return way == Way::ramps ? DriveAmplitude{before, (amplitude - before) / tests::two_pi}
                           : DriveAmplitude{amplitude};
}

/// Drives every plant so, and keeps what it is told.
class Leaps final : public DriveSource {
 public:
  Leaps(std::size_t plants, std::size_t periods, Way way = Way::leaps)
      : mean_friction(plants), periods_(periods), way_(way) {}

  std::optional<DriveAmplitude> next_amplitude(std::size_t plant, double mean) override {
    std::vector<double>& all = mean_friction[plant];
    all.push_back(mean);
    return all.size() < periods_ ? std::optional(drive_in(plant, all.size(), way_)) : std::nullopt;
  }
  bool ramps() const override { return way_ != Way::leaps; }

  std::vector<std::vector<double>> mean_friction;

 private:
  std::size_t periods_;
  Way way_;
};

constexpr std::size_t periods = 20;

std::vector<DahlPlant> begun(std::vector<DahlPlant> plants) {
  for (std::size_t i = 0; i < plants.size(); ++i) {
    plants[i].drive_amplitude = amplitude_in(i, 0);
  }
  return plants;
}

/// The scalar solver at order 16 and tolerance 1e-12 under the same drive.
std::vector<double> scalar_means(const DahlPlant& plant, std::size_t index, Way way) {
  using Model =
      plant::Model<friction::Dahl<double>, plant::Damped<double>, plant::RampedCosineDrive>;
  const Model model = {{{plant.contact_stiffness}, plant.friction_force, plant.vibration_sign},
                       {plant.damping},
                       plant.stiffness};
  plant::EventTaylor<Model, 16> solver;
  solver.configure(model, 1e-12);
  plant::NoObserver observer;
  plant::State<double> state = plant.initial;
  std::vector<double> means;
  for (std::size_t period = 0; period < periods; ++period) {
    plant::MeanFriction<double> account;
    const DriveAmplitude drive = drive_in(index, period, way);
    const plant::IntervalOf<Model> interval = {
        0.0, tests::two_pi, {drive.at_zero, drive.slope, 0.0}, plant.sliding_velocity, 0.0};
    EXPECT_EQ(solver.advance(interval, state, account, observer).error, plant::Error::none);
    means.push_back(account.friction_integral / tests::two_pi);
  }
  return means;
}

double largest_error(const std::vector<DahlPlant>& plants, const Leaps& driven, Way way) {
  double largest = 0.0;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const std::vector<double> expected = scalar_means(plants[i], i, way);
    EXPECT_EQ(driven.mean_friction[i].size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      largest = std::max(largest, std::abs(driven.mean_friction[i][k] - expected[k]));
    }
  }
  return largest;
}

TEST(DrivenPlants, EachPeriodOfTable1IsGoodTo1e6) {
  const std::vector<DahlPlant> plants = begun(table_1_sweep(12));
  on_each_instruction_set([&](const char* name) {
    SCOPED_TRACE(name);
    for (const Way way : {Way::leaps, Way::ramps}) {
      Leaps driven(plants.size(), periods, way);
      for (const RunStatus status : run_driven_plants(plants, driven)) {
        EXPECT_EQ(status, RunStatus::solved);
      }
      EXPECT_LE(largest_error(plants, driven, way), 1e-6);
    }
  });
}

std::vector<std::vector<double>> means_of(const std::vector<DahlPlant>& plants,
                                          Way way = Way::leaps) {
  Leaps driven(plants.size(), periods, way);
  run_driven_plants(plants, driven);
  return std::move(driven.mean_friction);
}

void expect_same_bits(const std::vector<double>& some, const std::vector<double>& others) {
  ASSERT_EQ(some.size(), others.size());
  EXPECT_EQ(std::memcmp(some.data(), others.data(), some.size() * sizeof(double)), 0);
}

/// Plants that lanes do not take come first: what drives a plant goes by its index.
std::vector<double> means_alone(const DahlPlant& plant, std::size_t index) {
  DahlPlant unsuitable;
  unsuitable.contact_stiffness = 0.0;
  std::vector<DahlPlant> plants(index, unsuitable);
  plants.push_back(plant);
  return means_of(plants).back();
}

TEST(DrivenPlants, TheSameBitsAloneAndAmongOthers) {
  const std::vector<DahlPlant> plants = begun(random_plants(45, 21));
  on_each_instruction_set([&](const char* name) {
    SCOPED_TRACE(name);
    const std::vector<std::vector<double>> together = means_of(plants);
    for (std::size_t i = 0; i < plants.size(); ++i) {
      expect_same_bits(means_alone(plants[i], i), together[i]);
    }
  });
}

TEST(DrivenPlants, ARampWithoutSlopeHasTheBitsOfALeap) {
  const std::vector<DahlPlant> plants = begun(random_plants(45, 22));
  const std::vector<std::vector<double>> leaps = means_of(plants);
  const std::vector<std::vector<double>> ramps = means_of(plants, Way::flat_ramps);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    expect_same_bits(ramps[i], leaps[i]);
  }
}

TEST(DrivenPlants, BegunWithTheirOwnAmplitude) {
  DahlPlant plant = table_1_sweep(3)[4];
  Leaps driven(1, 1);
  plant.drive_amplitude = 0.0;
  plant.initial.friction = 1.0;
  EXPECT_EQ(run_driven_plants({plant}, driven)[0], RunStatus::solved);
  ASSERT_EQ(driven.mean_friction[0].size(), 1U);
  EXPECT_NEAR(driven.mean_friction[0][0], 1.0, 1e-12);  // it slides on, undriven
}

TEST(DrivenPlants, ThoseThatAreGivenUpSayWhyAndDisturbNoOther) {
  const std::vector<DahlPlant> plants = begun(table_1_sweep(5));
  const std::vector<std::vector<double>> undisturbed = means_of(plants);
  DahlPlant unsuitable;
  unsuitable.stiffness = std::numeric_limits<double>::quiet_NaN();
  DahlPlant resting;
  resting.drive_amplitude = 0.0;
  DahlPlant stuck;
  stuck.contact_stiffness = 1e9;
  stuck.friction_force = 10.0;
  stuck.sliding_velocity = 0.1;
  DahlPlant lost;
  lost.drive_amplitude = 0.9e15;
  std::vector<DahlPlant> mixed = plants;
  mixed.insert(mixed.end(), {unsuitable, resting, stuck, lost});
  Leaps driven(mixed.size(), periods);
  const std::vector<RunStatus> statuses = run_driven_plants(mixed, driven);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    EXPECT_EQ(statuses[i], RunStatus::solved);
    expect_same_bits(driven.mean_friction[i], undisturbed[i]);
  }
  EXPECT_EQ(statuses[25], RunStatus::outside_range);
  EXPECT_EQ(statuses[26], RunStatus::undecided_reversal);
  EXPECT_EQ(statuses[27], RunStatus::too_many_steps);
  EXPECT_EQ(statuses[28], RunStatus::not_finite);
}

/// A drive that is no number.
class Nonsense final : public DriveSource {
 public:
  std::optional<DriveAmplitude> next_amplitude(std::size_t /*plant*/,
                                               double /*mean_friction*/) override {
    return DriveAmplitude{std::numeric_limits<double>::quiet_NaN()};
  }
};

TEST(DrivenPlants, ADriveThatIsNoNumberEndsTheRun) {
  Nonsense nonsense;
  EXPECT_EQ(run_driven_plants(begun(table_1_sweep(2)), nonsense)[0], RunStatus::not_finite);
}

}  // namespace
}  // namespace sonoglide::batch::driven_plants_test
