
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host_sim/output/number.hpp"
#include "host_sim/studies/design/report.hpp"
#include "host_sim/studies/design/study.hpp"

namespace sonoglide::design {
namespace {

double most_N(const DesignStudy& study) {
  return study.task.scene.max_drive_force_N();
}

std::string speed(double value_m_per_s) {
  return output::quantity(value_m_per_s, "m/s");
}

std::string force(double value_N) {
  return fmt::format("{:.4g} N", value_N);
}

const RatioRequirements& curve_of(const DesignStudy& study, double ratio) {
  return *std::find_if(study.curves.begin(), study.curves.end(),
                       [&](const RatioRequirements& curve) { return curve.ratio == ratio; });
}

/// Up to which speed a ratio is to be had; empty where that is not known.
std::string reach(const DesignStudy& study, double ratio) {
  const double fastest_m_per_s = curve_of(study, ratio).fastest_m_per_s;
  return std::isfinite(fastest_m_per_s)
             ? fmt::format("within reach up to {}", speed(fastest_m_per_s))
             : std::string();
}

std::string nearest_text(const steady::Requirement& point, const char* where) {
  return std::isfinite(point.reachable_ratio)
             ? fmt::format(" The nearest{} is {:.4f}", where, point.reachable_ratio)
             : std::string(" No nearer ratio was found");
}

/// Nothing where the ratio is within reach.
std::string shortfall(const DesignStudy& study, const steady::Requirement& point) {
  const std::string where =
      fmt::format("Ratio {:g} at {}", point.ratio, speed(point.sliding_m_per_s));
  switch (point.limit) {
    case steady::Obstacle::actuator: {
      const std::string slower = reach(study, point.ratio);
      return fmt::format("{} is beyond the drive: it needs {}, {:.3g} times the limit of {}.{}{}.",
                         where, force(point.motion.drive_force_N),
                         point.motion.drive_force_N / most_N(study), force(most_N(study)),
                         nearest_text(point, " at this speed"),
                         slower.empty() ? "" : fmt::format("; {:g} is {}", point.ratio, slower));
    }
    case steady::Obstacle::velocity_at_rail:
      return fmt::format(
          "{} is beyond the controller: its velocities end at {}. From there on it holds the drive, and "
          "then takes it to zero.",
          where, speed(study.task.full_scale_m_per_s));
    case steady::Obstacle::amplitude:
      return fmt::format("{} cannot be reached: more vibration raises the friction again.{}.",
                         where, nearest_text(point, ""));
    case steady::Obstacle::contact_lost:
      return fmt::format(
          "{} cannot be reached while the contact stays closed.{}; with more vibration it opens, "
          "and the mean normal force rises.",
          where, nearest_text(point, ""));
    case steady::Obstacle::unstable:
      return fmt::format("{} does not stay: {}.", where, point.reason);
    case steady::Obstacle::no_orbit:
      return fmt::format("{}: no steady vibration was found. {}.", where, point.reason);
    case steady::Obstacle::undriven:
    case steady::Obstacle::none:
      break;
  }
  return {};
}

/// The point of the most force for a ratio that is within reach.
Advice drive(const DesignStudy& study, const steady::Requirement& point) {
  const std::string topic = fmt::format("Ratio {:g}", point.ratio);
  if (point.limit == steady::Obstacle::undriven) {
    return {topic, "Needs no drive: the contact has this ratio undriven."};
  }
  const std::string further = reach(study, point.ratio);
  return {topic, fmt::format("Drive with {} ({:.3g} % of {}) at {}, a vibration of {} and {}{}.",
                             force(point.motion.drive_force_N),
                             100.0 * point.motion.drive_force_N / most_N(study),
                             force(most_N(study)), speed(point.sliding_m_per_s),
                             output::quantity(point.motion.displacement_amplitude_m, "m"),
                             speed(point.motion.velocity_amplitude_m_per_s),
                             further.empty() ? "" : "; " + further)};
}

/// Of a point: the magnitude; less than any where it is not known.
double miss(const DesignPoint& point) {
  const double error = std::abs(point.requirement.closed_form_error);
  return std::isnan(error) ? -1.0 : error;
}

Advice closed_form(const DesignStudy& study, const std::vector<DesignPoint>& points) {
  const DesignPoint& most = *std::max_element(
      points.begin(), points.end(),
      [](const DesignPoint& a, const DesignPoint& b) { return miss(a) < miss(b); });
  const steady::Requirement& worst = most.requirement;
  if (miss(most) < 0.0) {
    return {"Closed form",
            "With its forces the plant does not settle on an orbit of the carrier period."};
  }
  const double band = study.task.scene.run.settling_band;
  return {"Closed form",
          fmt::format("Its largest error is {:+.2g}, {} the settling band of {:g}: for ratio {:g} "
                      "at {} it gives {} in place of {}. It takes the motion as a sine.",
                      worst.closed_form_error, miss(most) > band ? "more than" : "within", band,
                      worst.ratio, speed(worst.sliding_m_per_s), force(worst.closed_form_force_N),
                      force(worst.motion.drive_force_N))};
}

Advice power(const DesignStudy& study, const std::vector<DesignPoint>& points) {
  const steady::Requirement& point =
      std::max_element(points.begin(), points.end(),
                       [](const DesignPoint& a, const DesignPoint& b) {
                         return a.requirement.motion.drive_power_W <
                                b.requirement.motion.drive_power_W;
                       })
          ->requirement;
  const steady::SteadyMotion& motion = point.motion;
  const auto watts = [](double value_W) { return output::quantity(value_W, "W"); };
  return {"Power",
          fmt::format(
              "The largest mechanical power is {}, for ratio {:g} at {}. Damping dissipates {}, "
              "friction {} (undriven {}). Another spring does not change them. It changes the "
              "apparent power of drive and mass, Fe v/2 = {}, which falls towards resonance.{}",
              watts(motion.drive_power_W), point.ratio, speed(point.sliding_m_per_s),
              watts(motion.damping_power_W), watts(motion.friction_power_W),
              watts(motion.undriven_friction_power_W), watts(motion.apparent_power_W),
              study.task.scene.transducer ? "" : " The piezo's electrical side is not modelled.")};
}

double total_change(const DesignPoint& point) {
  double sum = 0.0;
  for (const Sensitivity& each : point.sensitivities) {
    sum += std::isnan(each.largest_change()) ? 0.0 : each.largest_change();
  }
  return sum;
}

/// Parameters of which 1 % leaves the plant without an orbit; empty where there is none.
std::string lost_orbits(const DesignPoint& point) {
  std::string symbols;
  for (const Sensitivity& each : point.sensitivities) {
    if (std::isnan(each.largest_change())) {
      symbols += fmt::format("{}{}", symbols.empty() ? "" : ", ", each.parameter.symbol);
    }
  }
  return symbols.empty()
             ? symbols
             : fmt::format(" With 1 % more or less of {} the plant has no steady orbit.", symbols);
}

Advice accuracy(const DesignStudy& study, const std::vector<DesignPoint>& points) {
  const DesignPoint& worst = *std::max_element(
      points.begin(), points.end(),
      [](const DesignPoint& a, const DesignPoint& b) { return total_change(a) < total_change(b); });
  std::vector<Sensitivity> by_size;
  std::copy_if(worst.sensitivities.begin(), worst.sensitivities.end(), std::back_inserter(by_size),
               [](const Sensitivity& each) { return !std::isnan(each.largest_change()); });
  std::sort(by_size.begin(), by_size.end(), [](const Sensitivity& a, const Sensitivity& b) {
    return a.largest_change() > b.largest_change();
  });
  const double total = total_change(worst);
  const double band = study.task.scene.run.settling_band;
  const double ratio = worst.requirement.ratio;
  std::string text = fmt::format(
      "Without feedback, an error of 1 % in every parameter could shift ratio {:g} at {} {}, {} the "
      "settling band of {:g}.",
      ratio, speed(worst.requirement.sliding_m_per_s),
      total < std::max(ratio, 1.0 - ratio) ? fmt::format("by {:.3f}", total)
                                           : std::string("as far as it can move, to 0 or 1"),
      total > band ? "more than" : "within", band);
  if (by_size.size() > 1) {
    text += fmt::format(" It is most sensitive to {} ({:.4f} for 1 %) and {} ({:.4f}).",
                        by_size[0].parameter.symbol, by_size[0].largest_change(),
                        by_size[1].parameter.symbol, by_size[1].largest_change());
  }
  return {"Accuracy", text + lost_orbits(worst)};
}

std::string frequency(const DesignStudy& study, double tuning) {
  return output::quantity(std::sqrt(tuning) * study.task.scene.drive->frequency_Hz, "Hz");
}

/// The edge of the sensitive band below resonance, and what the drive needs there.
std::string lower_edge(const DesignStudy& study, const Detuning& detuning) {
  const double force_N = detuning.force_at_sensitive_low_N;
  return fmt::format("at {:.3g} ({}) it needs {}{}", detuning.sensitive->low,
                     frequency(study, detuning.sensitive->low), force(force_N),
                     force_N > most_N(study) ? ", more than the drive has" : "");
}

/// Where the spring stands, seen from resonance.
std::string position(const DesignStudy& study, const Detuning& detuning) {
  const double allowed = study.task.scene.run.settling_band;
  if (study.tuning > detuning.sensitive->high) {
    return "driven below resonance, outside the sensitive band";
  }
  if (study.tuning < detuning.sensitive->low) {
    return "driven above resonance, outside the sensitive band; a stiffer spring saves force: " +
           lower_edge(study, detuning);
  }
  if (detuning.change_by_stiffness <= allowed) {
    return fmt::format(
        "on the flat top of a damped resonance, 1 % of Ks moves ratio {:g} by {:.4f}",
        detuning.ratio, detuning.change_by_stiffness);
  }
  return fmt::format(
      "too near to resonance, 1 % of Ks moves ratio {:g} by {:.4f}; use feedback, or a softer "
      "spring: {}",
      detuning.ratio, detuning.change_by_stiffness, lower_edge(study, detuning));
}

Advice resonance(const DesignStudy& study, const Detuning& detuning) {
  const std::string here = fmt::format("Ks/(m w^2) = {:.3g}, natural frequency {}", study.tuning,
                                       frequency(study, study.tuning));
  if (!detuning.sensitive) {
    return {"Resonance",
            here + ": at every tuning, 1 % of Ks moves the ratio by less than the settling band."};
  }
  const TuningBand& band = *detuning.sensitive;
  const std::string high =
      band.high < largest_tuning ? fmt::format("to {:.3g}", band.high) : std::string("up");
  return {"Resonance",
          fmt::format("{}: {}. Avoid Ks/(m w^2) from {:.3g} {}: there 1 % of Ks may move the "
                      "ratio by more than the settling band of {:g}.",
                      here, position(study, detuning), band.low, high,
                      study.task.scene.run.settling_band)};
}

/// An end that was not found lies beyond the tunings that were tried.
std::string band_text(const TuningBand& band) {
  const bool has_low = band.low > smallest_tuning;
  const bool has_high = band.high < largest_tuning;
  if (!has_low && !has_high) {
    return fmt::format("every Ks/(m w^2) that was tried, {:g} to {:g}", band.low, band.high);
  }
  if (!has_high) {
    return fmt::format("Ks/(m w^2) from {:.3g} on; up to {:g} was tried", band.low, band.high);
  }
  return has_low ? fmt::format("Ks/(m w^2) from {:.3g} to {:.3g}", band.low, band.high)
                 : fmt::format("Ks/(m w^2) up to {:.3g}", band.high);
}

Advice tuning_reach(const Detuning& detuning) {
  return {"Detuning", fmt::format("The drive reaches ratio {:g} at {} for {}.", detuning.ratio,
                                  speed(detuning.sliding_m_per_s), band_text(*detuning.reachable))};
}

Advice amplifier(const DesignStudy& study, const steady::Requirement& point) {
  const scene::Scene& scene = study.task.scene;
  const loop::ElectricalFigures& figures = *point.motion.electrical;
  return {
      "Amplifier",
      fmt::format(
          "The largest demand, for ratio {:g} at {}: {} and {}, {} for {} (power factor "
          "{:.2g}). The clamped capacitance alone takes {}. k_eff = {:.3f}, series "
          "resonance {}, parallel resonance {}.",
          point.ratio, speed(point.sliding_m_per_s), output::quantity(figures.voltage_peak_V, "V"),
          output::quantity(figures.current_peak_A, "A"),
          output::quantity(figures.apparent_power_VA, "VA"),
          output::quantity(figures.active_power_W, "W"), figures.power_factor,
          output::quantity(clamped_power_VA(scene, figures.voltage_peak_V), "VA"),
          std::sqrt(coupling_square(scene)), output::quantity(scene.plant.natural_Hz(), "Hz"),
          output::quantity(parallel_resonance_Hz(scene), "Hz"))};
}

/// What an inductor and a spring would save.
Advice relief(const DesignStudy& study, const steady::Requirement& point) {
  const loop::ElectricalFigures& figures = *point.motion.electrical;
  const double inductance_H = matching_inductance_H(study.task.scene, figures);
  std::string sentence =
      std::isfinite(inductance_H)
          ? fmt::format(
                "An inductor of {} in parallel with the transducer compensates its reactive power "
                "at the carrier. The amplifier then supplies {} and the losses of the inductor.",
                output::quantity(inductance_H, "H"), output::quantity(figures.active_power_W, "W"))
          : std::string("The transducer is not capacitive: an inductor would not help.");
  if (study.task.at_resonance) {
    return {"Matching", sentence};
  }
  const ResonantSpring& spring = *study.resonant_spring;
  sentence += fmt::format(" A spring of {} puts the resonance on the carrier",
                          output::quantity(spring.stiffness_N_per_m, "N/m"));
  if (const auto& resonant = spring.requirement.motion.electrical) {
    sentence += fmt::format(
        ": the same ratio then takes {}, {} and {}, and needs feedback "
        "to hold it.",
        output::quantity(resonant->voltage_peak_V, "V"),
        output::quantity(resonant->current_peak_A, "A"),
        output::quantity(resonant->apparent_power_VA, "VA"));
  } else {
    sentence += ", where no steady vibration of this ratio was found.";
  }
  return {"Matching", sentence};
}

}  // namespace

std::vector<std::string> shortfalls(const DesignStudy& study) {
  std::vector<std::string> all;
  for (const DesignPoint& point : study.points) {
    std::string sentence = shortfall(study, point.requirement);
    if (!sentence.empty()) {
      all.push_back(std::move(sentence));
    }
  }
  return all;
}

std::vector<Advice> advice(const DesignStudy& study) {
  std::vector<Advice> all;
  for (const DesignPoint& point : study.points) {
    const steady::Requirement& each = point.requirement;
    const bool hardest = each.sliding_m_per_s == study.task.speeds.fastest_m_per_s;
    if (hardest &&
        (each.limit == steady::Obstacle::none || each.limit == steady::Obstacle::undriven)) {
      all.push_back(drive(study, each));
    }
  }
  const std::vector<DesignPoint> points = moving_points(study);
  if (!points.empty()) {
    all.push_back(closed_form(study, points));
    all.push_back(power(study, points));
    all.push_back(accuracy(study, points));
  }
  if (const steady::Requirement* most = most_electrical(study)) {
    all.push_back(amplifier(study, *most));
    all.push_back(relief(study, *most));
  }
  if (study.natural_mode) {
    const std::vector<Advice> mode = natural_mode_advice(*study.natural_mode);
    all.insert(all.end(), mode.begin(), mode.end());
  }
  for (const SelfExcitation& each : study.self_excitation) {
    all.push_back(self_excitation_advice(each));
  }
  if (!study.detunings.empty() && !study.task.at_resonance) {
    const Detuning& lowest = study.detunings.front();
    all.push_back(resonance(study, lowest));
    if (lowest.reachable) {
      all.push_back(tuning_reach(lowest));
    }
  }
  return all;
}

}  // namespace sonoglide::design
