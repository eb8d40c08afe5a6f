#include "host_sim/studies/identify/friction/comparison.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host_sim/output/number.hpp"
#include "host_sim/studies/identify/identification.hpp"

namespace sonoglide::identify::friction {

std::string verdict(const Comparison& comparison, const LawFit& fit) {
  std::string text;
  if (!fit.is_determined) {
    return "not determined: fewer different readings than parameters";
  }
  if (fit.exceeds_standard_errors()) {
    text = "fails: larger than the standard errors";
  } else if (fit.runs_probability < fails_below) {
    text = "fails: residuals have a pattern";
  }
  const double difference = comparison.difference(fit);
  const bool told = std::isfinite(difference) && difference >= told_apart_from;
  if (told) {
    text += fmt::format("{}worse than the best", text.empty() ? "" : "; ");
  }
  return text.empty() ? "possible" : text;
}

namespace {

using nlohmann::ordered_json;

ordered_json law_json(const Comparison& comparison, const LawFit& fit) {
  ordered_json json;
  json["law"] = fit.law.law;
  if (fit.law.elements > 0) {
    json["elements"] = fit.law.elements;
  }
  json["vibration"] = fit.law.direction;
  json["verdict"] = verdict(comparison, fit);
  json["parameters"] = identify::to_json(fit.parameters);
  json["residual_rms"] = output::json_number(fit.residual_rms);
  json["misfit"] = output::json_number(fit.misfit);
  json["aicc"] = output::json_number(fit.akaike);
  json["aicc_difference"] = output::json_number(comparison.difference(fit));
  json["runs_probability"] = output::json_number(fit.runs_probability);
  json["autocorrelation"] = output::json_number(fit.autocorrelation);
  json["chi_square_probability"] = output::json_number(fit.chi_square_probability);
  json["open"] = fit.open;
  return json;
}

std::string law_line(const Comparison& comparison, const LawFit& fit) {
  return fmt::format("{:<22} {:<18} {:<7} {:>2} {:>9} {:>9.2g} {:>8.2g} {:>7.2g}  {}\n",
                     fit.law.title, fit.law.law, fit.law.direction, fit.parameter_count(),
                     output::formatted(comparison.difference(fit), "{:.1f}"), fit.residual_rms,
                     fit.misfit, fit.runs_probability, verdict(comparison, fit));
}

std::string text(const Comparison& comparison) {
  std::string lines =
      fmt::format("{:<22} {:<18} {:<7} {:>2} {:>9} {:>9} {:>8} {:>7}\n", "law", "--law", "vibr.",
                  "p", "AICc diff", "residual", "misfit", "runs p");
  for (const LawFit& each : comparison.laws) {
    lines += law_line(comparison, each);
  }
  lines += '\n';
  for (const Estimate& each : comparison.best().parameters) {
    lines += fmt::format("{}: {} = {} ({} to {})\n", comparison.best().law.title, each.name,
                         formatted(each.name, each.value, "open"),
                         formatted(each.name, each.low_95, "open"),
                         formatted(each.name, each.high_95, "open"));
  }
  return lines + remark_lines(comparison.warnings, comparison.cannot_tell);
}

}  // namespace

ordered_json to_json(const Comparison& comparison) {
  const LawFit& best = comparison.best();
  ordered_json json = identify::to_json(Identification{"friction",
                                                       best.law.title,
                                                       best.parameters,
                                                       best.residual_rms,
                                                       best.misfit,
                                                       {},
                                                       comparison.warnings,
                                                       comparison.cannot_tell});
  json["law"] = best.law.law;
  json["readings"] = comparison.readings.rows.size();
  json["laws"] = ordered_json::array();
  for (const LawFit& each : comparison.laws) {
    json["laws"].push_back(law_json(comparison, each));
  }
  return json;
}

output::StudyReport report(const Comparison& comparison, const std::string& name) {
  return {{{"report.html", output::to_html(page(comparison, name))},
           {"identify.json", to_json(comparison).dump(2) + '\n'},
           {"scene.toml", comparison.scene}},
          text(comparison)};
}

}  // namespace sonoglide::identify::friction
