#include "host_sim/studies/identify/friction/law_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonoglide::identify::friction {
namespace {

/// A logarithm in its range as the sine of a free number: the solver knows no ranges.
struct Bend {
  double middle;
  double half;

  explicit Bend(const LawProblem::Range& range)
      : middle(0.5 * (range.least + range.most)), half(0.5 * (range.most - range.least)) {}
  double log_of(double free) const { return middle + half * std::sin(free); }
  double free_of(double log) const {
    return std::asin(std::clamp((log - middle) / half, -1.0, 1.0));
  }
};

}  // namespace

LawProblem::LawProblem(const Readings& readings, const Candidate& candidate)
    : readings_(readings),
      candidate_(candidate),
      measured_(this->readings()),
      weights_(this->readings()),
      white_(readings, 0.0, 1.0, 1.0) {
  for (const ShapeParameter& each : candidate.shape) {
    ranges_.push_back({std::log(each.least), std::log(each.most)});
  }
  double inverses = 0.0;
  for (Eigen::Index i = 0; i < measured_.size(); ++i) {
    const Reading& row = readings.rows[static_cast<std::size_t>(i)];
    measured_(i) = row.friction;
    weights_(i) = readings.have_standard_errors ? 1.0 / row.standard_error : 1.0;
    inverses += weights_(i);
  }
  const double mean = inverses / static_cast<double>(weights_.size());
  weights_ /= mean;
  stated_variance_ = readings.have_standard_errors ? 1.0 / (mean * mean) : 0.0;
  constexpr double exact_to = 1e-6;
  least_variance_ =
      std::pow(std::max(readings.rounding, exact_to * measured_.cwiseAbs().maxCoeff()), 2);
  if (readings.are_forces) {
    const double largest = std::log(measured_.cwiseAbs().maxCoeff());
    ranges_.push_back({largest - 7.0, largest + 7.0});
  }
}

/// Over the friction limit where the readings are forces.
double LawProblem::shape_friction(const Reading& row, const Eigen::VectorXd& logs) const {
  std::vector<double> values(candidate_.shape.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = std::exp(logs(static_cast<Eigen::Index>(i)));
  }
  const MeanFriction mean = candidate_.mean(candidate_, row, values);
  return readings_.are_forces ? mean.driven : mean.driven / mean.undriven;
}

Eigen::VectorXd LawProblem::shape_friction(const Eigen::VectorXd& logs) const {
  Eigen::VectorXd values(readings());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values(i) = shape_friction(readings_.rows[static_cast<std::size_t>(i)], logs);
  }
  return values;
}

double LawProblem::friction(const Reading& row, const Eigen::VectorXd& logs) const {
  const double limit = readings_.are_forces ? std::exp(logs(logs.size() - 1)) : 1.0;
  return limit * shape_friction(row, logs);
}

Eigen::VectorXd LawProblem::friction(const Eigen::VectorXd& logs) const {
  const double limit = readings_.are_forces ? std::exp(logs(logs.size() - 1)) : 1.0;
  return limit * shape_friction(logs);
}

Eigen::VectorXd LawProblem::residuals(const Eigen::VectorXd& logs) const {
  return (measured_ - friction(logs)).cwiseProduct(weights_);
}

Eigen::MatrixXd LawProblem::jacobian(const Eigen::VectorXd& logs) const {
  constexpr double step = 1e-4;
  Eigen::MatrixXd columns(readings(), parameters());
  for (Eigen::Index i = 0; i < parameters(); ++i) {
    Eigen::VectorXd up = logs;
    Eigen::VectorXd down = logs;
    up(i) = std::min(up(i) + step, range(i).most);
    down(i) = std::max(down(i) - step, range(i).least);
    columns.col(i) = (residuals(up) - residuals(down)) / (up(i) - down(i));
  }
  return columns;
}

LawProblem::Residuals LawProblem::whitened(const Scatter& scatter, Eigen::VectorXd logs,
                                           bool limit_is_free) const {
  Eigen::MatrixXd columns(readings(), 2);
  columns.col(0) = measured_.cwiseProduct(weights_);
  columns.col(1) = shape_friction(logs).cwiseProduct(weights_);
  scatter.whiten(columns);
  double limit = 1.0;
  if (readings_.are_forces) {
    const Eigen::Index last = logs.size() - 1;
    if (limit_is_free) {
      const double best = columns.col(1).dot(columns.col(0)) / columns.col(1).squaredNorm();
      const Range& allowed = ranges_.back();
      logs(last) =
          best > 0.0 ? std::clamp(std::log(best), allowed.least, allowed.most) : allowed.least;
    }
    limit = std::exp(logs(last));
  }
  return {columns.col(0) - limit * columns.col(1), std::move(logs)};
}

