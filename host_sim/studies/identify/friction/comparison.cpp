#include "host_sim/studies/identify/friction/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "host_sim/studies/identify/friction/candidate.hpp"
#include "host_sim/studies/identify/friction/scene_text.hpp"

namespace sonoglide::identify::friction {
namespace {

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Which law it is.
void tell_laws_apart(Comparison& comparison) {
  const LawFit& best = comparison.best();
  if (!std::isfinite(best.akaike)) {
    if (comparison.laws.size() > 1) {
      comparison.cannot_tell.push_back(fmt::format(
          "Which law it is: {} readings are too few for a criterion. Taken is the law with the "
          "smallest residuals for its parameters, {}; any that does not fail is possible.",
          comparison.readings.rows.size(), best.law.title));
    }
    return;
  }
  std::vector<std::string> alike;
  for (const LawFit& each : comparison.laws) {
    if (&each != &best && comparison.difference(each) < told_apart_from) {
      alike.push_back(fmt::format("{} ({:.2g})", each.law.title, comparison.difference(each)));
    }
  }
  if (!alike.empty()) {
    comparison.cannot_tell.push_back(fmt::format(
        "Which law it is: {} is best, but not told apart from {}. In brackets the difference in "
        "AICc, below {:g}. Readings where these laws differ most would tell: see the page.",
        best.law.title, joined(alike), told_apart_from));
  }
}

void warn_of_failure(Comparison& comparison) {
  const LawFit& best = comparison.best();
  std::vector<std::string> failing;
  for (const LawFit& each : comparison.laws) {
    if (each.fails()) {
      failing.push_back(each.law.title);
    }
  }
  if (!failing.empty() && failing.size() < comparison.laws.size()) {
    comparison.warnings.push_back(
        fmt::format("Laws that fail, whatever their parameters: {}.", joined(failing)));
  }
  if (failing.size() == comparison.laws.size()) {
    comparison.warnings.push_back(fmt::format(
        "No law that was fitted describes the readings: of the best, {}, residuals of {:.2g} (rms, "
        "as a friction ratio) are {}.",
        best.law.title, best.residual_rms,
        best.chi_square_probability < fails_below ? "larger than the stated standard errors allow"
                                                  : "a pattern and no scatter"));
  } else if (best.fails()) {
    comparison.warnings.push_back(
        fmt::format("The residuals of the best law, {}, are no mere scatter.", best.law.title));
  }
  if (best.misfit > 0.0) {
    comparison.warnings.push_back(
        fmt::format("{}: a misfit of {:.2g} (rms, as a friction ratio) that neighbouring readings "
                    "share is more "
                    "likely than none; it is in the intervals.",
                    best.law.title, best.misfit));
  }
}

/// What no reading of this kind tells.
void tell_open_products(Comparison& comparison) {
  std::vector<std::string>& open = comparison.cannot_tell;
  open.emplace_back(
      comparison.readings.are_forces
          ? "Friction coefficient and normal force apart: mean friction depends on their product "
            "Fc alone. A measured normal force tells."
          : "The friction limit Fc, and friction coefficient and normal force apart: a friction "
            "ratio depends on neither. friction_force_N in place of friction_ratio tells Fc.");
  std::set<std::string_view> laws;
  for (const LawFit& each : comparison.laws) {
    laws.insert(each.law.law);
  }
  const bool elastic = laws.count("dahl") + laws.count("iwan") + laws.count("lugre") > 0;
  if (elastic) {
    open.emplace_back(
        comparison.readings.have_frequency
            ? "Contact stiffness and friction limit apart, by a ratio: mean friction depends on "
              "Kt/Fc."
            : "Kt/Fc: without frequency_Hz no amplitude is known, only Kt/(w Fc).");
  }
  if (laws.count("lugre") > 0) {
    open.emplace_back("LuGre, bristle damping: it does not change the mean friction.");
  }
  if (laws.count("normal_coulomb") > 0) {
    open.emplace_back(
        "Coulomb with springs, kz and N0 apart, and mu, kz and kx apart: mean friction depends on "
        "kz/N0 and mu kz/kx.");
  }
}

void tell_direction(Comparison& comparison) {
  std::set<std::string> directions;
  for (const LawFit& each : comparison.laws) {
    directions.insert(each.law.direction);
  }
  if (directions.size() > 1) {
    comparison.cannot_tell.push_back(fmt::format(
        "Which way the contact vibrates: the file does not say, and laws for several directions "
        "were fitted ({}). Leave those of another direction than yours out: --law.",
        fmt::join(directions, ", ")));
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
  tell_laws_apart(comparison);
  warn_of_failure(comparison);
  tell_open_products(comparison);
  tell_direction(comparison);
  for (const LawFit& each : comparison.laws) {
    if (comparison.is_possible(each)) {
      comparison.cannot_tell.insert(comparison.cannot_tell.end(), each.open.begin(),
                                    each.open.end());
    }
  }
  if (const std::string refusal = scene_refusal(comparison); !refusal.empty()) {
    comparison.has_scene = false;
    comparison.warnings.push_back("No scene.toml is written, because run would refuse it: " +
                                  refusal);
  }
  return comparison;
}

}  // namespace sonoglide::identify::friction
