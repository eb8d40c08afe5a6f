#include "host_sim/report/texture_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "firmware/numeric/turn.hpp"

namespace sonoglide::report {
namespace {

constexpr std::size_t most_harmonics = 16;

/// sin(x)/x
double sinc(double x) {
  return x == 0.0 ? 1.0 : std::sin(x) / x;
}

std::complex<double> turned(double turns) {
  return std::polar(1.0, -numeric::two_pi * (turns - std::floor(turns)));
}

int highest_harmonic(const scene::Texture& texture) {
  return static_cast<int>(texture.values.size() / 2);
}

double largest_amplitude(const scene::Texture& texture) {
  double largest = 0.0;
  for (int harmonic = 1; harmonic <= highest_harmonic(texture); ++harmonic) {
    largest = std::max(largest, std::abs(harmonic_of(texture, harmonic)));
  }
  return largest;
}

/// With the angle to the other one reversed. @param about  not 0
std::complex<double> mirrored(const std::complex<double>& value,
                              const std::complex<double>& about) {
  return about * std::conj(value / about);
}

/// The mean, and what is worth a line.
std::vector<int> worth_telling(const scene::Texture& texture) {
  constexpr double least_part = 1e-3;
  const int most = highest_harmonic(texture);
  const double largest = largest_amplitude(texture);
  std::vector<int> numbers{0};
  for (int harmonic = 1; harmonic <= most && numbers.size() <= most_harmonics; ++harmonic) {
    const double amplitude = std::abs(harmonic_of(texture, harmonic));
    if (amplitude > 0.0 && amplitude >= least_part * largest) {
      numbers.push_back(harmonic);
    }
  }
  return numbers;
}

}  // namespace

std::complex<double> harmonic_of(const scene::Texture& texture, int harmonic) {
  const auto count = static_cast<double>(texture.values.size());
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < texture.values.size(); ++i) {
    sum += texture.values[i] * turned(harmonic * static_cast<double>(i) / count);
  }
  const double straight = sinc(0.5 * numeric::two_pi * harmonic / count);
  return (harmonic == 0 ? 1.0 : 2.0) * straight * straight / count * sum;
}

double TextureHarmonic::amplitude_ratio() const {
  return std::abs(rendered) / std::abs(wanted);
}

double TextureHarmonic::lag_deg() const {
  return angle_deg(wanted * std::conj(rendered));
}

double angle_deg(const std::complex<double>& value) {
  return 360.0 / numeric::two_pi * std::arg(value);
}

TextureMeter::TextureMeter(const scene::Scene& scene)
    : scene_(scene),
      texture_(*scene.controller->texture),
      unit_(target_unit(scene)),
      numbers_(worth_telling(texture_)),
      sums_(numbers_.size()),
      pass_(numbers_.size()) {}

void TextureMeter::take(const loop::Period& period) {
  remember(period);
  const double begin_m = period.begin_distance_m;
  const double end_m = period.end_distance_m;
  const double value = unit_.held(period);
  counts_ = counts_ && !std::isnan(value);
  const bool forward = begin_m <= end_m;
  // The ends of the path's periods that are passed, in order.
  double from_m = begin_m;
  double number = forward ? std::floor(begin_m / texture_.period_m) + 1.0
                          : std::ceil(begin_m / texture_.period_m) - 1.0;
  while (forward ? number * texture_.period_m <= end_m : number * texture_.period_m >= end_m) {
    const double passed_m = number * texture_.period_m;
    add(from_m, passed_m, value);
    end_pass(passed_m, period.begin_s >= 0.5 * scene_.run.duration_s);
    counts_ = counts_ && !std::isnan(value);
    from_m = passed_m;
    number += forward ? 1.0 : -1.0;
  }
  add(from_m, end_m, value);
}

void TextureMeter::remember(const loop::Period& period) {
  constexpr double periods_shown = 4.0;
  constexpr std::size_t most_places = 20000;
  const double middle_m = 0.5 * (period.begin_distance_m + period.end_distance_m);
  places_.push_back({middle_m, period.target, unit_.held(period) * unit_.size});
  while (places_.size() > most_places ||
         std::abs(places_.front().distance_m - middle_m) > periods_shown * texture_.period_m) {
    places_.pop_front();
  }
}

/// A value that holds along a piece of the path.
void TextureMeter::add(double begin_m, double end_m, double value) {
  if (!counts_ || begin_m == end_m) {
    return;
  }
  const double length = std::abs(end_m - begin_m) / texture_.period_m;
  const double middle = 0.5 * (begin_m + end_m) / texture_.period_m;
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const double number = numbers_[i];
    pass_[i] +=
        value * length * sinc(0.5 * numeric::two_pi * number * length) * turned(number * middle);
  }
  travelled_m_ += std::abs(end_m - begin_m);
}

void TextureMeter::end_pass(double end_m, bool steady) {
  constexpr double rounding = 1e-6;
  const double period_m = texture_.period_m;
  const bool whole = std::abs(std::abs(end_m - entered_m_) - period_m) < rounding * period_m &&
                     travelled_m_ < (1.0 + rounding) * period_m;
  if (counts_ && whole) {
    ++passes_;
    const bool forward = entered_m_ < end_m;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      sums_[i] += forward || numbers_[i] == 0
                      ? pass_[i]
                      : mirrored(pass_[i], harmonic_of(texture_, numbers_[i]));
    }
  }
  std::fill(pass_.begin(), pass_.end(), 0.0);
  entered_m_ = end_m;
  travelled_m_ = 0.0;
  counts_ = steady;
}

std::vector<TextureHarmonic> TextureMeter::harmonics() const {
  constexpr double faint_part = 1e-2;
  const double faint = faint_part * largest_amplitude(texture_);
  std::vector<TextureHarmonic> all;
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const double sides = numbers_[i] == 0 ? 1.0 : 2.0;
    const std::complex<double> wanted = harmonic_of(texture_, numbers_[i]);
    const std::complex<double> rendered =
        passes_ > 0 ? sides * sums_[i] / static_cast<double>(passes_)
                    : std::complex<double>(std::numeric_limits<double>::quiet_NaN());
    all.push_back(
        {numbers_[i], wanted / unit_.size, rendered, numbers_[i] != 0 && std::abs(wanted) < faint});
  }
  return all;
}

}  // namespace sonoglide::report
