/// The file in which a trace is saved.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host_sim/boards/unit/step_response.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"
#include "host_sim/boards/unit/unit_trace.hpp"
#include "host_sim/process/output_folder.hpp"

namespace sonoglide::unit {

/// A name that ends with .html is that of a page, any other that of a table, CSV.
class TraceFile {
 public:
  /// @param name  of a new file
  /// @throws process::FileError  it is there already, is a folder, or cannot be written
  explicit TraceFile(const std::string& name);

  /// @param caveat  of a page, see Console
  /// @throws process::FileError  the file system refuses; there is no file then
  void write(const RecordedTrace& trace, const UnitScales& scales,
             const std::optional<StepResponse>& response, const std::string& caveat);

 private:
  std::filesystem::path path_;
  process::OutputFolder folder_;
};

}  // namespace sonoglide::unit
