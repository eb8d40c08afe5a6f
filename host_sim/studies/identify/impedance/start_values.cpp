#include "host_sim/studies/identify/impedance/start_values.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host_sim/studies/identify/impedance/description.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

struct Ranked {
  double misfit;
  Circuit circuit;
};

/// The best ones, each of another resonance or bandwidth. @param mode  which of the modes is tried
std::vector<Circuit> best_of(std::vector<Ranked> all, std::size_t mode, std::size_t most) {
  std::sort(all.begin(), all.end(),
            [](const Ranked& a, const Ranked& b) { return a.misfit < b.misfit; });
  std::vector<Circuit> best;
  for (const Ranked& each : all) {
    const Mode& tried = each.circuit.modes[mode];
    const bool near = std::any_of(best.begin(), best.end(), [&](const Circuit& other) {
      const Mode& taken = other.modes[mode];
      return std::abs(tried.resonance_Hz - taken.resonance_Hz) <
             0.5 * std::max(tried.bandwidth_Hz, taken.bandwidth_Hz);
    });
    if (!near) {
      best.push_back(each.circuit);
    }
    if (best.size() == most) {
      break;
    }
  }
  return best;
}

/// Readings of the largest local maxima, the largest first.
template <class Height>
std::vector<std::size_t> largest_maxima(std::size_t readings, const Height& height,
                                        std::size_t most) {
  std::vector<std::pair<double, std::size_t>> maxima;
  for (std::size_t i = 0; i < readings; ++i) {
    const bool rises = i == 0 || height(i) >= height(i - 1);
    const bool falls = i + 1 == readings || height(i) >= height(i + 1);
    if (rises && falls) {
      maxima.emplace_back(-height(i), i);
    }
  }
  std::sort(maxima.begin(), maxima.end());
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < std::min(maxima.size(), most); ++i) {
    found.push_back(maxima[i].second);
  }
  return found;
}

/// Where a resonance may be: the readings with the largest maxima of G/f, and the middles beside.
std::vector<double> places(const Sweep& sweep) {
  const auto height = [&](std::size_t i) {
    const Complex y = sweep.admittance_S[i];
    return (sweep.has_phase ? y.real() : std::abs(y)) / sweep.frequency_Hz[i];
  };
  constexpr std::size_t most = 8;
  const std::vector<double>& all = sweep.frequency_Hz;
  std::vector<double> found;
  for (const std::size_t i : largest_maxima(all.size(), height, most)) {
    found.push_back(all[i]);
    if (i > 0) {
      found.push_back(0.5 * (all[i] + all[i - 1]));
    }
    if (i + 1 < all.size()) {
      found.push_back(0.5 * (all[i] + all[i + 1]));
    }
  }
  return found;
}

std::vector<double> geometric(double from, double factor, int count) {
  std::vector<double> values(static_cast<std::size_t>(count), from);
  for (std::size_t i = 1; i < values.size(); ++i) {
    values[i] = values[i - 1] * factor;
  }
  return values;
}

Complex shape(double frequency_Hz, double resonance_Hz, double bandwidth_Hz) {
  return 1.0 / Complex(1.0, (frequency_Hz - resonance_Hz) * (frequency_Hz + resonance_Hz) /
                                (frequency_Hz * bandwidth_Hz));
}

/// Capacitance, loss and conductance by linear least squares of the relative residuals.
void try_complex(const Sweep& sweep, double resonance_Hz, double bandwidth_Hz,
                 std::vector<Ranked>& found) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
    const double f = sweep.frequency_Hz[i];
    const Eigen::Vector3cd column =
        Eigen::Vector3cd(Complex(0.0, f), f, shape(f, resonance_Hz, bandwidth_Hz)) /
        sweep.admittance_S[i];
    normal += (column.conjugate() * column.transpose()).real();
    right += column.real();
  }
  const Eigen::Vector3d scales = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix3d scaled = scales.asDiagonal() * normal * scales.asDiagonal();
  const Eigen::Vector3d solution =
      scales.asDiagonal() * scaled.ldlt().solve(scales.asDiagonal() * right);
  if (!solution.allFinite() || solution(0) <= 0.0 || solution(2) <= 0.0) {
    return;
  }
  const double misfit = static_cast<double>(sweep.frequency_Hz.size()) - right.dot(solution);
  found.push_back({misfit,
                   {solution(0) / two_pi,
                    std::max(solution(1), 0.0) / solution(0),
                    {{solution(2), resonance_Hz, bandwidth_Hz}}}});
}

