#include "tests/host_sim/studies/sweep/scenes/scratch_scene.hpp"

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace sonoglide::sweep {

ScratchScene::ScratchScene(const std::string& text) {
  std::string name = (std::filesystem::temp_directory_path() / "sonoglide_sweep_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("no scratch folder can be made");
  }
  folder_ = name;
  std::ofstream(file(), std::ios::binary) << text;
}

ScratchScene::~ScratchScene() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace sonoglide::sweep
