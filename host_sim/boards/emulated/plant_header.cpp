#include "host_sim/boards/emulated/controller_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmware/friction/dahl.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/strang/fixed_point_strang_design.hpp"
#include "host_sim/boards/emulated/initialiser.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/plant_model.hpp"
#include "host_sim/loop/control/sensor.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/plant/plant_description.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/scene/bound.hpp"
#include "host_sim/scene/names.hpp"

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
  require(!sensor.samples_per_period, "sensor.samples_per_period", ideal + "remove it");
  require(sensor.delay_periods == 0, "sensor.delay_periods", ideal + "allowed: 0");
  require(sensor.force_offset_N == 0.0, "sensor.force_offset_N", ideal + "allowed: 0");
  require(sensor.force_gain == 1.0, "sensor.force_gain", ideal + "allowed: 1");
  require(sensor.velocity_offset_m_per_s == 0.0, "sensor.velocity_offset_m_per_s",
          ideal + "allowed: 0");
  require(!sensor.velocity_bits, "sensor.velocity_bits", ideal + "remove it");
  require(sensor.velocity_gain == 1.0, "sensor.velocity_gain", ideal + "allowed: 1");
}

std::uint64_t whole_periods(const scene::Scene& scene) {
  const loop::CarrierGrid grid(scene);
  const std::uint64_t periods = grid.is_whole(grid.count() - 1) ? grid.count() : grid.count() - 1;
  constexpr std::uint32_t most = 0xffffffff;
  require(periods <= most, "run.duration_s",
          fmt::format("has more carrier periods than an image counts; allowed: at most {} of "
                      "them, {} s",
                      most, scene::at_most(most * grid.period_s())));
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
  std::int32_t sliding_code;
  plant::State<double> initial;
  int latency_periods;  ///< of the drive

  SceneNumbers(const scene::Scene& scene, const configure::ControlScales& scales_of_codes)
      : plant(scene), codes(scales_of_codes), latency_periods(scene.drive->delay_periods) {
    const double sliding_m_per_s = constant_sliding_m_per_s(scene.sliding);
    const scene::PlantScales& scales = plant.scales;
    sliding_velocity = sliding_m_per_s / scales.velocity_m_per_s();
    full_drive = codes.drive_amplitude_N / scales.force_N;
    sliding_code = loop::Sensor(scene.sensor, codes).sample(0.0, sliding_m_per_s).sliding_velocity;
    initial = configure::initial_state(scene, scales);
  }
};

template <class Scalar, template <class> class Damping>
using ModelOf =
    plant::Model<friction::Dahl<Scalar>, Damping<Scalar>, plant::CosineDrive, plant::LinearSliding>;

template <class Scalar, template <class> class Damping>
ModelOf<Scalar, Damping> plant_model(const SceneNumbers& scene) {
  return configure::plant_model<Scalar, Damping, plant::CosineDrive, plant::LinearSliding>(
      std::get<scene::laws::Dahl>(scene.plant.scene.friction.law), scene.plant.scene.friction,
      scene.plant.scales, scene.plant.numbers);
}

/// A float plant's number.
std::string number(double value) {
  return Initialiser<float>::of(numeric::from_real<float>(value));
}

std::string number(float value) {
  return number(static_cast<double>(value));
}

std::string damping_type(const plant::Undamped<float>& /*damping*/) {
  return "Undamped";
}
std::string damping_type(const plant::Damped<float>& /*damping*/) {
  return "Damped";
}
std::string damping_number(const plant::Undamped<float>& /*damping*/) {
  return "";
}
std::string damping_number(const plant::Damped<float>& damping) {
  return number(damping.damping);
}

/// As plant::Model is initialised.
template <class Model>
std::string model_number(const Model& model) {
  return fmt::format("{{{{{{{}}}, {}, {}}}, {{{}}}, {}}}", number(model.law.contact_stiffness),
                     number(model.friction_force), number(model.vibration_sign),
                     damping_number(model), number(model.stiffness));
}

template <template <class> class Damping>
PlantText float_plant(const SceneNumbers& scene) {
  const ModelOf<float, Damping> model = plant_model<float, Damping>(scene);
  return {
      R"(#include "firmware/friction/dahl.hpp"
#include "firmware/plant/contact.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/strang/equal_step_strang.hpp"
#include "firmware/image/plant/plant_board.hpp"
)",
      fmt::format(
          R"(using PlantModel = plant::Model<friction::Dahl<float>, plant::{}<float>, plant::CosineDrive>;
using PlantBoard = image::PlantBoard<plant::EqualStepStrang<PlantModel>, {}>;

inline constexpr PlantBoard::Parameters plant_parameters{{
    {},  // contact, damping, stiffness
    {},  // step, {} to a carrier period
    {{{}, {}, {}}},  // initial
    {},  // full_drive
    {},  // force_per_friction
    {},  // sliding_velocity
    {},  // sliding_code
}};
)",
          damping_type(model), scene.latency_periods, model_number(model),
          number(numeric::two_pi / steps_per_period), steps_per_period,
          number(scene.initial.displacement), number(scene.initial.velocity),
          number(scene.initial.friction), number(scene.full_drive),
          number(scene.plant.scales.friction_N / (numeric::two_pi * scene.codes.force_N)),
          number(scene.sliding_velocity), scene.sliding_code)};
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

