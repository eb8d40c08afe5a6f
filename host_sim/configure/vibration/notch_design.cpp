#include "host_sim/configure/vibration/notch_design.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {
namespace {

// The elementary functions are the core's own, so that a scene gives the same taps, bit for bit, on
// every machine.

constexpr double half_turn = 0.5 * numeric::two_pi;

double power(double base, int exponent) {
  double product = 1.0;
  for (int i = 0; i < exponent; ++i) {
    product *= base;
  }
  return product;
}

/// Taps of a notch with zeros at d exp(±iθ), before they are divided by their sum.
std::array<double, 3> zero_pair(double decay, double cosine) {
  return {1.0, -2.0 * decay * cosine, decay * decay};
}

bool partial_sums_within_one(const NotchTaps& taps) {
  constexpr double rounding = 1e-12;
  double sum = 0.0;
  return std::all_of(taps.begin(), taps.end(), [&](double tap) {
    sum += tap;
    return -rounding <= sum && sum <= 1.0 + rounding;
  });
}

/// Divides the taps by their sum.
/// @return false where the first one would be 1 or more
bool normalise(NotchTaps& taps) {
  double sum = 0.0;
  for (const double tap : taps) {
    sum += tap;
  }
  for (double& tap : taps) {
    tap /= sum;
  }
  return sum > 1.0;
}

std::optional<NotchDesign> place_notch(const NaturalMode& mode, int spacing) {
  const double decay = power(mode.decay, spacing);
  const auto pair = zero_pair(decay, numeric::cos(mode.rotation * spacing));
  NotchDesign notch{{pair[0], pair[1], pair[2]}, 3, static_cast<std::uint8_t>(spacing)};
  if (!normalise(notch.taps) || std::abs(notch.taps[1]) >= 1.0) {
    return std::nullopt;
  }
  return notch;
}

struct Interval {
  double low;
  double high;
};

/// Of cos θ for θ between these.
Interval cosine_range(double from, double to) {
  const double first = numeric::cos(from);
  const double last = numeric::cos(to);
  Interval range{std::min(first, last), std::max(first, last)};
  for (double turns = std::ceil(from / half_turn); turns * half_turn <= to; turns += 1.0) {
    const bool whole = std::fmod(turns, 2.0) == 0.0;
    (whole ? range.high : range.low) = whole ? 1.0 : -1.0;
  }
  return range;
}

/// Of two filters in a row.
NotchTaps in_a_row(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[0] * b[2] + a[1] * b[1] + a[2] * b[0],
          a[1] * b[2] + a[2] * b[1], a[2] * b[2]};
}

double magnitude(const NotchTaps& taps) {
  double sum = 0.0;
  for (const double tap : taps) {
    sum += std::abs(tap);
  }
  return sum;
}

std::optional<NotchDesign> place_robust_notch(const NaturalMode& mode, double range, int spacing) {
  constexpr double inverse_sqrt2 = 0.70710678118654752;
  constexpr double largest_magnitude = 2.9;
  const double angle = mode.rotation * spacing;
  if (angle * range >= half_turn) {
    return std::nullopt;  // the mode may be at any phase when the next tap comes
  }
  const Interval cosine = cosine_range(angle * (1.0 - range), angle * (1.0 + range));
  const double middle = 0.5 * (cosine.low + cosine.high);
  const double node = 0.5 * inverse_sqrt2 * (cosine.high - cosine.low);
  const double decay = power(mode.decay, spacing);
  NotchDesign notch{in_a_row(zero_pair(decay, middle + node), zero_pair(decay, middle - node)), 5,
                    static_cast<std::uint8_t>(spacing), range};
  if (!normalise(notch.taps) || !partial_sums_within_one(notch.taps) ||
      magnitude(notch.taps) > largest_magnitude) {
    return std::nullopt;
  }
  notch.ripple = notch_ripple(notch, mode, range);
  return notch;
}

/// |Σ h_i z^(n − 1 − i)|, z what becomes of the free motion within one spacing, n taps.
double left_over(const NotchDesign& notch, double decay, double angle) {
  const double turn_real = decay * numeric::cos(angle);
  const double turn_imaginary = decay * numeric::sin(angle);
  double real = 0.0;
  double imaginary = 0.0;
  for (std::size_t i = 0; i < notch.tap_count; ++i) {
    const double turned = real * turn_real - imaginary * turn_imaginary;
    imaginary = real * turn_imaginary + imaginary * turn_real;
    real = turned + notch.taps[i];
  }
  return numeric::sqrt(real * real + imaginary * imaginary);
}

}  // namespace

