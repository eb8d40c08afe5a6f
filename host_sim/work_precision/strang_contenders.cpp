#include "host_sim/work_precision/strang_contenders.hpp"

#include "firmware/plant/adaptive_strang.hpp"
#include "host_sim/work_precision/composed.hpp"

namespace sonoglide::work_precision {

using Made = std::unique_ptr<peers::Contender>;

template <class Scalar>
Made strang(const peers::Problem& problem, double tolerance) {
  return compose<plant::AdaptiveStrang, Scalar>(problem, tolerance);
}

template Made strang<double>(const peers::Problem& problem, double tolerance);
template Made strang<float>(const peers::Problem& problem, double tolerance);

}  // namespace sonoglide::work_precision
