#include "host_sim/output/output_folder.hpp"

namespace sonoglide::output {

void write(const std::filesystem::path& folder, const StudyReport& report) {
  OutputFolder files(folder);
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
