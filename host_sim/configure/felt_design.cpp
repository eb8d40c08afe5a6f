#include "host_sim/configure/felt_design.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdlib>
#include <limits>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/damped_design.hpp"
#include "host_sim/configure/friction_response.hpp"
#include "host_sim/configure/mode_model.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::configure {
namespace {

namespace felt = control::felt;
using Complex = std::complex<double>;

bool slides_backwards(const scene::Sliding& sliding) {
  return std::any_of(sliding.profile.begin(), sliding.profile.end(),
                     [](const auto& point) { return point.velocity_m_per_s < 0.0; });
}

void require_feeling(const scene::Scene& scene) {
  if (!scene::vibrates_along(scene.friction.law)) {
    throw ConfigurationError(
        "friction.law",
        fmt::format("\"{}\" does not show the vibration along the sliding; allowed with "
                    "controller.vibration = \"damped\" and no sensor.vibration: a law of "
                    "longitudinal vibration",
                    scene::name_of(scene.friction.law)));
  }
  const auto& profile = scene.sliding.profile;
  const bool forwards = std::any_of(profile.begin(), profile.end(),
                                    [](const auto& point) { return point.velocity_m_per_s > 0.0; });
  if (forwards && slides_backwards(scene.sliding)) {
    throw ConfigurationError(
        "sliding.profile",
        "turns, and the natural mode shows itself differently in the friction of either direction; "
        "allowed: one direction, or a sensor.vibration with controller.vibration = \"damped\"");
  }
}

/// What is the same for every place in the table.
struct Felt {
  double speed = 0.0;     ///< fastest |Vt|, per unit
  double lambda = 0.0;    ///< Kt Vt/(ω Fc); infinite for Coulomb friction
  double sign = 1.0;      ///< of the vibration in the velocity along the sliding
  double noise = 0.0;     ///< of a sharpened ratio, rms
  double doubtful = 0.0;  ///< by how much sharpening lifts what the model has wrong
  ReadingChain chain;

