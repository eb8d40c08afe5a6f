// Plant and controller in one image, on every emulated board: the same samples and the same
// commands as on the workstation, bit for bit. What they cost is printed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "firmware/friction/dahl.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/strang/equal_step_strang.hpp"
#include "firmware/plant/strang/fixed_point_strang.hpp"
#include "firmware/plant/strang/fixed_point_strang_design.hpp"
#include "hal/trace_hash.hpp"
#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/boards/emulated/image.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/control_run.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/plant/plant_description.hpp"
#include "host_sim/process/child_process.hpp"
#include "tested_boards.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::plant_image_test {
namespace {

using tests::two_pi;

/// The controller of a scene, with what it gets and answers hashed.
class HashedControl final : public loop::ControlPort {
 public:
  explicit HashedControl(const scene::Scene& scene)
      : port_(loop::make_control_port(scene, configure::design_control(scene))),
        amplitudes_(static_cast<std::size_t>(scene.drive->delay_periods) + 1, 0) {}

  void set_target(double friction_ratio) override { port_->set_target(friction_ratio); }
  hal::Drive exchange(const hal::Sample& sample) override {
    samples_.add(sample);
    const hal::Drive drive = port_->exchange(sample);
    amplitudes_.push_back(drive.amplitude);
    return drive;
  }
  std::vector<numeric::SignalRecord> signals() const override { return {}; }

  /// In force in a carrier period: of the answers so far, after the drive's delay.
  std::int32_t amplitude(std::size_t period) const { return amplitudes_.at(period); }
  std::uint64_t sample_hash() const { return samples_.value(); }

 private:
  std::unique_ptr<loop::ControlPort> port_;
  hal::TraceHash samples_;
  std::vector<std::int32_t> amplitudes_;
};

/// A carrier period of a plant that is not the simulation's.
struct LivedPeriod {
  double reading;  ///< of the force sensor, on its full scale
  double friction_ratio;
};

float number(double value) {
  return static_cast<float>(value);
}

class FloatPlant {
 public:
  explicit FloatPlant(const scene::Scene& scene) {
    const loop::PlantDescription described(scene);
    const configure::ControlScales codes = configure::design_control(scene).scales;
    const configure::PlantNumbers& numbers = described.numbers;
    solver_.configure({{{number(numbers.contact_stiffness)},
                        number(numbers.friction_force),
                        number(configure::vibration_sign(scene.friction.sign_convention))},
                       {},
                       number(numbers.stiffness)},
                      number(two_pi / 8.0));
    sliding_ = number(scene.sliding.profile.front().velocity_m_per_s /
                      described.scales.velocity_m_per_s());
    full_drive_ = number(codes.drive_amplitude_N / described.scales.force_N);
    force_ = number(described.scales.friction_N / (two_pi * codes.force_N));
  }

  LivedPeriod advance(std::int32_t amplitude) {
    plant::MeanFriction<float> account;
    plant::NoObserver nobody;
    const plant::Interval<float> period{
        0.0F, number(two_pi), full_drive_ * numeric::from_code<float>(amplitude), sliding_, 0.0F};
    EXPECT_EQ(solver_.advance(period, state_, account, nobody).error, plant::Error::none);
    const float reading = force_ * account.friction_integral;
    return {static_cast<double>(reading), static_cast<double>(account.friction_integral) / two_pi};
  }

 private:
  using Model = plant::Model<friction::Dahl<float>, plant::Undamped<float>, plant::CosineDrive>;

  plant::EqualStepStrang<Model> solver_;
  plant::State<float> state_;
  float sliding_;
  float full_drive_;
  float force_;
};

class FixedPlant {
 public:
  explicit FixedPlant(const scene::Scene& scene) : plant_(parameters(scene)) {
    EXPECT_EQ(scene.sensor.force_full_scale_N, 2.0 * scene.friction.limit_N());
  }

  LivedPeriod advance(std::int32_t amplitude) {
    const double friction = static_cast<double>(plant_.advance(amplitude)) * 0x1p-36;
    EXPECT_EQ(plant_.saturations(), 0U);
    // As a code already: the way through newtons could turn a tie.
    return {numeric::from_code<double>(numeric::to_code(0.5 * friction)), friction};
  }

