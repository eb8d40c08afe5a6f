/// A whole sweep: from options to files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "host_sim/studies/sweep/journal.hpp"
#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/progress.hpp"

namespace sonoglide::sweep {

struct Summary {
  std::size_t points;
  std::size_t failed;
  std::size_t found_finished;  ///< by an earlier, interrupted sweep
  double wall_s;               ///< to read all points and compute those that were left
};

/// Checks every point's scene, computes the points that the journal in the folder does not hold
/// yet, and writes sweep.csv, sweep.svg (one or two drawn axes) and report.html, all or none; the
/// journal goes last. The files of an interrupted sweep that is run again are those of one that was
/// not.
///
/// @param program  name and version: a journal of another program is refused
/// @param threads  0: one for each core
/// @throws scene::SceneError  nothing was written
/// @throws ForeignJournal, report::OutputError, process::ProcessError
Summary run_sweep(const Plan& plan, const std::filesystem::path& out, const std::string& program,
                  unsigned threads, const Progress& progress);

}  // namespace sonoglide::sweep
