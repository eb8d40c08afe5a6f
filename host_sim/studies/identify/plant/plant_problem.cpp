#include "host_sim/studies/identify/plant/plant_problem.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/reader.hpp"

namespace sonoglide::identify::plant {
namespace {

/// Of a plant that cannot be modelled: as if nothing were read right.
constexpr double no_model = 1.0;

/// Readings at the start of a stretch that do not count: the loop before it may have swung.
constexpr Eigen::Index unrecorded_steps = 8;

double number(const nlohmann::ordered_json& scene, const char* table, const char* key) {
  const auto found = scene.find(table);
  return found != scene.end() && found->contains(key) ? (*found)[key].get<double>() : 0.0;
}

std::vector<std::string> true_keys(const std::vector<Unknown>& unknowns) {
  std::vector<std::string> keys;
  keys.reserve(unknowns.size());
  for (const Unknown& each : unknowns) {
    keys.push_back("true_values." + each.key);
  }
  return keys;
}

scene::Scene without_true_values(scene::Scene scene) {
  scene.true_values.clear();
  return scene;
}

}  // namespace

std::vector<Unknown> unknowns_of(const scene::Scene& scene, FullForce force) {
  constexpr double wide = 4.0;
  const nlohmann::ordered_json echo = scene_file::to_json(scene);
  std::vector<Unknown> all;
  const auto add = [&](const char* table, const char* key) {
    if (const double value = number(echo, table, key); value > 0.0) {
      all.push_back({fmt::format("{}.{}", table, key), value, value, value / wide, value * wide});
    }
  };
  add("plant", "stiffness_N_per_m");
  add("friction", "coefficient");
  add("friction", "contact_stiffness_N_per_m");
  add("transducer", "force_factor_N_per_V");
  if (force == FullForce::fitted) {
    add("drive", "max_force_amplitude_N");
  }
  // A scene may leave the damper out, where no real plant does.
  const double critical = 2.0 * std::sqrt(scene.plant.stiffness_N_per_m * scene.plant.mass_kg);
  constexpr double least = 1e-9;
  constexpr double usual = 1e-3;
  constexpr double small = 1e-5;
  const double stated = scene.plant.damping_N_s_per_m / critical;
  all.push_back({damping_key, scene.plant.damping_N_s_per_m,
                 critical * (stated > least ? stated : usual), critical * least, critical,
                 critical * small});
  return all;
}

PlantProblem::PlantProblem(const configure::Experiment& nominal,
                           const std::vector<Stretch>& stretches, FullForce force)
    : nominal_(nominal),
      stretches_(stretches),
      unknowns_(unknowns_of(nominal.nominal, force)),
      document_(scene_file::Source{nominal.nominal.name,
                                   experiment::text_of(without_true_values(nominal.nominal))},
                {}, true_keys(unknowns_)) {}

Eigen::Index PlantProblem::index_of(std::string_view key) const {
  const auto found = std::find_if(unknowns_.begin(), unknowns_.end(),
                                  [&](const Unknown& each) { return each.key == key; });
  return found == unknowns_.end() ? -1 : found - unknowns_.begin();
}

Eigen::VectorXd PlantProblem::start() const {
  const auto count = static_cast<Eigen::Index>(unknowns_.size());
  const auto driven = static_cast<Eigen::Index>(stretches_.size()) - 1;
  Eigen::VectorXd parameters = Eigen::VectorXd::Zero(count + 2 * driven);
  for (Eigen::Index i = 0; i < count; ++i) {
    parameters(i) = std::log(unknowns_[static_cast<std::size_t>(i)].start);
  }
  return parameters;
}

double PlantProblem::value(const Eigen::VectorXd& parameters, std::size_t unknown) const {
  const Unknown& range = unknowns_[unknown];
  return std::clamp(std::exp(parameters(static_cast<Eigen::Index>(unknown))), range.least,
                    range.most);
}

double PlantProblem::full_force(const Eigen::VectorXd& parameters) const {
  const Eigen::Index force = index_of(force_key);
  const auto place = static_cast<std::size_t>(force);
  return force < 0 ? 1.0 : value(parameters, place) / unknowns_[place].stated;
}

std::optional<scene::Scene> PlantProblem::plant(const Eigen::VectorXd& parameters) const {
  std::vector<scene_file::VariedValue> values;
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    values.emplace_back(value(parameters, i));
  }
  try {
    scene::Scene plant = scene_file::read_truth(document_, values, nominal_.nominal);
    if (plant.drive && plant.drive->bias_limit_N > 0.0) {
      plant.drive->bias_limit_N *= full_force(parameters);
    }
    return plant;
  } catch (const scene_file::SceneError&) {
    return std::nullopt;
  }
}

