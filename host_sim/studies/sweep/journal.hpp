/// The finished points of a sweep on disk, so that one that was killed can go on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "host_sim/long_work/journal.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

using long_work::ForeignJournal;
/// The options are the axes, the scene that of the first point.
using long_work::Identity;

class Journal {
 public:
  /// Opens the journal of this folder, or begins one; nobody else can until this is destroyed.
  /// @param folder  exists
  /// @param points  records of points from here on count as damaged
  /// @throws ForeignJournal, output::OutputError
  Journal(const std::filesystem::path& folder, const Identity& identity, std::size_t points);

  /// What was found on opening, in no particular order.
  const std::vector<Record>& finished() const { return finished_; }

  /// Finished points as append() takes them.
  static std::string text_of(const std::vector<Record>& records);

  /// @param text  from text_of()
  /// @throws output::OutputError
  void append(const std::string& text) { journal_.append(text); }

  /// The sweep is whole: removes the file.
  void remove() { journal_.remove(); }

 private:
  std::vector<Record> finished_;
  long_work::Journal journal_;
};

}  // namespace sonoglide::sweep
