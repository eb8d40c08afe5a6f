#include "tests/host_sim/studies/identify/friction/synthetic/synthetic.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <random>

namespace sonoglide::identify::friction::synthetic {
namespace {

constexpr int count = 24;
constexpr double noise = 0.01;

/// The distributions are this file's own: the same numbers with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    constexpr double unit = 1.0 / 9007199254740992.0;
    return low + (high - low) * (static_cast<double>(engine_() >> 11U) + 0.5) * unit;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform(0.0, 1.0)));
    return radius * std::cos(6.283185307179586 * uniform(0.0, 1.0));
  }

 private:
  std::mt19937_64 engine_;
};

Readings design(const Kind& kind) {
  Readings readings{};
  readings.are_forces = kind.are_forces;
  readings.have_frequency = true;
  const double fastest = kind.law == "stribeck" ? 2.0 : 1.0;
  for (int i = 0; i < count; ++i) {
    const double ratio = 0.05 + fastest * (i + 0.5) / count;
    readings.rows.push_back({0.1 * ratio, 0.1, 26e3, kind.are_forces ? 2.0 : 1.0, 0.0});
  }
  return readings;
}

std::vector<double> truth(const Kind& kind, const Extent& extent, Random& random) {
  if (kind.law == "stribeck") {
    return {random.uniform(0.2, 0.8), random.uniform(0.08, 0.16)};
  }
  if (kind.law == "normal_coulomb") {
    return {random.uniform(0.3, 0.9) / extent.largest_length, random.uniform(0.5, 1.2)};
  }
  return {random.log_uniform(0.3, 4.0) / extent.largest_length};
}

/// A smooth random function, of standard deviation 1.
Eigen::VectorXd smooth(double length, Random& random) {
  Eigen::MatrixXd covariance(count, count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const double distance = (i - j) / (length * count);
      covariance(i, j) = std::exp(-0.5 * distance * distance) + (i == j ? 1e-9 : 0.0);
    }
  }
  Eigen::VectorXd white(count);
  for (double& each : white) {
    each = random.normal();
  }
  return covariance.llt().matrixL() * white;
}

}  // namespace

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list = {{"dahl ratio", "dahl", false, 0.5},
                                         {"dahl force", "dahl", true, 0.5},
                                         {"iwan ratio", "iwan", false, 0.5},
                                         {"stribeck ratio", "stribeck", false, 0.5},
                                         {"normal ratio", "normal_coulomb", false, 0.5},
                                         {"dahl, no misfit", "dahl", false, 0.0},
                                         {"dahl, always misfit", "dahl", false, 1.0}};
  return list;
}

std::vector<bool> covered(const Kind& kind, unsigned set) {
  Random random(7919U * (set + 1U));
  Readings readings = design(kind);
  const Extent extent = extent_of(readings);
  const std::vector<Candidate> all = candidates(extent);
  const Candidate& law = *std::find_if(all.begin(), all.end(),
                                       [&](const Candidate& each) { return each.law == kind.law; });
  const std::vector<double> values = truth(kind, extent, random);
  const auto shapes = static_cast<Eigen::Index>(values.size());
  Eigen::VectorXd logs(shapes + (kind.are_forces ? 1 : 0));
  for (Eigen::Index i = 0; i < shapes; ++i) {
    logs(i) = std::log(values[static_cast<std::size_t>(i)]);
  }
  const double limit = kind.are_forces ? 2.0 : 1.0;
  if (kind.are_forces) {
    logs(shapes) = std::log(limit);
  }
  const bool has_misfit = random.uniform(0.0, 1.0) < kind.misfit_probability;
  const double misfit = has_misfit ? noise * random.log_uniform(1.0, 10.0) : 0.0;
  const Eigen::VectorXd shape = smooth(random.log_uniform(0.08, 0.2), random);
  const Eigen::VectorXd exact = LawProblem(readings, law).friction(logs);
  for (int i = 0; i < count; ++i) {
    readings.rows[static_cast<std::size_t>(i)].friction =
        exact(i) + limit * (misfit * shape(i) + noise * random.normal());
  }
  const LawProblem problem(readings, law);
  const LawProblem::Solution best = problem.solve();
  const std::vector<Scatter> scattered = scatters(readings);
  const std::vector<LogInterval> ends = intervals(
      problem, best.logs, scattered,
      probabilities(scattered, problem.residuals(best.logs), problem.jacobian(best.logs)));
  std::vector<bool> has(ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double at = logs(static_cast<Eigen::Index>(i));
    // An open end has every value.
    has[i] = !(ends[i].low > at) && !(ends[i].high < at);
  }
  return has;
}

}  // namespace sonoglide::identify::friction::synthetic