template <template <class> class Damping>
plant::FixedStrangParameters designed(const SceneNumbers& scene) {
  const plant::FixedStrangDesign design = plant::design_fixed_strang(
      plant_model<double, Damping>(scene), scene.full_drive, scene.sliding_velocity, scene.initial);
  if (design.refusal != plant::FixedStrangRefusal::none) {
    refuse(design.refusal);
  }
  return design.parameters;
}

using DrivenRows = decltype(plant::FixedStrangParameters::driven);

/// Visits the parameters of the solver: a line for each, a table's a row each.
struct SolverLines {
  std::string text;

  template <class Field>
  void operator()(const char* name, const Field& field) {
    text += fmt::format("        {},  // {}\n", Initialiser<std::int32_t>::of(field), name);
  }

  void operator()(const char* name, const DrivenRows& rows) {
    text += "        {{\n";
    for (const auto& row : rows) {
      text += fmt::format("         {},\n", Initialiser<std::int32_t>::of(row));
    }
    text += fmt::format("        }}}},  // {}\n", name);
  }
};

template <template <class> class Damping>
PlantText fixed_plant(const SceneNumbers& scene) {
  const double force_per_friction = scene.plant.scales.friction_N / scene.codes.force_N;
  require(force_per_friction < 1.0, "sensor.force_full_scale_N",
          fmt::format("is not above the friction force; allowed: above {} N",
                      scene::at_least(scene.plant.scales.friction_N)));
  const plant::FixedStrangParameters parameters = designed<Damping>(scene);
  SolverLines solver;
  plant::FixedStrangParameters::fields(parameters, solver);
  return {
      R"(#include "firmware/image/plant/fixed_plant_board.hpp"
)",
      fmt::format(R"(using PlantBoard = image::FixedPlantBoard<{}>;

inline constexpr PlantBoard::Parameters plant_parameters{{
    {{
{}    }},
    {},  // force_per_friction
    {},  // sliding_code
}};
)",
                  scene.latency_periods, solver.text,
                  std::lround(std::ldexp(force_per_friction, 26)), scene.sliding_code)};
}

PlantText plant_text(const SceneNumbers& scene, scene::Arithmetic arithmetic) {
  const bool damped = scene.plant.numbers.damping > 0.0;
  switch (arithmetic) {
    case scene::Arithmetic::float32:
      return damped ? float_plant<plant::Damped>(scene) : float_plant<plant::Undamped>(scene);
    case scene::Arithmetic::q31:
      return damped ? fixed_plant<plant::Damped>(scene) : fixed_plant<plant::Undamped>(scene);
    case scene::Arithmetic::float64:
    case scene::Arithmetic::q15:
      break;
  }
  throw configure::ConfigurationError(
      "plant", fmt::format("{} is not for the plant of an image; allowed: float32, q31",
                           scene::name_of(scene::arithmetics, arithmetic)));
}

}  // namespace

std::string plant_header(const configure::Experiment& experiment, scene::Arithmetic arithmetic) {
  const scene::Scene& scene = experiment.plant;
  require(experiment.design.has_value(), "controller",
          "missing; required: a table [controller], of which an image is made");
  require(scene::is<scene::laws::Dahl>(scene.friction.law), "friction.law",
          "the plant of an image has Dahl friction; allowed: \"dahl\"");
  require(
      !scene.load, "load",
      "the plant of an image slides at a velocity that is given; required: a table [sliding] in "
      "its place");
  const char* key = scene.profile_key();
  require(key == nullptr, key,
          "changes, but the plant of an image does not; allowed: a constant value in place of a "
          "profile");
  require(scene.drive->waveform == scene::Waveform::cosine, "drive.waveform",
          "the plant of an image is driven by a cosine; allowed: \"cosine\"");
  require(scene.drive->interpolation == scene::Interpolation::step, "drive.interpolation",
          "the plant of an image holds the amplitude over a carrier period; allowed: \"step\"");
  require(!scene.drive->bits, "drive.bits",
          "the plant of an image takes the amplitude as it is; remove it");
  require(scene.drive->bias_limit_N == 0.0, "drive.bias_limit_N",
          "the plant of an image has no bias force; allowed: 0");
  require(
      !scene.sensor.vibration, "controller.vibration",
      "the plant of an image shows no vibration, and its drive has one frequency; allowed: a scene "
      "without this key");
  require(!scene.controller->texture, "controller.target_texture",
          "the plant of an image runs with target steps; allowed: target_friction_ratio or "
          "target_friction_force_N");
  require(scene.controller->every_periods == 1, "controller.every_periods",
          "the plant of an image waits for a step in each carrier period; allowed: 1");
  require_ideal(scene.sensor);
  const PlantText text = plant_text(SceneNumbers(scene, experiment.design->scales), arithmetic);
  return fmt::format(
      R"(/// The plant of the scene {}. Written by sonoglide configure: edit the scene.
#pragma once


{}
namespace sonoglide::app::configuration {{

{}inline constexpr std::uint32_t plant_periods = {};

}}  // namespace sonoglide::app::configuration
)",
      process::printable(scene.name), text.includes, text.definitions, whole_periods(scene));
}

}  // namespace sonoglide::emulated
