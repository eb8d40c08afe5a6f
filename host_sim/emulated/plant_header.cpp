#include "host_sim/emulated/plant_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmware/friction/dahl.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/strang/fixed_point_strang_design.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/emulated/float_number.hpp"
#include "host_sim/loop/carrier_grid.hpp"
#include "host_sim/loop/plant_description.hpp"
#include "host_sim/loop/sensor.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/text/printable.hpp"

namespace sonoglide::emulated {
namespace {

constexpr int steps_per_period = 8;

void require(bool allowed, const char* key, const std::string& finding) {
  if (!allowed) {
    throw configure::ConfigurationError(key, finding);
  }
}

double constant_sliding_m_per_s(const scene::Sliding& sliding) {
  const double velocity = sliding.profile.front().velocity_m_per_s;
  require(std::all_of(sliding.profile.begin(), sliding.profile.end(),
                      [&](const auto& point) { return point.velocity_m_per_s == velocity; }),
          "sliding.profile",
          "changes, but the plant of an image slides at one velocity; allowed: velocity_m_per_s");
  return velocity;
}

void require_ideal(const scene::Sensor& sensor) {
  const std::string ideal = "the sensor of a plant in an image is ideal; ";
  require(!sensor.adc_bits, "sensor.adc_bits", ideal + "remove it");
  require(sensor.force_noise_N == 0.0, "sensor.force_noise_N", ideal + "allowed: 0");
  require(!sensor.force_bandwidth_Hz, "sensor.force_bandwidth_Hz", ideal + "remove it");
  require(sensor.delay_periods == 0, "sensor.delay_periods", ideal + "allowed: 0");
  require(sensor.force_offset_N == 0.0, "sensor.force_offset_N", ideal + "allowed: 0");
  require(sensor.force_gain == 1.0, "sensor.force_gain", ideal + "allowed: 1");
  require(sensor.velocity_offset_m_per_s == 0.0, "sensor.velocity_offset_m_per_s",
          ideal + "allowed: 0");
  require(sensor.velocity_gain == 1.0, "sensor.velocity_gain", ideal + "allowed: 1");
}

std::uint64_t whole_periods(const scene::Scene& scene) {
  const loop::CarrierGrid grid(scene);
  const std::uint64_t periods = grid.is_whole(grid.count() - 1) ? grid.count() : grid.count() - 1;
  constexpr std::uint32_t most = 0xffffffff;
  require(periods <= most, "run.duration_s",
          fmt::format("has more carrier periods than an image counts; allowed: up to {:g} s",
                      most * grid.period_s()));
  return periods;
}

/// What a header is made of: where the plant is joined to the codes of the seam.
struct PlantText {
  std::string includes;
  std::string definitions;
};

struct SceneNumbers {
  loop::PlantDescription plant;
  configure::ControlScales codes;
  double sliding_velocity;  ///< in units of L ω
  double full_drive;        ///< in units of m L ω²
  double vibration_sign;    ///< +1 dissipative, −1 as printed
  std::int32_t sliding_code;
  plant::State<double> initial;
  int latency_periods;  ///< of the drive

  explicit SceneNumbers(const scene::Scene& scene)
      : plant(scene),
        codes(configure::design_control(scene).scales),
        vibration_sign(configure::vibration_sign(scene.friction.sign_convention)),
        latency_periods(scene.drive->delay_periods) {
    const double sliding_m_per_s = constant_sliding_m_per_s(scene.sliding);
    const scene::PlantScales& scales = plant.scales;
    sliding_velocity = sliding_m_per_s / scales.velocity_m_per_s();
    full_drive = codes.drive_amplitude_N / scales.force_N;
    sliding_code = loop::Sensor(scene.sensor, codes).sample(0.0, sliding_m_per_s).sliding_velocity;
    initial = configure::initial_state(scene, scales);
  }
};

PlantText float_plant(const SceneNumbers& scene) {
  const configure::PlantNumbers& numbers = scene.plant.numbers;
  const bool damped = numbers.damping > 0.0;
  return {
      R"(#include "firmware/friction/dahl.hpp"
#include "firmware/plant/contact.hpp"
#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/strang/equal_step_strang.hpp"
#include "hal/simulated/plant_board.hpp"
)",
      fmt::format(
          R"(using PlantModel = plant::Model<friction::Dahl<float>, plant::{}<float>, plant::CosineDrive>;
using PlantBoard = hal::simulated::PlantBoard<plant::Strang<PlantModel>, {}>;

inline constexpr PlantBoard::Parameters plant_parameters{{
    {{{{{{{}}}, {}, {}}}, {{{}}}, {}}},  // contact, damping, stiffness
    {},  // step, {} to a carrier period
    {{{}, {}, {}}},  // initial
    {},  // full_drive
    {},  // force_per_friction
    {},  // sliding_velocity
    {},  // sliding_code
}};
)",
          damped ? "Damped" : "Undamped", scene.latency_periods,
          float_number(numbers.contact_stiffness), float_number(numbers.friction_force),
          float_number(scene.vibration_sign), damped ? float_number(numbers.damping) : "",
          float_number(numbers.stiffness), float_number(numeric::two_pi / steps_per_period),
          steps_per_period, float_number(scene.initial.displacement),
          float_number(scene.initial.velocity), float_number(scene.initial.friction),
          float_number(scene.full_drive),
          float_number(scene.plant.scales.friction_N / (numeric::two_pi * scene.codes.force_N)),
          float_number(scene.sliding_velocity), scene.sliding_code)};
}

