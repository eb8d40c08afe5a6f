#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/output/chart.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/studies/design/natural_mode_words.hpp"
#include "host_sim/studies/design/report.hpp"

namespace sonoglide::design {

std::string means(const QuietDrive& drive) {
  std::string notch = fmt::format("a notch of {} taps", drive.tap_count);
  switch (drive.quieting) {
    case configure::Quieting::notch:
      return notch;
    case configure::Quieting::ramp:
      return "the ramp alone";
    case configure::Quieting::ramp_and_notch:
      return "the ramp and " + notch;
    case configure::Quieting::nothing:
      break;
  }
  return "no notch";
}

std::string word(const QuietDrive& drive) {
  return fmt::format("drive.interpolation = \"{}\"",
                     scene::name_of(scene::interpolations, drive.interpolation));
}

std::string promptly() {
  return fmt::format("within {} carrier periods", prompt_periods);
}

std::string tally_text(const Tally& tally) {
  return fmt::format("{} settle {}, {} later, {} never", tally.settled, promptly(), tally.late,
                     tally.never);
}

namespace {

using nlohmann::ordered_json;

constexpr std::array<scene::Named<configure::Quieting>, 4> quietings = {{
    {"nothing", configure::Quieting::nothing},
    {"notch", configure::Quieting::notch},
    {"ramp", configure::Quieting::ramp},
    {"ramp_and_notch", configure::Quieting::ramp_and_notch},
}};

/// A swing by more than half cannot be: the ratio of a contact stays between -1 and 1.
constexpr double largest_swing = 0.5;

std::string swing_text(const QuietDrive& drive) {
  return drive.left.ratio_swing > largest_swing ? fmt::format("more than ±{:g}", largest_swing)
                                                : fmt::format("±{:.2g}", drive.left.ratio_swing);
}

/// Over the forced vibration.
std::string left_text(const QuietDrive& drive) {
  const double left = drive.left.left;
  return left < 2.0 ? fmt::format("{:.3g} %", 100.0 * left) : fmt::format("{:.2g} times", left);
}

std::string left_behind(const QuietDrive& drive) {
  return fmt::format(
      "with {} ({}) a change of the amplitude is complete after {:g} carrier {} and leaves {} free "
      "vibration, which swings the ratio by {}",
      word(drive), means(drive), drive.changing_periods,
      drive.changing_periods == 1.0 ? "period" : "periods", left_text(drive), swing_text(drive));
}

/// The number of a multiple of the carrier, as a place.
std::string multiple(const CarrierPoint& point) {
  const double whole = std::round(point.mode_per_carrier);
  return whole == 0.0   ? std::string("0")
         : whole == 1.0 ? std::string("the carrier itself")
                        : fmt::format("{:g} times the carrier", whole);
}

std::string tried(const NaturalModeStudy& mode) {
  return fmt::format("{} plants with the stiffness off by up to {:.2g} %{}{}", mode.plants,
                     100.0 * mode.stiffness_range,
                     mode.model_error ? " on top of the scene's [model_error]" : "",
                     mode.assumed_range ? ", as the scene tells of no [tolerance]" : "");
}

Advice mode_advice(const NaturalModeStudy& mode) {
  const CarrierPoint& own = mode.carriers[mode.own];
  return {
      "Natural mode",
      fmt::format("{} is {:.4g} times the carrier, {:.3g} carrier frequencies from {}. Where it is "
                  "off by up to {:.2g} %, over the forced vibration: {}; {}.",
                  output::quantity(mode.natural_Hz, "Hz"), own.mode_per_carrier, own.from_multiple,
                  multiple(own), 100.0 * mode.range, left_behind(mode.drives.front()),
                  left_behind(mode.drives.back()))};
}

/// Of the controller of damped_by_force.toml: float32 on a Cortex-M4F to Q31 on a Cortex-M3.
constexpr const char* observer_cost = "1089 to 2074 instructions a period and 18 kB";

Advice controller_advice(const NaturalModeStudy& mode) {
  const QuietDrive& best = mode.drives[mode.best_drive];
  const std::string found = fmt::format("{} ({}): of {}, {}.", word(best), means(best), tried(mode),
                                        tally_text(best.plants));
  const bool shown = mode.recommended_loop.means.kind != configure::ModeKind::across;
  if (best.plants.never == 0) {
    return {"Controller",
            fmt::format(
                "The cheapest that holds this plant feeds the drive forward with {} It does "
                "without an observer of the mode{}.",
                found,
                shown ? fmt::format(", which controller.vibration = \"damped\" has and which takes "
                                    "{} where there is no vibration sensor",
                                    observer_cost)
                      : "")};
  }
  return {"Controller",
          fmt::format("The best that feeds the drive forward has {} For the others use another "
                      "carrier, or controller.vibration = \"damped\"{}.",
                      found,
                      shown ? fmt::format(", best with a vibration sensor; without one its "
                                          "observer takes {}",
                                          observer_cost)
                            : " with a vibration sensor")};
}

std::string keys(const RecommendedLoop& loop) {
  std::vector<std::string> all;
  for (const SceneLine& line : loop.lines) {
    all.push_back(fmt::format("{}.{} = {}", line.table, line.key, line.value));
  }
  return fmt::format("{}", fmt::join(all, ", "));
}

std::string line_text(const SceneLine& line) {
  return fmt::format("{} = {}", line.key, line.value);
}

/// The lines of each table, in their order.
std::vector<std::pair<std::string, std::vector<std::string>>> lines_by_table(
    const RecommendedLoop& loop) {
  std::vector<std::pair<std::string, std::vector<std::string>>> tables;
  for (const SceneLine& line : loop.lines) {
    if (tables.empty() || tables.back().first != line.table) {
      tables.emplace_back(line.table, std::vector<std::string>{});
    }
    tables.back().second.push_back(line_text(line));
  }
  return tables;
}

/// What to write into a scene that has none of the recommended means: TOML, to be pasted table by table.
Advice keys_advice(const RecommendedLoop& loop) {
  std::string sentence = "For the recommended loop ";
  if (!loop.leaves.empty()) {
    sentence +=
        fmt::format("leave out {}, if the scene has them, and ", fmt::join(loop.leaves, ", "));
  }
  sentence +=
      "write these lines below the header of each table, in place of lines with the same keys:";
  for (const auto& [table, lines] : lines_by_table(loop)) {
    sentence += fmt::format("\n[{}]\n{}", table, fmt::join(lines, "\n"));
  }
  return {"Keys", sentence};
}

/// Which loop reaches the most with the force sensor alone.
Advice recommended_advice(const NaturalModeStudy& mode) {
  const RecommendedLoop& loop = mode.recommended_loop;
  if (!loop.refused.empty()) {
    return {"Recommended",
            fmt::format("A mode there does best with {}, because {}. This scene cannot have "
                        "it: {}.",
                        keys(loop), configure::reason(loop.means.kind), loop.refused)};
  }
  return {"Recommended",
          fmt::format("With the force sensor alone, {}: {}. Of {}, {}.{}", keys(loop),
                      configure::reason(loop.means.kind), tried(mode), tally_text(loop.plants),
                      loop.friction == scene::FrictionSource::trusted
                          ? " The first target is too short for a calibration of the friction."
                          : "")};
}

Advice bias_advice(const NaturalModeStudy& mode) {
  return {"Bias",
          fmt::format("Below {:g} carrier frequencies the friction itself moves the mass, which no "
                      "amplitude of the drive prevents. A force that is constant over a carrier "
                      "period does: drive.bias_limit_N = {:.3g} or more, with "
                      "controller.vibration = \"damped\", best with sensor.vibration = "
                      "\"velocity\". With these of {}, {}.",
                      configure::slow_mode, mode.bias->limit_N, tried(mode),
                      tally_text(mode.bias->plants))};
}

Advice carrier_advice(const NaturalModeStudy& mode) {
  const CarrierPoint& own = mode.carriers[mode.own];
  const auto settled = [&](const CarrierPoint& point) {
    return fmt::format("{} of {} settle {}", point.plants.settled, mode.plants, promptly());
  };
  if (!mode.recommended) {
    return {"Carrier",
            fmt::format("Of {}, none settles {} at any carrier from {} to {}.", tried(mode),
                        promptly(), output::quantity(mode.carriers.front().frequency_Hz, "Hz"),
                        output::quantity(mode.carriers.back().frequency_Hz, "Hz"))};
  }
  const CarrierPoint& best = mode.carriers[*mode.recommended];
  // That the stiffness may be off moves the mode by so many carrier frequencies.
  const double moved = 0.5 * mode.stiffness_range * best.mode_per_carrier;
  const std::string far = fmt::format(
      "the mode is {:.3g} carrier frequencies from {} there, and such a stiffness moves it by {:.2g}",
      best.from_multiple, multiple(best), moved);
  if (*mode.recommended == mode.own) {
    return {"Carrier",
            fmt::format("Keep {}{}: of {}, {}; {}.", output::quantity(own.frequency_Hz, "Hz"),
                        best_other_carrier(mode).plants.settled > own.plants.settled
                            ? ", as no other settles two plants more"
                            : "",
                        tried(mode), settled(best), far)};
  }
  return {"Carrier", fmt::format("Use {} in place of {}: of {}, {} (here {}); {}.",
                                 output::quantity(best.frequency_Hz, "Hz"),
                                 output::quantity(own.frequency_Hz, "Hz"), tried(mode),
                                 settled(best), own.plants.settled, far)};
}

output::Chart carrier_chart(const NaturalModeStudy& mode) {
  output::Chart chart{"Plants that settle at carriers around the scene's",
                      fmt::format("{} at each carrier. Settled: every target within {} carrier "
                                  "periods. Without a mark the drive has not the force.",
                                  tried(mode), prompt_periods),
                      {"Carrier frequency [Hz]"},
                      {"Plants [-]"},
                      {},
                      {}};
  chart.y_axis.has_zero = true;
  chart.y_axis.whole_numbers = true;
  output::Curve settled{"settled", {}};
  output::Curve late{"late", {}};
  output::Curve never{"never", {}};
  for (const CarrierPoint& point : mode.carriers) {
    const auto count = [&](std::size_t plants) {
      return point.reachable ? static_cast<double>(plants) : steady::undefined;
    };
    chart.x.push_back(point.frequency_Hz);
    settled.y.push_back(count(point.plants.settled));
    late.y.push_back(count(point.plants.late));
    never.y.push_back(count(point.plants.never));
  }
  chart.curves = {std::move(settled), std::move(late), std::move(never)};
  chart.curves.push_back(
      {"the scene", {1.0}, output::Line::full_height, {mode.carriers[mode.own].frequency_Hz}});
  return chart;
}

output::Table drives_table(const NaturalModeStudy& mode) {
  output::Table table{"What keeps the natural mode quiet",
                      {"Drive", "Quieted by", "Taps", "Complete after", "Free vibration left",
                       "Swing of the ratio", "Settled", "Late", "Never"},
                      {}};
  for (const QuietDrive& drive : mode.drives) {
    table.rows.push_back(
        {std::string(scene::name_of(scene::interpolations, drive.interpolation)), means(drive),
         fmt::format("{}", drive.tap_count), fmt::format("{:g} periods", drive.changing_periods),
         left_text(drive), swing_text(drive), fmt::format("{}", drive.plants.settled),
         fmt::format("{}", drive.plants.late), fmt::format("{}", drive.plants.never)});
  }
  return table;
}

}  // namespace

std::vector<Advice> natural_mode_advice(const NaturalModeStudy& mode) {
  std::vector<Advice> all = {mode_advice(mode), recommended_advice(mode)};
  const RecommendedLoop& loop = mode.recommended_loop;
  if (loop.unnamed && loop.refused.empty()) {
    all.push_back(keys_advice(loop));
  }
  all.push_back(controller_advice(mode));
  if (mode.bias) {
    all.push_back(bias_advice(mode));
  }
  all.push_back(carrier_advice(mode));
  all.push_back(choice_advice(mode));
  return all;
}

output::Section natural_mode_section(const DesignStudy& study, const NaturalModeStudy& mode) {
  output::Section section;
  section.title = "The natural mode and the carrier";
  section.text = fmt::format(
      "Each change of the amplitude excites the natural mode. Free vibration left: of a change, over "
      "the forced vibration, in displacement, at the worst natural frequency within the range. Swing "
      "of the ratio: half of it, from rest to the target that swings most; the settling band is {:g}. "
      "Settled, late and never are closed loops of {} targets of {} carrier periods each; in the chart "
      "with {}.",
      study.task.scene.run.settling_band, mode.targets, mode.step_periods,
      word(mode.drives[mode.best_drive]));
  section.tables = {drives_table(mode)};
  section.charts = {carrier_chart(mode)};
  return section;
}

ordered_json to_json(const NaturalModeStudy& mode) {
  ordered_json json = {
      {"frequency_Hz", mode.natural_Hz},         {"frequency_range", mode.range},
      {"drives", ordered_json::array()},         {"plants", mode.plants},
      {"stiffness_range", mode.stiffness_range}, {"prompt_periods", prompt_periods},
      {"carriers", ordered_json::array()}};
  for (const QuietDrive& drive : mode.drives) {
    json["drives"].push_back(
        {{"interpolation", scene::name_of(scene::interpolations, drive.interpolation)},
         {"quieted_by", scene::name_of(quietings, drive.quieting)},
         {"taps", drive.tap_count},
         {"changing_periods", drive.changing_periods},
         {"free_vibration_left", drive.left.left},
         {"ratio_swing", drive.left.ratio_swing},
         {"settled", drive.plants.settled},
         {"late", drive.plants.late},
         {"never", drive.plants.never}});
  }
  for (const CarrierPoint& point : mode.carriers) {
    json["carriers"].push_back({{"frequency_Hz", point.frequency_Hz},
                                {"mode_per_carrier", point.mode_per_carrier},
                                {"from_multiple", point.from_multiple},
                                {"within_reach", point.reachable},
                                {"settled", point.plants.settled},
                                {"late", point.plants.late},
                                {"never", point.plants.never}});
  }
  json["best_interpolation"] =
      scene::name_of(scene::interpolations, mode.drives[mode.best_drive].interpolation);
  json["recommended_frequency_Hz"] =
      mode.recommended ? ordered_json(mode.carriers[*mode.recommended].frequency_Hz)
                       : ordered_json(nullptr);
  const RecommendedLoop& loop = mode.recommended_loop;
  json["recommended_loop"] = {
      {"interpolation",
       scene::name_of(scene::interpolations, loop.means.ramped() ? scene::Interpolation::linear
                                                                 : scene::Interpolation::step)},
      {"codes_per_period", loop.means.codes_per_period},
      {"damped", loop.means.sensorless},
      {"bias_limit_N", loop.bias_limit_N},
      {"friction", scene::name_of(scene::friction_sources, loop.friction)},
      {"settled", loop.plants.settled},
      {"late", loop.plants.late},
      {"never", loop.plants.never},
      {"write", ordered_json::object()},
      {"remove", loop.leaves},
      {"refused", loop.refused}};
  for (const auto& [table, lines] : lines_by_table(loop)) {
    json["recommended_loop"]["write"][table] = lines;
  }
  if (mode.bias) {
    json["bias"] = {{"limit_N", mode.bias->limit_N},
                    {"settled", mode.bias->plants.settled},
                    {"late", mode.bias->plants.late},
                    {"never", mode.bias->plants.never}};
  }
  return json;
}

}  // namespace sonoglide::design
