#include "host_sim/work_precision/taylor_definition.hpp"

namespace sonoglide::work_precision {

using Made = std::unique_ptr<peers::Contender>;

template Made event_taylor<double, 8>(const peers::Problem& problem, double tolerance);
template Made event_taylor<double, 12>(const peers::Problem& problem, double tolerance);
template Made event_taylor<double, 16>(const peers::Problem& problem, double tolerance);
template Made event_taylor<double, 20>(const peers::Problem& problem, double tolerance);

}  // namespace sonoglide::work_precision
