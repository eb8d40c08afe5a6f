#include "host_sim/studies/identify/impedance/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/studies/identify/identification.hpp"
#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Place = std::ptrdiff_t;

/// Of the largest G/f (|Y|/f).
Place largest_reading(const Sweep& sweep) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
    const auto y = sweep.admittance_S[i];
    heights.push_back((sweep.has_phase ? y.real() : std::abs(y)) / sweep.frequency_Hz[i]);
  }
  return std::max_element(heights.begin(), heights.end()) - heights.begin();
}

/// At most most_readings of a longer sweep, evenly, with all readings about one.
Sweep thinned(const Sweep& sweep, Place place) {
  const auto n = static_cast<Place>(sweep.frequency_Hz.size());
  constexpr auto about = static_cast<Place>(most_readings / 3);
  const Place stride = 1 + n / (static_cast<Place>(most_readings) - about);
  Sweep left{sweep.format, {}, {}, sweep.has_phase, sweep.warnings};
  for (Place i = 0; i < n; ++i) {
    if (i % stride == 0 || std::abs(i - place) <= about / 2) {
      left.frequency_Hz.push_back(sweep.frequency_Hz[static_cast<std::size_t>(i)]);
      left.admittance_S.push_back(sweep.admittance_S[static_cast<std::size_t>(i)]);
    }
  }
  left.warnings.push_back(fmt::format(
      "Of {} readings {} are used: one of {}, and all about {}.", n, left.frequency_Hz.size(),
      stride, formatted("_Hz", sweep.frequency_Hz[static_cast<std::size_t>(place)])));
  return left;
}

}  // namespace

Selection select_of_any_length(const Sweep& sweep) {
  const std::vector<double>& all = sweep.frequency_Hz;
  if (all.size() <= most_readings) {
    return select_circuit(sweep);
  }
  const Place largest = largest_reading(sweep);
  Selection selected = select_circuit(thinned(sweep, largest));
  const Place resonance = std::lower_bound(all.begin(), all.end() - 1,
                                           selected.fit.circuit.modes.front().resonance_Hz) -
                          all.begin();
  constexpr auto margin = static_cast<Place>(most_readings / 12);
  return std::abs(resonance - largest) <= margin ? selected
                                                 : select_circuit(thinned(sweep, resonance));
}

namespace {

/// A refusal says what was assumed of the file.
Selection select_or_say_what_was_assumed(const Sweep& sweep) {
  try {
    return select_of_any_length(sweep);
  } catch (const loop::ComputationError& error) {
    std::string reason = error.what();
    for (const std::string& each : sweep.warnings) {
      reason +=
          (reason.back() == '?' ? " " : ". ") + each.substr(0, each.find_last_not_of('.') + 1);
    }
    throw loop::ComputationError(reason);
  }
}

/// Of the residuals, as the fit sees it or, where it sees too little, as they scatter.
double misfit_of(const CircuitFit& fit, const Description& description) {
  return std::max(description.residual * std::sqrt(fit.noise.correlated_share),
                  description.fails() ? description.misfit() : 0.0);
}

Correlations correlations_of(const CircuitFit& fit) {
  Correlations result;
  result.names.emplace_back("ln clamped_capacitance_F");
  for (std::size_t i = 0; i < part_count; ++i) {
    if (fit.parts.fitted[i]) {
      result.names.emplace_back(name_of(static_cast<Part>(i)));
    }
  }
  for (int mode = 1; mode <= fit.parts.modes; ++mode) {
    const std::string number = mode == 1 ? "" : fmt::format(" of mode {}", mode);
    for (const char* name :
         {"ln motional_conductance_S", "ln resonance_frequency_Hz", "ln bandwidth_Hz"}) {
      result.names.push_back(name + number);
    }
  }
  const std::vector<Eigen::Index> fitted = fit.parts.indices();
  const Eigen::MatrixXd matrix = correlations(fit.covariance(fitted, fitted));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    result.rows.emplace_back(matrix.row(i).begin(), matrix.row(i).end());
  }
  return result;
}

std::string model_of(const CircuitFit& fit) {
  const Parts& parts = fit.parts;
  std::vector<std::string> lead;
  append(lead, {{parts.has(Part::lead_resistance), "resistance"},
                {parts.has(Part::lead_inductance), "inductance"}});
  return fmt::format(
      "clamped capacitance{} beside {}{}{}{}{}{}",
      parts.has(Part::loss_tangent) ? " with a loss tangent" : "",
      parts.modes == 1 ? std::string("one motional branch")
                       : fmt::format("{} motional branches", parts.modes),
      parts.has(Part::lean) ? ", the first with a resonance that goes with its current" : "",
      lead.empty() ? "" : ", behind a lead of ", fmt::join(lead, " and "),
      parts.has(Part::rotation) ? ", with a rotation of all phases by one angle" : "",
      parts.has(Part::delay) ? ", with a delay between the channels" : "");
}

/// A figure that is open by more than a factor of ten is none.
void withhold(std::vector<Estimate>& estimates) {
  for (Estimate& each : estimates) {
    if (is_open(each)) {
      each.value = each.low_95 = each.high_95 = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

/// The scene, or why there is none.
void add_scene(ImpedanceStudy& study) {
  std::vector<std::string>& open = study.identification.cannot_tell;
  const std::vector<Estimate>& all = study.identification.parameters;
  if (std::any_of(all.begin(), all.end(),
                  [](const Estimate& each) { return !each.may_be_0 && std::isnan(each.value); })) {
    open.emplace_back("A scene: it needs the figures that are open.");
    return;
  }
  study.scene = scene_toml(study);
  try {
    experiment::read_text(study.scene, "scene.toml");
  } catch (const scene_file::SceneError& error) {
    study.scene.clear();
    open.push_back(fmt::format("A scene: no scene has what is identified. {}", error.what()));
  }
}

}  // namespace

ImpedanceStudy study(const std::string& name, const Sweep& measured, const MechanicalFact& fact) {
  Selection selected = select_or_say_what_was_assumed(measured);
  const Description description = selected.fit.description;
  Identification identification;
  identification.subject = "impedance";
  identification.model = model_of(selected.fit);
  identification.parameters = figures(selected.fit, fact);
  identification.residual_rms = description.residual;
  identification.misfit = misfit_of(selected.fit, description);
  identification.correlations = correlations_of(selected.fit);
  identification.warnings = warnings_of(selected);
  identification.cannot_tell = open_questions(identification.parameters, selected, fact);
  withhold(identification.parameters);
  ImpedanceStudy result{name, std::move(selected.sweep), std::move(selected.fit),
                        fact, std::move(identification), {}};
  if (fact.known()) {
    add_scene(result);
  }
  return result;
}

}  // namespace sonoglide::identify::impedance