[[noreturn]] void refuse(plant::FixedStrangRefusal refusal) {
  using plant::FixedStrangRefusal;
  switch (refusal) {
    case FixedStrangRefusal::oscillator:
      throw configure::ConfigurationError(
          "plant.stiffness_N_per_m",
          "has a natural frequency or a damping that 32 steps in a carrier period do not "
          "follow in q31; allowed: the plant in float32");
    case FixedStrangRefusal::contact:
      throw configure::ConfigurationError(
          "friction.contact_stiffness_N_per_m",
          "is too stiff against the vibration for q31; allowed: the plant in float32");
    case FixedStrangRefusal::friction:
      throw configure::ConfigurationError(
          "friction.coefficient",
          "is too large against the inertia for q31; allowed: the plant in float32");
    case FixedStrangRefusal::range:
    case FixedStrangRefusal::none:
      break;
  }
  throw configure::ConfigurationError(
      "sliding.velocity_m_per_s",
      "or the initial state is out of the range of the vibration in "
      "q31; allowed: the plant in float32");
}

template <class Damping>
plant::FixedStrangParameters designed(const SceneNumbers& scene, const Damping& damping) {
  using Model = plant::Model<friction::Dahl<double>, Damping, plant::CosineDrive>;
  const configure::PlantNumbers& numbers = scene.plant.numbers;
  const Model model{{{numbers.contact_stiffness}, numbers.friction_force, scene.vibration_sign},
                    damping,
                    numbers.stiffness};
  const plant::FixedStrangDesign design =
      plant::design_fixed_strang(model, scene.full_drive, scene.sliding_velocity, scene.initial);
  if (design.refusal != plant::FixedStrangRefusal::none) {
    refuse(design.refusal);
  }
  return design.parameters;
}

std::string driven_rows(const plant::FixedStrangParameters& plant) {
  std::string rows;
  for (const auto& [displacement, velocity] : plant.driven) {
    rows += fmt::format("         {{{}, {}}},\n", displacement, velocity);
  }
  return rows;
}

PlantText fixed_plant(const SceneNumbers& scene) {
  const double damping = scene.plant.numbers.damping;
  const double force_per_friction = scene.plant.scales.friction_N / scene.codes.force_N;
  require(force_per_friction < 1.0, "sensor.force_full_scale_N",
          fmt::format("is not above the friction force; allowed: more than {:g} N",
                      scene.plant.scales.friction_N));
  const plant::FixedStrangParameters p = damping > 0.0
                                             ? designed(scene, plant::Damped<double>{damping})
                                             : designed(scene, plant::Undamped<double>{});
  const auto& g = p.growth;
  return {
      R"(#include "hal/simulated/fixed_plant_board.hpp"
)",
      fmt::format(R"(using PlantBoard = hal::simulated::FixedPlantBoard<{}>;

inline constexpr PlantBoard::Parameters plant_parameters{{
    {{
        {{{{{{{}, {}}}, {{{}, {}}}}}}},  // growth
        {{{{
{}        }}}},  // driven
        {},  // kick
        {},  // contact_stiffness
        {},  // step
        {},  // sliding_velocity
        {},  // sliding_travel
        {},  // side
        {{{}, {}, {}}},  // initial
    }},
    {},  // force_per_friction
    {},  // sliding_code
}};
)",
                  scene.latency_periods, g[0][0], g[0][1], g[1][0], g[1][1], driven_rows(p), p.kick,
                  p.contact_stiffness, p.step, p.sliding_velocity, p.sliding_travel, p.side,
                  p.initial[0], p.initial[1], p.initial[2],
                  std::lround(std::ldexp(force_per_friction, 26)), scene.sliding_code)};
}

PlantText plant_text(const SceneNumbers& scene, scene::Arithmetic arithmetic) {
  switch (arithmetic) {
    case scene::Arithmetic::float32:
      return float_plant(scene);
    case scene::Arithmetic::q31:
      return fixed_plant(scene);
    case scene::Arithmetic::float64:
    case scene::Arithmetic::q15:
      break;
  }
  throw configure::ConfigurationError(
      "plant", fmt::format("{} is not for the plant of an image; allowed: float32, q31",
                           scene::name_of(scene::arithmetics, arithmetic)));
}

}  // namespace

std::string plant_header(const scene::Scene& scene, scene::Arithmetic arithmetic) {
  require(scene.controller.has_value(), "controller",
          "missing; required: a table [controller], of which an image is made");
  require(scene::is<scene::laws::Dahl>(scene.friction.law), "friction.law",
          "the plant of an image has Dahl friction; allowed: \"dahl\"");
  require(!scene.friction.has_profile(), scene.friction.profile_key(),
          "changes, but the plant of an image has one friction; allowed: coefficient and "
          "normal_force_N");
  require(scene.drive->waveform == scene::Waveform::cosine, "drive.waveform",
          "the plant of an image is driven by a cosine; allowed: \"cosine\"");
  require_ideal(scene.sensor);
  const PlantText text = plant_text(SceneNumbers(scene), arithmetic);
  return fmt::format(
      R"(/// The plant of the scene {}. Written by sonoglide configure: edit the scene.
#pragma once

#include <cstdint>

{}
namespace sonoglide::app::configuration {{

{}inline constexpr std::uint32_t plant_periods = {};

}}  // namespace sonoglide::app::configuration
)",
      text::printable(scene.name), text.includes, text.definitions, whole_periods(scene));
}

}  // namespace sonoglide::emulated
