#include "host_sim/configure/vibration/sensorless_design.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdlib>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/vibration/mode_model.hpp"
#include "host_sim/configure/vibration/sensorless_reading.hpp"
#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::configure {
namespace {

using Index = control::SensorlessIndex;
using Complex = std::complex<double>;

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

constexpr double slower_rise = 0.85;  // of the amplitude: what it adds to the mode is not yet known
constexpr double largest_ratio = 0.985;  // of a node; at 1 the friction ratio has no slope

/// Re(c w) of a phasor w in its two parts.
Eigen::RowVector2d row_of(Complex c) {
  return {c.real(), -c.imag()};
}

/// A model with a mode that a reading shows.
struct ObservedMode {
  ModeModel model;
  Complex rate;          ///< of its free motion, per period
  Eigen::Matrix2d back;  ///< the mode a period before
  double phase = 0.0;    ///< of the steady vibration, along the sliding
};

ObservedMode observed_mode(const Resonator& resonator, double sign) {
  ObservedMode mode;
  mode.model = mode_model(resonator);
  const double decay = 0.5 * resonator.damping;
  mode.rate = {-decay, numeric::sqrt(resonator.stiffness - decay * decay)};
  mode.back = mode.model.rotation.inverse();
  const Eigen::Vector2d forced = sign * mode.model.forced;
  const double angle = numeric::acos(std::clamp(forced(0) / forced.norm(), -1.0, 1.0));
  mode.phase = forced(1) < 0.0 ? -angle : angle;
  return mode;
}

struct Node {
  Eigen::RowVector2d output;
  double last_change;
  double change_before;
};

Node node_of(const ObservedMode& mode, double ratio, const FrictionReading& reading) {
  const ReadingResponse response =
      reading_response(reading.contact(ratio, mode.phase), mode.rate, reading.chain);
  const double forced = mode.model.forced.norm();
  // A mode that dies within a period is not worth a look.
  constexpr double fading = 1.0;
  if (-mode.rate.real() > fading) {
    return {Eigen::RowVector2d::Zero(), -forced * (response.forced[1] + response.forced[2]),
            -forced * response.forced[2]};
  }
  const Eigen::RowVector2d earlier = reading.sign * row_of(response.mode[2]) * mode.back;
  const Eigen::RowVector2d before = (reading.sign * row_of(response.mode[1]) + earlier) * mode.back;
  return {reading.sign * row_of(response.mode[0]) + before,
          -before * mode.model.input_gain - forced * (response.forced[1] + response.forced[2]),
          -earlier * mode.model.input_gain - forced * response.forced[2]};
}

double ratio_of_node(std::size_t index) {
  return std::min(largest_ratio,
                  static_cast<double>(index + 1) / static_cast<double>(Index::nodes));
}

void put_node(const ObservedMode& mode, std::size_t index, const FrictionReading& reading,
              control::SensorlessRow<double>& row) {
  const double ratio = ratio_of_node(index);
  const Node node = node_of(mode, ratio, reading);
  double* const numbers = &row[Index::plain + index * Index::Node::count];
  numbers[Index::Node::output] = node.output(0);
  numbers[Index::Node::output + 1] = node.output(1);
  numbers[Index::Node::last_change] = node.last_change;
  numbers[Index::Node::change_before] = node.change_before;
  numbers[Index::Node::noise] = reading.speed * noise_of(ratio, reading);
}

/// A mode next to zero or to a multiple of the carrier costs what the friction shows of it, and a
/// little of its own: a slow one acts as another sliding speed, which the vibration at the carrier
/// hardly shows.
Eigen::RowVector3d feedback_of(const ObservedMode& mode, const FrictionReading& reading) {
  const ModeModel& model = mode.model;
  if (is_quick(model)) {
    Eigen::RowVector3d feedback = feedback_of(model, vibration_error(model));
    feedback(2) *= slower_rise;
    return feedback;
  }
  constexpr double usual_ratio = 0.7;
  constexpr double own = 0.2;
  FrictionReading bare = reading;
  bare.chain = {};
  Eigen::RowVector3d output;
  output << node_of(mode, usual_ratio, bare).output, model.forced.norm();
  Eigen::Matrix3d error = output.transpose() * output;
  error.topLeftCorner<2, 2>() += own * model.square;
  return feedback_of(model, error);
}

/// A row stands for the modes as far as the next rows: the mean of theirs, each with the part that
/// the row has in what is interpolated there. Next to half a turn in a period a change of the
/// amplitude moves one part of the mode, and the feedback of the other part changes its sign within
/// a fraction of a row.
Eigen::RowVector3d feedback_around(const Resonator& resonator, double spacing,
                                   const FrictionReading& reading) {
  constexpr int parts = 8;
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (int part = 1 - parts; part < parts; ++part) {
    Resonator near = resonator;
    near.stiffness += spacing * part / parts;
    sum += (parts - std::abs(part)) * feedback_of(observed_mode(near, reading.sign), reading);
  }
  return sum / (parts * parts);
}

/// @param spacing  of the rows, a difference of the stiffness
control::SensorlessRow<double> row_of(const Resonator& resonator, double spacing,
                                      const FrictionReading& reading) {
  const ObservedMode mode = observed_mode(resonator, reading.sign);
  const ModeModel& model = mode.model;
  const double forced = model.forced.norm();
  const Eigen::RowVector3d feedback = feedback_around(resonator, spacing, reading);
  control::SensorlessRow<double> row{};
  row[Index::rotation] = model.rotation(0, 0);
  row[Index::rotation + 1] = model.rotation(1, 0);
  row[Index::input_gain] = model.input_gain(0);
  row[Index::input_gain + 1] = model.input_gain(1);
  row[Index::forced] = forced;
  row[Index::feedback] = feedback(0);
  row[Index::feedback + 1] = feedback(1);
  row[Index::feedback + 2] = feedback(2);
  row[Index::per_velocity] = 1.0 / forced;
  const double angle = 0.5 * spacing / mode.rate.imag();
  row[Index::bend] = 0.5 * angle * angle;
  for (std::size_t i = 0; i < Index::nodes; ++i) {
    put_node(mode, i, reading, row);
  }
  return row;
}

/// The mode turns so little in a period, against zero or a multiple of the carrier, that it cannot
/// be told from the vibration. A mode next to a multiple that dies within 20 periods is told by
/// that.
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
control::SensorlessTable<double> table_of_gains(const Resonator& resonator,
                                                const FrictionReading& reading) {
  constexpr double largest = 1.2;
  const double turns = numeric::sqrt(resonator.stiffness) / numeric::two_pi;
  const double gain = std::max(1.0, largest * numeric::sqrt(1.0 + turns * turns));
  static_assert(Index::rows == 9);
  const double step = numeric::sqrt(numeric::sqrt(numeric::sqrt(gain)));
  double forced = mode_model(resonator).forced.norm();
  control::SensorlessTable<double> table{};
  for (control::SensorlessRow<double>& row : table) {
    row[Index::rotation] = 1.0;
    row[Index::forced] = forced;
    forced *= step;
    row[Index::feedback + 2] = slower_rise;
    row[Index::per_velocity] = 1.0 / row[Index::forced];
    for (std::size_t node = 0; node < Index::nodes; ++node) {
      row[Index::plain + node * Index::Node::count + Index::Node::noise] =
          reading.speed * noise_of(ratio_of_node(node), reading);
    }
  }
  return table;
}

control::SensorlessTable<double> table_of(const Resonator& lowest, double spacing,
                                          const FrictionReading& reading) {
  control::SensorlessTable<double> table{};
  for (std::size_t i = 0; i < Index::rows; ++i) {
    Resonator resonator = lowest;
    resonator.stiffness += static_cast<double>(i) * spacing;
    table[i] = row_of(resonator, spacing, reading);
  }
  return table;
}

/// The table in multiples of a mode that leaves the input gain an eighth.
/// @return that mode; 1 without an input gain
double scale_mode(control::SensorlessTable<double>& table) {
  double largest = 0.0;
  for (const control::SensorlessRow<double>& row : table) {
    largest =
        std::max({largest, std::abs(row[Index::input_gain]), std::abs(row[Index::input_gain + 1])});
  }
  const double unit = largest > 0.0 ? 8.0 * largest : 1.0;
  for (control::SensorlessRow<double>& row : table) {
    for (std::size_t i = 0; i < 2; ++i) {
      row[Index::input_gain + i] /= unit;
      row[Index::feedback + i] *= unit;
      for (std::size_t node = 0; node < Index::nodes; ++node) {
        double* const numbers = &row[Index::plain + node * Index::Node::count];
        numbers[Index::Node::output + i] *= unit;
      }
    }
  }
  return unit;
}

}  // namespace