LawProblem::Solution LawProblem::solve(const Scatter& scatter, const Eigen::VectorXd& start,
                                       std::optional<Eigen::Index> held) const {
  const auto shapes = static_cast<Eigen::Index>(candidate_.shape.size());
  const bool limit_is_free = readings_.are_forces && held != shapes;
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < shapes; ++i) {
    if (i != held) {
      free.push_back(i);
    }
  }
  if (free.empty()) {
    const Residuals at_start = whitened(scatter, start, limit_is_free);
    return {at_start.logs, at_start.whitened.squaredNorm()};
  }
  const auto count = static_cast<Eigen::Index>(free.size());
  const auto logs_of = [&](const Eigen::VectorXd& bent) {
    Eigen::VectorXd logs = start;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Index parameter = free[static_cast<std::size_t>(i)];
      logs(parameter) = Bend(range(parameter)).log_of(bent(i));
    }
    return logs;
  };
  const auto at = [&](const Eigen::VectorXd& bent) {
    return whitened(scatter, logs_of(bent), limit_is_free);
  };
  // As many residuals as parameters at least, as the solver wants: the others are 0.
  const Eigen::Index rows = std::max(readings(), count);
  const LeastSquares problem = {
      rows, count, [&](const Eigen::VectorXd& bent, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
        r.setZero(rows);
        r.head(readings()) = at(bent).whitened;
        if (jacobian == nullptr) {
          return;
        }
        constexpr double step = 1e-5;
        jacobian->setZero(rows, count);
        for (Eigen::Index i = 0; i < count; ++i) {
          Eigen::VectorXd moved = bent;
          moved(i) += step;
          const Eigen::VectorXd up = at(moved).whitened;
          moved(i) -= 2.0 * step;
          jacobian->col(i).head(readings()) = (up - at(moved).whitened) / (2.0 * step);
        }
      }};
  Eigen::VectorXd bent(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index parameter = free[static_cast<std::size_t>(i)];
    // On an end itself the residuals do not feel it.
    constexpr double off_the_end = 1.5;
    bent(i) =
        std::clamp(Bend(range(parameter)).free_of(start(parameter)), -off_the_end, off_the_end);
  }
  // Of the sum of squares, far below what an interval feels.
  constexpr double accuracy = 1e-6;
  // In a valley that is flat the search does not end.
  constexpr int most_evaluations = 40;
  const LeastSquaresFit fit = minimise(problem, bent, accuracy, most_evaluations);
  return {at(fit.parameters).logs, fit.sum_of_squares};
}

/// A grid over the shape parameters, their ends among them.
/// @param first, others  steps of the first one and of each other; 0: it keeps its least
std::vector<Eigen::VectorXd> LawProblem::grid(int first, int others) const {
  std::vector<Eigen::VectorXd> points = {Eigen::VectorXd::Zero(parameters())};
  for (std::size_t parameter = 0; parameter < candidate_.shape.size(); ++parameter) {
    const auto at = static_cast<Eigen::Index>(parameter);
    const int steps = parameter == 0 ? first : others;
    std::vector<Eigen::VectorXd> more;
    for (const Eigen::VectorXd& each : points) {
      for (int step = 0; step <= steps; ++step) {
        const double part = static_cast<double>(step) / std::max(steps, 1);
        more.push_back(each);
        more.back()(at) = range(at).least + part * (range(at).most - range(at).least);
      }
    }
    points = std::move(more);
  }
  return points;
}

/// The best of some points, made better.
LawProblem::Solution LawProblem::best_from(const std::vector<Eigen::VectorXd>& points,
                                           std::size_t most_tries) const {
  std::vector<Solution> tries;
  for (const Eigen::VectorXd& each : points) {
    const Residuals at_start = whitened(white_, each, readings_.are_forces);
    tries.push_back({at_start.logs, at_start.whitened.squaredNorm()});
  }
  const auto is_better = [](const Solution& a, const Solution& b) {
    return a.sum_of_squares < b.sum_of_squares;
  };
  std::sort(tries.begin(), tries.end(), is_better);
  tries.resize(std::min(tries.size(), most_tries));
  for (Solution& each : tries) {
    const Solution better = solve(white_, each.logs);
    if (is_better(better, each)) {
      each = better;
    }
  }
  return *std::min_element(tries.begin(), tries.end(), is_better);
}

LawProblem::Solution LawProblem::solve() const {
  const std::size_t shapes = candidate_.shape.size();
  // Its valleys may be narrow. With the others at their least a law is a simpler one.
  constexpr int fine = 28;
  Solution simple = best_from(grid(fine, 0), 4);
  if (shapes < 2) {
    return simple;
  }
  Solution full = best_from(shapes > 2 ? grid(8, 4) : grid(8, 8), 10);
  return simple.sum_of_squares < full.sum_of_squares ? simple : full;
}

}  // namespace sonoglide::identify::friction
