#include "host_sim/studies/identify/impedance/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/loop/failure.hpp"
#include "host_sim/studies/identify/impedance/description.hpp"
#include "host_sim/studies/identify/impedance/figures.hpp"
#include "host_sim/studies/identify/impedance/remarks.hpp"
#include "host_sim/studies/identify/impedance/thinning.hpp"
#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
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
  if (fit.parts.loss_tangent) {
    result.names.emplace_back("loss_tangent");
  }
  if (has_resistance(fit.parts.lead)) {
    result.names.emplace_back("lead_resistance_ohm");
  }
  if (has_inductance(fit.parts.lead)) {
    result.names.emplace_back("lead_inductance_H");
  }
  for (int mode = 1; mode <= fit.parts.modes; ++mode) {
    const std::string number = mode == 1 ? "" : fmt::format(" of mode {}", mode);
    for (const char* name :
         {"ln motional_conductance_S", "ln resonance_frequency_Hz", "ln bandwidth_Hz"}) {
      result.names.push_back(name + number);
    }
  }
  const Eigen::MatrixXd matrix = correlations(fit.covariance);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    result.rows.emplace_back(matrix.row(i).begin(), matrix.row(i).end());
  }
  return result;
}

std::string model_of(const CircuitFit& fit) {
  constexpr const char* leads[] = {"", ", behind a lead of resistance",
                                   ", behind a lead of inductance",
                                   ", behind a lead of resistance and inductance"};
  return fmt::format("clamped capacitance{} beside {}{}",
                     fit.parts.loss_tangent ? " with a loss tangent" : "",
                     fit.parts.modes == 1 ? std::string("one motional branch")
                                          : fmt::format("{} motional branches", fit.parts.modes),
                     leads[static_cast<std::size_t>(fit.parts.lead)]);
}

}  // namespace

ImpedanceStudy study(const std::string& name, const Sweep& measured, const MechanicalFact& fact) {
  Selection selected = select_or_say_what_was_assumed(measured);
  const Description description = describe(selected.fit);
  Identification identification;
  identification.subject = "impedance";
  identification.model = model_of(selected.fit);
  identification.parameters = figures(selected.fit);
  identification.residual_rms = description.residual;
  identification.misfit = misfit_of(selected.fit, description);
  identification.correlations = correlations_of(selected.fit);
  identification.warnings = warnings_of(selected);
  identification.cannot_tell = open_questions(identification.parameters, selected, fact);
  if (fact.known()) {
    const std::vector<Estimate> mechanical = mechanical_figures(selected.fit, fact);
    identification.parameters.insert(identification.parameters.end(), mechanical.begin(),
                                     mechanical.end());
  }
  return {name, std::move(selected.sweep), std::move(selected.fit), fact,
          std::move(identification)};
}

}  // namespace sonoglide::identify::impedance
