#include "host_sim/studies/identify/impedance/selection.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

/// The best ones, each with another resonance of its last mode.
std::vector<Start> best_of(std::vector<Start> all, std::size_t most) {
  std::sort(all.begin(), all.end(),
            [](const Start& a, const Start& b) { return a.misfit < b.misfit; });
  std::vector<Start> best;
  for (Start& each : all) {
    const Mode& tried = each.circuit.modes.back();
    const bool is_near = std::any_of(best.begin(), best.end(), [&](const Start& other) {
      const Mode& taken = other.circuit.modes.back();
      return std::abs(tried.resonance_Hz - taken.resonance_Hz) <
             0.5 * std::max(tried.bandwidth_Hz, taken.bandwidth_Hz);
    });
    if (!is_near && best.size() < most) {
      best.push_back(std::move(each));
    }
  }
  return best;
}

/// Readings of the largest local maxima.
template <class Height>
std::vector<std::size_t> largest_maxima(std::size_t readings, const Height& height,
                                        std::size_t most) {
  std::vector<std::pair<double, std::size_t>> maxima;
  for (std::size_t i = 0; i < readings; ++i) {
    if ((i == 0 || height(i) >= height(i - 1)) &&
        (i + 1 == readings || height(i) >= height(i + 1))) {
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

std::vector<double> geometric(double from, double factor, int count) {
  std::vector<double> values(static_cast<std::size_t>(count), from);
  for (std::size_t i = 1; i < values.size(); ++i) {
    values[i] = values[i - 1] * factor;
  }
  return values;
}

/// 1/(1 + j d), of a mode of conductance 1.
Complex shape(double frequency_Hz, double resonance_Hz, double bandwidth_Hz) {
  return 1.0 / Complex(1.0, (frequency_Hz - resonance_Hz) * (frequency_Hz + resonance_Hz) /
                                (frequency_Hz * bandwidth_Hz));
}

/// By linear least squares of the relative residuals.
void try_start(const Sweep& sweep, double resonance_Hz, double bandwidth_Hz,
               std::vector<Start>& found) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
    const double f = sweep.frequency_Hz[i];
    const Complex y = sweep.admittance_S[i];
    const Complex mode = shape(f, resonance_Hz, bandwidth_Hz);
    Eigen::Vector3cd column(Complex(0.0, f) / y, f / y, mode / y);
    if (!sweep.has_phase) {
      column = Eigen::Vector3cd(f * f, 2.0 * f * mode.imag(), std::norm(mode)) / std::norm(y);
    }
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
  const bool phase = sweep.has_phase;
  found.push_back({misfit,
                   {(phase ? solution(0) : std::sqrt(solution(0))) / two_pi,
                    phase ? std::max(solution(1), 0.0) / solution(0) : 0.0,
                    {{phase ? solution(2) : std::sqrt(solution(2)), resonance_Hz, bandwidth_Hz}}}});
}

/// Further modes that are tried; their conductance follows.
std::vector<Mode> further_modes(const Sweep& sweep, const CircuitFit& fit,
                                const Eigen::VectorXd& residuals) {
  const std::vector<double>& all = sweep.frequency_Hz;
  const auto readings = static_cast<std::ptrdiff_t>(all.size());
  std::vector<Mode> tried;
  const auto add = [&](std::ptrdiff_t reading, std::ptrdiff_t around) {
    const auto at = [&](std::ptrdiff_t i) {
      return all[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, readings - 1))];
    };
    const double least_Hz =
        std::max(at(reading + around) - at(reading - around), 1e-9 * at(reading));
    for (const double bandwidth_Hz : geometric(least_Hz, 3.0, 6)) {
      tried.push_back({0.0, at(reading), bandwidth_Hz});
    }
  };
  constexpr std::ptrdiff_t most_places = 60;
  const std::ptrdiff_t stride = std::max<std::ptrdiff_t>(1, readings / most_places);
  for (std::ptrdiff_t reading = 0; reading < readings; reading += stride) {
    add(reading, stride);
  }
  constexpr std::size_t most_peaks = 6;
  const auto size = [&](std::size_t reading) {
    const auto i = static_cast<Eigen::Index>(reading);
    return std::hypot(residuals(i), residuals(residuals.size() - readings + i));
  };
  for (const std::size_t i : largest_maxima(all.size(), size, most_peaks)) {
    add(static_cast<std::ptrdiff_t>(i), 1);
  }
  if (sweep.has_phase) {
    for (const double away : {0.01, 0.03, 0.06, 0.12, 0.25, 0.45}) {
      const double distance_Hz = away * (all.back() - all.front());
      for (const double resonance_Hz : {all.back() + distance_Hz, all.front() - distance_Hz}) {
        const double quality = fit.circuit.modes.front().quality();
        tried.push_back({0.0, resonance_Hz, resonance_Hz / quality});
      }
    }
  }
  return tried;
}

}  // namespace

