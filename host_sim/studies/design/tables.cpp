#include "host_sim/studies/design/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host_sim/output/number.hpp"
#include "host_sim/output/program.hpp"
#include "host_sim/scene_file/echo.hpp"

namespace sonoglide::design {
namespace {

using nlohmann::ordered_json;

std::string electrical_cells(const steady::SteadyMotion& motion) {
  if (!motion.electrical) {
    return output::csv_cells(std::vector<double>(5, steady::undefined));
  }
  const loop::ElectricalFigures& figures = *motion.electrical;
  return output::csv_cells({figures.voltage_peak_V, figures.current_peak_A, figures.active_power_W,
                            figures.reactive_power_var, figures.apparent_power_VA});
}

std::string row(const steady::Requirement& point, bool has_transducer) {
  const steady::SteadyMotion& motion = point.motion;
  return fmt::format(
      "{},{}{}\n",
      output::csv_cells({point.sliding_m_per_s, point.ratio, motion.drive_force_N,
                         motion.displacement_amplitude_m, motion.velocity_amplitude_m_per_s,
                         motion.drive_power_W, motion.apparent_power_W, motion.friction_power_W,
                         motion.undriven_friction_power_W, motion.damping_power_W,
                         point.closed_form_force_N, point.closed_form_error,
                         point.reachable_ratio}),
      name(point.limit), has_transducer ? ',' + electrical_cells(motion) : "");
}

ordered_json sensitivity_json(const Sensitivity& sensitivity) {
  return {{"key", sensitivity.parameter.key},
          {"symbol", sensitivity.parameter.symbol},
          {"logarithmic_derivative", output::json_number(sensitivity.logarithmic)},
          {"ratio_change_by_1_percent_more", output::json_number(sensitivity.change_by_more)},
          {"ratio_change_by_1_percent_less", output::json_number(sensitivity.change_by_less)}};
}

ordered_json electrical_json(const scene::Scene& scene, const loop::ElectricalFigures& figures) {
  return {{"voltage_V", figures.voltage_peak_V},
          {"current_A", figures.current_peak_A},
          {"active_power_W", figures.active_power_W},
          {"reactive_power_var", figures.reactive_power_var},
          {"apparent_power_VA", figures.apparent_power_VA},
          {"power_factor", output::json_number(figures.power_factor)},
          {"clamped_power_VA", clamped_power_VA(scene, figures.voltage_peak_V)},
          {"matching_inductance_H", output::json_number(matching_inductance_H(scene, figures))}};
}

ordered_json transducer_json(const DesignStudy& study) {
  const scene::Scene& scene = study.task.scene;
  ordered_json json = {
      {"coupling", std::sqrt(coupling_square(scene))},
      {"series_resonance_Hz", scene.plant.natural_Hz()},
      {"parallel_resonance_Hz", output::json_number(parallel_resonance_Hz(scene))}};
  if (study.resonant_spring) {
    const steady::Requirement& requirement = study.resonant_spring->requirement;
    json["on_resonance"] = {{"stiffness_N_per_m", study.resonant_spring->stiffness_N_per_m},
                            {"friction_ratio", requirement.ratio},
                            {"sliding_velocity_m_per_s", requirement.sliding_m_per_s},
                            {"limit", name(requirement.limit)}};
    if (const auto& electrical = requirement.motion.electrical) {
      json["on_resonance"]["electrical"] = electrical_json(scene, *electrical);
    }
  }
  return json;
}

ordered_json point_json(const scene::Scene& scene, const DesignPoint& point) {
  const steady::Requirement& each = point.requirement;
  ordered_json json = {
      {"sliding_velocity_m_per_s", each.sliding_m_per_s},
      {"friction_ratio", each.ratio},
      {"limit", name(each.limit)},
      {"reachable_friction_ratio", output::json_number(each.reachable_ratio)},
      {"drive_force_N", output::json_number(each.motion.drive_force_N)},
      {"displacement_amplitude_m", output::json_number(each.motion.displacement_amplitude_m)},
      {"velocity_amplitude_m_per_s", output::json_number(each.motion.velocity_amplitude_m_per_s)},
      {"drive_power_W", output::json_number(each.motion.drive_power_W)},
      {"apparent_power_W", output::json_number(each.motion.apparent_power_W)},
      {"friction_power_W", output::json_number(each.motion.friction_power_W)},
      {"undriven_friction_power_W", output::json_number(each.motion.undriven_friction_power_W)},
      {"damping_power_W", output::json_number(each.motion.damping_power_W)},
      {"closed_form",
       {{"drive_force_N", output::json_number(each.closed_form_force_N)},
        {"friction_ratio_error", output::json_number(each.closed_form_error)}}},
      {"sensitivities", ordered_json::array()}};
  if (each.motion.electrical) {
    json["electrical"] = electrical_json(scene, *each.motion.electrical);
  }
  if (!each.reason.empty()) {
    json["reason"] = each.reason;
  }
  for (const Sensitivity& sensitivity : point.sensitivities) {
    json["sensitivities"].push_back(sensitivity_json(sensitivity));
  }
  return json;
}

ordered_json band_json(const std::optional<TuningBand>& band) {
  return band ? ordered_json{{"low", band->low}, {"high", band->high}} : ordered_json(nullptr);
}

ordered_json detuning_json(const Detuning& detuning) {
  return {
      {"friction_ratio", detuning.ratio},
      {"sliding_velocity_m_per_s", detuning.sliding_m_per_s},
      {"reachable_tuning", band_json(detuning.reachable)},
      {"sensitive_tuning", band_json(detuning.sensitive)},
      {"ratio_change_by_1_percent_stiffness", output::json_number(detuning.change_by_stiffness)},
      {"drive_force_at_sensitive_low_N", output::json_number(detuning.force_at_sensitive_low_N)}};
}

}  // namespace

std::string requirements_csv(const DesignStudy& study) {
  std::string csv =
      "sliding_velocity_m_per_s,friction_ratio,drive_force_N,displacement_amplitude_m,"
      "velocity_amplitude_m_per_s,drive_power_W,apparent_power_W,friction_power_W,"
      "undriven_friction_power_W,damping_power_W,closed_form_force_N,closed_form_ratio_error,"
      "reachable_friction_ratio,limit";
  const bool has_transducer = study.task.scene.transducer.has_value();
  csv += has_transducer ? ",voltage_V,current_A,active_power_W,reactive_power_var,"
                          "electrical_apparent_power_VA\n"
                        : "\n";
  for (const RatioRequirements& curve : study.curves) {
    for (const steady::Requirement& point : curve.requirements) {
      csv += row(point, has_transducer);
    }
  }
  return csv;
}

std::string detuning_csv(const DesignStudy& study) {
  std::string csv =
      "friction_ratio,tuning,drive_force_N,ratio_change_by_1_percent_stiffness,"
      "friction_ratio_at_the_scenes_force\n";
  for (const Detuning& detuning : study.detunings) {
    for (const DetunedPoint& point : detuning.points) {
      csv += output::csv_cells({detuning.ratio, point.tuning, point.drive_force_N,
                                point.change_by_stiffness, point.ratio_at_same_force}) +
             '\n';
    }
  }
  return csv;
}

ordered_json to_json(const DesignStudy& study) {
  ordered_json json;
  json["program"] = output::program_json();
  json["scene"] = scene_file::to_json(study.task.stated);
  json["tuning"] = study.tuning;
  json["speed_floor_m_per_s"] = study.task.speed_floor_m_per_s;
  if (study.task.scene.transducer) {
    json["transducer"] = transducer_json(study);
  }
  json["points"] = ordered_json::array();
  for (const DesignPoint& point : study.points) {
    json["points"].push_back(point_json(study.task.scene, point));
  }
  json["reach"] = ordered_json::array();
  for (const RatioRequirements& curve : study.curves) {
    json["reach"].push_back(
        {{"friction_ratio", curve.ratio},
         {"fastest_sliding_m_per_s", output::json_number(curve.fastest_m_per_s)}});
  }
  json["detuning"] = ordered_json::array();
  for (const Detuning& detuning : study.detunings) {
    json["detuning"].push_back(detuning_json(detuning));
  }
  if (study.natural_mode) {
    json["natural_mode"] = to_json(*study.natural_mode);
  }
  for (const SelfExcitation& each : study.self_excitation) {
    json["self_excitation"].push_back(to_json(each));
  }
  return json;
}

}  // namespace sonoglide::design
