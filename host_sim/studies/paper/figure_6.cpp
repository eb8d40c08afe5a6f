#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "host_sim/report/spectrum.hpp"
#include "host_sim/studies/paper/figure_style.hpp"
#include "host_sim/studies/paper/figures.hpp"
#include "host_sim/studies/paper/runs.hpp"

namespace sonoglide::paper {
namespace {

constexpr double highest_Hz = 260e3;
constexpr int spectrum_samples_per_period = 32;
constexpr int periods = 2000;
/// Peaks below this part of the highest are left unnamed.
constexpr double least_peak = 3e-3;
constexpr int highest_order = 6;
constexpr double lowest_dB = -120.0;

struct Peak {
  double frequency_Hz;
  double amplitude;
  std::string name;
};

struct Lines {
  report::Spectrum spectrum;
  std::vector<Peak> peaks;
};

std::string multiple(int factor, const char* symbol) {
  return std::abs(factor) == 1 ? symbol : fmt::format("{}{}", std::abs(factor), symbol);
}

/// "2f - fn", the drive's part first.
std::string combination(int drives, int naturals) {
  if (drives == 0) {
    return multiple(naturals, "fn");
  }
  if (naturals == 0) {
    return multiple(drives, "f");
  }
  if (drives < 0) {
    return fmt::format("{} - {}", multiple(naturals, "fn"), multiple(drives, "f"));
  }
  return fmt::format("{} {} {}", multiple(drives, "f"), naturals > 0 ? "+" : "-",
                     multiple(naturals, "fn"));
}

/// The combination of lowest order that lies within a frequency's resolution; else "?".
std::string name_of(double frequency_Hz, double drive_Hz, double natural_Hz, double resolution_Hz) {
  for (int order = 1; order <= highest_order; ++order) {
    for (int drives = -order; drives <= order; ++drives) {
      for (const int naturals : {order - std::abs(drives), std::abs(drives) - order}) {
        const double combined_Hz = drives * drive_Hz + naturals * natural_Hz;
        if (std::abs(combined_Hz - frequency_Hz) <= resolution_Hz) {
          return combination(drives, naturals);
        }
      }
    }
  }
  return "?";
}

/// Local maxima, the highest first.
std::vector<Peak> peaks_of(const report::Spectrum& spectrum, const scene::Scene& scene) {
  const std::vector<double>& a = spectrum.amplitude;
  const double resolution_Hz = 1.5 * spectrum.frequency_Hz[1];
  const double highest = *std::max_element(a.begin(), a.end());
  std::vector<Peak> peaks;
  for (std::size_t i = 1; i + 1 < a.size(); ++i) {
    if (a[i] > a[i - 1] && a[i] >= a[i + 1] && a[i] > least_peak * highest) {
      peaks.push_back({spectrum.frequency_Hz[i], a[i],
                       name_of(spectrum.frequency_Hz[i], scene.drive->frequency_Hz,
                               scene.plant.natural_Hz(), resolution_Hz)});
    }
  }
  std::sort(peaks.begin(), peaks.end(),
            [](const Peak& one, const Peak& other) { return one.amplitude > other.amplitude; });
  return peaks;
}

Lines lines(std::vector<double> values, double interval_s, const scene::Scene& scene) {
  values.pop_back();  // begins the next carrier period
  report::Spectrum spectrum = report::amplitude_spectrum(values, interval_s, highest_Hz);
  std::vector<Peak> peaks = peaks_of(spectrum, scene);
  return {std::move(spectrum), std::move(peaks)};
}

std::vector<double> decibels(const std::vector<double>& amplitude) {
  const double highest = *std::max_element(amplitude.begin(), amplitude.end());
  std::vector<double> levels;
  levels.reserve(amplitude.size());
  for (const double each : amplitude) {
    levels.push_back(std::max(20.0 * std::log10(each / highest), lowest_dB));
  }
  return levels;
}

std::vector<output::Mark> marks(const Lines& lines, bool in_decibels) {
  constexpr std::size_t most_marks = 8;
  std::vector<output::Mark> marks;
  for (std::size_t i = 0; i < std::min(most_marks, lines.peaks.size()); ++i) {
    const Peak& peak = lines.peaks[i];
    marks.push_back({peak.name, 1e-3 * peak.frequency_Hz,
                     in_decibels ? 20.0 * std::log10(peak.amplitude / lines.peaks[0].amplitude)
                                 : peak.amplitude});
  }
  return marks;
}

std::vector<output::Chart> charts(const char* letter, const char* quantity, const char* unit,
                                  const Lines& lines, int colour) {
  const std::vector<double> x = output::scaled(lines.spectrum.frequency_Hz, 1e-3);
  const std::vector<double> levels = decibels(lines.spectrum.amplitude);
  output::Chart linear =
      chart(fmt::format("({}) {}, linear", letter, quantity), "frequency [kHz]",
            fmt::format("amplitude [{}]", unit), {curve("", x, lines.spectrum.amplitude, colour)},
            Key::above, {0.0, 1.2 * lines.peaks[0].amplitude});
  output::Chart level =
      chart(fmt::format("({}) {}, in dB of the highest peak", letter, quantity), "frequency [kHz]",
            "level [dB]", {curve("", x, levels, colour)}, Key::above, {lowest_dB, 30.0});
  linear.marks = marks(lines, false);
  level.marks = marks(lines, true);
  return {std::move(linear), std::move(level)};
}

std::string listed(const std::vector<Peak>& peaks, const char* unit) {
  constexpr std::size_t most_listed = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(most_listed, peaks.size()); ++i) {
    text += fmt::format("{}{} ({:.2f} kHz) {:.3g} {}", i > 0 ? ", " : "", peaks[i].name,
                        1e-3 * peaks[i].frequency_Hz, peaks[i].amplitude, unit);
  }
  return text;
}

bool has_sum_or_difference(const std::vector<Peak>& peaks) {
  return std::any_of(peaks.begin(), peaks.end(),
                     [](const Peak& peak) { return peak.name.find(' ') != std::string::npos; });
}

std::vector<Claim> claims(const Lines& velocity, const Lines& steady_velocity, const Lines& force) {
  return {{"The velocity has two components, at the drive's and at the natural frequency.",
           ClaimStatus::depends,
           fmt::format("From rest: {}. On the steady orbit: {}. The second component is the free "
                       "vibration of the start.",
                       listed(velocity.peaks, "m/s"), listed(steady_velocity.peaks, "m/s"))},
          {"The friction force has harmonics of both, and of their sums and differences.",
           verdict(has_sum_or_difference(force.peaks)),
           fmt::format("{}. As for the velocity: on the steady orbit only the drive and its "
                       "harmonics are left.",
                       listed(force.peaks, "N"))}};
}

}  // namespace

