#include "host_sim/studies/robust/report.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace sonoglide::robust {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// NaN is above all.
bool below(double a, double b) {
  return std::isnan(b) ? !std::isnan(a) : a < b;
}

/// Largest difference that is rounding, relative.
constexpr double rounding = 1e-12;

double at(const std::vector<double>& rising, double part) {
  const auto place =
      static_cast<std::size_t>(std::ceil(part * static_cast<double>(rising.size()) - 1e-9));
  return rising[std::clamp<std::size_t>(place, 1, rising.size()) - 1];
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

Quantiles quantiles(std::vector<double> values) {
  std::sort(values.begin(), values.end(), below);
  return {at(values, 0.5), at(values, 0.95), at(values, 0.99), values.back()};
}

double failure_probability_upper(std::size_t failures, std::size_t runs, double confidence) {
  if (failures >= runs) {
    return 1.0;
  }
  return boost::math::ibeta_inv(static_cast<double>(failures + 1),
                                static_cast<double>(runs - failures), confidence);
}

bool is_one_value(double lowest, double highest) {
  return highest - lowest <= rounding * std::max(std::abs(lowest), std::abs(highest));
}

Ranks::Ranks(const std::vector<double>& values) : places(values.size()) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return below(values[a], values[b]); });
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && (!below(values[order[begin]], values[order[end]]) ||
                                  is_one_value(values[order[begin]], values[order[end]]))) {
      ++end;
    }
    for (std::size_t i = begin; i < end; ++i) {
      places[order[i]] = 0.5 * static_cast<double>(begin + end - 1);
    }
    begin = end;
  }
}

double rank_correlation(const Ranks& a, const Ranks& b) {
  const std::vector<double>& x = a.places;
  const std::vector<double>& y = b.places;
  const double x_mean = mean(x);
  const double y_mean = mean(y);
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - x_mean) * (x[i] - x_mean);
    yy += (y[i] - y_mean) * (y[i] - y_mean);
    xy += (x[i] - x_mean) * (y[i] - y_mean);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : undefined;
}

namespace {

std::size_t classes_of(std::size_t count) {
  constexpr std::size_t most_classes = 32;
  return std::min(most_classes, static_cast<std::size_t>(std::sqrt(static_cast<double>(count))));
}

}  // namespace

double effect_of_chance(std::size_t count) {
  return (static_cast<double>(classes_of(count)) - 1.0) / static_cast<double>(count);
}

double main_effect(const Ranks& x, const Ranks& y) {
  constexpr std::size_t fewest = 32;
  const std::vector<double>& x_rank = x.places;
  const std::vector<double>& y_rank = y.places;
  const std::size_t count = x_rank.size();
  if (count < fewest) {
    return undefined;
  }
  const std::size_t classes = classes_of(count);
  std::vector<double> sum(classes, 0.0);
  std::vector<double> size(classes, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto place = static_cast<std::size_t>(x_rank[i] * static_cast<double>(classes) /
                                                static_cast<double>(count));
    sum[place] += y_rank[i];
    size[place] += 1.0;
  }
  const double y_mean = mean(y_rank);
  double between = 0.0;
  double all = 0.0;
  double used = 0.0;
  for (std::size_t i = 0; i < classes; ++i) {
    used += size[i] > 0.0 ? 1.0 : 0.0;
    between += size[i] > 0.0 ? sum[i] * sum[i] / size[i] : 0.0;
  }
  between -= y_mean * y_mean * static_cast<double>(count);
  for (const double rank : y_rank) {
    all += (rank - y_mean) * (rank - y_mean);
  }
  if (!(all > 0.0)) {
    return undefined;
  }
  const double within = (all - between) / (static_cast<double>(count) - used);
  return std::clamp((between - (used - 1.0) * within) / all, 0.0, 1.0);
}

}  // namespace sonoglide::robust
