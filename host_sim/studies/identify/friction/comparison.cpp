#include "host_sim/studies/identify/friction/comparison.hpp"
#include "host_sim/configure/read/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "host_sim/studies/identify/friction/candidate.hpp"
#include "host_sim/studies/identify/identification.hpp"

namespace sonoglide::identify::friction {
namespace {

void warn_of_failure(Comparison& comparison) {
  const LawFit& best = comparison.best();
  std::vector<std::string> failing;
  for (const LawFit& each : comparison.laws) {
    if (each.fails()) {
      failing.push_back(each.law.title);
    }
  }
  const bool all_fail = failing.size() == comparison.laws.size();
  append(
      comparison.warnings,
      {{!failing.empty() && !all_fail,
        fmt::format("Laws that fail, whatever their parameters: {}.", fmt::join(failing, ", "))},
       {all_fail,
        fmt::format("No law that was fitted describes the readings: of the best, {}, residuals of "
                    "{:.2g} (rms, as a friction ratio) are {}.",
                    best.law.title, best.residual_rms,
                    best.chi_square_probability < fails_below
                        ? "larger than the stated standard errors allow"
                        : "systematic, not scatter")},
       {!all_fail && best.fails(),
        fmt::format("The residuals of the best law, {}, are systematic, not scatter.",
                    best.law.title)},
       {best.misfit > 0.0,
        fmt::format("{}: a misfit of {:.2g} (rms, as a friction ratio) that neighbouring readings "
                    "share is more likely than none; the intervals include it.",
                    best.law.title, best.misfit)}});
}

/// The laws that are not told apart from the best, with their distance.
std::vector<std::string> alike(const Comparison& comparison) {
  std::vector<std::string> laws;
  for (const LawFit& each : comparison.laws) {
    if (&each != &comparison.best() && comparison.difference(each) < told_apart_from) {
      laws.push_back(fmt::format("{} ({:.2g})", each.law.title, comparison.difference(each)));
    }
  }
  return laws;
}

/// Which law it is, what no reading of this kind tells, and which way the contact vibrates.
void tell_what_is_open(Comparison& comparison) {
  const LawFit& best = comparison.best();
  const bool has_criterion = std::isfinite(best.akaike);
  const std::vector<std::string> others =
      has_criterion ? alike(comparison) : std::vector<std::string>();
  std::set<std::string_view> laws;
  std::set<std::string> directions;
  for (const LawFit& each : comparison.laws) {
    laws.insert(each.law.law);
    directions.insert(each.law.direction);
  }
  const bool elastic = laws.count("dahl") + laws.count("iwan") + laws.count("lugre") > 0;
  const Readings& readings = comparison.readings;
  append(
      comparison.cannot_tell,
      {{!has_criterion && comparison.laws.size() > 1,
        fmt::format("Which law it is: {} readings are too few for a criterion. Taken is the law "
                    "with the smallest residuals for its parameters, {}; any that does not fail is "
                    "possible.",
                    readings.rows.size(), best.law.title)},
       {!others.empty(),
        fmt::format("Which law it is: {} is best, but the readings do not separate it from {}. In "
                    "brackets the difference in AICc, below {:g}. Measure where these laws differ "
                    "most: see the page.",
                    best.law.title, fmt::join(others, ", "), told_apart_from)},
       {readings.are_forces,
        "Friction coefficient and normal force apart: mean friction depends on their product Fc "
        "alone. Measure the normal force."},
       {!readings.are_forces,
        "The friction limit Fc, and friction coefficient and normal force apart: a friction ratio "
        "depends on neither. friction_force_N in place of friction_ratio determines Fc."},
       {elastic && readings.have_frequency,
        "Contact stiffness and friction limit apart, by a ratio: mean friction depends on Kt/Fc."},
       {elastic && !readings.have_frequency,
        "Kt/Fc: without frequency_Hz no amplitude is known, only Kt/(w Fc)."},
       {laws.count("lugre") > 0, "LuGre, bristle damping: it does not change the mean friction."},
       {laws.count("normal_coulomb") > 0,
        "Coulomb with springs, kz and N0 apart, and mu, kz and kx apart: mean friction depends on "
        "kz/N0 and mu kz/kx."},
       {directions.size() > 1,
        fmt::format("Which way the contact vibrates: the file does not say, and laws for several "
                    "directions were fitted ({}). Leave those of another direction than yours out: "
                    "--law.",
                    fmt::join(directions, ", "))}});
}

/// The scene, or a warning that run would refuse it.
void add_scene(Comparison& comparison) {
  comparison.scene = scene_text(comparison);
  try {
    experiment::read_text(comparison.scene, "scene.toml");
  } catch (const scene_file::SceneError& error) {
    comparison.scene.clear();
    comparison.warnings.push_back(
        fmt::format("No scene.toml is written, because run would refuse it: {}: {}.", error.key(),
                    error.message()));
  }
}

bool wanted(const std::vector<std::string>& laws, const Candidate& candidate) {
  return laws.empty() || std::find(laws.begin(), laws.end(), candidate.law) != laws.end();
}

void sort_laws(Comparison& comparison) {
  const auto n = static_cast<Eigen::Index>(comparison.readings.rows.size());
  const auto rank = [n](const LawFit& fit) {
    const Eigen::Index freedom = n - fit.parameter_count();
    const double deviation =
        fit.residual_rms / std::sqrt(static_cast<double>(std::max<Eigen::Index>(freedom, 1)));
    return std::make_tuple(fit.exceeds_standard_errors(), fit.akaike, !fit.is_determined,
                           freedom <= 0, deviation);
  };
  std::stable_sort(comparison.laws.begin(), comparison.laws.end(),
                   [&](const LawFit& a, const LawFit& b) { return rank(a) < rank(b); });
}

}  // namespace

Comparison compare(Readings readings, const std::vector<std::string>& laws,
                   const std::function<void(double)>& progress) {
  Comparison comparison;
  comparison.readings = std::move(readings);
  comparison.warnings = comparison.readings.warnings;
  std::vector<Candidate> chosen;
  for (Candidate& each : candidates(extent_of(comparison.readings))) {
    if (wanted(laws, each)) {
      chosen.push_back(std::move(each));
    }
  }
  for (const Candidate& each : chosen) {
    comparison.laws.push_back(fit(comparison.readings, each));
  }
  sort_laws(comparison);
  double done = 0.0;
  for (LawFit& each : comparison.laws) {
    if (comparison.is_possible(each)) {
      add_intervals(comparison.readings, each);
    }
    progress(++done / static_cast<double>(comparison.laws.size()));
  }
  warn_of_failure(comparison);
  tell_what_is_open(comparison);
  for (const LawFit& each : comparison.laws) {
    if (comparison.is_possible(each)) {
      comparison.cannot_tell.insert(comparison.cannot_tell.end(), each.open.begin(),
                                    each.open.end());
    }
  }
  add_scene(comparison);
  return comparison;
}

}  // namespace sonoglide::identify::friction