std::vector<PlantProblem::Part> PlantProblem::parts(std::size_t after) const {
  std::vector<Part> all;
  Eigen::Index first = 0;
  for (const Stretch& each : stretches_) {
    const auto place = static_cast<Eigen::Index>(all.size());
    const auto steps = static_cast<Eigen::Index>(std::min(each.steps.size(), each.before + after));
    const auto swing = static_cast<Eigen::Index>(unknowns_.size()) + 2 * (place - 1);
    all.push_back({each, place == 0 ? -1 : swing, first, steps});
    first += steps;
  }
  return all;
}

Eigen::VectorXd PlantProblem::residuals(const std::optional<scene::Scene>& plant,
                                        const Eigen::VectorXd& parameters, const Part& part) const {
  const configure::ControlDesign& design = *nominal_.design;
  if (plant) {
    std::complex<double> free;
    if (part.swing >= 0) {
      free = design.scales.velocity_m_per_s *
             std::complex<double>(parameters(part.swing), parameters(part.swing + 1));
    }
    try {
      Eigen::VectorXd residuals = readings(part.stretch).head(part.steps) -
                                  modelled_readings(*plant, design, part.stretch, part.steps, free);
      if (part.swing >= 0) {
        // They answer to drives that were not recorded.
        residuals.head(std::min(part.steps, unrecorded_steps)).setZero();
      }
      return residuals;
    } catch (const loop::ComputationError&) {
      // As if there were no such plant.
    }
  }
  return Eigen::VectorXd::Constant(part.steps, no_model);
}

Eigen::VectorXd PlantProblem::residuals(const Eigen::VectorXd& parameters,
                                        std::size_t after) const {
  const std::vector<Part> parts = this->parts(after);
  const std::optional<scene::Scene> plant = this->plant(parameters);
  Eigen::VectorXd all(parts.back().first + parts.back().steps);
  for (const Part& part : parts) {
    all.segment(part.first, part.steps) = residuals(plant, parameters, part);
  }
  return all;
}

/// What a stretch swings by changes its own residuals alone.
Eigen::MatrixXd PlantProblem::jacobian(const Eigen::VectorXd& parameters,
                                       const Eigen::VectorXd& residuals, std::size_t after,
                                       Eigen::Index from) const {
  constexpr double step = 1e-5;
  const std::vector<Part> parts = this->parts(after);
  const auto unknowns = static_cast<Eigen::Index>(unknowns_.size());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(residuals.size(), parameters.size() - from);
  tbb::parallel_for(from, parameters.size(), [&](Eigen::Index i) {
    Eigen::VectorXd moved = parameters;
    moved(i) += step;
    const std::optional<scene::Scene> plant = this->plant(moved);
    for (const Part& part : parts) {
      if (i < unknowns || i == part.swing || i == part.swing + 1) {
        columns.col(i - from).segment(part.first, part.steps) =
            (this->residuals(plant, moved, part) - residuals.segment(part.first, part.steps)) /
            step;
      }
    }
  });
  return columns;
}

Eigen::VectorXd PlantProblem::adjusted(Eigen::VectorXd parameters, Eigen::Index from,
                                       std::size_t after) const {
  const Eigen::Index count = parameters.size() - from;
  if (count > 0) {
    const Eigen::VectorXd residuals = this->residuals(parameters, after);
    const Eigen::VectorXd moved =
        jacobian(parameters, residuals, after, from).colPivHouseholderQr().solve(residuals);
    if (moved.allFinite()) {
      parameters.tail(count) -= moved;
    }
  }
  return parameters;
}

