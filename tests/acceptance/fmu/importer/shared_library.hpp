/// A shared library while it is loaded.
#pragma once

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace sonoglide::acceptance {

class SharedLibrary {
 public:
  explicit SharedLibrary(const std::string& path)
      : handle_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (handle_ == nullptr) {
      throw std::runtime_error(dlerror());
    }
  }
  ~SharedLibrary() { dlclose(handle_); }
  SharedLibrary(const SharedLibrary&) = delete;
  SharedLibrary& operator=(const SharedLibrary&) = delete;

  template <class Function>
  Function* function(const char* name) const {
    void* found = dlsym(handle_, name);
    if (found == nullptr) {
      throw std::runtime_error(std::string("no function ") + name);
    }
    return reinterpret_cast<Function*>(found);
  }

 private:
  void* handle_;
};

}  // namespace sonoglide::acceptance
