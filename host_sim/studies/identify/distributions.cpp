#include "host_sim/studies/identify/distributions.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace sonoglide::identify {

double student_t_probability(double degrees_of_freedom, double t) {
  return boost::math::cdf(boost::math::students_t(degrees_of_freedom), t);
}

double student_t_quantile(double degrees_of_freedom, double probability) {
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), probability);
}

double student_t_95(double degrees_of_freedom) {
  return student_t_quantile(degrees_of_freedom, 0.975);
}

double chi_squared_above(double degrees_of_freedom, double value) {
  return boost::math::cdf(
      boost::math::complement(boost::math::chi_squared(degrees_of_freedom), value));
}

}  // namespace sonoglide::identify