  VibratedContact contact(double ratio, double phase) const {
    return {ratio, lambda / ratio, phase};
  }
};

constexpr double slower_rise = 0.85;     // of the amplitude: what it kicks is not yet known
constexpr double largest_ratio = 0.985;  // of a node; at 1 the friction ratio has no slope

ReadingChain chain_of(const scene::Sensor& sensor, double period_s) {
  ReadingChain chain;
  if (sensor.force_bandwidth_Hz) {
    const double periods = numeric::two_pi * *sensor.force_bandwidth_Hz * period_s;
    chain.fade = numeric::exp(-periods);
    chain.fresh = 1.0 + numeric::expm1(-periods) / periods;
    chain.old = 1.0 - chain.fade - chain.fresh;
  }
  return chain;
}

/// Rms of a measured ratio.
double reading_noise(const scene::Sensor& sensor, double friction_N) {
  const double code_N =
      sensor.adc_bits ? 2.0 * sensor.force_full_scale_N * std::exp2(-*sensor.adc_bits) : 0.0;
  const double noise_N = sensor.force_noise_N;
  return numeric::sqrt(noise_N * noise_N + code_N * code_N / 12.0) / friction_N;
}

Felt felt_of(const scene::Scene& scene, const BelievedPlant& plant, double velocity_m_per_s) {
  const double period_s = 1.0 / scene.drive->frequency_Hz;
  const double speed_m_per_s = fastest_sliding_m_per_s(scene.sliding);
  Felt felt;
  felt.speed = speed_m_per_s / velocity_m_per_s;
  const bool dahl = scene::friction_map(scene.friction.law) == scene::FrictionMap::dahl;
  felt.lambda = dahl ? plant.contact_stiffness_N_per_m * speed_m_per_s * period_s /
                           (numeric::two_pi * plant.friction_N)
                     : std::numeric_limits<double>::infinity();
  const bool backwards = slides_backwards(scene.sliding);
  felt.sign = (backwards ? -1.0 : 1.0) * vibration_sign(scene.friction.sign_convention);
  felt.chain = chain_of(scene.sensor, period_s);
  constexpr double usual_ratio = 0.6;
  constexpr double short_memory = 0.1;
  constexpr double longest_memory = 0.9;  // more would make too much of noise
  const double memory = friction_response(felt.contact(usual_ratio, 0.0)).memory;
  felt.chain.contact_memory = memory > short_memory ? std::min(memory, longest_memory) : 0.0;
  felt.noise = reading_noise(scene.sensor, plant.friction_N);
  felt.doubtful = 1.0;
  constexpr double lifted = 0.2;
  for (const double kept : {felt.chain.fade, felt.chain.contact_memory}) {
    felt.noise *= numeric::sqrt(1.0 + kept * kept) / (1.0 - kept);
    felt.doubtful *= 1.0 + lifted * kept / (1.0 - kept);
  }
  return felt;
}

/// Re(c w) of a phasor w in its two parts.
Eigen::RowVector2d row_of(Complex c) {
  return {c.real(), -c.imag()};
}

/// A model with a mode that is seen in a reading.
struct Place {
  ModeModel model;
  Complex rate;          ///< of its free motion, per period
  Eigen::Matrix2d back;  ///< the mode a period before
  double phase = 0.0;    ///< of the steady vibration, along the sliding
};

Place place_of(const Resonator& resonator, double sign) {
  Place place;
  place.model = mode_model(resonator);
  const double decay = 0.5 * resonator.damping;
  place.rate = {-decay, numeric::sqrt(resonator.stiffness - decay * decay)};
  place.back = place.model.turn.inverse();
  const Eigen::Vector2d forced = sign * place.model.forced;
  const double angle = numeric::acos(std::clamp(forced(0) / forced.norm(), -1.0, 1.0));
  place.phase = forced(1) < 0.0 ? -angle : angle;
  return place;
}

struct Node {
  Eigen::RowVector2d seen;
  double last_change;
  double change_before;
};

Node node_of(const Place& place, double ratio, const Felt& felt) {
  const ReadingResponse response =
      reading_response(felt.contact(ratio, place.phase), place.rate, felt.chain);
  const double forced = place.model.forced.norm();
  // A mode that dies within a period is not worth a look.
  constexpr double fading = 1.0;
  if (-place.rate.real() > fading) {
    return {Eigen::RowVector2d::Zero(), -forced * (response.forced[1] + response.forced[2]),
            -forced * response.forced[2]};
  }
  const Eigen::RowVector2d earlier = felt.sign * row_of(response.mode[2]) * place.back;
  const Eigen::RowVector2d before = (felt.sign * row_of(response.mode[1]) + earlier) * place.back;
  return {felt.sign * row_of(response.mode[0]) + before,
          -before * place.model.kick - forced * (response.forced[1] + response.forced[2]),
          -earlier * place.model.kick - forced * response.forced[2]};
}

/// Rms of a reading, per sliding velocity.
double noise_of(double ratio, const Felt& felt) {
  constexpr double rest = 0.001;  // of the velocity: map and contact, in a settled loop
  // Of Coulomb friction: a velocity per ratio, per sliding velocity.
  const double steepness =
      0.25 * numeric::two_pi * numeric::sqrt(1.0 - ratio * ratio) / (ratio * ratio);
  const double model = rest * felt.doubtful / ratio;
  const double sensor = felt.noise * steepness;
  return numeric::sqrt(model * model + sensor * sensor);
}

double ratio_of_node(std::size_t index) {
  return std::min(largest_ratio, static_cast<double>(index + 1) / static_cast<double>(felt::nodes));
}

void put_node(const Place& place, std::size_t index, const Felt& felt,
              control::FeltRow<double>& row) {
  const double ratio = ratio_of_node(index);
  const Node node = node_of(place, ratio, felt);
  double* const numbers = &row[felt::plain + index * felt::per_node];
  numbers[felt::seen] = node.seen(0);
  numbers[felt::seen + 1] = node.seen(1);
  numbers[felt::last_change] = node.last_change;
  numbers[felt::change_before] = node.change_before;
  numbers[felt::noise] = felt.speed * noise_of(ratio, felt);
}

/// A mode next to zero or to a multiple of the carrier costs what the friction shows of it, and a little
/// of its own: a slow one acts as another sliding speed, which the vibration at the carrier hardly
/// shows.
Eigen::RowVector3d feedback_of(const Place& place, const Felt& felt) {
  const ModeModel& model = place.model;
  if (is_quick(model)) {
    Eigen::RowVector3d feedback = feedback_of(model, vibration_error(model));
    feedback(2) *= slower_rise;
    return feedback;
  }
  constexpr double usual_ratio = 0.7;
  constexpr double own = 0.2;
  Felt bare = felt;
  bare.chain = {};
  Eigen::RowVector3d shown;
  shown << node_of(place, usual_ratio, bare).seen, model.forced.norm();
  Eigen::Matrix3d error = shown.transpose() * shown;
  error.topLeftCorner<2, 2>() += own * model.square;
  return feedback_of(model, error);
}

/// A row stands for the modes as far as the next rows: the mean of theirs, each with the part that the
/// row has in what is interpolated there. Next to half a turn in a period a change of the amplitude
/// moves one part of the mode, and the feedback of the other part changes its sign within a fraction of
/// a row.
Eigen::RowVector3d feedback_around(const Resonator& resonator, double spacing, const Felt& felt) {
  constexpr int parts = 8;
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (int part = 1 - parts; part < parts; ++part) {
    Resonator near = resonator;
    near.stiffness += spacing * part / parts;
    sum += (parts - std::abs(part)) * feedback_of(place_of(near, felt.sign), felt);
  }
  return sum / (parts * parts);
}

/// @param spacing  of the rows, a difference of the stiffness
control::FeltRow<double> row_of(const Resonator& resonator, double spacing, const Felt& felt) {
  const Place place = place_of(resonator, felt.sign);
  const ModeModel& model = place.model;
  const double forced = model.forced.norm();
  const Eigen::RowVector3d feedback = feedback_around(resonator, spacing, felt);
  control::FeltRow<double> row{};
  row[felt::turn] = model.turn(0, 0);
  row[felt::turn + 1] = model.turn(1, 0);
  row[felt::kick] = model.kick(0);
  row[felt::kick + 1] = model.kick(1);
  row[felt::forced] = forced;
  row[felt::feedback] = feedback(0);
  row[felt::feedback + 1] = feedback(1);
  row[felt::feedback + 2] = feedback(2);
  row[felt::per_velocity] = 1.0 / forced;
  const double angle = 0.5 * spacing / place.rate.imag();
  row[felt::bend] = 0.5 * angle * angle;
  for (std::size_t i = 0; i < felt::nodes; ++i) {
    put_node(place, i, felt, row);
  }
  return row;
}

/// The mode turns so little in a period, against zero or a multiple of the carrier, that it cannot be
/// told from the vibration. A mode next to a multiple that dies within 20 periods is told by that.
bool is_one_with_vibration(const Resonator& resonator) {
  constexpr double apart = 1.0 / 192.0;
  constexpr double decay = 0.05;
  const double turns = numeric::sqrt(resonator.stiffness) / numeric::two_pi;
  const double nearest = std::round(turns);
  return nearest != 1.0 && std::abs(turns - nearest) < apart &&
         (nearest == 0.0 || 0.5 * resonator.damping < decay);
}

/// By how much the stiffness may be off until a mode is next to zero or a multiple of the carrier,
/// where it is hardly quieted; relative.
double multiple_range(const Resonator& resonator) {
  constexpr double beside = 0.06;
  const double turns = numeric::sqrt(resonator.stiffness) / numeric::two_pi;
  const double nearest = std::round(turns);
  return nearest == 1.0 ? 1.0 : 2.0 * (std::abs(turns - nearest) - beside) / turns;
}

/// Of such a mode: it rings with the drive, so what it adds counts as a gain. The first row has the
/// steady vibration alone, the last one a mode that rings with 1.2 times its displacement.
control::FeltTable<double> table_of_gains(const Resonator& resonator, const Felt& felt) {
  constexpr double largest = 1.2;
  const double turns = numeric::sqrt(resonator.stiffness) / numeric::two_pi;
  const double gain = std::max(1.0, largest * numeric::sqrt(1.0 + turns * turns));
  static_assert(felt::rows == 9);
  const double step = numeric::sqrt(numeric::sqrt(numeric::sqrt(gain)));
  double forced = mode_model(resonator).forced.norm();
  control::FeltTable<double> table{};
  for (control::FeltRow<double>& row : table) {
    row[felt::turn] = 1.0;
    row[felt::forced] = forced;
    forced *= step;
    row[felt::feedback + 2] = slower_rise;
    row[felt::per_velocity] = 1.0 / row[felt::forced];
    for (std::size_t node = 0; node < felt::nodes; ++node) {
      row[felt::plain + node * felt::per_node + felt::noise] =
          felt.speed * noise_of(ratio_of_node(node), felt);
    }
  }
  return table;
}

control::FeltTable<double> table_of(const Resonator& lowest, double spacing, const Felt& felt) {
  control::FeltTable<double> table{};
  for (std::size_t i = 0; i < felt::rows; ++i) {
    Resonator resonator = lowest;
    resonator.stiffness += static_cast<double>(i) * spacing;
    table[i] = row_of(resonator, spacing, felt);
  }
  return table;
}

/// The table in multiples of a mode that leaves the kicks an eighth.
/// @return that mode; 1 where nothing kicks one
double scale_mode(control::FeltTable<double>& table) {
  double largest = 0.0;
  for (const control::FeltRow<double>& row : table) {
    largest = std::max({largest, std::abs(row[felt::kick]), std::abs(row[felt::kick + 1])});
  }
  const double unit = largest > 0.0 ? 8.0 * largest : 1.0;
  for (control::FeltRow<double>& row : table) {
    for (std::size_t i = 0; i < 2; ++i) {
      row[felt::kick + i] /= unit;
      row[felt::feedback + i] *= unit;
      for (std::size_t node = 0; node < felt::nodes; ++node) {
        double* const numbers = &row[felt::plain + node * felt::per_node];
        numbers[felt::seen + i] *= unit;
      }
    }
  }
  return unit;
}

}  // namespace

