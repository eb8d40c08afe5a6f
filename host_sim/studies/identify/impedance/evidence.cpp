#include "host_sim/studies/identify/impedance/evidence.hpp"

#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

namespace sonoglide::identify::impedance {

double chance(const CircuitFit& smaller, const CircuitFit& larger) {
  const auto rows = static_cast<double>(larger.at.residuals.size());
  const double freedom = rows - static_cast<double>(larger.p.size());
  const auto more = static_cast<double>(larger.p.size() - smaller.p.size());
  const double f = std::expm1((smaller.deviance - larger.deviance) / rows) * freedom / more;
  return f > 0.0 && std::isfinite(f)
             ? boost::math::cdf(boost::math::complement(boost::math::fisher_f(more, freedom), f))
             : (f > 0.0 ? 0.0 : 1.0);
}

double penalty(const CircuitFit& fit) {
  return static_cast<double>(fit.p.size()) * std::log(static_cast<double>(fit.at.residuals.size()));
}

}  // namespace sonoglide::identify::impedance
