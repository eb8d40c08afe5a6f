#include "host_sim/configure/vibration/friction_response.hpp"

#include <cmath>
#include <cstddef>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/vibration/complex_exponential.hpp"

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

}  // namespace sonoglide::configure