Eigen::MatrixXd PlantProblem::slopes(const LeastSquaresFit& fit) const {
  Eigen::MatrixXd columns = fit.jacobian;
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    if (unknowns_[i].unit > 0.0) {
      const auto at = static_cast<Eigen::Index>(i);
      Eigen::VectorXd moved = fit.parameters;
      moved(at) = std::log(value(moved, i) + unknowns_[i].unit);
      columns.col(at) = residuals(moved, all_steps) - fit.residuals;
    }
  }
  return columns;
}

Eigen::VectorXd PlantProblem::moved(Eigen::VectorXd parameters, const Eigen::VectorXd& step) const {
  const Eigen::VectorXd before = parameters;
  parameters += step;
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    if (unknowns_[i].unit > 0.0) {
      const auto at = static_cast<Eigen::Index>(i);
      const double number = value(before, i) + step(at) * unknowns_[i].unit;
      parameters(at) = std::log(std::max(number, unknowns_[i].least));
    }
  }
  return parameters;
}

double PlantProblem::turn_of_a_step(const Eigen::VectorXd& parameters) const {
  const double natural_rad_per_s = std::sqrt(value(parameters, 0) / nominal_.nominal.plant.mass_kg);
  return natural_rad_per_s * nominal_.design->scales.step_period_s();
}

double PlantProblem::longest_turn(const Eigen::VectorXd& parameters) const {
  std::size_t longest = 0;
  for (const Stretch& each : stretches_) {
    longest = std::max(longest, each.steps.size());
  }
  return turn_of_a_step(parameters) * static_cast<double>(longest);
}

Eigen::MatrixXd PlantProblem::turned(Eigen::MatrixXd slopes, const Eigen::VectorXd& parameters,
                                     double moved) const {
  const double radians = turn_of_a_step(parameters) * std::expm1(0.5 * moved);
  for (const Part& part : parts(all_steps)) {
    if (part.swing < 0) {
      continue;
    }
    for (Eigen::Index i = 0; i < part.steps; ++i) {
      const std::complex<double> turn = std::polar(1.0, radians * static_cast<double>(i));
      double& in_phase = slopes(part.first + i, part.swing);
      double& quadrature = slopes(part.first + i, part.swing + 1);
      const std::complex<double> both = std::complex<double>(in_phase, -quadrature) * turn;
      in_phase = both.real();
      quadrature = -both.imag();
    }
  }
  return slopes;
}

LeastSquaresFit PlantProblem::at(const Eigen::VectorXd& parameters) const {
  const Eigen::VectorXd residuals = this->residuals(parameters, all_steps);
  return {parameters, residuals, jacobian(parameters, residuals, all_steps),
          residuals.squaredNorm(), true};
}

LeastSquaresFit PlantProblem::polished(LeastSquaresFit fit, Eigen::Index from) const {
  constexpr int most_steps = 8;
  constexpr double enough = 0.999;
  constexpr double shorter = 0.25;
  constexpr double shortest = 0.05;
  double part = 1.0;
  for (int i = 0; i < most_steps && part >= shortest; ++i) {
    const Eigen::MatrixXd free = slopes(fit).rightCols(fit.parameters.size() - from);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(fit.parameters.size());
    step.tail(free.cols()) = -free.colPivHouseholderQr().solve(fit.residuals);
    if (!step.allFinite()) {
      break;
    }
    LeastSquaresFit next = fit;
    do {
      next.parameters = moved(fit.parameters, part * step);
      next.residuals = residuals(next.parameters, all_steps);
      next.sum_of_squares = next.residuals.squaredNorm();
    } while (!(next.sum_of_squares < fit.sum_of_squares) && (part *= shorter) >= shortest);
    if (!(next.sum_of_squares < enough * fit.sum_of_squares)) {
      break;
    }
    next.jacobian = jacobian(next.parameters, next.residuals, all_steps);
    fit = std::move(next);
  }
  return fit;
}

LeastSquaresFit PlantProblem::fit(const Eigen::VectorXd& start, std::size_t after) const {
  constexpr double accuracy = 1e-7;
  constexpr int most_evaluations = 100;
  const std::vector<Part> parts = this->parts(after);
  const LeastSquares problem{
      parts.back().first + parts.back().steps, start.size(),
      [&](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd* columns) {
        r = residuals(p, after);
        if (columns != nullptr) {
          *columns = jacobian(p, r, after);
        }
      }};
  return minimise(problem, start, accuracy, most_evaluations);
}

}  // namespace sonoglide::identify::plant
