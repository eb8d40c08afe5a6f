#include "host_sim/studies/identify/friction/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host_sim/output/output_folder.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/studies/identify/friction/scene_text.hpp"
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

std::string interval_text(const Estimate& estimate) {
  const auto end = [&](double value, const char* open) {
    return std::isfinite(value) ? shown(estimate.name, value) : std::string(open);
  };
  return fmt::format("{} ({} to {})", end(estimate.value, "-"), end(estimate.low_95, "open"),
                     end(estimate.high_95, "open"));
}

namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

Identification identification(const Comparison& comparison, const LawFit& fit) {
  Identification all{};
  all.subject = "friction";
  all.model = fit.law.title;
  all.parameters = fit.parameters;
  all.residual_rms = fit.residual_rms;
  all.misfit = fit.misfit;
  all.warnings = comparison.warnings;
  all.cannot_tell = comparison.cannot_tell;
  return all;
}

ordered_json law_json(const Comparison& comparison, const LawFit& fit) {
  ordered_json json;
  json["law"] = fit.law.law;
  if (fit.law.elements > 0) {
    json["elements"] = fit.law.elements;
  }
  json["vibration"] = fit.law.direction;
  json["verdict"] = verdict(comparison, fit);
  json["parameters"] = identify::to_json(identification(comparison, fit))["parameters"];
  json["residual_rms"] = number(fit.residual_rms);
  json["misfit"] = number(fit.misfit);
  json["aicc"] = number(fit.akaike);
  json["aicc_difference"] = number(comparison.difference(fit));
  json["runs_probability"] = number(fit.runs_probability);
  json["autocorrelation"] = number(fit.autocorrelation);
  json["chi_square_probability"] = number(fit.chi_square_probability);
  json["open"] = fit.open;
  return json;
}

std::string law_line(const Comparison& comparison, const LawFit& fit) {
  const double difference = comparison.difference(fit);
  return fmt::format(
      "{:<22} {:<18} {:<7} {:>2} {:>9} {:>9.2g} {:>8.2g} {:>7.2g}  {}\n", fit.law.title,
      fit.law.law, fit.law.direction, fit.parameter_count(),
      std::isfinite(difference) ? fmt::format("{:.1f}", difference) : std::string("-"),
      fit.residual_rms, fit.misfit, fit.runs_probability, verdict(comparison, fit));
}

}  // namespace

ordered_json to_json(const Comparison& comparison) {
  ordered_json json = identify::to_json(identification(comparison, comparison.best()));
  json.erase("correlations");
  json["law"] = comparison.best().law.law;
  json["readings"] = comparison.readings.rows.size();
  json["laws"] = ordered_json::array();
  for (const LawFit& each : comparison.laws) {
    json["laws"].push_back(law_json(comparison, each));
  }
  return json;
}

void write(const std::filesystem::path& out, const Comparison& comparison,
           const std::string& name) {
  const std::string html = output::to_html(page(comparison, name));
  output::OutputFolder folder(out);
  folder.write("report.html", html);
  folder.write("identify.json", to_json(comparison).dump(2) + '\n');
  if (comparison.has_scene) {
    folder.write("scene.toml", scene_text(comparison));
  }
  folder.commit();
}

std::string text(const Comparison& comparison, const std::filesystem::path& out) {
  std::string lines =
      fmt::format("{:<22} {:<18} {:<7} {:>2} {:>9} {:>9} {:>8} {:>7}\n", "law", "--law", "vibr.",
                  "p", "AICc diff", "residual", "misfit", "runs p");
  for (const LawFit& each : comparison.laws) {
    lines += law_line(comparison, each);
  }
  lines += '\n';
  for (const Estimate& each : comparison.best().parameters) {
    lines +=
        fmt::format("{}: {} = {}\n", comparison.best().law.title, each.name, interval_text(each));
  }
  for (const std::string& each : comparison.warnings) {
    lines += fmt::format("WARNING: {}\n", each);
  }
  for (const std::string& each : comparison.cannot_tell) {
    lines += fmt::format("CANNOT TELL: {}\n", each);
  }
  return lines + fmt::format("report: {}\n", process::printable((out / "report.html").string()));
}

}  // namespace sonoglide::identify::friction
