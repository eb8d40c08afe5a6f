#include "host_sim/configure/read/experiment.hpp"

#include <optional>
#include <utility>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/scene_file/echo.hpp"
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

namespace {

/// Of the first of these overrides with which that key is wrong; none if it is without them too.
std::optional<scene_file::Location> culprit(const scene_file::Source& source,
                                            const std::vector<std::string>& overrides,
                                            const std::string& key) {
  std::vector<std::string> some;
  for (const std::string& each : overrides) {
    try {
      experiment::read(scene_file::Document(source, some));
    } catch (const scene_file::SceneError& error) {
      if (error.key() == key) {
        break;
      }
    }
    some.push_back(each);
  }
  return some.empty() ? std::nullopt : std::optional(scene_file::Location{"--set", some.size(), 1});
}

}  // namespace

Experiment read(const scene_file::Source& source, const std::vector<std::string>& overrides) {
  const scene_file::Document document(source, overrides);
  try {
    return experiment::read(document);
  } catch (const scene_file::SceneError& error) {
    // What an override has made unusable is told at the override, if it has no line of its own.
    if (error.file() == "--set" || document.gives(error.key())) {
      throw;
    }
    const std::optional<scene_file::Location> place = culprit(source, overrides, error.key());
    if (!place) {
      throw;
    }
    throw scene_file::SceneError(*place, error.key(), error.message());
  }
}

Experiment read_text(std::string_view text, const std::string& file,
                     const std::vector<std::string>& overrides) {
  return experiment::read(scene_file::Source{file, std::string(text)}, overrides);
}

Experiment read_file(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  return experiment::read(scene_file::read_source(path), overrides);
}

nlohmann::ordered_json echo_of(const scene::Scene& scene) {
  return scene_file::to_json(scene);
}

std::string text_of(const scene::Scene& scene) {
  return scene_file::to_toml(echo_of(scene));
}

}  // namespace sonoglide::experiment