FeltDesign design_felt(const scene::Scene& scene, const BelievedPlant& plant,
                       double velocity_m_per_s) {
  require_mode(plant);
  require_feeling(scene);
  const double period_s = 1.0 / scene.drive->frequency_Hz;
  const double push = scene.drive->max_force_amplitude_N * plant.force_factor * period_s /
                      (plant.mass_kg * velocity_m_per_s);
  const Resonator middle{plant.stiffness_N_per_m / plant.mass_kg * period_s * period_s,
                         plant.damping_N_s_per_m / plant.mass_kg * period_s, push};
  const Felt felt = felt_of(scene, plant, velocity_m_per_s);
  FeltDesign design;
  design.stiffness_range = stiffness_range(middle.stiffness);
  constexpr double nearly_rad = 0.3;
  design.turn_range = 2.0 * nearly_rad / numeric::sqrt(middle.stiffness);
  design.multiple_range = multiple_range(middle);
  design.quick = is_quick(mode_model(middle));
  const double range = design.stiffness_range * middle.stiffness;
  const double spacing = 2.0 / (felt::rows - 1) * range;
  design.apart = !is_one_with_vibration(middle);
  Resonator lowest = middle;
  lowest.stiffness -= range;
  design.table = design.apart ? table_of(lowest, spacing, felt) : table_of_gains(middle, felt);
  constexpr double usual_ratio = 0.6;
  design.blur = usual_ratio * noise_of(usual_ratio, felt);
  design.speed = felt.speed;
  constexpr double nonlinear = 0.04;  // of friction under a mode
  constexpr double unknown = 0.12;    // of the angle by which the range turns a mode
  design.swing =
      nonlinear + unknown * 0.5 * design.stiffness_range * numeric::sqrt(middle.stiffness);
  design.mode_unit = scale_mode(design.table);
  const double linear = design.quick ? 0.5 : 0.2;
  design.linear = linear / design.mode_unit;
  design.sensor_memory = felt.chain.fade;
  design.contact_memory = felt.chain.contact_memory;
  design.backwards = slides_backwards(scene.sliding);
  design.delay_periods =
      static_cast<std::uint8_t>(scene.drive->delay_periods + scene.sensor.delay_periods);
  return design;
}

}  // namespace sonoglide::configure
