#include "host_sim/loop/steady/self_excitation.hpp"

#include <tbb/parallel_for.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/loop/plant/steady_orbit.hpp"
#include "host_sim/loop/steady/requirement.hpp"
#include "host_sim/scene/friction_laws.hpp"

namespace sonoglide::steady {
namespace {

Fate fate_of(double multiplier) {
  if (std::isnan(multiplier)) {
    return Fate::unknown;
  }
  if (std::abs(multiplier - 1.0) <= loop::largest_rounding) {
    return Fate::stays;
  }
  return multiplier > 1.0 ? Fate::grows : Fate::dies_out;
}

double vibration_m_per_s(const scene::Scene& scene, double drive_force_N) {
  return drive_force_N / force_N(scene, 1.0);
}

double mean_friction_N(const scene::Scene& scene, double sliding_m_per_s, double vibration) {
  const double undriven_N =
      scene::undriven_friction_N(scene.friction.law, scene.friction, sliding_m_per_s);
  return vibration > 0.0 ? undriven_N * closed_form_ratio(scene, sliding_m_per_s, vibration)
                         : undriven_N;
}

/// dF/dVt of the mean friction.
double friction_slope_N_s_per_m(const scene::Scene& scene, double sliding_m_per_s,
                                double vibration) {
  const double part_m_per_s = 1e-5 * sliding_m_per_s;
  return (mean_friction_N(scene, sliding_m_per_s + part_m_per_s, vibration) -
          mean_friction_N(scene, sliding_m_per_s - part_m_per_s, vibration)) /
         (2.0 * part_m_per_s);
}

double averaged_multiplier(const scene::Scene& scene, double sliding_m_per_s,
                           double drive_force_N) {
  const scene::Plant& plant = scene.plant;
  const double damping =
      plant.damping_N_s_per_m +
      friction_slope_N_s_per_m(scene, sliding_m_per_s, vibration_m_per_s(scene, drive_force_N));
  const std::complex<double> discriminant =
      damping * damping - 4.0 * plant.mass_kg * plant.stiffness_N_per_m;
  const double growth_per_s = (std::sqrt(discriminant).real() - damping) / (2.0 * plant.mass_kg);
  return std::exp(growth_per_s / scene.drive->frequency_Hz);
}

double orbit_multiplier(const scene::Scene& scene, double sliding_m_per_s, double drive_force_N) {
  if (averaged_multiplier(scene, sliding_m_per_s, drive_force_N) > largest_growth) {
    return undefined;
  }
  try {
    return loop::find_orbit(steady_scene(scene, sliding_m_per_s, drive_force_N), most_steps)
        .multiplier;
  } catch (const loop::ComputationError&) {
    return undefined;
  }
}

/// Places from none to all of the drive: by equal steps, and, while these are longer, by equal factors about the
/// force at which the sliding begins to reverse. There the mean friction changes abruptly, and a scan
/// must not depend on how much more the drive can.
std::vector<double> scan_forces_N(const scene::Scene& scene, double sliding_m_per_s, double most_N,
                                  double factor) {
  constexpr double first_part = 0.01;
  constexpr double least_part =
      1e-9;  // where the mode lies at the carrier nothing is needed to reverse
  const double reversing_N = force_N(scene, sliding_m_per_s);
  const double step_N = most_N / scan_steps;
  std::vector<double> all;
  for (int i = 0; i <= scan_steps; ++i) {
    all.push_back(most_N * i / scan_steps);
  }
  for (const double part : {0.99, 1.01}) {
    all.push_back(part * reversing_N);
  }
  for (double place_N = std::max(first_part * reversing_N, least_part * most_N);
       place_N * (factor - 1.0) < step_N; place_N *= factor) {
    all.push_back(place_N);
  }
  all.erase(std::remove_if(all.begin(), all.end(), [&](double each) { return each > most_N; }),
            all.end());
  std::sort(all.begin(), all.end());
  return all;
}

/// Between neighbours of one fate, those that a function comes nearest to the other fate at.
template <class Multiplier>
std::vector<double> with_extremes(const std::vector<double>& forces_N,
                                  const Multiplier& multiplier) {
  constexpr int bits = 26;
  std::vector<double> values(forces_N.size());
  std::transform(forces_N.begin(), forces_N.end(), values.begin(), multiplier);
  std::vector<double> all = forces_N;
  for (std::size_t i = 1; i + 1 < forces_N.size(); ++i) {
    const double sign = values[i] > 1.0 ? 1.0 : -1.0;
    if (sign * values[i] < sign * values[i - 1] && sign * values[i] < sign * values[i + 1]) {
      const auto distance = [&](double force_N) { return sign * multiplier(force_N); };
      all.push_back(
          boost::math::tools::brent_find_minima(distance, forces_N[i - 1], forces_N[i + 1], bits)
              .first);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Whether a multiplier is on the side of a place: of an edge between growing and dying out that is the
/// sign of its excess over 1, to the last bit; of any other edge the fate.
bool is_beside(double multiplier, Fate fate, Fate next) {
  const bool crosses_1 = (fate == Fate::grows && next == Fate::dies_out) ||
                         (fate == Fate::dies_out && next == Fate::grows);
  return crosses_1 ? (multiplier > 1.0) == (fate == Fate::grows) : fate_of(multiplier) == fate;
}

/// By halving: a multiplier may jump, or have no value at places.
template <class Multiplier>
double edge_between(const Multiplier& multiplier, double low_N, double high_N, Fate fate,
                    Fate next) {
  constexpr double accuracy = 1e-9;
  const double enough_N = accuracy * high_N;
  while (high_N - low_N > enough_N) {
    const double middle_N = 0.5 * (low_N + high_N);
    (is_beside(multiplier(middle_N), fate, next) ? low_N : high_N) = middle_N;
  }
  return 0.5 * (low_N + high_N);
}

template <class Multiplier>
std::vector<DriveWindow> windows(const std::vector<double>& forces_N, double most_N,
                                 const Multiplier& multiplier) {
  std::vector<Fate> fates(forces_N.size());
  tbb::parallel_for(std::size_t{0}, forces_N.size(),
                    [&](std::size_t i) { fates[i] = fate_of(multiplier(forces_N[i])); });
  std::vector<DriveWindow> all = {{0.0, most_N, fates.front()}};
  for (std::size_t i = 1; i < forces_N.size(); ++i) {
    if (fates[i] != fates[i - 1]) {
      all.back().high_N =
          edge_between(multiplier, forces_N[i - 1], forces_N[i], fates[i - 1], fates[i]);
      all.push_back({all.back().high_N, most_N, fates[i]});
    }
  }
  return all;
}

}  // namespace

const char* name(Fate fate) {
  switch (fate) {
    case Fate::dies_out:
      return "dies_out";
    case Fate::stays:
      return "stays";
    case Fate::grows:
      return "grows";
    case Fate::unknown:
      break;
  }
  return "unknown";
}

Fate SteadySliding::fate() const {
  return fate_of(multiplier);
}

Fate SteadySliding::averaged_fate() const {
  return fate_of(averaged_multiplier);
}

bool friction_falls(const scene::Friction& friction) {
  constexpr double slowest_m_per_s = 1e-7;
  constexpr double fastest_m_per_s = 1e2;
  constexpr double factor = 1.1;
  constexpr double rounding = 1e-12;
  double highest_N = 0.0;
  for (double v = slowest_m_per_s; v < fastest_m_per_s; v *= factor) {
    const double force_N = scene::undriven_friction_N(friction.law, friction, v);
    if (force_N < (1.0 - rounding) * highest_N) {
      return true;
    }
    highest_N = std::max(highest_N, force_N);
  }
  return false;
}

SteadySliding steady_sliding(const scene::Scene& scene, double sliding_m_per_s,
                             double drive_force_N) {
  return {sliding_m_per_s, drive_force_N, vibration_m_per_s(scene, drive_force_N),
          orbit_multiplier(scene, sliding_m_per_s, drive_force_N),
          averaged_multiplier(scene, sliding_m_per_s, drive_force_N)};
}

double undriven_exponent(const scene::Scene& scene, double sliding_m_per_s) {
  const double damping =
      scene.plant.damping_N_s_per_m + friction_slope_N_s_per_m(scene, sliding_m_per_s, 0.0);
  return std::abs(damping) / (scene.plant.mass_kg * scene.drive->frequency_Hz);
}

std::vector<DriveWindow> drive_windows(const scene::Scene& scene, double sliding_m_per_s,
                                       double most_N) {
  std::vector<double> forces_N =
      scan_forces_N(scene, sliding_m_per_s, most_N, 1.0 + narrowest_part);
  for (const DriveWindow& each : averaged_drive_windows(scene, sliding_m_per_s, most_N)) {
    forces_N.push_back(0.5 * (each.low_N + each.high_N));
  }
  std::sort(forces_N.begin(), forces_N.end());
  return windows(forces_N, most_N,
                 [&](double force_N) { return orbit_multiplier(scene, sliding_m_per_s, force_N); });
}

std::vector<DriveWindow> averaged_drive_windows(const scene::Scene& scene, double sliding_m_per_s,
                                                double most_N) {
  constexpr double factor = 1.02;  // a closed form takes little time
  const auto multiplier = [&](double force_N) {
    return averaged_multiplier(scene, sliding_m_per_s, force_N);
  };
  return windows(with_extremes(scan_forces_N(scene, sliding_m_per_s, most_N, factor), multiplier),
                 most_N, multiplier);
}

}  // namespace sonoglide::steady
