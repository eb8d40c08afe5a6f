/// A scene as Python holds it.
#pragma once

#include <string>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/scene_file/source.hpp"

namespace sonoglide::python {

/// With the text that it was read from, so that it can be read again elsewhere.
struct Scene {
  /// @throws scene_file::SceneError
  Scene(scene_file::Source text, std::vector<std::string> changes);

  scene_file::Source source;
  std::vector<std::string> overrides;
  experiment::Experiment experiment;
};

}  // namespace sonoglide::python
