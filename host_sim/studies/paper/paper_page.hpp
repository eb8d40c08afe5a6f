/// The page on which the paper's claims stand beside our figures.
#pragma once

#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/paper/balance.hpp"
#include "host_sim/studies/paper/faults.hpp"
#include "host_sim/studies/paper/figure.hpp"

namespace sonoglide::paper {

/// What is no figure.
struct Findings {
  std::vector<Fault> faults;
  std::vector<Balance> balances;
};

/// @param findings  left out where empty
output::Page paper_page(const std::vector<Figure>& figures, const Findings& findings);

}  // namespace sonoglide::paper