 private:
  static plant::FixedStrangParameters parameters(const scene::Scene& scene) {
    const loop::PlantDescription described(scene);
    const configure::PlantNumbers& numbers = described.numbers;
    using Model = plant::Model<friction::Dahl<double>, plant::Undamped<double>, plant::CosineDrive>;
    const Model model{{{numbers.contact_stiffness},
                       numbers.friction_force,
                       configure::vibration_sign(scene.friction.sign_convention)},
                      {},
                      numbers.stiffness};
    const plant::FixedStrangDesign design = plant::design_fixed_strang(
        model, scene.max_drive_force_N() / described.scales.force_N,
        scene.sliding.profile.front().velocity_m_per_s / described.scales.velocity_m_per_s(), {});
    EXPECT_EQ(design.refusal, plant::FixedStrangRefusal::none);
    return design.parameters;
  }

  plant::FixedStrang plant_;
};

struct ClosedLoop {
  std::uint64_t trace_hash = 0;
  std::uint64_t sample_hash = 0;
  std::vector<double> friction_ratios;
};

/// The closed loop of a scene with another plant, composed from the scene itself: nothing here has
/// seen a configured header, and sensor, targets and controller are the simulation's.
template <class Plant>
ClosedLoop closed_loop(const scene::Scene& scene, Plant plant) {
  loop::ControlRecord record;
  record.design = configure::design_control(scene);
  const loop::CarrierGrid grid(scene);
  HashedControl control(scene);
  loop::ControlRun run(scene, grid, control, record);
  ClosedLoop result;
  for (std::uint64_t k = 0; k < grid.count(); ++k) {
    const LivedPeriod period = plant.advance(control.amplitude(k));
    run.step(grid.end_s(k), period.reading * record.design.scales.force_N,
             scene.sliding.profile.front().velocity_m_per_s);
    result.friction_ratios.push_back(period.friction_ratio);
  }
  run.finish();
  result.trace_hash = record.trace_hash;
  result.sample_hash = control.sample_hash();
  return result;
}

scene::Scene scene_of(const std::string& controller) {
  return experiment::read_file(SONOGLIDE_CONTROLLERS "/" + controller + "/scene.toml").plant;
}

ClosedLoop closed_loop_of(const std::string& controller) {
  const scene::Scene scene = scene_of(controller);
  return controller == "target_step_fixed" ? closed_loop(scene, FixedPlant(scene))
                                           : closed_loop(scene, FloatPlant(scene));
}

/// What an image says, by name; numbers as it writes them.
std::map<std::string, std::string> words_of(const emulated::EmulatedBoard& board,
                                            const std::string& image) {
  std::istringstream output(process::run_tool(emulated::emulator_command(board, image)));
  std::map<std::string, std::string> words;
  for (std::string name, value; output >> name >> value;) {
    words[name] = value;
  }
  return words;
}

std::string hexadecimal(std::uint64_t value) {
  std::ostringstream text;
  text.fill('0');
  text.width(16);
  text << std::hex << value;
  return text.str();
}

/// (board, controller)
class PlantImage : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  const emulated::EmulatedBoard& board_ = *emulated::find_board(std::get<0>(GetParam()));
  std::string controller_ = std::get<1>(GetParam());
  std::string image_ =
      SONOGLIDE_IMAGES "/" + std::get<0>(GetParam()) + "/bin/" + controller_ + "_plant.elf";
};

TEST_P(PlantImage, SamplesAndDrivesAsTheWorkstationBitForBit) {
  const ClosedLoop expected = closed_loop_of(controller_);
  auto words = words_of(board_, image_);
  EXPECT_EQ(words["periods"], std::to_string(expected.friction_ratios.size()));
  EXPECT_EQ(words["trace_hash"], hexadecimal(expected.trace_hash));
  EXPECT_EQ(words["sample_hash"], hexadecimal(expected.sample_hash));
}