NaturalMode natural_mode(const NominalPlant& plant, double period_s) {
  const double sigma = 0.5 * plant.damping_N_s_per_m / plant.mass_kg;
  const double natural_squared = plant.stiffness_N_per_m / plant.mass_kg;
  const double damped_squared = std::max(0.0, natural_squared - sigma * sigma);
  return {numeric::exp(-sigma * period_s), numeric::sqrt(damped_squared) * period_s};
}

std::optional<NotchDesign> design_notch(const NaturalMode& mode) {
  std::optional<NotchDesign> notch;
  for (int spacing = 1; spacing <= max_notch_spacing && !notch && mode.rotation > 0.0; ++spacing) {
    notch = place_notch(mode, spacing);
  }
  return notch;
}

std::optional<NotchDesign> design_robust_notch(const NaturalMode& mode, double range) {
  std::optional<NotchDesign> best;
  double least = 0.5;
  for (int spacing = 1;
       spacing <= max_robust_spacing && least > robust_ripple && mode.rotation > 0.0; ++spacing) {
    const std::optional<NotchDesign> notch = place_robust_notch(mode, range, spacing);
    if (notch && notch->ripple < least) {
      best = notch;
      least = notch->ripple;
    }
  }
  return best;
}

std::optional<NotchDesign> design_widest_notch(const NaturalMode& mode) {
  constexpr int halvings = 16;
  const auto quiet = [&](double range) {
    std::optional<NotchDesign> notch = design_robust_notch(mode, range);
    return notch && notch->ripple <= robust_ripple ? notch : std::nullopt;
  };
  std::optional<NotchDesign> widest = quiet(default_shaping_range);
  double low = scene::least_shaping_range;
  double high = default_shaping_range;
  for (int i = 0; i < halvings && !(widest && widest->range == high); ++i) {
    const double middle = 0.5 * (low + high);
    const std::optional<NotchDesign> notch = quiet(middle);
    (notch ? low : high) = middle;
    widest = notch ? notch : widest;
  }
  return widest;
}

double notch_ripple_at(const NotchDesign& notch, const NaturalMode& mode, double factor) {
  return left_over(notch, power(mode.decay, notch.spacing), mode.rotation * notch.spacing * factor);
}

double notch_ripple(const NotchDesign& notch, const NaturalMode& mode, double range) {
  constexpr int points = 32;  // on either side
  double largest = 0.0;
  for (int i = -points; i <= points; ++i) {
    largest = std::max(largest, notch_ripple_at(notch, mode, 1.0 + range * i / points));
  }
  return largest;
}

NotchTaps rounded_taps(const NotchDesign& notch, int fraction_digits) {
  const double unit = numeric::scale_by_power_of_two(1.0, -fraction_digits);
  NotchTaps taps{};
  double exact = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < notch.tap_count; ++i) {
    exact += notch.taps[i];
    const bool last = i + 1 == notch.tap_count;
    const double partial =
        last ? 1.0 : std::clamp(std::round(exact / unit) * unit, 0.0, 1.0 - unit);
    taps[i] = partial - before;
    before = partial;
  }
  return taps;
}

namespace {

struct Factors {
  double least = 1.0;
  double most = 1.0;
};

/// Of the true value over the scene's.
Factors factors_of(const std::vector<scene::Tolerance>& tolerances, std::string_view key) {
  constexpr double deviations = 3.0;
  for (const scene::Tolerance& each : tolerances) {
    if (each.key == key) {
      const bool normal = each.spread == scene::Spread::normal;
      const double reach = deviations * each.amount * each.nominal;
      const double lowest = normal ? std::max(each.lowest, each.nominal - reach) : each.lowest;
      const double highest = normal ? std::min(each.highest, each.nominal + reach) : each.highest;
      return {lowest / each.nominal, highest / each.nominal};
    }
  }
  return {};
}

}  // namespace

double natural_frequency_range(const std::vector<scene::Tolerance>& tolerances) {
  const Factors stiffness = factors_of(tolerances, "plant.stiffness_N_per_m");
  const Factors mass = factors_of(tolerances, "plant.mass_kg");
  return std::max(numeric::sqrt(stiffness.most / mass.least) - 1.0,
                  1.0 - numeric::sqrt(stiffness.least / mass.most));
}

std::optional<double> tolerated_shaping_range(const std::vector<scene::Tolerance>& tolerances) {
  const double range = natural_frequency_range(tolerances);
  if (!(range > 0.0)) {
    return std::nullopt;
  }
  return std::clamp(range, scene::least_shaping_range, scene::most_shaping_range);
}

}  // namespace sonoglide::configure
