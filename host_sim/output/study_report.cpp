#include "host_sim/output/study_report.hpp"

#include "host_sim/process/output_folder.hpp"

namespace sonoglide::output {

void write(const std::filesystem::path& folder, const StudyReport& report) {
  process::OutputFolder files(folder);
  for (const auto& [name, content] : report.files) {
    if (content.empty()) {
      files.withdraw(name);
    } else {
      files.write(name, content);
    }
  }
  files.commit();
}

}  // namespace sonoglide::output
