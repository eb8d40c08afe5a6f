#include "host_sim/work_precision/gauss_contenders.hpp"

#include "firmware/plant/event_gauss.hpp"
#include "host_sim/work_precision/composed.hpp"

namespace sonoglide::work_precision {
namespace {

template <std::size_t Nodes>
struct WithNodes {
  template <class Model>
  using Solver = plant::EventGauss<Model, Nodes>;
};

}  // namespace

using Made = std::unique_ptr<peers::Contender>;

template <class Scalar, std::size_t Nodes>
Made event_gauss(const peers::Problem& problem, double tolerance) {
  return compose<WithNodes<Nodes>::template Solver, Scalar>(problem, tolerance);
}

template Made event_gauss<double, 8>(const peers::Problem& problem, double tolerance);
template Made event_gauss<double, 12>(const peers::Problem& problem, double tolerance);
template Made event_gauss<float, 8>(const peers::Problem& problem, double tolerance);

}  // namespace sonoglide::work_precision