/// Of magnitudes: the ratio G/(ω C0) at resonance is tried, the scale follows.
void try_magnitude(const Sweep& sweep, double resonance_Hz, double bandwidth_Hz, double ratio,
                   std::vector<Ranked>& found) {
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
    const double f = sweep.frequency_Hz[i];
    const Complex unit =
        Complex(0.0, f / resonance_Hz) + ratio * shape(f, resonance_Hz, bandwidth_Hz);
    const double difference = std::log(std::abs(sweep.admittance_S[i]) / std::abs(unit));
    sum += difference;
    squares += difference * difference;
  }
  const auto n = static_cast<double>(sweep.frequency_Hz.size());
  const double scale = std::exp(sum / n);
  found.push_back(
      {squares - sum * sum / n,
       {scale / (two_pi * resonance_Hz), 0.0, {{scale * ratio, resonance_Hz, bandwidth_Hz}}}});
}

/// The circuit with modes that are much narrower than the readings are apart widened to that, their
/// L and C kept: a fit that lacks modes may lose the bandwidth of those it has.
Circuit seen_by_readings(const Sweep& sweep, const Circuit& circuit) {
  const std::vector<double>& all = sweep.frequency_Hz;
  Circuit seen = circuit;
  for (Mode& mode : seen.modes) {
    const auto above = std::upper_bound(all.begin() + 1, all.end() - 1, mode.resonance_Hz);
    const double spacing_Hz = *above - *(above - 1);
    if (mode.bandwidth_Hz < 0.1 * spacing_Hz) {
      mode.conductance_S *= mode.bandwidth_Hz / spacing_Hz;
      mode.bandwidth_Hz = spacing_Hz;
    }
  }
  return seen;
}

/// A further mode that is tried: its conductance follows.
Circuit with_mode(Circuit circuit, double resonance_Hz, double bandwidth_Hz) {
  circuit.modes.push_back({0.0, resonance_Hz, bandwidth_Hz});
  return circuit;
}

/// With a further mode all over the sweep, and where the residuals are largest, from a bandwidth of the
/// readings around on.
std::vector<Circuit> with_mode_inside(const Sweep& sweep, const Circuit& seen,
                                      const Eigen::VectorXd& residuals) {
  const auto readings = static_cast<Eigen::Index>(sweep.frequency_Hz.size());
  std::vector<Circuit> tried;
  const auto add = [&](Eigen::Index reading, Eigen::Index around) {
    const auto at = [&](Eigen::Index i) {
      return sweep
          .frequency_Hz[static_cast<std::size_t>(std::clamp<Eigen::Index>(i, 0, readings - 1))];
    };
    const double least_Hz =
        std::max(at(reading + around) - at(reading - around), 1e-9 * at(reading));
    for (const double bandwidth_Hz : geometric(least_Hz, 3.0, 6)) {
      tried.push_back(with_mode(seen, at(reading), bandwidth_Hz));
    }
  };
  constexpr Eigen::Index most_places = 60;
  constexpr std::size_t most_peaks = 6;
  const Eigen::Index stride = std::max<Eigen::Index>(1, readings / most_places);
  for (Eigen::Index reading = 0; reading < readings; reading += stride) {
    add(reading, stride);
  }
  const auto size = [&](std::size_t reading) {
    const auto i = static_cast<Eigen::Index>(reading);
    return std::hypot(residuals(i), residuals(residuals.size() - readings + i));
  };
  for (const std::size_t i :
       largest_maxima(sweep.frequency_Hz.size(), size, stride > 1 ? most_peaks : 0)) {
    add(static_cast<Eigen::Index>(i), 1);
  }
  return tried;
}

/// Likewise just outside of it, with the quality of the first.
std::vector<Circuit> with_mode_beside(const Sweep& sweep, const Circuit& seen) {
  const double low_Hz = sweep.frequency_Hz.front();
  const double high_Hz = sweep.frequency_Hz.back();
  std::vector<Circuit> tried;
  for (const double away : {0.01, 0.03, 0.06, 0.12, 0.25, 0.45}) {
    const double distance_Hz = away * (high_Hz - low_Hz);
    for (const double resonance_Hz : {high_Hz + distance_Hz, low_Hz - distance_Hz}) {
      if (resonance_Hz > 0.0) {
        tried.push_back(with_mode(seen, resonance_Hz, resonance_Hz / seen.modes.front().quality()));
      }
    }
  }
  return tried;
}

