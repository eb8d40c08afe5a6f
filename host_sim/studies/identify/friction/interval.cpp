#include "host_sim/studies/identify/friction/comparison.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "host_sim/studies/identify/distributions.hpp"

namespace sonoglide::identify::friction {
namespace {

constexpr double open_end = std::numeric_limits<double>::quiet_NaN();

/// The parameters under one scatter.
struct Branch {
  const Scatter* scatter;
  double probability;
  LawProblem::Solution best;
  Eigen::VectorXd last;  ///< where the last profile ended, from which the next one starts
};

class Profile {
 public:
  Profile(const LawProblem& problem, const Eigen::VectorXd& best,
          const std::vector<Scatter>& scatters, const std::vector<double>& probabilities)
      : problem_(problem),
        freedom_(static_cast<double>(problem.readings() - problem.parameters())) {
    constexpr double negligible = 0.02;
    double total = 0.0;
    for (std::size_t i = 0; i < probabilities.size(); ++i) {
      if (probabilities[i] >= negligible) {
        const Scatter& scatter = scatters[i];
        branches_.push_back({&scatter, probabilities[i], problem.solve(scatter, best), {}});
        total += probabilities[i];
      }
    }
    for (Branch& each : branches_) {
      each.probability /= total;
    }
  }

  LogInterval of(Eigen::Index parameter, double first_step) {
    const LawProblem::Range& range = problem_.range(parameter);
    return {end(parameter, -1.0, range.least, first_step),
            end(parameter, 1.0, range.most, first_step)};
  }

 private:
  /// Student's t with the probability that the parameter is below a value.
  double t_at(Eigen::Index parameter, double log) {
    double below = 0.0;
    for (Branch& each : branches_) {
      below += each.probability * student_t_probability(freedom_, t_at(each, parameter, log));
    }
    constexpr double least = 1e-12;
    return student_t_quantile(freedom_, std::clamp(below, least, 1.0 - least));
  }

  double t_at(Branch& branch, Eigen::Index parameter, double log) const {
    Eigen::VectorXd start = branch.last;
    start(parameter) = log;
    const LawProblem::Solution solution = problem_.solve(*branch.scatter, start, parameter);
    branch.last = solution.logs;
    const double variance = std::max({branch.best.sum_of_squares / freedom_,
                                      problem_.stated_variance(), problem_.least_variance()});
    const double more = std::max(0.0, solution.sum_of_squares - branch.best.sum_of_squares);
    constexpr double most = 1e9;
    const double t = std::min(std::sqrt(more / variance), most);
    return log < branch.best.logs(parameter) ? -t : t;
  }

  /// Outwards in growing steps, then by TOMS 748 until t is met within its accuracy.
  double end(Eigen::Index parameter, double side, double limit, double step) {
    for (Branch& each : branches_) {
      each.last = each.best.logs;
    }
    const double wanted = student_t_95(freedom_);
    const auto missing = [&](double log) {
      constexpr double accuracy = 2e-3;
      const double value = side * t_at(parameter, log) - wanted;
      return std::abs(value) < accuracy ? 0.0 : value;  // 0 ends the search
    };
    double inner = branches_.front().best.logs(parameter);
    double at_inner = missing(inner);
    double outer = inner;
    double at_outer = at_inner;
    while (at_outer < 0.0) {
      if (outer == limit) {
        return open_end;
      }
      inner = outer;
      at_inner = at_outer;
      outer = side < 0.0 ? std::max(outer - step, limit) : std::min(outer + step, limit);
      step *= 2.0;
      at_outer = missing(outer);
    }
    if (at_inner >= 0.0) {
      return outer;
    }
    std::uintmax_t evaluations = 40;
    const boost::math::tools::eps_tolerance<double> narrow(40);
    const auto [low, high] =
        side < 0.0 ? boost::math::tools::toms748_solve(missing, outer, inner, at_outer, at_inner,
                                                       narrow, evaluations)
                   : boost::math::tools::toms748_solve(missing, inner, outer, at_inner, at_outer,
                                                       narrow, evaluations);
    return 0.5 * low + 0.5 * high;
  }

  const LawProblem& problem_;
  double freedom_;  ///< degrees of freedom
  std::vector<Branch> branches_;
};

}  // namespace

std::vector<LogInterval> intervals(const LawProblem& problem, const Eigen::VectorXd& best,
                                   const std::vector<Scatter>& scatters,
                                   const std::vector<double>& probabilities) {
  const auto count = static_cast<std::size_t>(problem.parameters());
  if (problem.readings() <= problem.parameters() || !problem.is_determined() || count == 0) {
    return std::vector<LogInterval>(count, {open_end, open_end});
  }
  Profile profile(problem, best, scatters, probabilities);
  const Eigen::MatrixXd covariance = inverse_normal_matrix(problem.jacobian(best)) *
                                     problem.residuals(best).squaredNorm() /
                                     static_cast<double>(problem.readings() - problem.parameters());
  std::vector<LogInterval> all;
  for (Eigen::Index i = 0; i < problem.parameters(); ++i) {
    const double width = problem.range(i).most - problem.range(i).least;
    const double step = 2.0 * std::sqrt(covariance(i, i));
    all.push_back(profile.of(
        i, std::isfinite(step) ? std::clamp(step, 1e-6 * width, 0.1 * width) : 0.1 * width));
  }
  return all;
}

}  // namespace sonoglide::identify::friction