TEST_P(PlantImage, CostsTheSameInEveryRun) {
  auto words = words_of(board_, image_);
  EXPECT_EQ(words_of(board_, image_), words);
  const auto mean = [&](const std::string& side) {
    return std::lround(std::stod(words[side + "_counts_sum"]) / std::stod(words["periods"]) /
                       board_.counts_per_instruction);
  };
  const emulated::ImageCost cost = emulated::measure_image(image_, board_);
  std::cout << board_.name << ' ' << controller_ << ": " << mean("plant")
            << " instructions of plant and " << mean("controller")
            << " of controller in a carrier period, " << cost.size.flash_bytes << " B flash, "
            << cost.size.ram_bytes << " B static RAM, "
            << (cost.stack.unbounded_by.empty() ? std::to_string(cost.stack.bytes) : "no known")
            << " B stack\n";
  EXPECT_GT(mean("controller"), 100);
  EXPECT_GT(mean("plant"), mean("controller"));
}

INSTANTIATE_TEST_SUITE_P(Boards, PlantImage,
                         testing::Combine(testing::ValuesIn(emulated::tested_boards()),
                                          testing::Values("target_step", "target_step_q31",
                                                          "target_step_fixed")),
                         [](const auto& parameter) {
                           std::string name = std::get<0>(parameter.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name + "_" + std::get<1>(parameter.param);
                         });

TEST(PlantInAnImageTest, KeepsTheFrictionRatioOfTheScenesOwnPlant) {
  for (const char* controller : {"target_step", "target_step_fixed"}) {
    const ClosedLoop image = closed_loop_of(controller);
    const loop::LoggedRun simulated = loop::run_logged(scene_of(controller));
    ASSERT_EQ(image.friction_ratios.size(), simulated.periods.size());
    for (std::size_t k = 0; k < simulated.periods.size(); ++k) {
      EXPECT_NEAR(image.friction_ratios[k], simulated.periods[k].friction_ratio, 5e-4)
          << controller << ", carrier period " << k;
    }
  }
}

std::string refused_key(const scene::Scene& scene,
                        scene::Arithmetic arithmetic = scene::Arithmetic::float32) {
  try {
    emulated::plant_header(configure::make_experiment(scene), arithmetic);
  } catch (const configure::ConfigurationError& error) {
    return error.key();
  }
  return "";
}

TEST(PlantHeaderTest, IsRefusedWithTheKeyThatAnImageCannotFollow) {
  const scene::Scene allowed = scene_of("target_step");
  EXPECT_EQ(refused_key(allowed), "");
  scene::Scene scene = allowed;
  scene.controller.reset();
  EXPECT_EQ(refused_key(scene), "controller");
  scene = allowed;
  scene.friction.law = scene::laws::Coulomb{};
  EXPECT_EQ(refused_key(scene), "friction.law");
  scene = allowed;
  scene.sliding.profile.push_back({1e-3, 0.05});
  EXPECT_EQ(refused_key(scene), "sliding.profile");
  scene = allowed;
  scene.sensor.adc_bits = 12;
  EXPECT_EQ(refused_key(scene), "sensor.adc_bits");
  scene = allowed;
  scene.sensor.force_noise_N = 1e-4;
  EXPECT_EQ(refused_key(scene), "sensor.force_noise_N");
  scene = allowed;
  scene.sensor.force_bandwidth_Hz = 5e3;
  EXPECT_EQ(refused_key(scene), "sensor.force_bandwidth_Hz");
  scene = allowed;
  scene.sensor.delay_periods = 1;
  EXPECT_EQ(refused_key(scene), "sensor.delay_periods");
  EXPECT_EQ(refused_key(allowed, scene::Arithmetic::float64), "plant");
}

TEST(PlantHeaderTest, IsRefusedWhereTheIntegersEnd) {
  const auto q31 = scene::Arithmetic::q31;
  const scene::Scene allowed = scene_of("target_step");
  EXPECT_EQ(refused_key(allowed, q31), "");
  scene::Scene scene = allowed;
  scene.plant.stiffness_N_per_m *= 50.0;
  EXPECT_EQ(refused_key(scene, q31), "plant.stiffness_N_per_m");
  scene = allowed;
  scene.friction.contact_stiffness_N_per_m *= 1000.0;
  EXPECT_EQ(refused_key(scene, q31), "friction.contact_stiffness_N_per_m");
}

}  // namespace
}  // namespace sonoglide::plant_image_test