SensorlessDesign design_sensorless(const scene::Scene& scene, const NominalPlant& plant,
                                   double velocity_m_per_s) {
  require_mode(plant);
  require_feeling(scene);
  const Resonator middle = nominal_resonator(scene, plant, velocity_m_per_s);
  const FrictionReading reading = friction_reading(scene, plant, velocity_m_per_s);
  SensorlessDesign design;
  design.stiffness_range = stiffness_range(middle.stiffness);
  constexpr double nearly_rad = 0.3;
  design.rotation_range = 2.0 * nearly_rad / numeric::sqrt(middle.stiffness);
  design.multiple_range = multiple_range(middle);
  design.quick = is_quick(mode_model(middle));
  const double range = design.stiffness_range * middle.stiffness;
  const double spacing = 2.0 / (Index::rows - 1) * range;
  design.apart = !is_one_with_vibration(middle);
  Resonator lowest = middle;
  lowest.stiffness -= range;
  design.table =
      design.apart ? table_of(lowest, spacing, reading) : table_of_gains(middle, reading);
  constexpr double usual_ratio = 0.6;
  design.blur = usual_ratio * noise_of(usual_ratio, reading);
  design.speed = reading.speed;
  constexpr double nonlinear = 0.04;  // of friction under a mode
  constexpr double unknown = 0.12;    // of the angle by which the range turns a mode
  design.swing =
      nonlinear + unknown * 0.5 * design.stiffness_range * numeric::sqrt(middle.stiffness);
  design.mode_unit = scale_mode(design.table);
  const double linear = design.quick ? 0.5 : 0.2;
  design.linear = linear / design.mode_unit;
  design.sensor_memory = reading.chain.fade;
  design.contact_memory = reading.chain.contact_memory;
  design.backwards = slides_backwards(scene.sliding);
  design.delay_periods =
      static_cast<std::uint8_t>(scene.drive->delay_periods + scene.sensor.delay_periods);
  return design;
}

}  // namespace sonoglide::configure