/// The best of circuits each of which has a further mode, by what of the residuals the mode takes
/// away that a change of the circuit does not. Its conductance follows.
std::vector<Circuit> best_of(const Sweep& sweep, const CircuitFit& fit, std::vector<Circuit> tried,
                             std::size_t most) {
  const auto n = static_cast<Eigen::Index>(sweep.frequency_Hz.size());
  Eigen::MatrixXd jacobian = fit.at.jacobian;
  Eigen::VectorXd residuals = fit.at.residuals;
  whiten(fit.noise, fit.at, jacobian);
  whiten(fit.noise, fit.at, residuals);
  jacobian.colwise().normalize();
  const Eigen::MatrixXd base = Eigen::HouseholderQR<Eigen::MatrixXd>(jacobian).householderQ() *
                               Eigen::MatrixXd::Identity(jacobian.rows(), jacobian.cols());
  Eigen::VectorXcd seen(n);  // the relative change at the terminals for one of 1 S behind the lead
  for (Eigen::Index i = 0; i < n; ++i) {
    const double f = sweep.frequency_Hz[static_cast<std::size_t>(i)];
    seen(i) = fit.circuit.share_behind_lead(f) / fit.circuit.admittance_S(f);
  }
  std::vector<Ranked> found;
  Eigen::VectorXd column(residuals.size());
  const std::size_t mode = fit.circuit.modes.size();
  for (Circuit& circuit : tried) {
    Mode& added = circuit.modes[mode];
    // By its own band width: one that hides others is too wide until they are fitted.
    const bool is_near =
        std::any_of(circuit.modes.begin(), circuit.modes.end() - 1, [&](const Mode& other) {
          return std::abs(other.resonance_Hz - added.resonance_Hz) <
                 least_distance_bands * std::min(other.bandwidth_Hz, added.bandwidth_Hz);
        });
    if (added.bandwidth_Hz > added.resonance_Hz || is_near) {
      continue;
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      const double f = sweep.frequency_Hz[static_cast<std::size_t>(i)];
      const Complex part = shape(f, added.resonance_Hz, added.bandwidth_Hz) * seen(i);
      column(i) = part.real();
      if (sweep.has_phase) {
        column(n + i) = part.imag();
      }
    }
    whiten(fit.noise, fit.at, column);
    column -= base * (base.transpose() * column);
    const double length = column.squaredNorm();
    const double along = column.dot(residuals);
    if (length > 0.0 && along > 0.0 && along * along > gain_to_fit(fit) * fit.variance * length) {
      added.conductance_S = along / length;
      found.push_back({-along * along / length, std::move(circuit)});
    }
  }
  return best_of(std::move(found), mode, most);
}

}  // namespace

double gain_to_fit(const CircuitFit& fit) {
  constexpr double least = 4.0;
  return describe(fit).fails() ? 0.0 : least;
}

std::vector<Circuit> start_circuits(const Sweep& sweep, std::size_t most) {
  std::vector<Ranked> found;
  for (const double resonance_Hz : places(sweep)) {
    for (const double bandwidth_Hz : geometric(resonance_Hz / 3.0, 0.35, 12)) {
      if (sweep.has_phase) {
        try_complex(sweep, resonance_Hz, bandwidth_Hz, found);
        continue;
      }
      // From G/(ω C0) = Q C1/C0 with C1/C0 between 1e-5 and 2.
      for (const double capacitances : geometric(2.0, 0.3, 11)) {
        try_magnitude(sweep, resonance_Hz, bandwidth_Hz, capacitances * resonance_Hz / bandwidth_Hz,
                      found);
      }
    }
  }
  return best_of(std::move(found), 0, most);
}

std::vector<Circuit> circuits_with_another_mode(const Sweep& sweep, const CircuitFit& fit,
                                                Place place, std::size_t most) {
  if (place == Place::beside) {
    return best_of(sweep, fit, with_mode_beside(sweep, fit.circuit), most);
  }
  Eigen::VectorXd residuals = fit.at.residuals;
  whiten(fit.noise, fit.at, residuals);
  return best_of(sweep, fit,
                 with_mode_inside(sweep, seen_by_readings(sweep, fit.circuit), residuals), most);
}

}  // namespace sonoglide::identify::impedance
