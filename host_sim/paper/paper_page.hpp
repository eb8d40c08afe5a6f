/// The page on which the paper's claims stand beside our figures.
#pragma once

#include <vector>

#include "host_sim/paper/balance.hpp"
#include "host_sim/paper/faults.hpp"
#include "host_sim/paper/figure.hpp"
#include "host_sim/report/page.hpp"

namespace sonoglide::paper {

/// What is no figure.
struct Findings {
  std::vector<Fault> faults;
  std::vector<Balance> balances;
};

/// @param findings  left out where empty
report::Page paper_page(const std::vector<Figure>& figures, const Findings& findings);

}  // namespace sonoglide::paper
