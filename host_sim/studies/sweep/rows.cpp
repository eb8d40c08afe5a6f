#include "host_sim/studies/sweep/rows.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <cstddef>
#include <numeric>
#include <utility>

#include "host_sim/studies/sweep/solve.hpp"

namespace sonoglide::sweep {

std::vector<PointResult> compute_rows(const Plan& plan, unsigned threads) {
  const tbb::global_control limit(
      tbb::global_control::max_allowed_parallelism,
      threads > 0 ? threads : static_cast<std::size_t>(tbb::info::default_concurrency()));
  const Solve solve(plan, plan.all(), nullptr);
  std::vector<PointResult> rows(plan.grid().size());
  Points all(rows.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  solve_all(solve, all, [&](std::vector<Record> records) {
    for (Record& record : records) {
      rows[record.point] = std::move(record.row);
    }
  });
  return rows;
}

}  // namespace sonoglide::sweep