Figure figure_6() {
  scene::Scene scene = table_1();
  const double interval_s = period_s(scene) / spectrum_samples_per_period;
  scene.run.duration_s = periods * period_s(scene);
  const loop::Recording from_rest = record(scene, 0.0, interval_s);
  const Lines velocity = lines(velocities_m_per_s(from_rest), interval_s, scene);
  const Lines force = lines(friction_forces_N(from_rest), interval_s, scene);
  scene.run.start = scene::Start::steady;
  const Lines steady_velocity =
      lines(velocities_m_per_s(record(scene, 0.0, interval_s)), interval_s, scene);

  std::vector<output::Chart> all = charts("a", "Velocity", "m/s", velocity, 1);
  for (output::Chart& chart : charts("b", "Friction force", "N", force, 2)) {
    all.push_back(std::move(chart));
  }
  return {
      6,
      "Spectra of velocity and friction force",
      fmt::format(
          "Table 1 at 384 N, velocity ratio 0.5, from rest: the first {} carrier periods, Hann "
          "window, {:.0f} Hz apart. f is the drive's frequency, fn = {:.2f} kHz that of the "
          "plant without a contact.",
          periods, 1.0 / scene.run.duration_s, 1e-3 * scene.plant.natural_Hz()),
      "sonoglide run table_1.toml --set run.duration_periods=2000 (the report shows the spectrum)",
      to_csv({{"frequency_Hz", velocity.spectrum.frequency_Hz},
              {"velocity_m_per_s", velocity.spectrum.amplitude},
              {"velocity_dB", decibels(velocity.spectrum.amplitude)},
              {"friction_force_N", force.spectrum.amplitude},
              {"friction_force_dB", decibels(force.spectrum.amplitude)}}),
      all,
      claims(velocity, steady_velocity, force)};
}

}  // namespace sonoglide::paper
