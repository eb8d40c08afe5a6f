#include "host_sim/boards/unit/trace_file.hpp"

#include <string_view>
#include <system_error>

#include "host_sim/boards/unit/trace_page.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/process/file_error.hpp"

namespace sonoglide::unit {
namespace {

std::filesystem::path new_file(const std::string& name) {
  if (name.empty()) {
    process::fail("FILE", "has no name; allowed: a new file");
  }
  std::filesystem::path path = std::filesystem::absolute(name);
  std::error_code unknown;
  if (path.filename().empty() || std::filesystem::is_directory(path, unknown)) {
    process::fail(name, "is a folder; allowed: a new file");
  }
  if (std::filesystem::exists(std::filesystem::symlink_status(path, unknown))) {
    process::fail(name, "is there already; allowed: a new file");
  }
  return path;
}

}  // namespace

TraceFile::TraceFile(const std::string& name)
    : path_(new_file(name)), folder_(path_.parent_path(), {path_.filename().string()}) {}

void TraceFile::write(const RecordedTrace& trace, const UnitScales& scales,
                      const std::optional<StepResponse>& response, const std::string& caveat) {
  constexpr std::string_view ending = ".html";
  const std::string name = path_.filename().string();
  const bool is_page = name.size() >= ending.size() &&
                       name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  folder_.write(name, is_page ? output::to_html(page_of(trace, scales, response, caveat))
                              : csv_of(trace, scales));
  folder_.commit();
}

}  // namespace sonoglide::unit
