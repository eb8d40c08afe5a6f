#include "host_sim/studies/identify/plant/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/studies/identify/least_squares.hpp"
#include "host_sim/studies/identify/plant/plant_problem.hpp"
#include "host_sim/studies/identify/plant/plant_search.hpp"
#include "host_sim/studies/identify/plant/uncertainty.hpp"

namespace sonoglide::identify::plant {
namespace {

constexpr double open = std::numeric_limits<double>::quiet_NaN();

/// The friction limit follows from the readings without a drive, whatever else the plant is.
/// @throws loop::ComputationError  they are those of no sliding contact
Eigen::VectorXd with_undriven_friction(const PlantProblem& problem,
                                       const configure::Experiment& nominal,
                                       const Stretch& undriven) {
  Eigen::VectorXd start = problem.start();
  const auto steps = static_cast<Eigen::Index>(undriven.steps.size());
  const double full_scale_N = nominal.design->scales.force_N;
  const double measured = readings(undriven).mean();
  const double modelled =
      modelled_readings(*problem.plant(start), *nominal.design, undriven, steps).mean();
  constexpr double least = 0.01;  // of what the scene has
  if (std::abs(modelled) * full_scale_N < least * nominal.nominal.friction.limit_N()) {
    throw loop::ComputationError(
        "without a drive the sliding velocity reads next to nothing: the plant is to slide while it is "
        "recorded");
  }
  if (measured / modelled < least) {
    throw loop::ComputationError(fmt::format(
        "without a drive the friction force reads {:.4g} N where the scene has {:.4g} N: the force sensor is "
        "wired backwards or dead, or there is no contact",
        full_scale_N * measured, full_scale_N * modelled));
  }
  if (const Eigen::Index friction = problem.index_of("friction.coefficient"); friction >= 0) {
    start(friction) += std::log(measured / modelled);
  }
  return start;
}

/// A logarithm that is told no better than this leaves its number open: a factor of ten.
const double most_half_width = 0.5 * std::log(10.0);

struct Interval {
  double low;
  double high;
};

Interval interval(const Unknown& unknown, double value, double half_width) {
  return unknown.unit > 0.0
             ? Interval{value - half_width * unknown.unit, value + half_width * unknown.unit}
             : Interval{value * std::exp(-half_width), value * std::exp(half_width)};
}

void add_estimate(const Unknown& unknown, double value, const Interval& interval, PlantFit& found) {
  Identification& told = found.identification;
  const bool may_be_0 = unknown.unit > 0.0;
  const auto [low, high] = interval;
  if (may_be_0 ? low > 0.0 : std::log(high / low) <= 2.0 * most_half_width) {
    told.parameters.push_back({unknown.key, value, low, high, may_be_0});
    if (unknown.stated < low || unknown.stated > high) {
      found.changed.emplace_back(unknown.key, value);
    }
  } else {
    const bool bounded = high < unknown.most;
    told.parameters.push_back({unknown.key, open, open, bounded ? high : open, may_be_0});
    told.cannot_tell.push_back(
        bounded ? fmt::format("{}: no more than that it is below {:.3g}.", unknown.key, high)
                : fmt::format("{}: the traces leave it open by more than a factor of ten.",
                              unknown.key));
  }
}

/// @param springs  that the readings do not tell from the fit's
void add_estimates(const PlantProblem& problem, const LeastSquaresFit& fit,
                   const PossibleSprings& springs, const Deviations& deviations, PlantFit& found) {
  for (std::size_t i = 0; i < problem.unknowns().size(); ++i) {
    const Unknown& unknown = problem.unknowns()[i];
    if (i == 0 && springs.is_cut) {
      found.identification.parameters.push_back({unknown.key, open, open, open});
      continue;
    }
    const double half = deviations.student * deviations.of_parameters(static_cast<Eigen::Index>(i));
    Interval all = interval(unknown, problem.value(fit.parameters, i), half);
    for (const Eigen::VectorXd& parameters : springs.parameters) {
      const Interval its = interval(unknown, problem.value(parameters, i), half);
      all = {std::min(all.low, its.low), std::max(all.high, its.high)};
    }
    add_estimate(unknown, problem.value(fit.parameters, i), all, found);
  }
  Identification& told = found.identification;
  const auto n = static_cast<Eigen::Index>(problem.unknowns().size());
  const Eigen::MatrixXd correlations =
      identify::correlations(deviations.covariance.topLeftCorner(n, n));
  for (Eigen::Index i = 0; i < n; ++i) {
    told.correlations.names.push_back(problem.unknowns()[static_cast<std::size_t>(i)].key);
    told.correlations.rows.emplace_back(correlations.row(i).begin(), correlations.row(i).end());
  }
}

/// Of the actuator whose full force was found to be another.
void add_bias(const scene::Drive& stated, PlantFit& found) {
  const auto force = std::find_if(found.changed.begin(), found.changed.end(),
                                  [](const auto& each) { return each.first == force_key; });
  if (stated.bias_limit_N > 0.0 && force != found.changed.end()) {
    const double factor = force->second / stated.max_force_amplitude_N;
    found.changed.emplace_back(bias_key, factor * stated.bias_limit_N);
  }
}

/// Spring and damper show in swings of a code or two.
void keep_stated_swings(PlantFit& found) {
  auto& changed = found.changed;
  changed.erase(std::remove_if(changed.begin(), changed.end(),
                               [](const auto& each) {
                                 return each.first == "plant.stiffness_N_per_m" ||
                                        each.first == "plant.damping_N_s_per_m";
                               }),
                changed.end());
}

double rms_of(const LeastSquaresFit& fit) {
  return std::sqrt(fit.sum_of_squares / static_cast<double>(fit.residuals.size()));
}

/// Over the expected residuals, from which on they are a sign of another plant.
constexpr double much = 2.0;

/// A problem with its best fit, but for springs that noise hides.
struct FittedProblem {
  std::unique_ptr<PlantProblem> problem;
  Eigen::VectorXd start;
  LeastSquaresFit fit;
};

FittedProblem fitted(const configure::Experiment& nominal, const std::vector<Stretch>& stretches,
                     FullForce force, const std::function<void(double)>& progress) {
  FittedProblem fitted{std::make_unique<PlantProblem>(nominal, stretches, force), {}, {}};
  fitted.start = with_undriven_friction(*fitted.problem, nominal, stretches.front());
  fitted.fit = best_fit(*fitted.problem, fitted.start, progress);
  return fitted;
}

/// Noise of the sensor is hardly ever smaller: nothing is left for another unknown.
bool is_explained(const LeastSquaresFit& fit, double expected) {
  constexpr double deviations = 3.0;
  const double of_rms = expected / std::sqrt(2.0 * static_cast<double>(fit.residuals.size()));
  return rms_of(fit) < expected - deviations * of_rms;
}

/// The interval of the full force excludes that of the scene: it allows for rounding too.
bool is_another(const FittedProblem& with_force, const std::vector<Stretch>& stretches,
                const Expected& expected) {
  const auto& [problem, start, fit] = with_force;
  const Deviations deviations = plant::deviations(fit, problem->slopes(fit), stretches, expected);
  const double moved = std::log(problem->full_force(fit.parameters));
  return std::abs(moved) >
         deviations.student * deviations.of_parameters(problem->index_of(force_key));
}

/// With the full force of the drive as the scene has it. Where no such plant fits, with the force that fits, if one
/// does: else the damper and the spring would make up for a force, or a mass, that is otherwise.
FittedProblem fitted(const configure::Experiment& nominal, const std::vector<Stretch>& stretches,
                     const Expected& expected, const std::function<void(double)>& progress,
                     Identification& told) {
  FittedProblem stated =
      fitted(nominal, stretches, FullForce::stated, [&](double part) { progress(0.5 * part); });
  if (is_explained(stated.fit, expected.deviation()) || nominal.nominal.transducer) {
    return stated;
  }
  FittedProblem free = fitted(nominal, stretches, FullForce::fitted,
                              [&](double part) { progress(0.5 + 0.5 * part); });
  if (!explains_more(free.fit, stated.fit, expected.deviation()) ||
      !is_another(free, stretches, expected)) {
    return stated;
  }
  const char* const bias = nominal.nominal.drive->bias_limit_N > 0.0 ? ", bias" : "";
  told.cannot_tell.push_back(fmt::format(
      "{}: whether the force or plant.mass_kg differs from the scene. The value found assumes the scene's mass. A mass "
      "that is off would change force{}, spring and damper by its own factor, and the controller would be the same.",
      force_key, bias));
  return free;
}

/// @param undriven  mean reading, over full scale
void add_warnings(const LeastSquaresFit& fit, double undriven, const Expected& expected,
                  PlantFit& found) {
  Identification& told = found.identification;
  const double rms = rms_of(fit);
  told.residual_rms = rms / std::abs(undriven);
  const double excess = std::max(rms * rms - found.expected_rms * found.expected_rms, 0.0);
  told.misfit = std::sqrt(excess) / std::abs(undriven);
  append(
      told.warnings,
      {{rms > much * found.expected_rms,
        fmt::format(
            "The residuals are {:.3g} of the undriven friction, {:.3g} times what the scene's "
            "[sensor] makes them: the sensor is noisier than stated, the plant is not what the "
            "scene's laws describe, or the fit has not found it. The intervals do not hold then.",
            told.residual_rms, rms / found.expected_rms)},
       {expected.rounds_coarsely(undriven),
        fmt::format(
            "The converter shows the undriven friction in {:.0f} codes. What it rounds is no noise then, and spring "
            "and damper may be off by far more than their intervals: commissioned.toml has those of the scene. {:.0f} "
            "codes, or noise of one code, would do.",
            std::abs(undriven) / expected.quantum(), Expected::fewest_codes)},
       {!fit.converged, "The fit has not converged: no value is sure."}});
}

/// The springs that the readings allow where noise hides the natural mode. The fit becomes the best of all that were
/// tried; where they leave the spring open, one with the spring next to the scene's.
PossibleSprings hidden_springs(const PlantProblem& problem, const SpringScan& scan,
                               LeastSquaresFit& fit, Identification& told) {
  const LeastSquaresFit another =
      problem.polished(problem.fit(scan.best(), PlantProblem::all_steps));
  if (another.sum_of_squares < fit.sum_of_squares) {
    fit = another;
  }
  PossibleSprings springs = scan.possible(fit);
  const std::string& key = problem.unknowns().front().key;
  if (springs.is_cut) {
    fit = problem.polished(problem.at(springs.nearest), 1);
    const std::string possible =
        springs.most < 1.01 * springs.least
            ? fmt::format("near {:.3g} times the scene's", springs.least)
            : fmt::format("from {:.3g} to {:.3g} times the scene's", springs.least, springs.most);
    told.cannot_tell.push_back(fmt::format(
        "{}: the natural mode does not stand out of noise and rounding, and springs {} or beyond may give these "
        "readings. commissioned.toml has the scene's, and the steps on the plant that was found are those with it. "
        "Readings with less noise, or with more bits, may tell.",
        key, possible));
  } else {
    told.cannot_tell.push_back(fmt::format(
        "{}: the natural mode does not stand out of the noise, so springs from {:.2g} to {:.2g} times the scene's were "
        "tried. The interval contains all of them that fit these readings. One farther away may fit too, as on the "
        "other side of the carrier frequency.",
        key, std::exp(-SpringScan::reach), std::exp(SpringScan::reach)));
  }
  return springs;
}

}  // namespace

PlantFit fit_plant(const configure::Experiment& nominal, const std::vector<Stretch>& stretches,
                   const std::function<void(double)>& progress) {
  const Expected expected = plant::expected(nominal.nominal.sensor);
  PlantFit found;
  auto [its_problem, start, fit] = fitted(
      nominal, stretches, expected, [&](double part) { progress(0.5 * part); },
      found.identification);
  const PlantProblem& problem = *its_problem;
  found.identification.subject = "plant";
  found.identification.model = "the plant of the scene";
  found.expected_rms = expected.deviation();
  PossibleSprings springs;
  if (!swings_are_plain(problem, fit, expected.deviation())) {
    const SpringScan scan(problem, start, expected.deviation(),
                          [&](double part) { progress(0.5 + 0.5 * part); });
    springs = hidden_springs(problem, scan, fit, found.identification);
  }
  progress(1.0);
  const Deviations deviations = plant::deviations(fit, problem.slopes(fit), stretches, expected);
  add_estimates(problem, fit, springs, deviations, found);
  add_bias(*nominal.nominal.drive, found);
  const double undriven = readings(stretches.front()).mean();
  if (expected.rounds_coarsely(undriven)) {
    keep_stated_swings(found);
  }
  add_warnings(fit, undriven, expected, found);
  Eigen::Index first = 0;
  for (const Stretch& each : stretches) {
    const auto n = static_cast<Eigen::Index>(each.steps.size());
    found.modelled.emplace_back(readings(each) - fit.residuals.segment(first, n));
    first += n;
  }
  return found;
}

}  // namespace sonoglide::identify::plant
