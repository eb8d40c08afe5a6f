/// The paper's figures and balance as data, pictures and one page.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/paper/figures.hpp"

namespace sonoglide::paper {

/// What is no figure.
struct Findings {
  std::vector<PrintedFault> faults;
  std::vector<Balance> balances;
};

/// @param findings  left out where empty
output::Page paper_page(const std::vector<Figure>& figures, const Findings& findings);

using Progress = std::function<void(double fraction)>;

/// Writes of each figure figure_NN.csv, figure_NN.svg and whatever else it has, balance.csv,
/// table_1.toml, table_2.toml and index.html; of one figure alone its own files, the two scenes and
/// the page.
/// @param figure  one of figure_list(); absent: all of them, and the balance
/// @throws output::OutputError, process::ProcessError, loop::ComputationError; nothing is written
/// then
void write_paper(const std::filesystem::path& out, std::optional<int> figure,
                 const Progress& progress);

}  // namespace sonoglide::paper
