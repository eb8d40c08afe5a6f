#include "host_sim/configure/vibration/sensorless_reading.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/design_steps.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/vibration/complex_exponential.hpp"
#include "host_sim/scene/friction_laws.hpp"

namespace sonoglide::configure {
namespace {

using Complex = std::complex<double>;

constexpr double stiffest = 150.0;
constexpr double two_pi = numeric::two_pi;

FrictionResponse coulomb_response(const VibratedContact& contact) {
  const double turn = numeric::acos(-contact.velocity_ratio);
  FrictionResponse response;
  for (const double angle : {turn, -turn}) {
    const double time = (angle - contact.phase) / two_pi;
    response.time.push_back(time - std::floor(time));
    response.own.push_back(1.0);
    response.next.push_back(0.0);
  }
  return response;
}

/// A part of a period in which the velocity is constant.
struct Cell {
  double direction;  ///< sign of the velocity
  double rate;       ///< at which the friction nears it, per period
  double fade;       ///< of a deviation, to the end of the cell
  double mean;       ///< of a deviation of 1 at its beginning, times the cell's length
};

constexpr std::size_t cell_count = 256;
constexpr double length = 1.0 / cell_count;

double middle_of(std::size_t i) {
  return (static_cast<double>(i) + 0.5) * length;
}

std::vector<Cell> cells_of(const VibratedContact& contact) {
  constexpr double slow = 1e-9;
  std::vector<Cell> cells(cell_count);
  for (std::size_t i = 0; i < cell_count; ++i) {
    const double velocity =
        contact.velocity_ratio + numeric::cos(two_pi * middle_of(i) + contact.phase);
    Cell& cell = cells[i];
    cell.direction = velocity > 0.0 ? 1.0 : -1.0;
    cell.rate = two_pi * contact.dahl_number * std::abs(velocity);
    cell.fade = numeric::exp(-cell.rate * length);
    cell.mean = cell.rate > slow ? -numeric::expm1(-cell.rate * length) / cell.rate : length;
  }
  return cells;
}

double friction_after(const Cell& cell, double friction) {
  return cell.direction + (friction - cell.direction) * cell.fade;
}

/// Growth of the friction per change of the velocity in each cell, over the periodic friction.
std::vector<double> drive_of(const std::vector<Cell>& cells, double dahl_number, double memory) {
  double friction = 0.0;
  for (const Cell& cell : cells) {
    friction = friction_after(cell, friction);
  }
  friction /= 1.0 - memory;
  std::vector<double> drive(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double end = friction_after(cells[i], friction);
    drive[i] = two_pi * dahl_number * (1.0 - cells[i].direction * 0.5 * (friction + end));
    friction = end;
  }
  return drive;
}

FrictionResponse dahl_response(const VibratedContact& contact) {
  const std::vector<Cell> cells = cells_of(contact);
  FrictionResponse response;
  response.memory = 1.0;
  for (const Cell& cell : cells) {
    response.memory *= cell.fade;
  }
  const std::vector<double> drive = drive_of(cells, contact.dahl_number, response.memory);
  response.time.resize(cell_count);
  response.own.resize(cell_count);
  response.next.resize(cell_count);
  double later = 0.0;  // mean of the period per deviation at the end of the cell
  double kept = 1.0;   // deviation at the end of the period
  constexpr double slow = 1e-9;
  for (std::size_t i = cell_count; i-- > 0;) {
    const Cell& cell = cells[i];
    const double inside =
        cell.rate > slow ? (length - cell.mean) / cell.rate : 0.5 * length * length;
    response.time[i] = middle_of(i);
    response.own[i] = drive[i] * (inside + cell.mean * later);
    response.next[i] = drive[i] * cell.mean * kept;
    later = cell.mean + cell.fade * later;
    kept *= cell.fade;
  }
  for (double& share : response.next) {
    share *= later;
  }
  return response;
}

/// Answers of so many periods, in place, behind the sensor and its compensation.
template <class Number>
void pass(std::vector<Number>& answers, const ReadingChain& chain) {
  Number reading{};
  Number before{};
  for (Number& answer : answers) {
    const Number now = answer;
    reading = chain.fade * reading + chain.old * before + chain.fresh * now;
    before = now;
    answer = reading;
  }
  for (const double memory : {chain.fade, chain.contact_memory}) {
    Number last{};
    for (Number& answer : answers) {
      const Number now = answer;
      answer = (now - memory * last) / (1.0 - memory);
      last = now;
    }
  }
}

/// The first two, and the sum of all others.
template <class Number>
std::array<Number, 3> gathered(const std::vector<Number>& answers) {
  std::array<Number, 3> parts{answers[0], answers[1], Number{}};
  for (std::size_t k = 2; k < answers.size(); ++k) {
    parts[2] += answers[k];
  }
  return parts;
}

template <class Number>
std::vector<Number> answers_of(Number own, Number next, double memory, double sum) {
  constexpr std::size_t many = 48;
  std::vector<Number> answers(many);
  answers[0] = own / sum;
  Number share = next / sum;
  for (std::size_t k = 1; k < many; ++k) {
    answers[k] = share;
    share *= memory;
  }
  return answers;
}

}  // namespace

FrictionResponse friction_response(const VibratedContact& contact) {
  return contact.dahl_number < stiffest ? dahl_response(contact) : coulomb_response(contact);
}

double ratio_swing(const VibratedContact& contact, double turn) {
  const FrictionResponse response = friction_response(contact);
  Complex own;
  Complex next;
  for (std::size_t i = 0; i < response.time.size(); ++i) {
    const Complex velocity = exponential({0.0, turn * response.time[i]});
    own += response.own[i] * velocity;
    next += response.next[i] * velocity;
  }
  const Complex before = exponential({0.0, -turn});
  // The friction turns over twice a period, at the slope 2π √(1 − r²) of the velocity.
  const double slope =
      0.5 * two_pi * numeric::sqrt(1.0 - contact.velocity_ratio * contact.velocity_ratio);
  return std::abs(own + next * before / (1.0 - response.memory * before)) /
         (contact.dahl_number < stiffest ? 1.0 : slope);
}

ReadingResponse reading_response(const VibratedContact& contact, std::complex<double> rate,
                                 const ReadingChain& chain) {
  const FrictionResponse response = friction_response(contact);
  Complex mode_own;
  Complex mode_next;
  double forced_own = 0.0;
  double forced_next = 0.0;
  for (std::size_t i = 0; i < response.time.size(); ++i) {
    const Complex mode = exponential(rate * response.time[i]);
    const double forced = numeric::cos(two_pi * response.time[i] + contact.phase);
    mode_own += response.own[i] * mode;
    mode_next += response.next[i] * mode;
    forced_own += response.own[i] * forced;
    forced_next += response.next[i] * forced;
  }
  const double sum = forced_own + forced_next / (1.0 - response.memory);
  auto mode = answers_of(mode_own, mode_next, response.memory, sum);
  auto forced = answers_of(forced_own, forced_next, response.memory, sum);
  pass(mode, chain);
  pass(forced, chain);
  return {gathered(mode), gathered(forced)};
}

namespace {

ReadingChain chain_of(const scene::Sensor& sensor, double period_s) {
  ReadingChain chain;
  if (const std::optional<double> low_pass_Hz = sensor.low_pass_Hz()) {
    const double periods = numeric::two_pi * *low_pass_Hz * period_s;
    chain.fade = numeric::exp(-periods);
    chain.fresh = 1.0 + numeric::expm1(-periods) / periods;
    chain.old = 1.0 - chain.fade - chain.fresh;
  }
  return chain;
}

/// Rms of a measured ratio.
double reading_noise(const scene::Sensor& sensor, double friction_N) {
  const double rounding_N = code_N(sensor);
  const double noise_N = sensor.reading_noise_N();
  return numeric::sqrt(noise_N * noise_N + rounding_N * rounding_N / 12.0) / friction_N;
}

}  // namespace

bool slides_backwards(const scene::Sliding& sliding) {
  return std::any_of(sliding.profile.begin(), sliding.profile.end(),
                     [](const auto& point) { return point.velocity_m_per_s < 0.0; });
}

FrictionReading friction_reading(const scene::Scene& scene, const NominalPlant& plant,
                                 double velocity_m_per_s) {
  const double period_s = 1.0 / scene.drive->frequency_Hz;
  const double speed_m_per_s = scene.sliding.fastest_m_per_s();
  FrictionReading reading;
  reading.speed = speed_m_per_s / velocity_m_per_s;
  const bool elastic = scene::is_elastic(scene.friction.law);
  reading.lambda = elastic ? plant.contact_stiffness_N_per_m * speed_m_per_s * period_s /
                                 (numeric::two_pi * plant.friction_N)
                           : std::numeric_limits<double>::infinity();
  const bool backwards = slides_backwards(scene.sliding);
  reading.sign = (backwards ? -1.0 : 1.0) * vibration_sign(scene.friction.sign_convention);
  reading.chain = chain_of(scene.sensor, period_s);
  constexpr double usual_ratio = 0.6;
  constexpr double short_memory = 0.1;
  constexpr double longest_memory = 0.9;  // more would make too much of noise
  const double memory = friction_response(reading.contact(usual_ratio, 0.0)).memory;
  reading.chain.contact_memory = memory > short_memory ? std::min(memory, longest_memory) : 0.0;
  reading.noise = reading_noise(scene.sensor, plant.friction_N);
  reading.model_lift = 1.0;
  constexpr double lifted = 0.2;
  for (const double kept : {reading.chain.fade, reading.chain.contact_memory}) {
    reading.noise *= numeric::sqrt(1.0 + kept * kept) / (1.0 - kept);
    reading.model_lift *= 1.0 + lifted * kept / (1.0 - kept);
  }
  return reading;
}

double noise_of(double ratio, const FrictionReading& reading) {
  constexpr double rest = 0.001;  // of the velocity: map and contact, in a settled loop
  // Of Coulomb friction: a velocity per ratio, per sliding velocity.
  const double steepness =
      0.25 * numeric::two_pi * numeric::sqrt(1.0 - ratio * ratio) / (ratio * ratio);
  const double model = rest * reading.model_lift / ratio;
  const double sensor = reading.noise * steepness;
  return numeric::sqrt(model * model + sensor * sensor);
}

}  // namespace sonoglide::configure
