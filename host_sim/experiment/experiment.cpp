#include "host_sim/experiment/experiment.hpp"

#include <optional>
#include <utility>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/scene_file/reader.hpp"

namespace sonoglide::experiment {

Experiment read(const scene_file::Document& document,
                const std::vector<scene_file::VariedValue>& values,
                scene_file::UnusedKeys* unused) {
  scene::Scene stated = scene_file::read(document, values, unused);
  std::optional<scene::Scene> plant;
  if (!stated.true_values.empty()) {
    plant = scene_file::read_truth(document, values, stated);
  }
  try {
    return configure::make_experiment(std::move(stated), std::move(plant));
  } catch (const configure::ConfigurationError& error) {
    throw scene_file::SceneError(document.place_of(error.key()), error.key(), error.what());
  }
}

Experiment read(const scene_file::Source& source, const std::vector<std::string>& overrides) {
  return experiment::read(scene_file::Document(source, overrides));
}

Experiment read_text(std::string_view text, const std::string& file,
                     const std::vector<std::string>& overrides) {
  return experiment::read(scene_file::Source{file, std::string(text)}, overrides);
}

Experiment read_file(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  return experiment::read(scene_file::read_source(path), overrides);
}

}  // namespace sonoglide::experiment
