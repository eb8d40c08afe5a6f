#include "sample_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tests/common/constants/pi.hpp"

namespace sonoglide::report {
namespace {

using tests::pi;
constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr double kCarrier_Hz = 60e3;
constexpr double kCoulombForce_N = 0.01962;
constexpr double kContactStiffness_N_per_m = 0.056e6;
constexpr double kAmplitude_m = 7.1e-7;

std::vector<double> ramp(double from, double to, int count) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    values[static_cast<std::size_t>(i)] = from + (to - from) * i / (count - 1);
  }
  return values;
}

template <typename Function>
std::vector<double> mapped(const std::vector<double>& x, Function f) {
  std::vector<double> y(x.size());
  std::transform(x.begin(), x.end(), y.begin(), f);
  return y;
}

double target_at(double time_s) {
  return time_s < 1e-3 ? 0.4 : 0.6;
}

double ratio_at(double time_s) {
  const double since_s = time_s < 1e-3 ? time_s : time_s - 1e-3;
  const double from = time_s < 1e-3 ? 1.0 : 0.4;
  const double target = target_at(time_s);
  return target + (from - target) * std::exp(-since_s / 4e-5) * std::cos(since_s * 6e4);
}

output::Section regulation() {
  output::Section section{
      "Regulation", "Friction ratio of each carrier period against its target.", {}};
  const std::vector<double> periods_s = ramp(0.0, 2e-3, 121);
  section.charts.push_back(
      {"Friction ratio",
       "Mean friction force over a carrier period, divided by the Coulomb "
       "force. The first four periods are taken for calibration.",
       {"Time [s]"},
       {"Friction ratio [-]"},
       periods_s,
       {{"target", mapped(periods_s, target_at), output::Line::stepped},
        {"achieved", mapped(periods_s, [](double t) { return t < 6e-5 ? kGap : ratio_at(t); })}},
       "periods"});
  section.charts.push_back(
      {"Drive amplitude",
       "",
       {"Time [s]"},
       {"Drive amplitude [N]"},
       periods_s,
       {{"command",
         mapped(periods_s, [](double t) { return std::min(1920.0, 384.0 / (ratio_at(t) + 0.02)); }),
         output::Line::stepped}},
       "periods"});
  return section;
}

/// Dahl's force on one branch, from a reversal at -Fc: exact in displacement.
double branch_force(double travel_m) {
  return kCoulombForce_N *
         (1.0 - 1.9 * std::exp(-kContactStiffness_N_per_m * travel_m / kCoulombForce_N));
}

output::Chart hysteresis_loop() {
  output::Curve forward{"sliding forward", {}, output::Line::bridged};
  output::Curve back{"sliding back", {}, output::Line::bridged};
  for (const double angle : ramp(0.0, pi, 90)) {
    forward.x.push_back(-kAmplitude_m * std::cos(angle));
    forward.y.push_back(branch_force(forward.x.back() + kAmplitude_m));
    back.x.push_back(-kAmplitude_m * std::cos(angle + 0.5 * pi / 90));
    back.y.push_back(-branch_force(kAmplitude_m - back.x.back()));
  }
  return {"Friction against displacement",
          "One period, settled.",
          {"Displacement [m]"},
          {"Friction force [N]"},
          {},
          {forward, back}};
}

output::Section carrier() {
  output::Section section{"Within the carrier period", "The last eight periods of the run.", {}};
  const std::vector<double> time_s = ramp(2e-3 - 8 / kCarrier_Hz, 2e-3, 801);
  const auto angle = [](double t) { return 2.0 * pi * kCarrier_Hz * t; };
  const auto single = [&](const char* title, const char* label, const char* name, auto f) {
    section.charts.push_back(
        {title, "", {"Time [s]"}, {label}, time_s, {{name, mapped(time_s, f)}}, "carrier"});
  };
  single("Displacement", "Displacement [m]", "displacement", [&](double t) {
    return 1.42e-7 * std::cos(angle(t)) + 3e-8 * std::cos(0.216 * angle(t));
  });
  single("Velocity", "Velocity [m/s]", "velocity",
         [&](double t) { return -0.0534 * std::sin(angle(t)); });
  single("Friction force", "Friction force [N]", "friction",
         [&](double t) { return 0.0106 + 0.007 * std::tanh(2.0 * std::sin(angle(t))); });
  section.charts.push_back(hysteresis_loop());
  return section;
}

output::Section spectrum() {
  const std::vector<double> frequency_Hz = ramp(0.0, 200e3, 1001);
  const auto peak = [](double f, double at, double height) {
    return height / (1.0 + std::pow((f - at) / 300.0, 2));
  };
  return {"Spectrum",
          "",
          {{"Displacement",
            "The carrier stands at 60 kHz, the natural mode at 12.98 kHz.",
            {"Frequency [Hz]"},
            {"Amplitude [m]", true},
            frequency_Hz,
            {{"open loop", mapped(frequency_Hz,
                                  [&](double f) {
                                    return peak(f, 60e3, 1.4e-7) + peak(f, 12.98e3, 3e-8) + 2e-13;
                                  })},
             {"closed loop", mapped(frequency_Hz, [&](double f) {
                return peak(f, 60e3, 1.2e-7) + peak(f, 12.98e3, 2e-10) + 2e-13;
              })}}}}};
}

/// Friction ratio over vibration and sliding: three by four tiles, on an axis that rises and on one that
/// falls.
output::Section maps() {
  output::Chart chart{"Ratio", "", {"Sliding [m/s]"}, {"Vibration [m/s]", true}, {}, {}};
  output::Tiles& tiles = chart.tiles.emplace_back();
  for (int i = 0; i < 12; ++i) {
    const double sliding = 0.01 * (i % 3);
    const double vibration = std::pow(10.0, i / 3 - 3);
    tiles.all.push_back({{sliding, sliding + 0.01}, {vibration, 10.0 * vibration}, 0.05 * i});
  }
  output::Chart falling = chart;
  falling.title = "Ratio, the slowest vibration on top";
  falling.y_axis.span = {10.0, 1e-3};
  return {"Maps", "", {chart, falling}};
}

}  // namespace

output::Page sample_page() {
  output::Page page;
  page.title = "target_step: friction ratio 0.4, then 0.6";
  page.lead =
      "Closed loop at Table 1: 20 g slider, 60 kHz drive, Dahl contact, single-precision "
      "controller, ideal sensor. 2 ms simulated with event-located Taylor steps.";
  page.warnings = {
      "The drive reached its limit of 1920 N for 3.3 % of the run (at 1.00 ms).",
      "The friction law has no static floor: measured reductions at low speed are smaller than "
      "Dahl and Coulomb predict."};
  page.tables = {
      {"Steps",
       {"Time [ms]", "Target", "Settling time [µs]", "Overshoot", "Steady error", "Ripple",
        "Drive [N]", "Limit"},
       {{"0.000", "0.40", "83.3", "0.031", "−0.00021", "0.0004", "661.2", "none"},
        {"1.000", "0.60", "never", "0.104", "0.01200", "0.0151", "1920.0", "drive amplitude"}}},
      {"Run",
       {},
       {{"Solver", "event_taylor, tolerance 1e-10"},
        {"Steps, events", "9 841, 240"},
        {"Energy balance residual", "3.1e-12"}}}};
  page.sections = {regulation(), carrier(), spectrum(), maps()};
  return page;
}

}  // namespace sonoglide::report
