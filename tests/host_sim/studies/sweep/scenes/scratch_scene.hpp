/// A scene file in a folder of its own.
#pragma once

#include <filesystem>
#include <string>

namespace sonoglide::sweep {

/// Gone, with all that was put beside it, with its owner.
class ScratchScene {
 public:
  explicit ScratchScene(const std::string& text);
  ~ScratchScene();
  ScratchScene(const ScratchScene&) = delete;
  ScratchScene& operator=(const ScratchScene&) = delete;

  std::filesystem::path file() const { return folder_ / "scene.toml"; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

}  // namespace sonoglide::sweep