std::vector<Start> start_circuits(const Sweep& sweep, std::size_t most) {
  const std::vector<double>& all = sweep.frequency_Hz;
  const auto height = [&](std::size_t i) {
    const Complex y = sweep.admittance_S[i];
    return (sweep.has_phase ? y.real() : std::abs(y)) / all[i];
  };
  constexpr std::size_t most_places = 8;
  std::vector<Start> found;
  for (const std::size_t i : largest_maxima(all.size(), height, most_places)) {
    const double below_Hz = all[i > 0 ? i - 1 : i];
    const double above_Hz = all[i + 1 < all.size() ? i + 1 : i];
    for (const double place_Hz : {all[i], 0.5 * (all[i] + below_Hz), 0.5 * (all[i] + above_Hz)}) {
      for (const double bandwidth_Hz : geometric(place_Hz / 3.0, 0.35, 12)) {
        try_start(sweep, place_Hz, bandwidth_Hz, found);
      }
    }
  }
  return best_of(std::move(found), most);
}

std::vector<Start> starts_with_another_mode(const Sweep& sweep, const CircuitFit& fit, double least,
                                            std::size_t most) {
  const auto n = static_cast<Eigen::Index>(sweep.frequency_Hz.size());
  Eigen::MatrixXd base = fit.at.jacobian;
  Eigen::VectorXd residuals = fit.at.residuals;
  whiten(fit.noise, fit.at, base);
  whiten(fit.noise, fit.at, residuals);
  base.colwise().normalize();
  base = Eigen::HouseholderQR<Eigen::MatrixXd>(base).householderQ() *
         Eigen::MatrixXd::Identity(base.rows(), base.cols());
  Eigen::VectorXcd seen(n);  // d ln Y for each 1 S behind the lead
  Eigen::VectorXcd derivatives;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double f = sweep.frequency_Hz[static_cast<std::size_t>(i)];
    const Complex y = fit.circuit.admittance_S(f, &derivatives);
    seen(i) = derivatives(index_of(Part::loss_tangent)) /
              (two_pi * f * fit.circuit.clamped_capacitance_F * y);
  }
  std::vector<Start> found;
  Eigen::VectorXd column(residuals.size());
  for (Mode& added : further_modes(sweep, fit, residuals)) {
    // Apart by its own band width: a mode that hides others is too wide until they are fitted.
    added.conductance_S = std::numeric_limits<double>::infinity();
    if (added.resonance_Hz <= 0.0 || added.quality() < 1.0 ||
        !is_apart(sweep, fit.circuit, added)) {
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
    if (length > 0.0 && along > 0.0 && along * along > least * fit.variance * length) {
      added.conductance_S = along / length;
      found.push_back({-along * along / length, fit.circuit});
      found.back().circuit.modes.push_back(added);
    }
  }
  return best_of(std::move(found), most);
}

}  // namespace sonoglide::identify::impedance
